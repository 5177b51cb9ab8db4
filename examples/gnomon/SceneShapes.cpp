#include "SceneShapes.h"

#include "SceneParts.h"
#include "Vec3.h"

#include <vtkMath.h>

#include <cmath>
#include <map>

namespace gnomon::tool
{

namespace
{

/// The numbers of a shape, whose points are moved.
struct Numbers : std::vector<double>
{
  Numbers(const nlohmann::json& shape, const Vec3& offset)
    : offset(offset)
  {
    for (std::size_t i = 1; i < shape.size() && shape[i].is_number(); ++i)
    {
      this->push_back(shape[i]);
    }
  }
  Vec3 vector(std::size_t i) const { return { (*this)[i], (*this)[i + 1], (*this)[i + 2] }; }
  Vec3 point(std::size_t i) const { return this->vector(i) + this->offset; }
  std::vector<Vec3> points() const
  {
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < this->size(); i += 3)
    {
      all.push_back(this->point(i));
    }
    return all;
  }
  int integer(std::size_t i) const { return static_cast<int>((*this)[i]); }

  const Vec3 offset;
};
constexpr Vec3 unmoved{ -0.0, -0.0, -0.0 }; // added to -0.0, this keeps the sign

/// Add a bowl around an axis, open upwards. It is the part of a sphere below a fifth of the radius
/// above the sphere's centre. That centre lies one radius along the axis.
void addCup(MeshBuilder& mesh, const Vec3& foot, const Vec3& direction, double radius)
{
  const Vec3 right = normalized(cross(direction, { 0.0, 0.0, 1.0 }));
  const Vec3 back = cross(right, direction);
  mesh.addPatch(32, 12,
    [&](double u, double v)
    {
      // The pole is exactly one point.
      const double latitude = (1.0 - v) * -0.5 * vtkMath::Pi() + v * std::asin(0.2);
      const Vec3 turn = around(u);
      const Vec3 outward = turn[0] * right + turn[2] * back;
      const Vec3 normal = (v == 0.0 ? 0.0 : std::cos(latitude)) * outward +
        (v == 0.0 ? -1.0 : std::sin(latitude)) * direction;
      return SurfacePoint{ foot + radius * (direction + normal), normal };
    });
}

/// Add a torus around a vertical axis.
void addTorus(MeshBuilder& mesh, const Vec3& center, double ringRadius, double tubeRadius)
{
  mesh.addPatch(48, 32,
    [&](double u, double v)
    {
      const Vec3 outward = around(u);
      const Vec3 turn = around(v);
      const Vec3 normal = turn[0] * outward + Vec3{ 0.0, -turn[2], 0.0 };
      return SurfacePoint{ center + ringRadius * outward + tubeRadius * normal, normal };
    });
}

/// Add an upright letter C, open towards +x: three quarters of a ring with a square section around
/// the z axis.
void addLetter(MeshBuilder& mesh, const Vec3& center, double inner, double outer, double thickness)
{
  const double h = 0.5 * thickness;
  const auto direction = [](double share)
  {
    const double angle = (0.25 + 1.5 * share) * vtkMath::Pi();
    return Vec3{ std::cos(angle), std::sin(angle), 0.0 };
  };
  const auto place = [&](double share, double radius, double z) {
    return center + radius * direction(share) + Vec3{ 0.0, 0.0, z };
  };
  /// Add a side of the ring between two edges, each a radius and a z.
  const auto addSide = [&](const std::array<double, 2>& from, const std::array<double, 2>& to)
  {
    mesh.addPatch(48, 1,
      [&](double u, double v)
      {
        const Vec3 normal = from[0] == to[0] ? (to[1] > from[1] ? 1.0 : -1.0) * direction(u)
                                             : Vec3{ 0.0, 0.0, from[1] > 0.0 ? 1.0 : -1.0 };
        return SurfacePoint{
          place(u, from[0] + v * (to[0] - from[0]), from[1] + v * (to[1] - from[1])), normal
        };
      });
  };
  addSide({ outer, -h }, { outer, h });
  addSide({ inner, h }, { inner, -h });
  addSide({ outer, h }, { inner, h });
  addSide({ inner, -h }, { outer, -h });
  mesh.addPolygon(
    { place(0.0, inner, h), place(0.0, inner, -h), place(0.0, outer, -h), place(0.0, outer, h) });
  mesh.addPolygon(
    { place(1.0, inner, h), place(1.0, outer, h), place(1.0, outer, -h), place(1.0, inner, -h) });
}

const std::map<std::string, void (*)(MeshBuilder& mesh, const Numbers& n)> kinds = {
  { "box",
    [](MeshBuilder& mesh, const Numbers& n)
    {
      for (std::size_t i = 0; i < n.size(); i += 6)
      {
        mesh.addBox(n.point(i), n.point(i + 3));
      }
    } },
  { "polygon", [](MeshBuilder& mesh, const Numbers& n) { mesh.addPolygon(n.points()); } },
  { "plane", [](MeshBuilder& mesh, const Numbers& n) { mesh.addPlane(n.point(0), n[3]); } },
  { "cone",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addCone(n.point(0), n[3], n[4], n[5], n.integer(6)); } },
  { "sphere",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addSphere(n.point(0), n[3], n.integer(4), n.integer(5)); } },
  { "lathe",
    [](MeshBuilder& mesh, const Numbers& n)
    {
      std::vector<ProfilePoint> profile;
      for (std::size_t i = 7; i < n.size(); i += 2)
      {
        profile.push_back({ n[i], n[i + 1] });
      }
      mesh.addLathe({ n.point(0), normalized(n.vector(3)) }, profile, n.integer(6));
    } },
  { "limb",
    [](MeshBuilder& mesh, const Numbers& n)
    { mesh.addLimb(n.point(0), n.point(3), n[6], n[7], n.integer(8)); } },
  { "cup",
    [](MeshBuilder& mesh, const Numbers& n) { addCup(mesh, n.point(0), n.vector(3), n[6]); } },
  { "torus", [](MeshBuilder& mesh, const Numbers& n) { addTorus(mesh, n.point(0), n[3], n[4]); } },
  { "letter",
    [](MeshBuilder& mesh, const Numbers& n) { addLetter(mesh, n.point(0), n[3], n[4], n[5]); } },
};

/// Add shapes from an index on.
void addShapes(
  MeshBuilder& mesh, const nlohmann::json& shapes, std::size_t from, const Vec3& offset)
{
  for (std::size_t i = from; i < shapes.size(); ++i)
  {
    const Numbers n(shapes[i], offset);
    if (shapes[i][0] != "repeat")
    {
      kinds.at(shapes[i][0])(mesh, n);
      continue;
    }
    for (double k = 0.0; k < n[0]; ++k)
    {
      addShapes(mesh, shapes[i], 5, k * n.vector(1) + offset);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
SceneModel makeShapes(const nlohmann::json& shapes)
{
  const std::string kind = shapes[0][0];
  const Numbers n(shapes[0], unmoved);
  if (kind == "triangles")
  {
    return makeTriangles(kind, n.points());
  }
  if (kind == "sheet")
  {
    const Vec3 a = n.point(0), b = a + n.vector(3), c = b + n.vector(6), d = a + n.vector(6);
    return makeTriangles(kind, { a, b, c, a, c, d });
  }
  MeshBuilder mesh;
  addShapes(mesh, shapes, 0, unmoved);
  return makeModel(kind, mesh.build(), kind == "plane" ? planeColor : casterColor);
}

} // namespace gnomon::tool
