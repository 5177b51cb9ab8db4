#pragma once

#include "Scene.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <functional>

namespace gnomon::tool
{

/// A point of a surface.
struct SurfacePoint
{
  Vec3 position;
  Vec3 normal; ///< unit vector
};

/// A straight line with an origin and a direction.
struct Axis
{
  Vec3 origin;
  Vec3 direction; ///< unit vector
};

/// A point of a profile that is swept around an axis.
struct ProfilePoint
{
  double radius; ///< distance from the axis
  double height; ///< along the axis, from its origin
};

/// Builds triangle meshes for the built-in scenes. Vertices are floats with normals, shared on
/// smooth surfaces and duplicated along sharp edges. Fronts are counter-clockwise.
class MeshBuilder
{
public:
  MeshBuilder();

  /// Add a convex planar polygon, counter-clockwise, as a fan with its own flat normal.
  void addPolygon(const std::vector<Vec3>& corners);

  /// Add a box between two corners.
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

  /// Add a cone around a vertical axis, truncated unless `topRadius` is 0. Its ends are fans around
  /// their centres.
  /// @param base centre of the cone's bottom
  void addCone(
    const Vec3& base, double height, double bottomRadius, double topRadius, int segments);

  /// Add a sphere with `stacks` rings from pole to pole and `slices` cells around the vertical
  /// axis.
  void addSphere(const Vec3& center, double radius, int slices, int stacks);

  /// Return the number of triangles added.
  vtkIdType triangleCount() const { return this->triangles_->GetNumberOfCells(); }

  /// Return the mesh.
  vtkSmartPointer<vtkPolyData> build() const;

private:
  vtkIdType addVertex(const SurfacePoint& point);
  void addTriangle(vtkIdType a, vtkIdType b, vtkIdType c);
  void addDisc(const Vec3& center, double radius, int segments, bool facesUp);

  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normals_;
  vtkNew<vtkCellArray> triangles_;
};

} // namespace gnomon::tool
