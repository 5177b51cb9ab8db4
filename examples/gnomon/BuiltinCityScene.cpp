#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "Noise.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

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
constexpr double streetWidth = 22.0;
constexpr double pitch = blockSide + streetWidth;

/// A compact mesh of quads: flat, without normals, with corners shared along walls and 32-bit
/// indices. A window of 30 triangles takes 700 bytes.
class CityMesh
{
public:
  CityMesh()
  {
    this->points_->SetDataTypeToFloat();
    this->triangles_->Use32BitStorage();
  }

  vtkIdType addPoint(const Vec3& place) { return this->points_->InsertNextPoint(place.data()); }

  /// Add a quad of counter-clockwise corners.
  void addQuad(vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d)
  {
    this->triangles_->InsertNextCell({ a, b, c });
    this->triangles_->InsertNextCell({ a, c, d });
  }

  /// Add a block. Its lower and upper side have the same four corners, counter-clockwise from
  /// above.
  void addBlock(const std::array<Vec3, 4>& lower, double height)
  {
    vtkIdType low[4];
    vtkIdType high[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      low[i] = this->addPoint(lower[i]);
      high[i] = this->addPoint(lower[i] + Vec3{ { 0.0, height, 0.0 } });
    }
    this->addQuad(low[3], low[2], low[1], low[0]);
    this->addQuad(high[0], high[1], high[2], high[3]);
    for (int i = 0; i < 4; ++i)
    {
      const int next = (i + 1) % 4;
      this->addQuad(low[i], low[next], high[next], high[i]);
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
    return { { this->center + Vec3{ { -w, 0.0, d } }, this->center + Vec3{ { w, 0.0, d } },
      this->center + Vec3{ { w, 0.0, -d } }, this->center + Vec3{ { -w, 0.0, -d } } } };
  }
};

void addPrism(CityMesh& mesh, const Plot& plot, double height)
{
  mesh.addBlock(plot.corners(), height);
}

/// Add a wall between two upright edges as a grid of bays. Seen from its front, `from` is on the
/// left. Each bay has a recessed window with a projecting sill.
void addFacade(CityMesh& mesh, const Vec3& from, const Vec3& to, int bays, int floors,
  double floorHeight, double windowShare)
{
  const Vec3 along = (1.0 / bays) * (to - from);
  const Vec3 storey{ { 0.0, floorHeight, 0.0 } };
  const Vec3 outward = normalized(cross(along, storey));
  constexpr double depth = 0.35;
  constexpr double sillReach = 0.25;

  const vtkIdType grid = mesh.addPoint(from);
  for (int floor = 0; floor <= floors; ++floor)
  {
    for (int bay = floor == 0 ? 1 : 0; bay <= bays; ++bay)
    {
      mesh.addPoint(from + static_cast<double>(bay) * along + static_cast<double>(floor) * storey);
    }
  }
  const double margin = 0.5 * (1.0 - windowShare);
  for (int floor = 0; floor < floors; ++floor)
  {
    for (int bay = 0; bay < bays; ++bay)
    {
      const vtkIdType low = grid + floor * (bays + 1) + bay;
      const vtkIdType high = low + bays + 1;
      const vtkIdType wall[4] = { low, low + 1, high + 1, high };
      const Vec3 corner =
        from + static_cast<double>(bay) * along + static_cast<double>(floor) * storey;
      const Vec3 opening[4] = { corner + margin * along + 0.28 * storey,
        corner + (1.0 - margin) * along + 0.28 * storey,
        corner + (1.0 - margin) * along + 0.85 * storey, corner + margin * along + 0.85 * storey };
      vtkIdType rim[4];
      vtkIdType pane[4];
      for (int i = 0; i < 4; ++i)
      {
        rim[i] = mesh.addPoint(opening[i]);
        pane[i] = mesh.addPoint(opening[i] - depth * outward);
      }
      for (int i = 0; i < 4; ++i)
      {
        const int next = (i + 1) % 4;
        mesh.addQuad(wall[i], wall[next], rim[next], rim[i]);
        mesh.addQuad(rim[i], rim[next], pane[next], pane[i]);
      }
      mesh.addQuad(pane[0], pane[1], pane[2], pane[3]);

      const Vec3 sill = opening[0] - 0.05 * along - 0.05 * storey;
      const Vec3 sillAlong = (windowShare + 0.1) * along;
      mesh.addBlock({ { sill + sillReach * outward, sill + sillReach * outward + sillAlong,
                      sill + sillAlong, sill } },
        0.05 * floorHeight);
    }
  }
}

/// Add storeys of one outline: four walls with windows, a ledge below, a cornice on top, and the
/// roof.
/// @return the height of the top
double addTier(CityMesh& mesh, const Plot& plot, int floors, double floorHeight, double windowShare)
{
  const std::array<Vec3, 4> corners = plot.corners();
  constexpr double bayWidth = 3.2;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Vec3& from = corners[i];
    const Vec3& to = corners[(i + 1) % 4];
    const int bays = std::max(1, static_cast<int>(length(to - from) / bayWidth));
    addFacade(mesh, from, to, bays, floors, floorHeight, windowShare);
  }
  const double height = floors * floorHeight;
  // A ledge runs around the tower at every eighth storey.
  for (int floor = 8; floor < floors; floor += 8)
  {
    Plot ledge = plot;
    ledge.center[1] += floor * floorHeight - 0.15;
    ledge.width += 0.9;
    ledge.depth += 0.9;
    addPrism(mesh, ledge, 0.3);
  }
  Plot cornice = plot;
  cornice.center[1] += height;
  cornice.width += 1.4;
  cornice.depth += 1.4;
  addPrism(mesh, cornice, 0.8);
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
  addPrism(mesh, plot, 4.0);
  if (tiers == 3)
  {
    addPrism(mesh, { plot.center + Vec3{ { 0.0, 4.0, 0.0 } }, 0.7, 0.7 }, 22.0);
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
  const Vec3 center{ { (column - middle) * pitch, 0.0, (row - middle) * pitch } };
  Random random(static_cast<std::uint32_t>(1000 + row * blocksPerSide + column));
  addPrism(pavement, { center, blockSide, blockSide }, 0.15);
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
    CityMesh& mesh = towers[static_cast<std::size_t>(random.between(0.0, 4.0))];
    addTower(mesh, plot, height, random);
  }
}

} // namespace

//------------------------------------------------------------------------------
Scene makeCityScene()
{
  const Vec3 colors[] = { { { 0.78, 0.72, 0.62 } }, { { 0.6, 0.64, 0.7 } }, { { 0.7, 0.52, 0.43 } },
    { { 0.84, 0.83, 0.8 } } };
  Scene scene;
  scene.models = { makePlane({ { 0.0, 0.0, 0.0 } }, (blocksPerSide + 8) * pitch) };
  scene.models[0].name = "streets";
  scene.models[0].property->SetColor(0.33, 0.34, 0.36);
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
  scene.models.push_back(makeModel("pavement", pavement.build(), { { 0.6, 0.6, 0.58 } }));
  scene.camera = makeCamera({ { 245.0, 175.0, 640.0 } }, { { -10.0, 50.0, -60.0 } }, 45.0);
  scene.lights = { makeSun({ { 0.75, -0.62, -0.4 } }, { { 1.0, 0.95, 0.86 } }, 1.4) };
  setAmbient(scene, 0.3);
  scene.background = { { 0.72, 0.82, 0.93 } };
  return scene;
}

} // namespace gnomon::tool
