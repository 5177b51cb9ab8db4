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
  Vec3 normal; ///< unit
};

/// A straight line with a direction, of any position in space.
struct Axis
{
  Vec3 origin;
  Vec3 direction; ///< unit
};

/// A point of what is swept around an axis.
struct ProfilePoint
{
  double radius; ///< distance from the axis
  double height; ///< along the axis, from its origin
};

/// Builds triangle meshes for the built-in scenes: float vertices with normals, shared along smooth
/// surfaces and duplicated along sharp edges. Fronts are counter-clockwise.
class MeshBuilder
{
public:
  MeshBuilder();

  /// A convex planar polygon, counter-clockwise, as a fan with its own flat normal.
  void addPolygon(const std::vector<Vec3>& corners);

  /// A box between two corners.
  void addBox(const Vec3& low, const Vec3& high);

  /// A smooth patch of columns x rows cells over u, v in [0, 1], two triangles each. The front
  /// looks along cross(dP/du, dP/dv). Triangles that collapse to a line (the poles of a sphere) are
  /// left out.
  void addPatch(
    int columns, int rows, const std::function<SurfacePoint(double u, double v)>& surface);

  /// A smooth patch of which only the places are known; normals follow from its slopes. An edge
  /// may collapse to a point, as a petal's does.
  void addSheet(int columns, int rows, const std::function<Vec3(double u, double v)>& place);

  /// What a profile sweeps around an axis; the front looks away from the axis where the profile
  /// climbs. Open at its ends unless the profile begins and ends on the axis. Every piece of the
  /// profile has its own sharp edges.
  void addLathe(const Axis& axis, const std::vector<ProfilePoint>& profile, int segments);

  /// A cone, cut at its top unless `topRadius` is 0, around a vertical axis; `base` is the centre
  /// of its bottom. Its ends are fans around their centres.
  void addCone(
    const Vec3& base, double height, double bottomRadius, double topRadius, int segments);

  /// A sphere with `stacks` rings from pole to pole and `slices` cells around the vertical axis.
  void addSphere(const Vec3& center, double radius, int slices, int stacks);

  /// How many triangles there are so far.
  vtkIdType triangleCount() const { return this->triangles_->GetNumberOfCells(); }

  /// The mesh built so far.
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
