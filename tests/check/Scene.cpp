#include "Scene.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace gnomon::check
{

namespace
{

using Json = nlohmann::json;

Vec3 readVector(const Json& value)
{
  const auto numbers = value.get<std::array<double, 3>>();
  return { numbers[0], numbers[1], numbers[2] };
}

Camera readCamera(const Json& value)
{
  Camera camera;
  camera.position = readVector(value.at("position"));
  camera.target = readVector(value.at("target"));
  if (value.contains("up"))
  {
    camera.up = readVector(value.at("up"));
  }
  camera.fovDegrees = value.value("fov", camera.fovDegrees);
  return camera;
}

Light readLight(const Json& value)
{
  const std::string type = value.at("type");
  Light light;
  if (type == "directional")
  {
    light.direction = readVector(value.at("direction")).normalized();
    if (value.contains("box"))
    {
      const Json& box = value.at("box");
      light.position = readVector(box.at("position"));
      light.box.emplace();
      light.box->width = box.at("width");
      light.box->height = box.at("height");
      light.box->depth = box.at("depth");
      light.box->up = box.contains("up") ? readVector(box.at("up")) : Vec3(0.0, 1.0, 0.0);
    }
  }
  else if (type == "spot")
  {
    light.kind = Light::Kind::Spot;
    light.position = readVector(value.at("position"));
    light.direction = (readVector(value.at("target")) - light.position).normalized();
    light.coneAngleDegrees = value.value("cone_angle", 30.0);
  }
  else if (type == "point")
  {
    light.kind = Light::Kind::Point;
    light.position = readVector(value.at("position"));
  }
  else
  {
    throw std::runtime_error("lights of type " + type + " cannot be checked");
  }
  return light;
}

/// Row-major, last row 0, 0, 0, 1.
Vec3 transform(const std::array<double, 16>& m, const Vec3& p)
{
  return { m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
    m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11] };
}

Surface readSurface(const Json& value, const std::filesystem::path& folder)
{
  Surface surface;
  const std::string file = (folder / value.at("file").get<std::string>()).string();
  Mesh mesh = readModel(file);
  surface.triangles = std::move(mesh.triangles);
  if (value.contains("texture"))
  {
    if (mesh.coordinates.empty())
    {
      throw std::runtime_error(file + ": has no texture coordinates");
    }
    surface.holes = readHoles((folder / value.at("texture").get<std::string>()).string());
    surface.coordinates = std::move(mesh.coordinates);
  }
  if (value.contains("matrix"))
  {
    const auto matrix = value.at("matrix").get<std::array<double, 16>>();
    for (Triangle& triangle : surface.triangles)
    {
      for (Vec3& corner : triangle)
      {
        corner = transform(matrix, corner);
      }
    }
  }
  surface.casts = value.value("casts", true);
  surface.receives = value.value("receives", true);
  surface.oneSided = value.value("one_sided", false);
  return surface;
}

} // namespace

//------------------------------------------------------------------------------
Scene readScene(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error(path + ": cannot be read");
  }
  try
  {
    const Json root = Json::parse(file);
    Scene scene;
    scene.camera = readCamera(root.at("camera"));
    for (const Json& light : root.at("lights"))
    {
      scene.lights.push_back(readLight(light));
    }
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    for (const Json& model : root.at("models"))
    {
      scene.surfaces.push_back(readSurface(model, folder));
    }
    return scene;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(path + ": " + error.what());
  }
}

} // namespace gnomon::check
