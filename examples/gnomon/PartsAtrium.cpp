#include "Noise.h"
#include "SceneParts.h"
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

constexpr double storeyHeight = 440.0;
constexpr double springHeight = 265.0; ///< where arches leave their columns
constexpr double half = 0.5;

/// The bay between two columns.
struct Bay
{
  Vec3 from;
  Vec3 to;
  Vec3 along() const { return normalized(this->to - this->from); }
  Vec3 inward() const { return cross(this->along(), up); } ///< towards the court
  Vec3 middle() const { return half * (this->from + this->to); }
  double width() const { return length(this->to - this->from); }
};

/// Return the bays around the court on the ground, from left to right as seen from the court: ten
/// on the long sides, three on the short ones.
const std::vector<Bay>& allBays()
{
  static const std::vector<Bay> bays = []
  {
    constexpr Vec3 corners[] = { { 1200.0, 0.0, 300.0 }, { -1200.0, 0.0, 300.0 },
      { -1200.0, 0.0, -300.0 }, { 1200.0, 0.0, -300.0 } };
    std::vector<Bay> all;
    for (int side = 0; side < 4; ++side)
    {
      const int count = side % 2 == 0 ? 10 : 3;
      const Vec3& from = corners[side];
      const Vec3 step = (1.0 / count) * (corners[(side + 1) % 4] - from);
      for (double i = 0.0; i < count; ++i)
      {
        all.push_back({ from + i * step, from + (i + 1.0) * step });
      }
    }
    return all;
  }();
  return bays;
}

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
  mesh.addBox(foot - Vec3{ plinth, 0.0, plinth }, foot + Vec3{ plinth, 12.0, plinth });
  mesh.addBox(foot + Vec3{ -plinth, top, -plinth }, foot + Vec3{ plinth, springHeight, plinth });
}

/// Add the wall above a bay's opening: an arch with two faces, up to the floor above.
void addArch(MeshBuilder& mesh, const Bay& bay, double pier)
{
  constexpr int segments = 24;
  constexpr double top = 145.0; // of the wall, above the springs
  const double radius = half * bay.width() - pier;
  const Vec3 center = bay.middle() + springHeight * up;
  const Vec3 along = bay.along();
  const Vec3 depth = 25.0 * bay.inward();
  const auto onArch = [&](double share)
  {
    // Flatter than a circle if a circle would exceed the storey.
    const double angle = vtkMath::Pi() * (1.0 - share);
    return center + (radius * std::cos(angle)) * along +
      (std::min(1.0, 0.85 * top / radius) * radius * std::sin(angle)) * up;
  };
  /// Add both faces of the wall between two points and the ones above them.
  const auto addFaces = [&](const Vec3& a, const Vec3& b)
  {
    const auto above = [&](const Vec3& point) { return point + (center[1] + top - point[1]) * up; };
    mesh.addPolygon({ a + depth, b + depth, above(b) + depth, above(a) + depth });
    mesh.addPolygon({ b - depth, a - depth, above(a) - depth, above(b) - depth });
  };
  // The underside looks down: across the wall first, then along it.
  mesh.addSheet(
    segments, 1, [&](double u, double v) { return onArch(u) + (2.0 * v - 1.0) * depth; });
  for (double i = 0.0; i < segments; ++i)
  {
    addFaces(onArch(i / segments), onArch((i + 1.0) / segments));
  }
  // The wall from the arch's feet to the columns' axes.
  for (const double side : { -1.0, 1.0 })
  {
    const Vec3 inner = center + (side * radius) * along;
    const Vec3 outer = center + (side * half * bay.width()) * along;
    const Vec3& left = side < 0.0 ? outer : inner;
    const Vec3& right = side < 0.0 ? inner : outer;
    addFaces(left, right);
    mesh.addPolygon({ left - depth, right - depth, right + depth, left + depth });
  }
}

/// Add a banner that hangs from the gallery's rail into the court, in folds that widen downwards.
void addBanner(MeshBuilder& mesh, const Bay& bay, int i)
{
  const double width = 0.55 * bay.width();
  const double fall = 300.0 + 25.0 * (i % 3);
  const Vec3 along = bay.along();
  const Vec3 hook = bay.middle() + 42.0 * bay.inward() + (storeyHeight + 84.0) * up;
  mesh.addSheet(64, 64,
    [&](double u, double v)
    {
      const double down = 1.0 - v;
      const double fold = std::sin(9.0 * u + 1.7 * i) + 0.4 * std::sin(23.0 * u - 3.0 * down + i);
      const double sway = 10.0 * std::sin(2.5 * down + i);
      return hook + ((u - half) * width * (1.0 - 0.08 * down)) * along - (fall * down) * up +
        (14.0 * down * fold + down * sway) * bay.inward();
    });
}

} // namespace

void addArcades(Scene& scene)
{
  MeshBuilder arcades;
  for (int storey = 0; storey < 2; ++storey)
  {
    const Vec3 floor = (storey * storeyHeight) * up;
    for (const Bay& bay : allBays())
    {
      addColumn(arcades, bay.from + floor, storey == 0 ? 24.0 : 18.0);
      addArch(arcades, { bay.from + floor, bay.to + floor }, storey == 0 ? 38.0 : 30.0);
    }
  }
  add(scene, "arcades", arcades, { 0.76, 0.69, 0.58 });

  // Rails on turned balusters between the columns of the upper storey.
  MeshBuilder balustrades;
  for (const Bay& bay : allBays())
  {
    for (int i = 0; i < 7; ++i)
    {
      balustrades.addLathe(
        { bay.from + ((i + 1.0) / 8.0) * (bay.to - bay.from) + storeyHeight * up, up },
        { { 9.0, 0.0 }, { 9.0, 8.0 }, { 5.0, 12.0 }, { 10.0, 30.0 }, { 4.0, 55.0 }, { 4.0, 66.0 },
          { 8.0, 70.0 }, { 8.0, 76.0 } },
        10);
    }
    const Vec3 reach = half * (bay.to - bay.from) - 16.0 * bay.along() + 11.0 * bay.inward();
    const Vec3 size{ std::abs(reach[0]), 0.0, std::abs(reach[2]) };
    const Vec3 rail = bay.middle() + (storeyHeight + 76.0) * up;
    balustrades.addBox(rail - size, rail + size + 12.0 * up);
  }
  add(scene, "balustrades", balustrades, { 0.82, 0.77, 0.68 });
}

void addCloth(Scene& scene)
{
  const std::pair<const char*, Vec3> dyes[] = { { "red cloth", { 0.68, 0.18, 0.16 } },
    { "green cloth", { 0.2, 0.45, 0.28 } }, { "blue cloth", { 0.2, 0.3, 0.6 } } };
  for (int dye = 0; dye < 3; ++dye)
  {
    MeshBuilder mesh;
    // On the long sides' odd bays, alternately.
    for (int i = dye; i < 10; i += 3)
    {
      const int side = i % 2;
      addBanner(mesh, allBays()[static_cast<std::size_t>(13 * side + 2 * (i / 2) + side)], i);
    }
    add(scene, dyes[dye].first, mesh, dyes[dye].second);
  }
  // Sagging awnings across the court, from roof to roof.
  MeshBuilder awnings;
  for (int i = 0; i < 4; ++i)
  {
    awnings.addSheet(64, 64,
      [&](double u, double v)
      {
        const double sag = 90.0 * (4.0 * v * (1.0 - v));
        const double ripple = 9.0 * std::sin(14.0 * u + i) * std::sin(vtkMath::Pi() * v) +
          4.0 * std::sin(31.0 * v + 5.0 * u);
        return Vec3{ -880.0 + 560.0 * i + (u - half) * 240.0 + 25.0 * std::sin(4.0 * v + i),
          2.0 * storeyHeight - 45.0 - sag + ripple, 245.0 * (1.0 - 2.0 * v) };
      });
  }
  add(scene, "awnings", awnings, { 0.9, 0.84, 0.7 });
}

/// The pots have open rims and stand in front of the columns; the plants have open leaves.
void addPlants(Scene& scene)
{
  MeshBuilder pots, leaves;
  Random random(5);
  for (std::size_t i = 1; i < allBays().size(); ++i)
  {
    const Bay& bay = allBays()[i];
    const Vec3 foot = bay.from + 62.0 * bay.inward();
    pots.addLathe({ foot, up },
      { { 0.0, 1.0 }, { 16.0, 1.0 }, { 18.0, 0.0 }, { 20.0, 4.0 }, { 15.0, 8.0 }, { 17.0, 12.0 },
        { 27.0, 28.0 }, { 30.0, 42.0 }, { 26.0, 52.0 }, { 25.0, 56.0 }, { 31.0, 60.0 },
        { 32.0, 63.0 } },
      24);
    for (int leaf = 0; leaf < 106; ++leaf)
    {
      const double lean = random.between(0.1, 1.2);
      const double size = random.between(45.0, 85.0);
      const double width = random.between(4.0, 8.0);
      const Vec3 outward{ std::cos(2.4 * leaf), 0.0, std::sin(2.4 * leaf) };
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
  add(scene, "pots", pots, { 0.66, 0.4, 0.27 });
  add(scene, "plants", leaves, { 0.3, 0.47, 0.22 });
}

} // namespace gnomon::tool
