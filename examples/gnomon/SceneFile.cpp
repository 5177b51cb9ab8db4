#include "SceneFile.h"

#include "Errors.h"
#include "Files.h"
#include "ImageFile.h"
#include "ModelFile.h"
#include "SceneFraming.h"
#include "Text.h"
#include "Vec3.h"

#include "lights/SettingsTable.h"

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
#include <variant>

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

constexpr NumberRange lightIntensity{ 0.0, 1e6 };
constexpr NumberRange coneAngleDegrees{ 0.01, 89.9 };
constexpr NumberRange fieldOfViewDegrees{ 0.01, 179.0 };
constexpr NumberRange extent{ 1e-30, 1e30 };

Vec3 readDirection(const JsonValue& value)
{
  const Vec3 direction = value.numbers<3>(anyCoordinate);
  if (length(direction) == 0.0)
  {
    value.fail("a direction that is not zero");
  }
  return direction;
}

/// Return a reader of a target, which must differ from the position.
auto targetOf(const Vec3& position)
{
  return [&position](const JsonValue& value)
  {
    const Vec3 target = value.numbers<3>(anyCoordinate);
    if (target == position)
    {
      value.fail("a target that is not the position");
    }
    return target;
  };
}

/// Add an up direction, which must not be parallel to the direction from position to target.
void addUp(JsonMembers& members, Vec3& up, const Vec3& forward)
{
  members.add("up", up, readDirection);
  constexpr double smallestSine = 1e-6;
  if (members.reads() && length(cross(normalized(forward), normalized(up))) < smallestSine)
  {
    members.place("up").fail("an up direction that is not parallel to the view, as [0, 1, 0] is "
                             "by default");
  }
}

std::string readSetting(const JsonValue& value, const Setting& setting)
{
  ShadowSettings scratch;
  if (const auto* range = std::get_if<IntegerSetting>(&setting.values))
  {
    setting.write(scratch, value.integer(range->smallest, range->largest));
  }
  else if (const auto* reals = std::get_if<RealSetting>(&setting.values))
  {
    setting.write(scratch, value.number({ reals->smallest, reals->largest }));
  }
  else if (!setting.set(scratch, value.text()))
  {
    value.fail(setting.expected());
  }
  return setting.get(scratch);
}

/// Read or write the area of an area light. A rectangle's width lies along cross(travel, up), its
/// height across that.
void describe(JsonMembers& members, SceneLight::Area& area, const Vec3& travel,
  std::optional<std::string>& texture, const std::filesystem::path& folder)
{
  std::string shape = area.rectangle || members.reads() ? "rectangle" : "disk";
  members.add("shape", shape, oneOf({ "rectangle", "disk" }));
  area.rectangle = shape == "rectangle";
  if (area.rectangle)
  {
    members.add("width", area.width, numberIn(extent), true);
    members.add("height", area.height, numberIn(extent), true);
  }
  else
  {
    members.add("radius", area.radius, numberIn(extent), true);
  }
  if (area.rectangle || texture || members.place("texture").present())
  {
    addUp(members, area.up, travel);
  }
  members.add("texture", texture,
    [&](const JsonValue& file)
    {
      file.refuseOnError([&] { area.texture = readImage((folder / file.text()).string()); });
      return file.text();
    });
}

nlohmann::json parseScalar(const std::string& text)
{
  if (const std::optional<long long> whole = parseNumber<long long>(text))
  {
    return *whole;
  }
  const std::optional<double> number = parseNumber<double>(text);
  return number ? nlohmann::json(*number) : nlohmann::json(text);
}

/// Parse "key=value;key=value" as the JSON object of a scene file. Values with commas become
/// arrays.
nlohmann::json parseAssignments(const std::string& source, const std::string& text)
{
  nlohmann::json object = nlohmann::json::object();
  for (const std::string& assignment : split(text, ';'))
  {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0)
    {
      throw BadInput(source + ": found \"" + assignment + "\", expected key=value;key=value...");
    }
    const std::string key = assignment.substr(0, equals);
    nlohmann::json elements;
    for (const std::string& element : split(assignment.substr(equals + 1), ','))
    {
      elements.push_back(parseScalar(element));
    }
    if (!object.emplace(key, elements.size() > 1 ? elements : elements[0]).second)
    {
      throw BadInput(source + ": key \"" + key + "\" occurs twice, expected once");
    }
  }
  return object;
}

} // namespace

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

void describe(JsonMembers& members, SceneLight& light, std::optional<std::string>& texture,
  const std::filesystem::path& folder)
{
  using Type = SceneLight::Type;
  std::string type = light.area ? "area"
    : light.type == Type::Spot  ? "spot"
    : light.type == Type::Point ? "point"
                                : "directional";
  members.add("type", type, oneOf({ "directional", "spot", "point", "area" }), true);
  if (type == "directional")
  {
    Vec3 travel = light.target - light.position;
    members.add("direction", travel, readDirection, true);
    if (members.reads())
    {
      travel = normalized(travel);
      light.position = -travel;
    }
    if (light.box || members.place("box").present())
    {
      light.box = light.box.value_or(SceneLight::Box());
      members.addObject("box", *light.box,
        [&](JsonMembers& ofBox, SceneLight::Box& box)
        {
          ofBox.add("position", light.position, numbersIn<3>(anyCoordinate), true);
          addUp(ofBox, box.up, travel);
          ofBox.add("width", box.width, numberIn(extent), true);
          ofBox.add("height", box.height, numberIn(extent), true);
          ofBox.add("depth", box.depth, numberIn(extent), true);
          light.target = light.position + travel;
        });
    }
  }
  else
  {
    members.add("position", light.position, numbersIn<3>(anyCoordinate), true);
    if (type != "point")
    {
      members.add("target", light.target, targetOf(light.position), true);
    }
    else if (members.reads())
    {
      light.target = light.position - Vec3{ 0.0, 1.0, 0.0 }; // arbitrary
    }
    const bool isSpot = type == "spot" || light.type == Type::Spot ||
      (type == "area" && members.place("cone_angle").present());
    light.type = isSpot ? Type::Spot : Type::Point;
    if (isSpot)
    {
      members.add("cone_angle", light.coneAngleDegrees, numberIn(coneAngleDegrees));
    }
  }
  if (type == "area")
  {
    light.area = light.area.value_or(SceneLight::Area());
    describe(members, *light.area, light.target - light.position, texture, folder);
  }
  members.add("color", light.color, numbersIn<3>(colorChannel));
  members.add("intensity", light.intensity, numberIn(lightIntensity));
  for (const auto& [name, text] : light.settings)
  {
    const bool isChoice = std::holds_alternative<ChoiceSetting>(findSetting(name)->values);
    members.write(name, isChoice ? nlohmann::json(text) : nlohmann::json::parse(text));
  }
  for (const Setting* setting : shadowSettings())
  {
    if (const JsonValue value = members.place(setting->name); value.present())
    {
      light.settings[setting->name] = readSetting(value, *setting);
    }
  }
  members.refuseOthers();
}

void describe(JsonMembers& members, SceneCamera& camera, bool complete)
{
  members.add("position", camera.position, numbersIn<3>(anyCoordinate), complete);
  members.add("target", camera.target, targetOf(camera.position), complete);
  if (camera.target == camera.position)
  {
    members.place("position").fail("a position that is not the scene's target");
  }
  addUp(members, camera.up, camera.target - camera.position);
  if (const JsonValue angle = members.place("fov"); angle.present())
  {
    if (members.place("parallel_scale").present())
    {
      angle.refuse("means nothing for a parallel camera, which \"parallel_scale\" makes");
    }
    camera.parallelScale.reset();
  }
  members.add("parallel_scale", camera.parallelScale, numberIn(extent));
  if (!camera.parallelScale)
  {
    members.add("fov", camera.fovDegrees, numberIn(fieldOfViewDegrees));
  }
  members.refuseOthers();
}

SceneLight parseLight(const std::string& spec)
{
  const std::string source = "--light " + spec;
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos)
  {
    throw BadInput(source + ": no type, expected for example directional:direction=-1,-2,-1");
  }
  nlohmann::json object = parseAssignments(source, spec.substr(colon + 1));
  if (!object.emplace("type", spec.substr(0, colon)).second)
  {
    throw BadInput(source + ": unknown key \"type\", expected the type in front of the colon only");
  }
  JsonMembers members(JsonValue(source, object));
  SceneLight light;
  std::optional<std::string> texture;
  describe(members, light, texture, {});
  return light;
}

SceneCamera parseCamera(const std::string& spec, const SceneCamera& defaults)
{
  const std::string source = "--camera " + spec;
  const nlohmann::json object = parseAssignments(source, spec);
  JsonMembers members(JsonValue(source, object));
  SceneCamera camera = defaults;
  describe(members, camera, false);
  return camera;
}

} // namespace gnomon::tool
