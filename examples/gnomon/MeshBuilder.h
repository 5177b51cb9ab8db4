#pragma once

#include "Scene.h"
#include "Vec3.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

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
  explicit Frame(const Vec3& axis);
  /// Return the direction at an angle around the axis, in radians.
  Vec3 at(double angle) const;
  Vec3 right;
  Vec3 back;
};
/// Return a direction that leans away from `axis` by the angle `lean`, towards the angle `turn`
/// around it; in radians.
Vec3 leaning(const Vec3& axis, double lean, double turn);

/// Builds triangle meshes for the built-in scenes. Vertices are floats with normals, shared on
/// smooth surfaces and duplicated along sharp edges. Fronts are counter-clockwise.
class MeshBuilder
{
public:
  MeshBuilder();

  /// Add a convex planar polygon, counter-clockwise, as a fan with its own flat normal.
  void addPolygon(const std::vector<Vec3>& corners);

  /// Add a horizontal square around a point, facing up.
  void addPlane(const Vec3& center, double side);

  void addBox(const Vec3& low, const Vec3& high);

  /// Add a smooth patch of columns x rows cells over u, v in [0, 1], two triangles each. The front
  /// faces cross(dP/du, dP/dv). Triangles that collapse to a line (the poles of a sphere) are left
  /// out.
  void addPatch(
    int columns, int rows, const std::function<SurfacePoint(double u, double v)>& surface);

  /// Add a smooth patch given by its places; normals follow from its slopes. An edge may collapse
  /// to a point, as a petal's does.
  void addSheet(int columns, int rows, const std::function<Vec3(double u, double v)>& place);

  /// Add the surface that a profile sweeps around an axis. The front faces away from the axis where
  /// the profile climbs. The surface is open at its ends unless the profile begins and ends on the
  /// axis. All pieces of the profile have sharp edges.
  void addLathe(const Axis& axis, const std::vector<ProfilePoint>& profile, int segments);

  /// Add a round limb with open ends that tapers from one point to another.
  void addLimb(const Vec3& from, const Vec3& to, double radius, double taper, int segments);

  /// Add a cone around a vertical axis, truncated unless `topRadius` is 0. Its ends are fans around
  /// their centres.
  /// @param base centre of the cone's bottom
  void addCone(
    const Vec3& base, double height, double bottomRadius, double topRadius, int segments);

  /// Add a sphere with `stacks` rings from pole to pole and `slices` cells around the vertical
  /// axis.
  void addSphere(const Vec3& center, double radius, int slices, int stacks);

  /// Return the mesh.
  vtkSmartPointer<vtkPolyData> build() const;

private:
  vtkIdType addVertex(const SurfacePoint& point);
  void addDisc(const Vec3& center, double radius, int segments, bool facesUp);

  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkCellArray> triangles_;
};

/// Return the direction at a share, in [0, 1], of the circle around the vertical axis. A share of 1
/// closes the circle exactly, without a gap from rounding.
Vec3 around(double share);

/// Return a surface in one matt colour.
SceneModel makeModel(
  const std::string& name, vtkSmartPointer<vtkPolyData> surface, const Vec3& color);
inline constexpr Vec3 planeColor{ 0.75, 0.75, 0.72 };
inline constexpr Vec3 casterColor{ 0.75, 0.5, 0.4 };
/// Return a model of separate triangles, from three corners each: double coordinates, no normals.
SceneModel makeTriangles(const std::string& name, const std::vector<Vec3>& corners);
/// Return a horizontal square of two triangles around a point, facing up.
SceneModel makePlane(const Vec3& center, double side);
/// Return a white directional light.
SceneLight makeSun(const Vec3& travel, double intensity = 1.0);
SceneCamera makeCamera(const Vec3& position, const Vec3& target, double fovDegrees);

} // namespace gnomon::tool
