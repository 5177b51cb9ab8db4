#include "SceneFraming.h"

#include "Vec3.h"

#include <vtkCellData.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace gnomon::tool
{

namespace
{

Vec3 transformed(const std::array<double, 16>& matrix, const Vec3& point)
{
  Vec3 result;
  for (std::size_t row = 0; row < 3; ++row)
  {
    const double* m = matrix.data() + 4 * row;
    result[row] = m[0] * point[0] + m[1] * point[1] + m[2] * point[2] + m[3];
  }
  return result;
}

bool isFinite(const Vec3& point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

} // namespace

//------------------------------------------------------------------------------
std::array<double, 6> boundsWorld(const Scene& scene)
{
  std::array<double, 6> bounds{ { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 } };
  for (const SceneModel& model : scene.models)
  {
    for (vtkIdType i = 0; i < model.surface->GetNumberOfPoints(); ++i)
    {
      Vec3 point;
      model.surface->GetPoint(i, point.data());
      point = transformed(model.matrix, point);
      if (!isFinite(point))
      {
        continue;
      }
      const bool first = bounds[0] > bounds[1];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        double& low = bounds[2 * axis];
        double& high = bounds[2 * axis + 1];
        low = first ? point[axis] : std::min(low, point[axis]);
        high = first ? point[axis] : std::max(high, point[axis]);
      }
    }
  }
  return bounds[0] > bounds[1] ? std::array<double, 6>{} : bounds;
}

//------------------------------------------------------------------------------
SceneCamera framingCamera(const Scene& scene)
{
  const std::array<double, 6> bounds = boundsWorld(scene);
  const Vec3 low{ { bounds[0], bounds[2], bounds[4] } };
  const Vec3 high{ { bounds[1], bounds[3], bounds[5] } };
  // A scene that is one point still needs a camera that stands off it.
  const double diagonal = length(high - low);
  const double radius = diagonal > 0.0 ? 0.5 * diagonal : 1.0;

  SceneCamera camera;
  camera.target = 0.5 * (low + high);
  const double distance =
    1.05 * radius / std::sin(0.5 * vtkMath::RadiansFromDegrees(camera.fovDegrees));
  camera.position = camera.target + distance * normalized(Vec3{ { 0.3, 0.35, 1.0 } });
  return camera;
}

//------------------------------------------------------------------------------
SceneLight defaultLight()
{
  SceneLight light;
  light.position = normalized(Vec3{ { -1.0, 1.6, 1.2 } });
  return light;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkProperty> defaultProperty()
{
  auto property = vtkSmartPointer<vtkProperty>::New();
  property->SetColor(0.8, 0.8, 0.8);
  property->SetAmbient(0.2);
  property->SetDiffuse(0.8);
  return property;
}

//------------------------------------------------------------------------------
void paint(SceneModel& model, const Vec3& color)
{
  model.property = defaultProperty();
  model.property->SetColor(color[0], color[1], color[2]);
  model.texture = nullptr;

  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(model.surface);
  surface->GetPointData()->SetActiveScalars(nullptr);
  surface->GetCellData()->SetActiveScalars(nullptr);
  model.surface = surface;
}

} // namespace gnomon::tool
