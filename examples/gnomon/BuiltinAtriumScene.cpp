#include "BuiltinParts.h"
#include "BuiltinScenes.h"
#include "MeshBuilder.h"
#include "Noise.h"
#include "SceneFraming.h"
#include "Vec3.h"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>

// A court in the style of Sponza, whose model is not packaged. It has about Sponza's size in
// centimetres, with the light and main camera of Morais' thesis (section 5.1).

namespace gnomon::tool
{

namespace
{

constexpr double courtHalfLength = 1200.0; ///< from the middle to the arcades, along x
constexpr double courtHalfWidth = 300.0;   ///< along z
constexpr double aisle = 290.0;            ///< depth behind the arcades
constexpr double storeyHeight = 440.0;
constexpr double slabHeight = 30.0;
constexpr double springHeight = 265.0; ///< where arches leave their columns
const double half = 0.5;

/// The bay between two columns.
struct Bay
{
  Vec3 from;
  Vec3 to;
  Vec3 along() const { return normalized(this->to - this->from); }
  Vec3 inward() const { return cross(this->along(), up); } ///< towards the court
  double width() const { return length(this->to - this->from); }
};

/// Return the bays around the court on the ground, from left to right as seen from the court.
std::vector<Bay> makeBays()
{
  const Vec3 corners[] = { { { courtHalfLength, 0.0, courtHalfWidth } },
    { { -courtHalfLength, 0.0, courtHalfWidth } }, { { -courtHalfLength, 0.0, -courtHalfWidth } },
    { { courtHalfLength, 0.0, -courtHalfWidth } } };
  std::vector<Bay> bays;
  for (int side = 0; side < 4; ++side)
  {
    const Vec3& from = corners[side];
    const Vec3& to = corners[(side + 1) % 4];
    const int count = side % 2 == 0 ? 10 : 3;
    for (int i = 0; i < count; ++i)
    {
      const Vec3 step = (1.0 / count) * (to - from);
      bays.push_back(
        { from + static_cast<double>(i) * step, from + static_cast<double>(i + 1) * step });
    }
  }
  return bays;
}

//------------------------------------------------------------------------------
// Stone

void addColumn(MeshBuilder& mesh, const Vec3& foot, double radius)
{
  const double top = springHeight - 20.0;
  std::vector<ProfilePoint> profile = { { 1.35 * radius, 12.0 }, { 1.45 * radius, 16.0 },
    { 1.45 * radius, 22.0 }, { 1.3 * radius, 26.0 }, { 1.15 * radius, 28.0 },
    { 1.25 * radius, 33.0 }, { 1.15 * radius, 38.0 }, { radius, 40.0 } };
  // The shaft swells a little below its middle.
  for (int i = 1; i <= 5; ++i)
  {
    const double share = i / 6.0;
    profile.push_back({ radius * (1.0 + 0.05 * std::sin(vtkMath::Pi() * share) - 0.15 * share),
      40.0 + share * (top - 80.0) });
  }
  const double neck = 0.85 * radius;
  profile.insert(profile.end(),
    { { neck, top - 38.0 }, { 1.15 * neck, top - 35.0 }, { neck, top - 32.0 },
      { 1.1 * neck, top - 22.0 }, { 1.4 * neck, top - 10.0 }, { 1.7 * neck, top - 4.0 },
      { 1.75 * neck, top } });
  mesh.addLathe({ foot, up }, profile, 24);
  const double plinth = 1.6 * radius;
  mesh.addBox(foot - Vec3{ { plinth, 0.0, plinth } }, foot + Vec3{ { plinth, 12.0, plinth } });
  mesh.addBox(
    foot + Vec3{ { -plinth, top, -plinth } }, foot + Vec3{ { plinth, springHeight, plinth } });
}

/// Add the wall above a bay's opening: an arch with two faces, up to the floor above.
void addArch(MeshBuilder& mesh, const Bay& bay, double pier, double thickness)
{
  constexpr int segments = 24;
  const double radius = half * bay.width() - pier;
  const Vec3 center = half * (bay.from + bay.to) + springHeight * up;
  const double top = storeyHeight - slabHeight - springHeight;
  const Vec3 along = bay.along();
  const Vec3 depth = (half * thickness) * bay.inward();
  const auto rise = [&](double share)
  {
    // Flatter than a circle if a circle would exceed the storey.
    const double angle = vtkMath::Pi() * (1.0 - share);
    return std::pair<double, double>(
      radius * std::cos(angle), std::min(1.0, 0.85 * top / radius) * radius * std::sin(angle));
  };
  const auto onArch = [&](double share)
  {
    const auto [x, y] = rise(share);
    return center + x * along + y * up;
  };
  // The underside looks down: across the wall first, then along it.
  mesh.addSheet(
    segments, 1, [&](double u, double v) { return onArch(u) + (2.0 * v - 1.0) * depth; });
  for (int i = 0; i < segments; ++i)
  {
    const Vec3 a = onArch(static_cast<double>(i) / segments);
    const Vec3 b = onArch(static_cast<double>(i + 1) / segments);
    const auto above = [&](const Vec3& point) { return point + (center[1] + top - point[1]) * up; };
    mesh.addPolygon({ a + depth, b + depth, above(b) + depth, above(a) + depth });
    mesh.addPolygon({ b - depth, a - depth, above(a) - depth, above(b) - depth });
  }
  // The wall from the arch's feet to the columns' axes.
  for (const double side : { -1.0, 1.0 })
  {
    const Vec3 inner = center + (side * radius) * along;
    const Vec3 outer = center + (side * half * bay.width()) * along;
    const Vec3& left = side < 0.0 ? outer : inner;
    const Vec3& right = side < 0.0 ? inner : outer;
    const Vec3 rise2 = top * up;
    mesh.addPolygon({ left + depth, right + depth, right + depth + rise2, left + depth + rise2 });
    mesh.addPolygon({ right - depth, left - depth, left - depth + rise2, right - depth + rise2 });
    mesh.addPolygon({ left - depth, right - depth, right + depth, left + depth });
  }
}

SceneModel makeArcades(const std::vector<Bay>& bays)
{
  MeshBuilder mesh;
  for (int storey = 0; storey < 2; ++storey)
  {
    const Vec3 floor = (storey * storeyHeight) * up;
    for (const Bay& bay : bays)
    {
      const Bay here{ bay.from + floor, bay.to + floor };
      addColumn(mesh, here.from, storey == 0 ? 24.0 : 18.0);
      addArch(mesh, here, storey == 0 ? 38.0 : 30.0, 50.0);
    }
  }
  return makeModel("arcades", mesh.build(), { { 0.76, 0.69, 0.58 } });
}

/// Return rails on turned balusters between the columns of the upper storey.
SceneModel makeBalustrades(const std::vector<Bay>& bays)
{
  MeshBuilder mesh;
  for (const Bay& bay : bays)
  {
    constexpr int count = 7;
    for (int i = 0; i < count; ++i)
    {
      const double share = (i + 1.0) / (count + 1.0);
      mesh.addLathe({ bay.from + share * (bay.to - bay.from) + storeyHeight * up, up },
        { { 9.0, 0.0 }, { 9.0, 8.0 }, { 5.0, 12.0 }, { 10.0, 30.0 }, { 4.0, 55.0 }, { 4.0, 66.0 },
          { 8.0, 70.0 }, { 8.0, 76.0 } },
        10);
    }
    const Vec3 depth = 11.0 * bay.inward();
    const Vec3 low = storeyHeight * up + 76.0 * up;
    const Vec3 a = bay.from + 16.0 * bay.along() + low;
    const Vec3 b = bay.to - 16.0 * bay.along() + low;
    mesh.addBox({ { std::min(a[0], b[0]) - std::abs(depth[0]), a[1],
                  std::min(a[2], b[2]) - std::abs(depth[2]) } },
      { { std::max(a[0], b[0]) + std::abs(depth[0]), a[1] + 12.0,
        std::max(a[2], b[2]) + std::abs(depth[2]) } });
  }
  return makeModel("balustrades", mesh.build(), { { 0.82, 0.77, 0.68 } });
}

/// Return the ground, galleries, their roofs, and the outer walls.
SceneModel makeShell()
{
  const double x0 = courtHalfLength + 25.0;
  const double z0 = courtHalfWidth + 25.0;
  const double x1 = courtHalfLength + aisle;
  const double z1 = courtHalfWidth + aisle;
  MeshBuilder mesh;
  mesh.addBox({ { -x1 - 60.0, -40.0, -z1 - 60.0 } }, { { x1 + 60.0, -4.0, z1 + 60.0 } });
  for (int storey = 1; storey <= 2; ++storey)
  {
    // The upper edge of the slab is the floor above; the roof juts out over the court.
    const double high = storey * storeyHeight;
    const double low = high - slabHeight;
    const double reach = storey == 2 ? 80.0 : 50.0;
    mesh.addBox({ { -x1, low, z0 - reach } }, { { x1, high, z1 } });
    mesh.addBox({ { -x1, low, -z1 } }, { { x1, high, reach - z0 } });
    mesh.addBox({ { -x1, low, reach - z0 } }, { { reach - x0, high, z0 - reach } });
    mesh.addBox({ { x0 - reach, low, reach - z0 } }, { { x1, high, z0 - reach } });
  }
  const double top = 2.0 * storeyHeight + 60.0;
  mesh.addBox({ { -x1 - 60.0, -4.0, z1 } }, { { x1 + 60.0, top, z1 + 60.0 } });
  mesh.addBox({ { -x1 - 60.0, -4.0, -z1 - 60.0 } }, { { x1 + 60.0, top, -z1 } });
  mesh.addBox({ { -x1 - 60.0, -4.0, -z1 } }, { { -x1, top, z1 } });
  mesh.addBox({ { x1, -4.0, -z1 } }, { { x1 + 60.0, top, z1 } });
  return makeModel("shell", mesh.build(), { { 0.68, 0.6, 0.5 } });
}

/// Return pilasters and string courses on the outer walls, and doors between them.
SceneModel makeWallRelief()
{
  const double z1 = courtHalfWidth + aisle;
  MeshBuilder mesh;
  for (const double side : { -1.0, 1.0 })
  {
    for (int storey = 0; storey < 2; ++storey)
    {
      const double y = storey * storeyHeight;
      for (int i = 0; i <= 12; ++i)
      {
        const double x = -1440.0 + 240.0 * i;
        const double wall = side * z1;
        const double face = side * (z1 - 18.0);
        mesh.addBox({ { x - 20.0, y, std::min(wall, face) } },
          { { x + 20.0, y + storeyHeight - slabHeight, std::max(wall, face) } });
        if (i < 12)
        {
          // A frame around a door: two jambs and a lintel.
          const double door = x + 120.0;
          const double front = side * (z1 - 10.0);
          const double z = std::min(wall, front);
          const double zEnd = std::max(wall, front);
          mesh.addBox({ { door - 60.0, y, z } }, { { door - 45.0, y + 215.0, zEnd } });
          mesh.addBox({ { door + 45.0, y, z } }, { { door + 60.0, y + 215.0, zEnd } });
          mesh.addBox({ { door - 68.0, y + 215.0, z } }, { { door + 68.0, y + 235.0, zEnd } });
          mesh.addBox({ { door - 98.0, y + 290.0, z } }, { { door + 98.0, y + 302.0, zEnd } });
        }
      }
    }
  }
  return makeModel("wall relief", mesh.build(), { { 0.73, 0.65, 0.54 } });
}

/// Return the stones of one of two colours, with open joints, on the ground below.
SceneModel makePaving(bool light)
{
  constexpr double stone = 98.0;
  MeshBuilder mesh;
  for (int column = 0; column < 30; ++column)
  {
    for (int row = 0; row < 12; ++row)
    {
      if (((column + row) % 2 == 0) != light)
      {
        continue;
      }
      const double x = -1485.0 + 99.0 * column;
      const double z = -588.0 + 98.0 * row;
      mesh.addBox({ { x, -4.0, z } }, { { x + stone, 0.0, z + stone - 1.0 } });
    }
  }
  return light ? makeModel("light paving", mesh.build(), { { 0.74, 0.7, 0.62 } })
               : makeModel("dark paving", mesh.build(), { { 0.56, 0.5, 0.45 } });
}

//------------------------------------------------------------------------------
// Cloth: open sheets of 64 x 64 cells, displaced by sines

constexpr int clothCells = 64;

/// Add a banner that hangs from the gallery's rail into the court, in folds that widen downwards.
void addBanner(MeshBuilder& mesh, const Bay& bay, int i)
{
  const double width = 0.55 * bay.width();
  const double fall = 300.0 + 25.0 * (i % 3);
  const Vec3 along = bay.along();
  const Vec3 hook = half * (bay.from + bay.to) + 42.0 * bay.inward() + (storeyHeight + 84.0) * up;
  mesh.addSheet(clothCells, clothCells,
    [&](double u, double v)
    {
      const double down = 1.0 - v;
      const double fold = std::sin(9.0 * u + 1.7 * i) + 0.4 * std::sin(23.0 * u - 3.0 * down + i);
      const double sway = 10.0 * std::sin(2.5 * down + i);
      return hook + ((u - half) * width * (1.0 - 0.08 * down)) * along - (fall * down) * up +
        (14.0 * down * fold + down * sway) * bay.inward();
    });
}

/// Add a sagging awning across the court, from roof to roof.
void addAwning(MeshBuilder& mesh, double x, double width, int i)
{
  const double reach = courtHalfWidth - 55.0;
  mesh.addSheet(clothCells, clothCells,
    [&](double u, double v)
    {
      const double sag = 90.0 * (4.0 * v * (1.0 - v));
      const double ripple = 9.0 * std::sin(14.0 * u + i) * std::sin(vtkMath::Pi() * v) +
        4.0 * std::sin(31.0 * v + 5.0 * u);
      return Vec3{ { x + (u - half) * width + 25.0 * std::sin(4.0 * v + i),
        2.0 * storeyHeight - 45.0 - sag + ripple, reach * (1.0 - 2.0 * v) } };
    });
}

void addCloth(Scene& scene, const std::vector<Bay>& bays)
{
  const struct
  {
    const char* name;
    Vec3 color;
  } dyes[] = { { "red cloth", { { 0.68, 0.18, 0.16 } } },
    { "green cloth", { { 0.2, 0.45, 0.28 } } }, { "blue cloth", { { 0.2, 0.3, 0.6 } } } };
  for (int dye = 0; dye < 3; ++dye)
  {
    MeshBuilder mesh;
    // On the long sides' odd bays, alternately.
    for (int i = dye; i < 10; i += 3)
    {
      const int side = i % 2;
      addBanner(mesh, bays[static_cast<std::size_t>(13 * side + 2 * (i / 2) + side)], i);
    }
    scene.models.push_back(makeModel(dyes[dye].name, mesh.build(), dyes[dye].color));
  }
  MeshBuilder sails;
  for (int i = 0; i < 4; ++i)
  {
    addAwning(sails, -880.0 + 560.0 * i, 240.0, i);
  }
  scene.models.push_back(makeModel("awnings", sails.build(), { { 0.9, 0.84, 0.7 } }));
}

//------------------------------------------------------------------------------
/// Add pots with open rims in front of the columns, with plants of open leaves.
void addPots(Scene& scene, const std::vector<Bay>& bays)
{
  MeshBuilder pots;
  MeshBuilder leaves;
  Random random(5);
  for (std::size_t i = 1; i < bays.size(); ++i)
  {
    const Bay& bay = bays[i];
    const Vec3 foot = bay.from + 62.0 * bay.inward();
    pots.addLathe({ foot, up },
      { { 0.0, 1.0 }, { 16.0, 1.0 }, { 18.0, 0.0 }, { 20.0, 4.0 }, { 15.0, 8.0 }, { 17.0, 12.0 },
        { 27.0, 28.0 }, { 30.0, 42.0 }, { 26.0, 52.0 }, { 25.0, 56.0 }, { 31.0, 60.0 },
        { 32.0, 63.0 } },
      24);
    for (int leaf = 0; leaf < 106; ++leaf)
    {
      const double turn = 2.4 * leaf;
      const double lean = random.between(0.1, 1.2);
      const double size = random.between(45.0, 85.0);
      const double width = random.between(4.0, 8.0);
      const Vec3 outward{ { std::cos(turn), 0.0, std::sin(turn) } };
      const Vec3 across = cross(up, outward);
      leaves.addSheet(2, 5,
        [&](double u, double v)
        {
          // A blade that leans outwards increasingly, pointed at both ends.
          const double angle = lean * (0.4 + 0.9 * v);
          const double side = (2.0 * u - 1.0) * width * 4.0 * v * (1.0 - v);
          return foot + 46.0 * up + 6.0 * outward + side * across +
            (size * v) * (std::cos(angle) * up + std::sin(angle) * outward) +
            (0.3 * std::abs(side)) * up;
        });
    }
  }
  scene.models.push_back(makeModel("pots", pots.build(), { { 0.66, 0.4, 0.27 } }));
  scene.models.push_back(makeModel("plants", leaves.build(), { { 0.3, 0.47, 0.22 } }));
}

} // namespace

//------------------------------------------------------------------------------
Scene makeAtriumScene()
{
  Scene scene;
  const std::vector<Bay> bays = makeBays();
  scene.models = { makeShell(), makeArcades(bays), makeBalustrades(bays), makeWallRelief(),
    makePaving(true), makePaving(false) };
  addCloth(scene, bays);
  addPots(scene, bays);
  const Vec3 eye{ { -83.72924, 222.06694, -2.89993 } };
  scene.camera = makeCamera(eye, eye + 500.0 * Vec3{ { 0.810612, -0.273794, 0.517634 } }, 60.0);
  scene.lights = { makeSun({ { -0.001881, -0.968051, 0.250748 } }, { { 1.0, 0.96, 0.86 } }, 1.2) };
  setAmbient(scene, 0.4);
  scene.background = { { 0.6, 0.75, 0.92 } };
  return scene;
}

} // namespace gnomon::tool
