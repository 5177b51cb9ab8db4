#include "Noise.h"
#include "SceneParts.h"
#include "Vec3.h"

#include <algorithm>
#include <cmath>

// Streets and towers. Lengths are metres.

namespace gnomon::tool
{

namespace
{

constexpr int blocksPerSide = 18;
constexpr int blocksPerDistrict = 3; ///< along a side; a district is one model per colour
constexpr double blockSide = 60.0;   ///< between the kerbs
constexpr double pitch = blockSide + 22.0;

/// A horizontal rectangle around a centre.
struct Plot
{
  Vec3 center;
  double width; ///< along x
  double depth; ///< along z

  /// Return the corners, counter-clockwise from above.
  std::array<Vec3, 4> corners() const
  {
    const double w = 0.5 * this->width;
    const double d = 0.5 * this->depth;
    return { this->center + Vec3{ -w, 0.0, d }, this->center + Vec3{ w, 0.0, d },
      this->center + Vec3{ w, 0.0, -d }, this->center + Vec3{ -w, 0.0, -d } };
  }
  /// Return the plot at a height above this one, larger by `reach`.
  Plot above(double height, double reach) const
  {
    return { this->center + height * up, this->width + reach, this->depth + reach };
  }
};

/// A compact mesh of quads: flat, without normals, with corners shared along walls and 32-bit
/// indices. A window of 30 triangles takes 700 bytes.
class CityMesh
{
public:
  CityMesh() { this->triangles_->Use32BitStorage(); }

  vtkIdType addPoint(const Vec3& place) { return this->points_->InsertNextPoint(place.data()); }

  /// Add a quad of counter-clockwise corners.
  void addQuad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d)
  {
    this->triangles_->InsertNextCell({ a, b, c });
    this->triangles_->InsertNextCell({ a, c, d });
  }

  /// Add a block over four corners, counter-clockwise from above.
  void addBlock(const std::array<Vec3, 4>& lower, double height)
  {
    vtkIdType low[4], high[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      low[i] = this->addPoint(lower[i]);
      high[i] = this->addPoint(lower[i] + height * up);
    }
    this->addQuad(low[3], low[2], low[1], low[0]);
    this->addQuad(high[0], high[1], high[2], high[3]);
    for (int i = 0; i < 4; ++i)
    {
      this->addQuad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
    }
  }

  vtkSmartPointer<vtkPolyData> build() const
  {
    this->points_->Squeeze();
    this->triangles_->Squeeze();
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->points_);
    mesh->SetPolys(this->triangles_);
    return mesh;
  }

private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> triangles_;
};

/// Add a wall between two upright edges as a grid of bays. Seen from its front, `from` is on the
/// left. Each bay has a recessed window with a projecting sill.
void addFacade(CityMesh& mesh, const Vec3& from, const Vec3& to, int bays, int floors,
  double floorHeight, double windowShare)
{
  const Vec3 along = (1.0 / bays) * (to - from);
  const Vec3 storey = floorHeight * up;
  const Vec3 outward = normalized(cross(along, storey));
  const auto cornerOf = [&](double bay, double floor)
  { return from + bay * along + floor * storey; };
  vtkIdType low = 0; // the point at a bay's lower left; the next row's points follow
  for (int floor = 0; floor <= floors; ++floor)
  {
    for (int bay = 0; bay <= bays; ++bay)
    {
      low = mesh.addPoint(cornerOf(bay, floor));
    }
  }
  low -= (floors + 1) * (bays + 1) - 1;
  const double margin = 0.5 * (1.0 - windowShare);
  for (int floor = 0; floor < floors; ++floor, ++low)
  {
    for (int bay = 0; bay < bays; ++bay, ++low)
    {
      const vtkIdType high = low + bays + 1;
      const vtkIdType wall[4] = { low, low + 1, high + 1, high };
      const Vec3 corner = cornerOf(bay, floor);
      const Vec3 opening[4] = { corner + margin * along + 0.28 * storey,
        corner + (1.0 - margin) * along + 0.28 * storey,
        corner + (1.0 - margin) * along + 0.85 * storey, corner + margin * along + 0.85 * storey };
      vtkIdType rim[4], pane[4];
      for (int i = 0; i < 4; ++i)
      {
        rim[i] = mesh.addPoint(opening[i]);
        pane[i] = mesh.addPoint(opening[i] - 0.35 * outward);
      }
      for (int i = 0; i < 4; ++i)
      {
        const int next = (i + 1) % 4;
        mesh.addQuad(wall[i], wall[next], rim[next], rim[i]);
        mesh.addQuad(rim[i], rim[next], pane[next], pane[i]);
      }
      mesh.addQuad(pane[0], pane[1], pane[2], pane[3]);
      const Vec3 sill = opening[0] - 0.05 * along - 0.05 * storey;
      const Vec3 end = (windowShare + 0.1) * along;
      const Vec3 reach = 0.25 * outward;
      mesh.addBlock({ sill + reach, sill + reach + end, sill + end, sill }, 0.05 * floorHeight);
    }
  }
}

/// Add storeys of one outline: four walls with windows, a ledge below, a cornice on top, and the
/// roof.
/// @return the height of the top
double addTier(CityMesh& mesh, const Plot& plot, int floors, double floorHeight, double windowShare)
{
  const std::array<Vec3, 4> corners = plot.corners();
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Vec3& to = corners[(i + 1) % 4];
    const int bays = std::max(1, static_cast<int>(length(to - corners[i]) / 3.2));
    addFacade(mesh, corners[i], to, bays, floors, floorHeight, windowShare);
  }
  // A ledge runs around the tower at every eighth storey.
  for (int floor = 8; floor < floors; floor += 8)
  {
    mesh.addBlock(plot.above(floor * floorHeight - 0.15, 0.9).corners(), 0.3);
  }
  const Plot cornice = plot.above(floors * floorHeight, 1.4);
  mesh.addBlock(cornice.corners(), 0.8);
  return cornice.center[1] + 0.8;
}

/// Add a tower of up to three tiers, each narrower than the one below, with the structures on its
/// roof.
void addTower(CityMesh& mesh, Plot plot, double height, Random& random)
{
  const double floorHeight = random.between(3.2, 3.9);
  const double windowShare = random.between(0.45, 0.75);
  const int tiers = height > 120.0 ? 3 : height > 60.0 ? 2 : 1;
  for (int tier = 0; tier < tiers; ++tier)
  {
    const double share = tiers == 1 ? 1.0 : tier == 0 ? 0.55 : 0.45 / (tiers - 1);
    const int floors = std::max(3, static_cast<int>(share * height / floorHeight));
    plot.center[1] = addTier(mesh, plot, floors, floorHeight, windowShare);
    plot.width *= random.between(0.62, 0.85);
    plot.depth *= random.between(0.62, 0.85);
  }
  // A machine room, and an antenna on the tallest towers.
  plot.width *= 0.5;
  plot.depth *= 0.5;
  mesh.addBlock(plot.corners(), 4.0);
  if (tiers == 3)
  {
    mesh.addBlock(Plot{ plot.center + 4.0 * up, 0.7, 0.7 }.corners(), 22.0);
  }
}

/// Return the buildings' height at a place: high in the middle, low at the rim, with a second
/// centre to one side.
double skyline(double x, double z)
{
  const auto bell = [&](double cx, double cz, double radius)
  {
    const double dx = (x - cx) / radius;
    const double dz = (z - cz) / radius;
    return std::exp(-dx * dx - dz * dz);
  };
  return 22.0 + 97.0 * bell(0.0, -60.0, 330.0) + 44.0 * bell(-450.0, 400.0, 200.0);
}

/// Add four towers of different heights on a block. One block in eleven is a park.
void addBlock(std::array<CityMesh, 4>& towers, CityMesh& pavement, int column, int row)
{
  const double middle = 0.5 * (blocksPerSide - 1);
  const Vec3 center{ (column - middle) * pitch, 0.0, (row - middle) * pitch };
  Random random(static_cast<std::uint32_t>(1000 + row * blocksPerSide + column));
  pavement.addBlock(Plot{ center, blockSide, blockSide }.corners(), 0.15);
  if (random.between(0.0, 1.0) < 0.09)
  {
    return;
  }
  for (int i = 0; i < 4; ++i)
  {
    const double size = 0.5 * blockSide - 3.0;
    Plot plot{ center, size - random.between(0.0, 7.0), size - random.between(0.0, 7.0) };
    plot.center[0] += (i % 2 ? 0.25 : -0.25) * blockSide;
    plot.center[1] = 0.15;
    plot.center[2] += (i / 2 ? 0.25 : -0.25) * blockSide;
    const double height = skyline(plot.center[0], plot.center[2]) * random.between(0.55, 1.45);
    addTower(towers[static_cast<std::size_t>(random.between(0.0, 4.0))], plot, height, random);
  }
}

} // namespace

void addCity(Scene& scene)
{
  const Vec3 colors[] = { { 0.78, 0.72, 0.62 }, { 0.6, 0.64, 0.7 }, { 0.7, 0.52, 0.43 },
    { 0.84, 0.83, 0.8 } };
  CityMesh pavement;
  constexpr int districts = blocksPerSide / blocksPerDistrict;
  for (int district = 0; district < districts * districts; ++district)
  {
    std::array<CityMesh, 4> towers;
    for (int i = 0; i < blocksPerDistrict * blocksPerDistrict; ++i)
    {
      addBlock(towers, pavement, blocksPerDistrict * (district % districts) + i % blocksPerDistrict,
        blocksPerDistrict * (district / districts) + i / blocksPerDistrict);
    }
    for (std::size_t i = 0; i < towers.size(); ++i)
    {
      scene.models.push_back(
        makeModel("towers " + std::to_string(district), towers[i].build(), colors[i]));
    }
  }
  scene.models.push_back(makeModel("pavement", pavement.build(), { 0.6, 0.6, 0.58 }));
}

} // namespace gnomon::tool
