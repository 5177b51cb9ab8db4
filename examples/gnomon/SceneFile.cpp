#include "SceneFile.h"

#include "Errors.h"
#include "Files.h"
#include "ImageFile.h"
#include "ModelFile.h"
#include "SceneFraming.h"

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <filesystem>
#include <map>

namespace gnomon::tool
{

namespace
{

using Json = nlohmann::ordered_json;

/// Read a matrix from model to world, affine and invertible.
std::array<double, 16> readMatrix(const JsonValue& value)
{
  const std::array<double, 16> matrix = value.numbers<16>(anyCoordinate);
  if (matrix[12] != 0.0 || matrix[13] != 0.0 || matrix[14] != 0.0 || matrix[15] != 1.0)
  {
    value.fail("a row-major matrix with the last row 0, 0, 0, 1");
  }
  // With normalised rows, the determinant shows whether the matrix is singular.
  double scale = 1.0;
  for (std::size_t row = 0; row < 3; ++row)
  {
    scale *= std::hypot(matrix[4 * row], matrix[4 * row + 1], matrix[4 * row + 2]);
  }
  const double determinant = vtkMatrix4x4::Determinant(matrix.data());
  constexpr double smallestVolume = 1e-9;
  if (!(std::abs(determinant) > smallestVolume * scale))
  {
    value.fail("a matrix that can be inverted");
  }
  return matrix;
}

/// Read or write the members of an entry of "models", but its files.
/// @param color of its surfaces, if it is given
void describe(JsonMembers& members, SceneModel& model, std::optional<Vec3>& color)
{
  members.add("matrix", model.matrix, readMatrix);
  members.add("color", color, numbersIn<3>(colorChannel));
  members.add("casts", model.casts, &JsonValue::boolean);
  members.add("receives", model.receives, &JsonValue::boolean);
  members.add("one_sided", model.oneSided, &JsonValue::boolean);
}

/// Read an entry of "models": the surfaces of its file.
std::vector<SceneModel> readModel(const JsonValue& value, const std::filesystem::path& folder,
  std::map<std::string, Model>& loaded, std::vector<std::string>& notes)
{
  JsonMembers members(value);
  SceneModel entry;
  std::optional<Vec3> color;
  const JsonValue file = members.place("file");
  const JsonValue image = members.place("texture");
  describe(members, entry, color);
  members.refuseOthers();
  const std::string path = (folder / file.text()).string();
  if (loaded.find(path) == loaded.end())
  {
    file.refuseOnError([&] { loaded[path] = readModelFile(path); });
    notes.insert(notes.end(), loaded[path].notes.begin(), loaded[path].notes.end());
  }
  if (image.present())
  {
    image.refuseOnError([&] { entry.texture = readTexture((folder / image.text()).string()); });
  }
  std::vector<SceneModel> surfaces = loaded[path].surfaces;
  for (SceneModel& surface : surfaces)
  {
    const std::array<double, 16> fileFromSurface = surface.matrix;
    vtkMatrix4x4::Multiply4x4(entry.matrix.data(), fileFromSurface.data(), surface.matrix.data());
    if (color)
    {
      paint(surface, *color);
    }
    if (entry.texture)
    {
      if (!surface.surface->GetPointData()->GetTCoords())
      {
        image.refuse(path + ": has no texture coordinates");
      }
      surface.texture = entry.texture;
    }
    surface.casts = entry.casts;
    surface.receives = entry.receives;
    surface.oneSided = entry.oneSided;
  }
  return surfaces;
}

/// Write an image, if there is one, beside other files.
/// @return its name; none without one
std::optional<std::string> writeImage(
  vtkImageData* image, const std::filesystem::path& folder, const std::string& name)
{
  if (!image)
  {
    return std::nullopt;
  }
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  vtkUnsignedCharArray* const bytes = writer->GetResult();
  writeWholeFile((folder / (name + ".png")).string(),
    std::string(bytes->GetPointer(0), bytes->GetPointer(bytes->GetNumberOfValues())));
  return name + ".png";
}

/// Write a surface beside other files.
/// @return it as JSON
Json writeModel(SceneModel model, const std::filesystem::path& folder, const std::string& name)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(model.surface);
  writer->Write();
  writeWholeFile((folder / (name + ".vtp")).string(), writer->GetOutputString());
  std::optional<Vec3> color = Vec3();
  model.property->GetColor(color->data());
  Json json = { { "file", name + ".vtp" } };
  JsonMembers members(json);
  describe(members, model, color);
  members.write(
    "texture", writeImage(model.texture ? model.texture->GetInput() : nullptr, folder, name));
  return json;
}

void describeWhole(JsonMembers& members, SceneCamera& camera)
{
  describe(members, camera, true);
}

/// Read or write what surrounds the models, but for the lights.
void describe(JsonMembers& members, Scene& scene, std::optional<double>& ambient)
{
  members.add("background", scene.background, numbersIn<3>(colorChannel));
  members.add("sky", scene.sky, numberIn({ 0.0, 1e30 }));
  members.add("glass", scene.isGlass, &JsonValue::boolean);
  members.add("ambient", ambient, numberIn({ 0.0, 1.0 }));
}

} // namespace

//------------------------------------------------------------------------------
std::optional<double> readSurroundings(
  JsonMembers& members, const std::filesystem::path& folder, Scene& scene)
{
  members.addObject("camera", scene.camera, describeWhole);
  for (const JsonValue& light : members.place("lights").elementsOrNone())
  {
    JsonMembers ofLight(light);
    std::optional<std::string> texture;
    describe(ofLight, scene.lights.emplace_back(), texture, folder);
  }
  std::optional<double> ambient;
  describe(members, scene, ambient);
  return ambient;
}

//------------------------------------------------------------------------------
Scene readSceneFile(const std::string& path, std::optional<bool> ground)
{
  const nlohmann::json document = readJsonFile(path);
  const JsonValue root(path, document);
  JsonMembers members(root);

  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();

  // Cheap parts come first, so a typing error does not wait for the models.
  const std::optional<double> ambient = readSurroundings(members, folder, scene);
  bool onGround = false;
  members.add("ground", onGround, &JsonValue::boolean);
  onGround = ground.value_or(onGround);
  const JsonValue models = members.place("models");
  members.refuseOthers();

  const std::vector<JsonValue> entries = models.elements();
  if (entries.empty())
  {
    models.fail("at least one model");
  }
  std::map<std::string, Model> loaded;
  for (const JsonValue& entry : entries)
  {
    for (SceneModel& surface : readModel(entry, folder, loaded, scene.notes))
    {
      scene.models.push_back(std::move(surface));
    }
  }

  if (!root.member("camera").present())
  {
    scene.camera = framingCamera(scene, onGround);
  }
  if (onGround)
  {
    addGround(scene);
  }
  if (!root.member("lights").present())
  {
    scene.lights = { defaultLight() };
  }
  if (ambient)
  {
    setAmbient(scene, *ambient);
  }
  return scene;
}

//------------------------------------------------------------------------------
std::string exportScene(const Scene& scene, const std::string& folder)
{
  if (!scene.props.empty())
  {
    throw BadInput("--export: " + scene.name + " has props that no scene file describes, as \"" +
      scene.props.front().name + "\"");
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw BadInput("--export: " + folder + ": cannot be created: " + error.message());
  }
  const std::string path = (std::filesystem::path(folder) / (scene.name + ".json")).string();
  requireWritableFile(path, "--export", { ".json" });
  Scene written = scene;
  Json json;
  JsonMembers members(json);
  members.addObject("camera", written.camera, describeWhole);
  json["models"] = Json::array();
  json["lights"] = Json::array();
  for (const SceneModel& model : written.models)
  {
    json["models"].push_back(
      writeModel(model, folder, scene.name + "-" + std::to_string(json["models"].size())));
  }
  for (SceneLight& light : written.lights)
  {
    std::optional<std::string> texture = writeImage(light.area ? light.area->texture : nullptr,
      folder, scene.name + "-light-" + std::to_string(json["lights"].size()));
    JsonMembers ofLight(json["lights"].emplace_back());
    describe(ofLight, light, texture, {});
  }
  std::optional<double> ambient;
  describe(members, written, ambient);

  writeWholeFile(path, json.dump(2) + "\n");
  return path;
}

} // namespace gnomon::tool
