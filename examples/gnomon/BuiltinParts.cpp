#include "BuiltinParts.h"

#include "MeshBuilder.h"
#include "SceneFraming.h"
#include "Vec3.h"

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
SceneLight makeSun(const Vec3& travel)
{
  SceneLight light;
  light.target = { { 0.0, 0.0, 0.0 } };
  light.position = -normalized(travel);
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
SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees)
{
  SceneCamera camera;
  camera.position = position;
  camera.target = target;
  camera.fovDegrees = fovDegrees;
  return camera;
}

} // namespace gnomon::tool
