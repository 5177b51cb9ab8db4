// Blockers around the rays from a box to a light, tight or not quite. Receivers that are proved to
// be blocked are blocked when traced.

#include "shadowtech/tracing/UmbraProof.h"

#include "RandomScenes.h"

#include "shadowtech/tracing/EmbreeTracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Return a light of any kind at some distance, with an area or none.
ShadowLight farLight(Random& random, const glm::dvec3& towards)
{
  ShadowLight light;
  switch (random() % 4)
  {
    case 0:
      light = pointLight(towards);
      break;
    case 1:
      light = spotLight(towards, glm::dvec3(0.0), 80.0);
      break;
    case 2:
      light = boxLight(-towards, towards, glm::dvec3(30.0));
      break;
    default:
      light = directionalLight(-towards);
      break;
  }
  if (random() % 2)
  {
    light.area =
      diskArea(light.kind == LightKind::Point ? -glm::normalize(towards) : light.directionWorld,
        light.kind == LightKind::Directional ? 0.05 : 0.4);
  }
  return light;
}

/// Return a polygon that stands across the rays from a box to a light, around all of them.
/// @param more its enlargement, as a share of its size
std::vector<glm::dvec3> polygonAround(
  const Bounds& box, const RayEnds& ends, int corners, double more, Random& random)
{
  const glm::dvec3 towards =
    glm::normalize(ends.isDirectional ? ends.corners[0] : ends.corners[0] - box.centre());
  const glm::dvec3 normal = glm::normalize(towards + 0.5 * inCube(random));
  const glm::dvec3 onPlane = uniform(random, 2.0, 5.0) * towards;
  const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.5, 0.8)));
  const glm::dvec3 y = glm::cross(normal, x);
  std::vector<glm::dvec2> passes; // where rays pass the plane
  for (const glm::dvec3& start : box.corners())
  {
    for (const glm::dvec3& end : ends.corners)
    {
      const glm::dvec3 direction = ends.isDirectional ? end : end - start;
      const double t = glm::dot(onPlane - start, normal) / glm::dot(direction, normal);
      const glm::dvec3 at = start + t * direction - onPlane;
      passes.emplace_back(glm::dot(at, x), glm::dot(at, y));
    }
  }
  // Lines on all sides, each next to the farthest of these; the corners are where they meet.
  std::vector<glm::dvec3> lines;
  const double turn = uniform(random, 0.0, 6.28);
  for (int i = 0; i < corners; ++i)
  {
    const double angle = turn + 6.283185307179586 * i / corners + uniform(random, -0.2, 0.2);
    const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
    double farthest = -std::numeric_limits<double>::infinity();
    for (const glm::dvec2& at : passes)
    {
      farthest = std::max(farthest, glm::dot(at, outwards));
    }
    lines.emplace_back(outwards, -farthest - more);
  }
  std::vector<glm::dvec3> polygon;
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const glm::dvec3 meet = glm::cross(lines[i], lines[(i + 1) % lines.size()]);
    polygon.push_back(onPlane + meet.x / meet.z * x + meet.y / meet.z * y);
  }
  return polygon;
}

Mesh fanOf(const std::vector<glm::dvec3>& polygon)
{
  Mesh mesh{ polygon, {} };
  for (unsigned int i = 2; i < polygon.size(); ++i)
  {
    mesh.triangles.emplace_back(0, i - 1, i);
  }
  return mesh;
}

/// Return receivers in the corners of a box, facing the light.
ReceiverPixels cornersOf(const Bounds& box, const ShadowLight& light, const glm::dvec3& centreWorld)
{
  std::vector<PlacedReceiver> receivers;
  for (const glm::dvec3& corner : box.corners())
  {
    const glm::dvec3 toLight = light.kind == LightKind::Directional
      ? -light.directionWorld
      : glm::normalize(light.positionWorld - centreWorld - corner);
    receivers.push_back({ glm::vec3(corner), glm::vec3(toLight), 0.0f });
  }
  return rowOf(receivers);
}

/// Return the box of the same corners in float.
Bounds inFloat(const Bounds& box)
{
  return { glm::dvec3(glm::vec3(box.lower)), glm::dvec3(glm::vec3(box.upper)) };
}

/// A small box, a light, and the blockers between them.
struct Blocked
{
  ShadowLight light;
  Occluders occluders;
  Bounds box;
};
Blocked makeBlocked(Random& random, int corners, double more)
{
  Blocked blocked;
  blocked.light = farLight(random, uniform(random, 7.0, 12.0) * unitVector(random));
  const glm::dvec3 half = 0.4 * glm::abs(inCube(random));
  const Bounds box{ -half, half };
  const std::vector<glm::dvec3> polygon =
    polygonAround(box, RayEnds(blocked.light, Occluders()), corners, more, random);
  blocked.occluders = makeOccluders({ { fanOf(polygon) } });
  const glm::dvec3 centre = blocked.occluders.frame.centre;
  blocked.box = inFloat({ box.lower - centre, box.upper - centre });
  return blocked;
}

/// @param tracer gets the scene
bool isProved(const Blocked& blocked, EmbreeTracer& tracer)
{
  tracer.update(blocked.occluders);
  const RayEnds ends(blocked.light, blocked.occluders);
  std::optional<std::uint32_t> triangle;
  return UmbraProof(blocked.box, ends, blocked.occluders, tracer).finds(triangle);
}

} // namespace

TEST(UmbraProof, FindsBlockersThatAreLargeEnough)
{
  Random random(1);
  int proved = 0;
  constexpr int cases = 400;
  for (int i = 0; i < cases; ++i)
  {
    const Blocked blocked = makeBlocked(random, 3 + i % 4, 0.05);
    EmbreeTracer tracer;
    proved += isProved(blocked, tracer) ? 1 : 0;
  }
  EXPECT_EQ(proved, cases);
}

TEST(UmbraProof, ProvesNoLitReceiverDark)
{
  Random random(2);
  int proved = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i)
  {
    // Some blockers miss rays, some touch them to within rounding, some surround them.
    const double size = std::pow(10.0, uniform(random, -9.0, -1.0));
    const Blocked blocked = makeBlocked(random, 3 + i % 4, random() % 4 ? size : -size);
    EmbreeTracer tracer;
    if (!isProved(blocked, tracer))
    {
      ++refused;
      continue;
    }
    ++proved;
    ShadowLight light = blocked.light;
    const ReceiverPixels receivers = cornersOf(blocked.box, light, blocked.occluders.frame.centre);
    std::vector<float> visibility;
    light.lightSamples = 64;
    light.area ? tracer.traceArea(light, blocked.occluders, Receivers(receivers), visibility)
               : tracer.trace(light, blocked.occluders, Receivers(receivers), visibility);
    EXPECT_EQ(visibility, std::vector<float>(8, 0.0f)) << i;
  }
  EXPECT_GT(proved, 500);
  EXPECT_GT(refused, 500);
}

TEST(UmbraProof, LeavesOutBlockersBehindTheReceiversOrTheLight)
{
  const Bounds box{ glm::dvec3(-0.1), glm::dvec3(0.1) };
  const auto isHidden = [&](double height, const ShadowLight& light)
  {
    Blocked blocked{ light, makeOccluders({ { makePlane(20.0), at({ 0.0, 0.0, height }) } }), box };
    blocked.occluders.frame.centre = glm::dvec3(0.0);
    moveSurface(blocked.occluders, 0, { 0.0, 0.0, height });
    EmbreeTracer tracer;
    return isProved(blocked, tracer);
  };
  const ShadowLight lamp = pointLight({ 0.0, 0.0, 4.0 });
  const ShadowLight sun = directionalLight({ 0.0, 0.0, -1.0 });
  const ShadowLight boxed = boxLight({ 0.0, 0.0, -1.0 }, { 0.0, 0.0, 4.0 }, glm::dvec3(9.0));
  for (const ShadowLight& light : { lamp, sun, boxed })
  {
    EXPECT_TRUE(isHidden(2.0, light));
    EXPECT_FALSE(isHidden(-2.0, light));
    EXPECT_FALSE(isHidden(0.1, light)) << "in the box's side";
    EXPECT_EQ(isHidden(5.0, light), light.kind == LightKind::Directional && !light.box);
    EXPECT_EQ(isHidden(4.0, light), light.kind == LightKind::Directional && !light.box);
  }
}

} // namespace gnomon::test
