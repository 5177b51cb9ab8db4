#include "SceneFile.h"

#include "Errors.h"
#include "ModelFile.h"
#include "SceneFraming.h"
#include "SceneJson.h"
#include "TextureFile.h"

#include <vtkMatrix4x4.h>
#include <vtkPointData.h>

#include <cmath>
#include <filesystem>
#include <map>

namespace gnomon::tool
{

namespace
{

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

/// Read an entry of "models": the surfaces of its file.
std::vector<SceneModel> readModel(const JsonValue& value, const std::filesystem::path& folder,
  std::map<std::string, Model>& loaded, std::vector<std::string>& notes)
{
  value.requireObject({ "file", "matrix", "color", "texture", "casts", "receives", "one_sided" });
  const JsonValue file = value.member("file");
  const std::string path = (folder / file.text()).string();
  if (loaded.find(path) == loaded.end())
  {
    file.refuseOnError([&] { loaded[path] = readModelFile(path); });
    notes.insert(notes.end(), loaded[path].notes.begin(), loaded[path].notes.end());
  }
  const JsonValue image = value.member("texture");
  const JsonValue matrix = value.member("matrix");
  const JsonValue color = value.member("color");
  vtkSmartPointer<vtkTexture> texture;
  if (image.present())
  {
    image.refuseOnError([&] { texture = readTexture((folder / image.text()).string()); });
  }
  std::vector<SceneModel> surfaces = loaded[path].surfaces;
  for (SceneModel& surface : surfaces)
  {
    if (matrix.present())
    {
      const std::array<double, 16> fileFromSurface = surface.matrix;
      vtkMatrix4x4::Multiply4x4(
        readMatrix(matrix).data(), fileFromSurface.data(), surface.matrix.data());
    }
    if (color.present())
    {
      paint(surface, color.numbers<3>(colorChannel));
    }
    if (texture)
    {
      if (!surface.surface->GetPointData()->GetTCoords())
      {
        image.refuse(path + ": has no texture coordinates");
      }
      surface.texture = texture;
    }
    surface.casts = value.member("casts").booleanOr(surface.casts);
    surface.receives = value.member("receives").booleanOr(surface.receives);
    surface.oneSided = value.member("one_sided").booleanOr(surface.oneSided);
  }
  return surfaces;
}

} // namespace

//------------------------------------------------------------------------------
std::optional<double> readSurroundings(
  const JsonValue& root, const std::filesystem::path& folder, Scene& scene)
{
  if (const JsonValue camera = root.member("camera"); camera.present())
  {
    scene.camera = readCamera(camera, std::nullopt);
  }
  for (const JsonValue& value : root.member("lights").elementsOrNone())
  {
    scene.lights.push_back(readLight(value, folder));
  }
  scene.background = root.member("background").numbersOr(scene.background, colorChannel);
  scene.sky = root.member("sky").numberOr(scene.sky, { 0.0, 1e30 });
  scene.isGlass = root.member("glass").booleanOr(scene.isGlass);
  const JsonValue ambient = root.member("ambient");
  return ambient.present() ? std::optional(ambient.number({ 0.0, 1.0 })) : std::nullopt;
}

//------------------------------------------------------------------------------
Scene readSceneFile(const std::string& path, std::optional<bool> ground)
{
  const nlohmann::json document = readJsonFile(path);
  const JsonValue root(path, document);
  root.requireObject(
    { "camera", "models", "lights", "background", "ground", "ambient", "sky", "glass" });

  Scene scene;
  scene.name = std::filesystem::path(path).stem().string();
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();

  // Cheap parts come first, so a typing error does not wait for the models.
  const std::optional<double> ambient = readSurroundings(root, folder, scene);
  const bool onGround = ground.value_or(root.member("ground").booleanOr(false));

  const JsonValue models = root.member("models");
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

} // namespace gnomon::tool
