#include "SceneFraming.h"

#include "MeshBuilder.h"
#include "Vec3.h"

#include <vtkBoundingBox.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::tool
{

namespace
{

/// A border of the picture. Points with a sum >= 0 are inside.
struct Side
{
  Vec3 inward;
  double offset;

  double operator()(const Vec3& point) const { return dot(this->inward, point) + this->offset; }
};

/// Return the borders of a camera's visible points, for coordinates relative to its eye.
std::vector<Side> sidesOf(const SceneCamera& camera, double aspect)
{
  const Vec3 forward = normalized(camera.target - camera.position);
  const Vec3 right = normalized(cross(forward, camera.up));
  const Vec3 up = cross(right, forward);
  if (camera.parallelScale)
  {
    const double height = *camera.parallelScale;
    const double width = aspect * height;
    return { { -up, height }, { up, height }, { -right, width }, { right, width },
      { forward, 0.0 } };
  }
  const double tangent = std::tan(0.5 * vtkMath::RadiansFromDegrees(camera.fovDegrees));
  return { { tangent * forward - up, 0.0 }, { tangent * forward + up, 0.0 },
    { aspect * tangent * forward - right, 0.0 }, { aspect * tangent * forward + right, 0.0 } };
}

/// Return the part of a polygon inside a border.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Side& side)
{
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec3& from = polygon[i];
    const Vec3& to = polygon[(i + 1) % polygon.size()];
    const double start = side(from);
    const double end = side(to);
    if (start >= 0.0)
    {
      result.push_back(from);
    }
    if ((start < 0.0) != (end < 0.0))
    {
      result.push_back(from + (start / (start - end)) * (to - from)); // start, end: opposite signs
    }
  }
  return result;
}

/// Call `visit` with the points of each cell, and of each triangle of strips.
template <class Visit>
void visitCells(vtkPolyData* surface, const Visit& visit)
{
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* points = nullptr;
      cell->GetCurrentCell(size, points);
      const vtkIdType window = cells == surface->GetStrips() ? 3 : size;
      for (vtkIdType first = 0; first + window <= size; ++first)
      {
        visit(points + first, window);
      }
    }
  }
}

} // namespace

std::array<double, 6> boundsWorld(const Scene& scene)
{
  vtkBoundingBox box;
  for (const SceneModel& model : scene.models)
  {
    for (vtkIdType i = 0; i < model.surface->GetNumberOfPoints(); ++i)
    {
      Vec3 point;
      model.surface->GetPoint(i, point.data());
      point = transformed(model.matrix, point, 1.0);
      if (std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
      {
        box.AddPoint(point.data());
      }
    }
  }
  std::array<double, 6> bounds{};
  if (box.IsValid())
  {
    box.GetBounds(bounds.data());
  }
  return bounds;
}

SceneCamera framingCamera(const Scene& scene, bool withShadow)
{
  const std::array<double, 6> bounds = boundsWorld(scene);
  const Vec3 low{ { bounds[0], bounds[2], bounds[4] } };
  const Vec3 high{ { bounds[1], bounds[3], bounds[5] } };
  // A scene of one point also needs a camera at a distance.
  const double diagonal = length(high - low);
  const double radius = diagonal > 0.0 ? 0.5 * diagonal : 1.0;

  SceneCamera camera;
  camera.target = 0.5 * (low + high);
  const double margin = withShadow ? 1.5 : 1.05;
  const double distance =
    margin * radius / std::sin(0.5 * vtkMath::RadiansFromDegrees(camera.fovDegrees));
  camera.position = camera.target + distance * normalized(Vec3{ { 0.3, 0.35, 1.0 } });
  return camera;
}

void addGround(Scene& scene)
{
  const std::array<double, 6> bounds = boundsWorld(scene);
  const double size =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  // Slightly below the models, so a model's own floor hides it.
  const Vec3 centre{ { 0.5 * (bounds[0] + bounds[1]), bounds[2] - 1e-4 * size,
    0.5 * (bounds[4] + bounds[5]) } };
  scene.models.push_back(makePlane(centre, 4.0 * size));
  scene.models.back().name = "ground";
}

DepthRange visibleDepths(const Scene& scene, double aspect)
{
  const Vec3& eye = scene.camera.position;
  const Vec3 forward = normalized(scene.camera.target - eye);
  const std::vector<Side> sides = sidesOf(scene.camera, aspect);

  DepthRange range{ std::numeric_limits<double>::infinity(), 0.0 };
  const auto include = [&](const Vec3& point)
  {
    const double depth = dot(point, forward);
    if (std::isfinite(depth))
    {
      range.nearest = std::min(range.nearest, depth);
      range.farthest = std::max(range.farthest, depth);
    }
  };
  std::vector<Vec3> points;
  std::vector<unsigned> outsides; // one bit per side; NaN is outside
  for (const SceneModel& model : scene.models)
  {
    points.resize(static_cast<std::size_t>(model.surface->GetNumberOfPoints()));
    outsides.assign(points.size(), 0u);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      model.surface->GetPoint(static_cast<vtkIdType>(i), points[i].data());
      points[i] = transformed(model.matrix, points[i], 1.0) - eye;
      for (std::size_t side = 0; side < sides.size(); ++side)
      {
        outsides[i] |= sides[side](points[i]) >= 0.0 ? 0u : 1u << side;
      }
    }
    visitCells(model.surface,
      [&](const vtkIdType* ids, vtkIdType size)
      {
        unsigned everywhere = ~0u;
        unsigned anywhere = 0u;
        for (vtkIdType i = 0; i < size; ++i)
        {
          everywhere &= outsides[static_cast<std::size_t>(ids[i])];
          anywhere |= outsides[static_cast<std::size_t>(ids[i])];
        }
        if (everywhere != 0u)
        {
          return; // entirely outside one side
        }
        std::vector<Vec3> polygon;
        for (vtkIdType i = 0; i < size; ++i)
        {
          const Vec3& point = points[static_cast<std::size_t>(ids[i])];
          anywhere == 0u ? include(point) : polygon.push_back(point);
        }
        for (const Side& side : sides)
        {
          polygon = clipped(polygon, side);
        }
        std::for_each(polygon.begin(), polygon.end(), include);
      });
  }
  return range;
}

SceneLight defaultLight()
{
  SceneLight light;
  light.position = normalized(Vec3{ { -1.0, 1.6, 1.2 } });
  return light;
}

void setAmbient(Scene& scene, double share)
{
  for (SceneModel& model : scene.models)
  {
    model.property->SetAmbient(share);
  }
}

vtkSmartPointer<vtkProperty> defaultProperty()
{
  auto property = vtkSmartPointer<vtkProperty>::New();
  property->SetColor(0.8, 0.8, 0.8);
  property->SetAmbient(defaultAmbient);
  property->SetDiffuse(0.8);
  return property;
}

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
