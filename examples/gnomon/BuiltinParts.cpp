#include "BuiltinParts.h"

#include "MeshBuilder.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkMath.h>

#include <cmath>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color)
{
  SceneModel model;
  model.name = name;
  model.surface = std::move(surface);
  model.property = defaultProperty();
  model.property->SetColor(color[0], color[1], color[2]);
  return model;
}

//------------------------------------------------------------------------------
SceneModel makePlane(const Vec3& center, double side)
{
  const double h = 0.5 * side;
  MeshBuilder mesh;
  mesh.addPolygon({ center + Vec3{ { -h, 0.0, h } }, center + Vec3{ { h, 0.0, h } },
    center + Vec3{ { h, 0.0, -h } }, center + Vec3{ { -h, 0.0, -h } } });
  return makeModel("plane", mesh.build(), { { 0.75, 0.75, 0.72 } });
}

//------------------------------------------------------------------------------
SceneModel placed(SceneModel model, const Vec3& position, double degrees)
{
  const double c = std::cos(vtkMath::RadiansFromDegrees(degrees));
  const double s = std::sin(vtkMath::RadiansFromDegrees(degrees));
  model.matrix = { { c, 0.0, s, position[0], 0.0, 1.0, 0.0, position[1], -s, 0.0, c, position[2],
    0.0, 0.0, 0.0, 1.0 } };
  return model;
}

//------------------------------------------------------------------------------
SceneLight makeSun(const Vec3& travel, const Vec3& color, double intensity)
{
  SceneLight light;
  light.target = { { 0.0, 0.0, 0.0 } };
  light.position = -normalized(travel);
  light.color = color;
  light.intensity = intensity;
  return light;
}

//------------------------------------------------------------------------------
SceneLight makeLamp(const Vec3& position)
{
  SceneLight light;
  light.type = SceneLight::Type::Point;
  light.position = position;
  light.target = position + Vec3{ { 0.0, -1.0, 0.0 } };
  return light;
}

//------------------------------------------------------------------------------
Scene underLamp(Scene scene, double distance)
{
  const SceneLight& sun = scene.lights.front();
  SceneLight lamp;
  lamp.type = SceneLight::Type::Spot;
  lamp.coneAngleDegrees = 55.0;
  lamp.target = scene.camera.target;
  lamp.position = lamp.target - distance * normalized(sun.target - sun.position);
  lamp.area = SceneLight::Area{};
  lamp.area->rectangle = true;
  lamp.area->width = lamp.area->height = 0.1 * distance;
  lamp.area->up = { { 0.0, 0.0, -1.0 } };
  scene.lights = { lamp };
  return scene;
}

//------------------------------------------------------------------------------
SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees)
{
  SceneCamera camera;
  camera.position = position;
  camera.target = target;
  camera.fovDegrees = fovDegrees;
  return camera;
}

} // namespace gnomon::tool
