#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "Errors.h"
#include "ModelFile.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace gnomon::tool
{

namespace
{

Model readPackagedModel(const std::string& file)
{
  const char* folder = std::getenv("GNOMON_MODELS");
  const std::filesystem::path path =
    std::filesystem::path(folder && *folder ? folder : "/usr/share/glmark2/models") / file;
  std::error_code error;
  if (!std::filesystem::exists(path, error))
  {
    throw BadInput(path.string() +
      ": no such file; it comes with the Debian package glmark2-data, or the environment variable "
      "GNOMON_MODELS names its folder");
  }
  return readModelFile(path.string());
}

} // namespace

//------------------------------------------------------------------------------
Scene makeModelOnPlane(const std::string& file, const Vec3& color)
{
  Scene scene;
  for (const SceneModel& part : readPackagedModel(file).surfaces)
  {
    scene.models.push_back(makeModel(part.name, part.surface, color));
  }
  const std::array<double, 6> bounds = boundsWorld(scene);
  const double extent = std::max(bounds[1] - bounds[0], bounds[5] - bounds[4]);
  const double height = bounds[3] - bounds[2];
  // The plane lies at the model's lowest point.
  const Vec3 foot{ { 0.5 * (bounds[0] + bounds[1]), bounds[2], 0.5 * (bounds[4] + bounds[5]) } };
  scene.models.push_back(makePlane(foot, 4.0 * extent));

  // The view from the front shows the whole model and its whole shadow, which falls to the left and
  // back.
  const double size = std::max(extent, height);
  const Vec3 target = foot + Vec3{ { 0.0, 0.5 * height, 0.0 } };
  scene.camera = makeCamera(target + size * Vec3{ { -1.2, 1.6, 2.4 } }, target, 40.0);
  scene.lights = { makeSun({ { -1.0, -1.6, -1.0 } }) };
  return scene;
}

} // namespace gnomon::tool
