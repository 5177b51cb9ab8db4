#pragma once

#include "Scene.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gnomon::tool
{

inline constexpr Vec3 origin{ 0.0, 0.0, 0.0 };
inline constexpr Vec3 up{ 0.0, 1.0, 0.0 };

/// A point of a surface, with its unit normal.
struct SurfacePoint
{
  Vec3 position;
  Vec3 normal;
};

/// A straight line with an origin and a unit direction.
struct Axis
{
  Vec3 origin;
  Vec3 direction;
};

/// A point of a profile that is swept around an axis: its distance from the axis, and its height
/// along the axis from the origin.
struct ProfilePoint
{
  double radius;
  double height;
};

/// Two directions perpendicular to a unit vector and to each other.
struct Frame
{
  explicit Frame(const Vec3& axis)
    : right(normalized(cross(std::abs(axis[1]) < 0.9 ? up : Vec3{ 1.0, 0.0, 0.0 }, axis)))
    , back(cross(right, axis))
  {
  }

  /// Return the direction at an angle around the axis, in radians.
  Vec3 at(double angle) const
  {
    return std::cos(angle) * this->right + std::sin(angle) * this->back;
  }

  Vec3 right;
  Vec3 back;
};
/// Return a direction that leans away from `axis` by the angle `lean`, towards the angle `turn`
/// around it; in radians.
inline Vec3 leaning(const Vec3& axis, double lean, double turn)
{
  return std::cos(lean) * axis + std::sin(lean) * Frame(axis).at(turn);
}

/// Return the direction at a share, in [0, 1], of the circle around the vertical axis. A share of 1
/// closes the circle exactly, without a gap from rounding.
inline Vec3 around(double share)
{
  const double angle = share == 1.0 ? 0.0 : 2.0 * vtkMath::Pi() * share;
  return { std::cos(angle), 0.0, -std::sin(angle) };
}

/// Builds triangle meshes for the built-in scenes. Vertices are floats with normals, shared on
/// smooth surfaces and duplicated along sharp edges. Fronts are counter-clockwise.
class MeshBuilder
{
public:
  MeshBuilder()
  {
    this->normals_->SetName("Normals");
    this->normals_->SetNumberOfComponents(3);
  }

  /// Add a convex planar polygon, counter-clockwise, as a fan with its own flat normal.
  void addPolygon(const std::vector<Vec3>& corners)
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

  /// Add a horizontal square around a point, facing up.
  void addPlane(const Vec3& center, double side)
  {
    const double h = 0.5 * side;
    this->addPolygon({ center + Vec3{ -h, 0.0, h }, center + Vec3{ h, 0.0, h },
      center + Vec3{ h, 0.0, -h }, center + Vec3{ -h, 0.0, -h } });
  }

  void addBox(const Vec3& low, const Vec3& high)
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

  /// Add a smooth patch of columns x rows cells over u, v in [0, 1], two triangles each. The front
  /// faces cross(dP/du, dP/dv). Triangles that collapse to a line (the poles of a sphere) are left
  /// out.
  void addPatch(
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
    const auto addUnlessThin = [this](
                                 vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d, vtkIdType e)
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

  /// Add a smooth patch given by its places; normals follow from its slopes. An edge may collapse
  /// to a point, as a petal's does.
  void addSheet(int columns, int rows, const std::function<Vec3(double u, double v)>& place)
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

  /// Add the surface that a profile sweeps around an axis. The front faces away from the axis where
  /// the profile climbs. The surface is open at its ends unless the profile begins and ends on the
  /// axis. All pieces of the profile have sharp edges.
  void addLathe(const Axis& axis, const std::vector<ProfilePoint>& profile, int segments)
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

  /// Add a round limb with open ends that tapers from one point to another.
  void addLimb(const Vec3& from, const Vec3& to, double radius, double taper, int segments)
  {
    this->addLathe({ from, normalized(to - from) },
      { { radius, 0.0 }, { taper * radius, length(to - from) } }, segments);
  }

  /// Add a cone around a vertical axis, truncated unless `topRadius` is 0. Its ends are fans around
  /// their centres.
  /// @param base centre of the cone's bottom
  void addCone(const Vec3& base, double height, double bottomRadius, double topRadius, int segments)
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

  /// Add a sphere with `stacks` rings from pole to pole and `slices` cells around the vertical
  /// axis.
  void addSphere(const Vec3& center, double radius, int slices, int stacks)
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

  /// Return the mesh.
  vtkSmartPointer<vtkPolyData> build() const
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->points_);
    mesh->SetPolys(this->triangles_);
    mesh->GetPointData()->SetNormals(this->normals_);
    return mesh;
  }

private:
  vtkIdType addVertex(const SurfacePoint& point)
  {
    this->normals_->InsertNextTuple(point.normal.data());
    return this->points_->InsertNextPoint(point.position.data());
  }

  void addDisc(const Vec3& center, double radius, int segments, bool facesUp)
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

  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkCellArray> triangles_;
};

/// Return a surface in one matt colour.
inline SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color)
{
  SceneModel model;
  model.name = name;
  model.surface = std::move(surface);
  model.property = defaultProperty();
  model.property->SetColor(color[0], color[1], color[2]);
  return model;
}

inline constexpr Vec3 planeColor{ 0.75, 0.75, 0.72 };
inline constexpr Vec3 casterColor{ 0.75, 0.5, 0.4 };
/// Return a model of separate triangles, from three corners each: double coordinates, no normals.
inline SceneModel makeTriangles(const std::string& name, const std::vector<Vec3>& corners)
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

/// Return a horizontal square of two triangles around a point, facing up.
inline SceneModel makePlane(const Vec3& center, double side)
{
  MeshBuilder mesh;
  mesh.addPlane(center, side);
  return makeModel("plane", mesh.build(), planeColor);
}

/// Return a white directional light.
inline SceneLight makeSun(const Vec3& travel, double intensity = 1.0)
{
  SceneLight light;
  light.position = -normalized(travel);
  light.intensity = intensity;
  return light;
}

inline SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees)
{
  SceneCamera camera;
  camera.position = position;
  camera.target = target;
  camera.fovDegrees = fovDegrees;
  return camera;
}

} // namespace gnomon::tool
