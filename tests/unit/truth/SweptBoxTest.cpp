#include "shadowtech/tracing/TracedTiles.h"

#include "RandomScenes.h"

#include <gtest/gtest.h>

namespace gnomon::test
{
namespace
{

Bounds boxAround(const glm::dvec3& middle, const glm::dvec3& half)
{
  return { middle - half, middle + half };
}

const glm::dvec3 centreWorld(10.0, 20.0, 30.0);

/// A light at a centred place, or from its direction.
ShadowLight lightFrom(LightKind kind, const glm::dvec3& place)
{
  return kind == LightKind::Directional ? directionalLight(-place)
    : kind == LightKind::Point          ? pointLight(place + centreWorld)
                                        : spotLight(place + centreWorld, centreWorld, 30.0);
}

TEST(SweptBox, meetsWhatIsOnTheWayToTheLight)
{
  const Bounds start = boxAround({ 0.0, 0.0, 0.0 }, glm::dvec3(0.5));
  for (const LightKind kind : { LightKind::Directional, LightKind::Point, LightKind::Spot })
  {
    const SweptBox swept(start, lightFrom(kind, { 0.0, 0.0, 10.0 }), centreWorld);
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
  Random random(3);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const LightKind kind = i % 2 == 0 ? LightKind::Directional : LightKind::Point;
    const Bounds start = boxAround(inCube(random), 0.3 * glm::abs(inCube(random)));
    const glm::dvec3 place = 4.0 * inCube(random);
    ShadowLight light = lightFrom(kind, place);
    if (i % 3 == 0)
    {
      light.area = diskArea({ 0.0, 0.0, 1.0 }, 0.5);
    }
    const Bounds other = boxAround(0.5 * place + inCube(random), 0.5 * glm::abs(inCube(random)));
    const SweptBox swept(start, light, centreWorld);
    bool isHit = false;
    for (int ray = 0; ray < 50; ++ray)
    {
      const glm::dvec3 from = start.centre() + inCube(random) * (start.upper - start.centre());
      const glm::dvec3 onLight =
        light.area ? light.area->worldFromUnit * (0.7 * inCube(random)) : glm::dvec3(0.0);
      const bool isSun = kind == LightKind::Directional;
      const glm::dvec3 direction = isSun ? glm::normalize(place) + onLight : place + onLight - from;
      for (int step = 0; step <= 40; ++step)
      {
        const glm::dvec3 at = from + (isSun ? 0.2 : 1.0 / 40.0) * step * direction;
        isHit = isHit ||
          glm::all(glm::lessThanEqual(glm::abs(at - other.centre()), other.upper - other.centre()));
      }
    }
    met += isHit ? 1 : 0;
    EXPECT_TRUE(!isHit || swept.meets(other)) << i;
  }
  EXPECT_GT(met, 100);
}

} // namespace
} // namespace gnomon::test
