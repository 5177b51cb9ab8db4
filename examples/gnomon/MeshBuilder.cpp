#include "MeshBuilder.h"

#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace gnomon::tool
{

Frame::Frame(const Vec3& axis)
  : right(normalized(cross(std::abs(axis[1]) < 0.9 ? up : Vec3{ 1.0, 0.0, 0.0 }, axis)))
  , back(cross(right, axis))
{
}

Vec3 Frame::at(double angle) const
{
  return std::cos(angle) * this->right + std::sin(angle) * this->back;
}

Vec3 leaning(const Vec3& axis, double lean, double turn)
{
  return std::cos(lean) * axis + std::sin(lean) * Frame(axis).at(turn);
}

Vec3 around(double share)
{
  const double angle = share == 1.0 ? 0.0 : 2.0 * vtkMath::Pi() * share;
  return { std::cos(angle), 0.0, -std::sin(angle) };
}

MeshBuilder::MeshBuilder()
{
  this->normals_->SetName("Normals");
  this->normals_->SetNumberOfComponents(3);
}

vtkIdType MeshBuilder::addVertex(const SurfacePoint& point)
{
  this->normals_->InsertNextTuple(point.normal.data());
  return this->points_->InsertNextPoint(point.position.data());
}

void MeshBuilder::addPolygon(const std::vector<Vec3>& corners)
{
  const Vec3 normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  const vtkIdType first = this->points_->GetNumberOfPoints();
  for (const Vec3& corner : corners)
  {
    this->addVertex({ corner, normal });
  }
  for (vtkIdType i = 2; i < static_cast<vtkIdType>(corners.size()); ++i)
  {
    this->triangles_->InsertNextCell({ first, first + i - 1, first + i });
  }
}

void MeshBuilder::addPlane(const Vec3& center, double side)
{
  const double h = 0.5 * side;
  this->addPolygon({ center + Vec3{ -h, 0.0, h }, center + Vec3{ h, 0.0, h },
    center + Vec3{ h, 0.0, -h }, center + Vec3{ -h, 0.0, -h } });
}

void MeshBuilder::addBox(const Vec3& low, const Vec3& high)
{
  // A corner is three bits: whether its x, y and z are high.
  static constexpr int faces[6][4] = { { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 },
    { 1, 3, 7, 5 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
  for (const auto& face : faces)
  {
    std::vector<Vec3> corners;
    for (const int corner : face)
    {
      corners.push_back({ corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
        corner & 4 ? high[2] : low[2] });
    }
    this->addPolygon(corners);
  }
}

void MeshBuilder::addPatch(
  int columns, int rows, const std::function<SurfacePoint(double u, double v)>& surface)
{
  const vtkIdType first = this->points_->GetNumberOfPoints();
  for (int row = 0; row <= rows; ++row)
  {
    for (int column = 0; column <= columns; ++column)
    {
      this->addVertex(
        surface(static_cast<double>(column) / columns, static_cast<double>(row) / rows));
    }
  }
  const auto addUnlessThin = [this](vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d, vtkIdType e)
  {
    Vec3 p, q;
    this->points_->GetPoint(a, p.data());
    this->points_->GetPoint(b, q.data());
    if (p != q)
    {
      this->triangles_->InsertNextCell({ c, d, e });
    }
  };
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const vtkIdType a = first + row * (columns + 1) + column;
      const vtkIdType c = a + columns + 2;
      addUnlessThin(a, a + 1, a, a + 1, c);
      addUnlessThin(c, c - 1, a, c, c - 1);
    }
  }
}

void MeshBuilder::addSheet(
  int columns, int rows, const std::function<Vec3(double u, double v)>& place)
{
  this->addPatch(columns, rows,
    [&](double u, double v)
    {
      // Slopes are evaluated off the edges, as a sheet that ends in a point has none there.
      constexpr double step = 1e-3;
      constexpr double margin = 0.02;
      const double s = std::clamp(u, margin, 1.0 - margin);
      const double t = std::clamp(v, margin, 1.0 - margin);
      const Vec3 alongU = place(s + step, t) - place(s - step, t);
      const Vec3 alongV = place(s, t + step) - place(s, t - step);
      return SurfacePoint{ place(u, v), normalized(cross(alongU, alongV)) };
    });
}

void MeshBuilder::addLathe(const Axis& axis, const std::vector<ProfilePoint>& profile, int segments)
{
  // Two arbitrary directions perpendicular to the axis. The helper must not be parallel to it.
  const Vec3& along = axis.direction;
  const Vec3 helper = std::abs(along[0]) < 0.9 ? Vec3{ 1.0, 0.0, 0.0 } : Vec3{ 0.0, 0.0, 1.0 };
  const Vec3 right = normalized(cross(helper, along));
  const Vec3 back = cross(right, along);
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
  {
    const ProfilePoint& from = profile[i];
    const ProfilePoint& to = profile[i + 1];
    this->addPatch(segments, 1,
      [&](double u, double v)
      {
        const Vec3 turn = around(u);
        const Vec3 outward = turn[0] * right + turn[2] * back;
        const ProfilePoint& here = v == 0.0 ? from : to;
        return SurfacePoint{ axis.origin + here.radius * outward + here.height * along,
          normalized((to.height - from.height) * outward + (from.radius - to.radius) * along) };
      });
  }
}

void MeshBuilder::addLimb(
  const Vec3& from, const Vec3& to, double radius, double taper, int segments)
{
  this->addLathe({ from, normalized(to - from) },
    { { radius, 0.0 }, { taper * radius, length(to - from) } }, segments);
}

void MeshBuilder::addDisc(const Vec3& center, double radius, int segments, bool facesUp)
{
  const Vec3 normal{ 0.0, facesUp ? 1.0 : -1.0, 0.0 };
  const vtkIdType middle = this->addVertex({ center, normal });
  for (int i = 0; i <= segments; ++i)
  {
    const double share = static_cast<double>(i) / segments;
    this->addVertex({ center + radius * around(share), normal });
  }
  for (vtkIdType i = middle + 1; i <= middle + segments; ++i)
  {
    this->triangles_->InsertNextCell({ middle, facesUp ? i : i + 1, facesUp ? i + 1 : i });
  }
}

void MeshBuilder::addCone(
  const Vec3& base, double height, double bottomRadius, double topRadius, int segments)
{
  this->addPatch(segments, 1,
    [&](double u, double v)
    {
      const Vec3 outward = around(u);
      const double radius = bottomRadius + v * (topRadius - bottomRadius);
      return SurfacePoint{ base + radius * outward + (v * height) * up,
        normalized(height * outward + (bottomRadius - topRadius) * up) };
    });
  this->addDisc(base, bottomRadius, segments, false);
  if (topRadius > 0.0)
  {
    this->addDisc(base + height * up, topRadius, segments, true);
  }
}

void MeshBuilder::addSphere(const Vec3& center, double radius, int slices, int stacks)
{
  this->addPatch(slices, stacks,
    [&](double u, double v)
    {
      // The poles are explicit, as their ring must collapse to exactly one point.
      const double latitude = vtkMath::Pi() * (v - 0.5);
      const bool pole = v == 0.0 || v == 1.0;
      Vec3 normal = (pole ? 0.0 : std::cos(latitude)) * around(u);
      normal[1] = pole ? 2.0 * v - 1.0 : std::sin(latitude);
      return SurfacePoint{ center + radius * normal, normal };
    });
}

vtkSmartPointer<vtkPolyData> MeshBuilder::build() const
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(this->points_);
  mesh->SetPolys(this->triangles_);
  mesh->GetPointData()->SetNormals(this->normals_);
  return mesh;
}

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

SceneModel makeTriangles(const std::string& name, const std::vector<Vec3>& corners)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    const vtkIdType first = points->InsertNextPoint(corners[i].data());
    points->InsertNextPoint(corners[i + 1].data());
    points->InsertNextPoint(corners[i + 2].data());
    cells->InsertNextCell({ first, first + 1, first + 2 });
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return makeModel(name, surface, casterColor);
}

SceneModel makePlane(const Vec3& center, double side)
{
  MeshBuilder mesh;
  mesh.addPlane(center, side);
  return makeModel("plane", mesh.build(), planeColor);
}

SceneLight makeSun(const Vec3& travel, double intensity)
{
  SceneLight light;
  light.position = -normalized(travel);
  light.intensity = intensity;
  return light;
}

SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees)
{
  SceneCamera camera;
  camera.position = position;
  camera.target = target;
  camera.fovDegrees = fovDegrees;
  return camera;
}

} // namespace gnomon::tool
