#include "shadowtech/tracing/TracedTiles.h"

#include <gtest/gtest.h>

#include <random>

using gnomon::Bounds;
using gnomon::LightKind;
using gnomon::ShadowLight;
using gnomon::SweptBox;

namespace
{

Bounds boxAround(const glm::dvec3& middle, const glm::dvec3& half)
{
  return { middle - half, middle + half };
}

bool isInside(const Bounds& box, const glm::dvec3& point)
{
  return glm::all(glm::lessThanEqual(box.lower, point)) &&
    glm::all(glm::lessThanEqual(point, box.upper));
}

ShadowLight makeLight(LightKind kind, const glm::dvec3& positionWorld)
{
  ShadowLight light;
  light.kind = kind;
  light.positionWorld = positionWorld;
  light.directionWorld = -positionWorld;
  return light;
}

/// A disc across z.
gnomon::LightArea discOfRadius(double radius)
{
  gnomon::LightArea area;
  area.worldFromUnit = glm::dmat3(radius);
  area.worldFromUnit[2] = glm::dvec3(0.0);
  return area;
}

const glm::dvec3 centreWorld(10.0, 20.0, 30.0);

/// A sun's direction starts at the origin, so the centre is not subtracted.
glm::dvec3 placeOf(LightKind kind, const glm::dvec3& centred)
{
  return kind == LightKind::Directional ? centred : centred + centreWorld;
}

} // namespace

TEST(SweptBox, meetsWhatIsOnTheWayToTheLight)
{
  const Bounds start = boxAround({ 0.0, 0.0, 0.0 }, glm::dvec3(0.5));
  for (const LightKind kind : { LightKind::Directional, LightKind::Point, LightKind::Spot })
  {
    const SweptBox swept(start, makeLight(kind, placeOf(kind, { 0.0, 0.0, 10.0 })), centreWorld);
    EXPECT_TRUE(swept.meets(boxAround({ 0.0, 0.0, 5.0 }, glm::dvec3(0.1))));
    EXPECT_TRUE(swept.meets(start));
    EXPECT_FALSE(swept.meets(boxAround({ 0.7, 0.0, 5.0 }, glm::dvec3(0.1)))) << "beside";
    EXPECT_FALSE(swept.meets(boxAround({ 0.0, 0.0, -1.0 }, glm::dvec3(0.4)))) << "behind";
    EXPECT_EQ(
      swept.meets(boxAround({ 0.0, 0.0, 12.0 }, glm::dvec3(0.4))), kind == LightKind::Directional)
      << "beyond the light";
    // Rays towards a point converge; rays along a direction do not.
    EXPECT_EQ(
      swept.meets(boxAround({ 0.4, 0.0, 8.0 }, glm::dvec3(0.1))), kind == LightKind::Directional);
  }
}

TEST(SweptBox, holdsAllRays)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto point = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const LightKind kind = i % 2 == 0 ? LightKind::Directional : LightKind::Point;
    const Bounds start = boxAround(point(), 0.3 * glm::abs(point()));
    const glm::dvec3 place = 4.0 * point();
    ShadowLight light = makeLight(kind, placeOf(kind, place));
    if (i % 3 == 0)
    {
      light.area = discOfRadius(0.5);
    }
    const Bounds other = boxAround(0.5 * place + point(), 0.5 * glm::abs(point()));
    const SweptBox swept(start, light, centreWorld);
    bool isHit = false;
    for (int ray = 0; ray < 50; ++ray)
    {
      const glm::dvec3 from = start.centre() + point() * (start.upper - start.centre());
      const glm::dvec3 onLight =
        light.area ? light.area->worldFromUnit * (0.7 * point()) : glm::dvec3(0.0);
      const bool isSun = kind == LightKind::Directional;
      const glm::dvec3 direction = isSun ? glm::normalize(place) + onLight : place + onLight - from;
      for (int step = 0; step <= 40; ++step)
      {
        isHit = isHit || isInside(other, from + (isSun ? 0.2 : 1.0 / 40.0) * step * direction);
      }
    }
    met += isHit ? 1 : 0;
    EXPECT_TRUE(!isHit || swept.meets(other)) << i;
  }
  EXPECT_GT(met, 100);
}
