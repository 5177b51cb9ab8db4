#include "MeshBuilder.h"

#include "Vec3.h"

#include <vtkMath.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace gnomon::tool
{

namespace
{

const double fullTurn = 2.0 * vtkMath::Pi();

/// Return the direction at a share, in [0, 1], of the circle around the vertical axis. A share of 1
/// closes the circle exactly, without a gap from rounding.
Vec3 around(double share)
{
  const double angle = share == 1.0 ? 0.0 : fullTurn * share;
  return { { std::cos(angle), 0.0, -std::sin(angle) } };
}

} // namespace

//------------------------------------------------------------------------------
MeshBuilder::MeshBuilder()
{
  this->points_->SetDataTypeToFloat();
  this->normals_->SetName("Normals");
  this->normals_->SetNumberOfComponents(3);
}

//------------------------------------------------------------------------------
vtkIdType MeshBuilder::addVertex(const SurfacePoint& point)
{
  this->normals_->InsertNextTuple(point.normal.data());
  return this->points_->InsertNextPoint(point.position.data());
}

//------------------------------------------------------------------------------
void MeshBuilder::addTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
{
  this->triangles_->InsertNextCell({ a, b, c });
}

//------------------------------------------------------------------------------
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
    this->addTriangle(first, first + i - 1, first + i);
  }
}

//------------------------------------------------------------------------------
void MeshBuilder::addBox(const Vec3& low, const Vec3& high)
{
  const double x0 = low[0], y0 = low[1], z0 = low[2];
  const double x1 = high[0], y1 = high[1], z1 = high[2];
  this->addPolygon(
    { { { x0, y0, z0 } }, { { x1, y0, z0 } }, { { x1, y0, z1 } }, { { x0, y0, z1 } } });
  this->addPolygon(
    { { { x0, y1, z0 } }, { { x0, y1, z1 } }, { { x1, y1, z1 } }, { { x1, y1, z0 } } });
  this->addPolygon(
    { { { x0, y0, z0 } }, { { x0, y0, z1 } }, { { x0, y1, z1 } }, { { x0, y1, z0 } } });
  this->addPolygon(
    { { { x1, y0, z0 } }, { { x1, y1, z0 } }, { { x1, y1, z1 } }, { { x1, y0, z1 } } });
  this->addPolygon(
    { { { x0, y0, z0 } }, { { x0, y1, z0 } }, { { x1, y1, z0 } }, { { x1, y0, z0 } } });
  this->addPolygon(
    { { { x0, y0, z1 } }, { { x1, y0, z1 } }, { { x1, y1, z1 } }, { { x0, y1, z1 } } });
}

//------------------------------------------------------------------------------
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

  const auto samePlace = [this](vtkIdType a, vtkIdType b)
  {
    Vec3 p, q;
    this->points_->GetPoint(a, p.data());
    this->points_->GetPoint(b, q.data());
    return p == q;
  };
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const vtkIdType a = first + row * (columns + 1) + column;
      const vtkIdType b = a + 1;
      const vtkIdType c = b + columns + 1;
      const vtkIdType d = c - 1;
      if (!samePlace(a, b))
      {
        this->addTriangle(a, b, c);
      }
      if (!samePlace(c, d))
      {
        this->addTriangle(a, c, d);
      }
    }
  }
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
void MeshBuilder::addLathe(const Axis& axis, const std::vector<ProfilePoint>& profile, int segments)
{
  // Two arbitrary directions perpendicular to the axis. The helper must not be parallel to it.
  const Vec3& up = axis.direction;
  const Vec3 helper = std::abs(up[0]) < 0.9 ? Vec3{ { 1.0, 0.0, 0.0 } } : Vec3{ { 0.0, 0.0, 1.0 } };
  const Vec3 right = normalized(cross(helper, up));
  const Vec3 back = cross(right, up);
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
        return SurfacePoint{ axis.origin + here.radius * outward + here.height * up,
          normalized((to.height - from.height) * outward + (from.radius - to.radius) * up) };
      });
  }
}

//------------------------------------------------------------------------------
void MeshBuilder::addDisc(const Vec3& center, double radius, int segments, bool facesUp)
{
  const Vec3 normal{ { 0.0, facesUp ? 1.0 : -1.0, 0.0 } };
  const vtkIdType middle = this->addVertex({ center, normal });
  for (int i = 0; i <= segments; ++i)
  {
    const double share = static_cast<double>(i) / segments;
    this->addVertex({ center + radius * around(share), normal });
  }
  for (vtkIdType i = middle + 1; i <= middle + segments; ++i)
  {
    facesUp ? this->addTriangle(middle, i, i + 1) : this->addTriangle(middle, i + 1, i);
  }
}

//------------------------------------------------------------------------------
void MeshBuilder::addCone(
  const Vec3& base, double height, double bottomRadius, double topRadius, int segments)
{
  const Vec3 up{ { 0.0, 1.0, 0.0 } };
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

//------------------------------------------------------------------------------
void MeshBuilder::addSphere(const Vec3& center, double radius, int slices, int stacks)
{
  this->addPatch(slices, stacks,
    [&](double u, double v)
    {
      // The poles are explicit, as their ring must collapse to exactly one point.
      const double latitude = vtkMath::Pi() * (v - 0.5);
      const bool pole = v == 0.0 || v == 1.0;
      const double ring = pole ? 0.0 : std::cos(latitude);
      Vec3 normal = ring * around(u);
      normal[1] = pole ? (v == 0.0 ? -1.0 : 1.0) : std::sin(latitude);
      return SurfacePoint{ center + radius * normal, normal };
    });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MeshBuilder::build() const
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(this->points_);
  mesh->SetPolys(this->triangles_);
  mesh->GetPointData()->SetNormals(this->normals_);
  return mesh;
}

} // namespace gnomon::tool
