// Spheres and cylinders of impostors: the hits of rays, and no self-shadows.

#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "lights/LightArea.h"
#include "lights/LightSpace.h"
#include "shadowtech/base/Instances.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Solid.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Return a solid's matrix as the snapshot stores it.
glm::mat4x3 solidAlong(const glm::dvec3& halfAxis, double radius, const glm::dvec3& centre)
{
  const glm::dvec3 axis = glm::normalize(halfAxis);
  const glm::dvec3 x = glm::normalize(glm::cross(axisAcross(axis), axis));
  const glm::dvec3 y = glm::cross(axis, x);
  return glm::mat4x3(glm::dmat4x3(radius * x, radius * y, halfAxis, centre));
}

/// Return the matrix of any solid.
glm::mat4x3 anySolid(Random& random, Solid kind, double reach)
{
  const double radius = std::exp2(uniform(random, -8.0, 2.0));
  const double half = kind == Solid::Sphere ? radius : std::exp2(uniform(random, -8.0, 2.0));
  const glm::dvec3 axis = kind == Solid::Sphere ? glm::dvec3(0.0, 0.0, 1.0) : unitVector(random);
  return solidAlong(half * axis, radius, inCube(random, reach));
}

/// Return many of a kind.
std::vector<glm::mat4x3> anySolids(Random& random, Solid kind, std::size_t count)
{
  std::vector<glm::mat4x3> solids(count);
  std::generate(solids.begin(), solids.end(), [&] { return anySolid(random, kind, 30.0); });
  return solids;
}

/// Return a point's depth inside a solid: negative outside.
double depthIn(const PlacedSolid& solid, const glm::dvec3& point)
{
  const glm::dvec3 from = point - solid.centre;
  if (solid.kind == Solid::Sphere)
  {
    return solid.radius - glm::length(from);
  }
  const double along = glm::dot(from, solid.axis);
  if (solid.kind == Solid::Tube)
  {
    const double nearest = glm::clamp(along, -solid.halfLength, solid.halfLength);
    return solid.radius - glm::length(from - nearest * solid.axis);
  }
  return std::min(
    solid.radius - glm::length(from - along * solid.axis), solid.halfLength - std::abs(along));
}

/// Return solids as in a snapshot, one surface for each kind.
Occluders occludersOf(const std::vector<std::pair<Solid, std::vector<glm::mat4x3>>>& kinds)
{
  Occluders occluders;
  for (const auto& [kind, matrices] : kinds)
  {
    const SolidMesh mesh = meshOf(kind, matrices.size());
    Surface surface;
    surface.solid = kind;
    surface.firstVertex = static_cast<std::uint32_t>(occluders.positionsCentred.size());
    surface.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
    surface.firstTriangle = static_cast<std::uint32_t>(occluders.triangles.size());
    surface.triangleCount = static_cast<std::uint32_t>(mesh.triangles.size());
    surface.centredFromSource = matrices;
    surface.topologyVersion = surface.positionsVersion = occluders.surfaces.size() + 1;
    occluders.positionsCentred.insert(
      occluders.positionsCentred.end(), mesh.positions.begin(), mesh.positions.end());
    for (const glm::uvec3& triangle : mesh.triangles)
    {
      occluders.triangles.push_back(triangle + surface.firstVertex);
    }
    occluders.castersCentred.add(solidsBounds(kind, matrices));
    occluders.surfaces.push_back(std::move(surface));
  }
  occluders.allCentred = occluders.castersCentred;
  occluders.topologyVersion = occluders.positionsVersion = 1;
  return occluders;
}

using Solids = testing::TestWithParam<Solid>;
INSTANTIATE_TEST_SUITE_P(Of, Solids, testing::Values(Solid::Sphere, Solid::Cylinder, Solid::Tube),
  [](const testing::TestParamInfo<Solid>& kind)
  {
    return kind.param == Solid::Sphere ? "spheres"
      : kind.param == Solid::Cylinder  ? "cylinders"
                                       : "tubes";
  });

TEST_P(Solids, linesCrossThemWhereTheyAreInside)
{
  Random random(1);
  int crossed = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const PlacedSolid solid = placedSolid(GetParam(), anySolid(random, GetParam(), 10.0));
    const double size = solid.radius + solid.halfLength;
    const glm::dvec3 origin = solid.centre + 3.0 * size * inCube(random);
    const glm::dvec3 direction =
      uniform(random, 0.1, 10.0) * (solid.centre + 1.2 * size * inCube(random) - origin);
    const auto crossing = crossingOf(solid, origin, direction);
    // Depth is concave along the line; find its maximum.
    const auto depthAt = [&](double t) { return depthIn(solid, origin + t * direction); };
    double lower = -30.0, upper = 30.0;
    for (int step = 0; step < 200; ++step)
    {
      const double a = (2.0 * lower + upper) / 3.0, b = (lower + 2.0 * upper) / 3.0;
      (depthAt(a) < depthAt(b) ? lower : upper) = depthAt(a) < depthAt(b) ? a : b;
    }
    const double deepest = depthAt(lower);
    if (std::abs(deepest) < 1e-9 * size)
    {
      continue; // it only touches
    }
    ASSERT_EQ(crossing.has_value(), deepest > 0.0) << i;
    if (crossing)
    {
      ++crossed;
      EXPECT_NEAR(depthAt(crossing->enters), 0.0, 1e-9 * size);
      EXPECT_NEAR(depthAt(crossing->leaves), 0.0, 1e-9 * size);
      EXPECT_LE(crossing->enters, lower);
      EXPECT_GE(crossing->leaves, lower);
    }
  }
  EXPECT_GT(crossed, 4000);
}

/// Lines that touch at distances down to rounding, from all around and from inside.
TEST_P(Solids, raysAreBlockedWhereTheirLinesCross)
{
  Random random(9);
  int blocked = 0;
  for (int i = 0; i < 200000; ++i)
  {
    const PlacedSolid solid = placedSolid(GetParam(), anySolid(random, GetParam(), 10.0));
    const glm::dvec3 direction = unitVector(random) * std::exp2(uniform(random, -20.0, 20.0));
    const glm::dvec3 axis = GetParam() == Solid::Sphere ? unitVector(random) : solid.axis;
    const double off =
      solid.radius * (1.0 - uniform(random, 0.0, 1.0) * std::exp2(uniform(random, -50.0, 1.0)));
    const glm::dvec3 origin = solid.centre + off * glm::normalize(glm::cross(direction, axis)) +
      uniform(random, -1.5, 1.5) * solid.halfLength * axis +
      uniform(random, -3.0, 1.0) * solid.radius * glm::normalize(direction);
    const double far = i % 2 == 0 ? INFINITY : solid.radius / glm::length(direction);
    const bool oneSided = i % 4 < 2;
    const auto crossing = crossingOf(solid, origin, direction);
    const auto isAhead = [&](double t) { return crossing && t >= 0.0 && t <= far; };
    const bool leaves = !oneSided && GetParam() != Solid::Tube && isAhead(crossing->leaves);
    ASSERT_EQ(blocks(solid, oneSided, origin, direction, far), leaves || isAhead(crossing->enters))
      << i;
    blocked += isAhead(crossing->enters) ? 1 : 0;
  }
  EXPECT_GT(blocked, 20000);
  EXPECT_LT(blocked, 150000);
}

TEST_P(Solids, aRayMeetsTheirSurfaceOrPassesByIt)
{
  Random random(2);
  int met = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const PlacedSolid solid = placedSolid(GetParam(), anySolid(random, GetParam(), 10.0));
    const double size = solid.radius + solid.halfLength;
    const glm::dvec3 origin = solid.centre + 4.0 * size * unitVector(random);
    const glm::dvec3 direction = solid.centre + 1.2 * size * inCube(random) - origin;
    const SolidPoint point = seenPoint(solid, origin, direction);
    EXPECT_NEAR(depthIn(solid, point.position), 0.0, 1e-12 * size);
    EXPECT_NEAR(glm::length(point.normal), 1.0, 1e-12);
    // A step along the normal leads outwards, a step against it inwards.
    EXPECT_LT(depthIn(solid, point.position + 1e-6 * size * point.normal), 0.0);
    EXPECT_GT(depthIn(solid, point.position - 1e-6 * std::min(solid.radius, size) * point.normal),
      -1e-12 * size);
    if (point.isMet)
    {
      ++met;
      EXPECT_LE(glm::dot(point.normal, direction), 1e-9 * glm::length(direction));
      EXPECT_NEAR(
        glm::length(glm::cross(point.position - origin, direction)) / glm::length(direction), 0.0,
        1e-9 * size);
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(met, 19000);
}

/// For any light that the receiver faces; at half, once and twice the offset; near the origin and
/// far away.
TEST_P(Solids, noneShadowsItself)
{
  for (const double reach : { 1.0, 100.0, 10000.0 })
  {
    SCOPED_TRACE(reach);
    Random random(3);
    int dark = 0;
    for (int i = 0; i < 50000; ++i)
    {
      const PlacedSolid solid = placedSolid(GetParam(), anySolid(random, GetParam(), reach));
      const double size = solid.radius + solid.halfLength;
      const glm::dvec3 origin = solid.centre + 4.0 * size * unitVector(random);
      const SolidPoint seen =
        seenPoint(solid, origin, solid.centre + size * inCube(random) - origin);
      const glm::vec3 position(seen.position);
      const glm::vec3 normal(seen.normal);
      const glm::vec3 light =
        glm::normalize(seen.normal + uniform(random, 0.9, 1.1) * unitVector(random));
      const float noise = noiseOf(solid, seen);
      for (const float share : { 0.5f, 1.0f, 2.0f })
      {
        const glm::vec3 start = position + share * shadowRayOffsetInside(noise, 0.0f) * normal;
        dark += facesLight(normal, light) && blocks(solid, false, start, light, INFINITY) ? 1 : 0;
      }
    }
    EXPECT_EQ(dark, 0);
  }
}

/// Molecules show a bond as two sticks, one for each atom's colour, each rounded separately.
using SolidPairs = testing::TestWithParam<Solid>;
INSTANTIATE_TEST_SUITE_P(Of, SolidPairs, testing::Values(Solid::Cylinder, Solid::Tube));

TEST_P(SolidPairs, halvesOfABondDoNotShadowEachOther)
{
  Random random(4);
  int dark = 0;
  int facing = 0;
  for (int i = 0; i < 50000; ++i)
  {
    const double radius = std::exp2(uniform(random, -6.0, 0.0));
    const glm::dvec3 halfAxis = unitVector(random) * std::exp2(uniform(random, -4.0, 1.0));
    const glm::dvec3 middle = inCube(random, 1000.0);
    PlacedSolid halves[2];
    for (const int half : { 0, 1 })
    {
      halves[half] = placedSolid(
        GetParam(), solidAlong(halfAxis, radius, middle + (half == 0 ? -1.0 : 1.0) * halfAxis));
    }
    const glm::dvec3 target = halves[0].centre + uniform(random, 0.0, 1.0) * halfAxis;
    const glm::dvec3 origin = target + 5.0 * unitVector(random);
    const SolidPoint seen = seenPoint(halves[0], origin, target - origin);
    const glm::vec3 position(seen.position);
    const glm::vec3 normal(seen.normal);
    if (std::abs(glm::dot(seen.normal, halves[0].axis)) > 0.5)
    {
      continue; // an end
    }
    const float noise = noiseOf(halves[0], seen);
    const glm::vec3 start = position + shadowRayOffsetInside(noise, 0.0f) * normal;
    const glm::vec3 light =
      glm::normalize(seen.normal + uniform(random, 0.95, 1.05) * unitVector(random));
    if (facesLight(normal, light))
    {
      ++facing;
      dark += blocks(halves[1], false, start, light, INFINITY) ? 1 : 0;
    }
  }
  EXPECT_GT(facing, 20000);
  EXPECT_EQ(dark, 0);
}

TEST_P(Solids, meshesAreClosedAndInscribed)
{
  if (GetParam() == Solid::Tube)
  {
    const SolidMesh tube = meshOf(GetParam(), 1);
    const SolidMesh cylinder = meshOf(Solid::Cylinder, 1);
    EXPECT_EQ(tube.positions, cylinder.positions);
    EXPECT_EQ(tube.triangles.size(), tube.positions.size()); // without ends
    return;
  }
  for (const std::size_t count : { 1u, 1000u, 5000u, 100000u })
  {
    const SolidMesh mesh = meshOf(GetParam(), count);
    EXPECT_LE(mesh.triangles.size() * count, std::max<std::size_t>(1u << 20, 128 * count));
    const PlacedSolid solid = placedSolid(GetParam(), glm::mat4x3(1.0f));
    for (const glm::vec3& position : mesh.positions)
    {
      EXPECT_NEAR(depthIn(solid, position), 0.0, 1e-6);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        ++edges[{ triangle[i], triangle[(i + 1) % 3] }];
      }
      const auto corner = [&](int i) { return glm::dvec3(mesh.positions[triangle[i]]); };
      volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
    }
    for (const auto& [edge, times] : edges)
    {
      EXPECT_EQ(times, 1);
      EXPECT_EQ(edges.count({ edge.second, edge.first }), 1u);
    }
    const double pi = 3.14159265358979;
    const double whole = GetParam() == Solid::Sphere ? 4.0 / 3.0 * pi : 2.0 * pi;
    EXPECT_LT(volume, whole);
    EXPECT_GT(volume, (count < 5000 ? 0.95 : 0.9) * whole);
  }
}

/// In packets and alone, built and refitted, one-sided and two-sided.
TEST(SolidTracing, theTracerAnswersAsTheyDo)
{
  Random random(6);
  std::vector<glm::mat4x3> spheres = anySolids(random, Solid::Sphere, 300);
  spheres[7] = glm::mat4x3(0.0f); // left out
  Occluders occluders = occludersOf(
    { { Solid::Sphere, spheres }, { Solid::Cylinder, anySolids(random, Solid::Cylinder, 300) } });
  std::vector<PlacedReceiver> placed;
  for (int i = 0; i < 4000; ++i)
  {
    placed.push_back({ glm::vec3(inCube(random, 30.0)), glm::vec3(unitVector(random)), 0.001f });
  }
  const ReceiverPixels receivers = rowOf(placed);
  EmbreeTracer tracer;
  for (const bool oneSided : { false, true })
  {
    for (Surface& surface : occluders.surfaces)
    {
      surface.oneSided = oneSided;
      surface.positionsVersion += 10;
      for (glm::mat4x3& matrix : surface.centredFromSource)
      {
        matrix[3].x += Surface::isLeftOut(matrix) ? 0.0f : 1.0f;
      }
    }
    ++occluders.topologyVersion;
    ++occluders.positionsVersion;
    tracer.update(occluders);
    for (const ShadowLight& light :
      { directionalLight({ 0.3, -0.4, -1.0 }), pointLight({ 5.0, 5.0, 35.0 }) })
    {
      std::vector<float> together;
      tracer.trace(light, occluders, receivers, together);
      const ShadowRayLight rayLight(light, occluders.frame.centre);
      int dark = 0;
      for (std::size_t i = 0; i < placed.size(); ++i)
      {
        const PlacedReceiver& receiver = placed[i];
        const float expected = visitShadowRays(rayLight,
          [&](const auto& makeRay, float far)
          {
            const ShadowRay ray = makeRay(receiver.position, receiver.normal, receiver.offset);
            bool blocked = !ray.traced;
            for (const Surface& surface : occluders.surfaces)
            {
              for (const glm::mat4x3& matrix : surface.centredFromSource)
              {
                blocked = blocked ||
                  (!Surface::isLeftOut(matrix) &&
                    blocks(placedSolid(surface.solid, matrix), oneSided, ray.origin, ray.direction,
                      far));
              }
            }
            return blocked ? 0.0f : 1.0f;
          });
        ASSERT_EQ(together[i], expected) << i;
        dark += expected == 0.0f && facesLight(receiver.normal, rayLight.toLight) ? 1 : 0;
        if (i < 300)
        {
          std::vector<float> alone;
          tracer.trace(light, occluders, rowOf({ receiver }), alone);
          ASSERT_EQ(alone[0], expected) << i;
        }
      }
      EXPECT_GT(dark, 200);
      EXPECT_LT(dark, 2000);
    }
  }
}

/// A ray meets the solid that it enters first, or leaves first if it begins inside.
TEST(SolidTracing, raysMeetTheNearest)
{
  Random random(7);
  const Occluders occluders =
    occludersOf({ { Solid::Sphere, anySolids(random, Solid::Sphere, 100) },
      { Solid::Cylinder, anySolids(random, Solid::Cylinder, 100) } });
  EmbreeTracer tracer;
  tracer.update(occluders);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const glm::vec3 origin(inCube(random, 30.0));
    const glm::vec3 direction(unitVector(random));
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t surfaceMet = 0;
    for (std::uint32_t surface = 0; surface < 2; ++surface)
    {
      for (const glm::mat4x3& matrix : occluders.surfaces[surface].centredFromSource)
      {
        const std::optional<Crossing> crossing =
          crossingOf(placedSolid(occluders.surfaces[surface].solid, matrix), origin, direction);
        const double at = !crossing ? -1.0
          : crossing->enters > 0.0  ? crossing->enters
                                    : crossing->leaves;
        if (at > 0.0 && at < nearest)
        {
          nearest = at;
          surfaceMet = surface;
        }
      }
    }
    const auto hit =
      tracer.nearest(origin, direction, 0.0f, std::numeric_limits<float>::infinity());
    ASSERT_EQ(hit.has_value(), std::isfinite(nearest));
    if (hit)
    {
      ++met;
      EXPECT_NEAR(hit->at, nearest, 1e-6 * nearest);
      EXPECT_EQ(hit->surface, surfaceMet);
      ASSERT_NE(hit->solid, nullptr);
      const glm::dvec3 point = glm::dvec3(origin) + nearest * glm::dvec3(direction);
      EXPECT_NEAR(depthIn(*hit->solid, point), 0.0, 1e-6);
      EXPECT_FALSE(tracer.nearest(origin, direction, 0.0f, 0.999f * hit->at));
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(met, 1900);
}

// Surfaces stored as instances, against the triangles of all instances.

/// Return the receivers of a picture of the triangles of all instances.
ReceiverPixels receiversOf(const Occluders& occluders, int side = 400)
{
  const View view = makeView(
    expanded(occluders), { { 9.0, -14.0, 12.0 }, {}, { 0.0, 0.0, 1.0 }, 40.0, 0.0, side, side });
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  return receivers;
}

TEST(Instances, ReceiversAreThoseOfTheirTriangles)
{
  for (const bool mirrored : { false, true })
  {
    const Occluders instanced = cupsOverFloor(mirrored, false);
    const ReceiverPixels expected = receiversOf(expanded(instanced));
    const ReceiverPixels receivers = receiversOf(instanced);
    EXPECT_EQ(receivers.surface, expected.surface);
    EXPECT_GT(std::count(receivers.surface.begin(), receivers.surface.end(), 1u), 10000);
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      if (receivers.surface[i] == ReceiverPixels::notCovered)
      {
        continue;
      }
      const glm::vec3 off = receivers.position(i) - expected.position(i);
      const glm::vec3 normal = expected.normal(i);
      ASSERT_LT(glm::length(off), 2e-3f) << "rays meet silhouettes at a flat angle";
      ASSERT_LT(std::abs(glm::dot(off, normal)), 4e-6f);
      ASSERT_GT(glm::dot(receivers.normal(i), normal), 0.9999f);
      ASSERT_GE(
        receivers.offset[i], expected.offset[i] * (receivers.surface[i] == 0 ? 1.0f : 0.99f));
      ASSERT_LT(receivers.offset[i], expected.offset[i] + 2e-4f);
    }
  }
}

TEST(Instances, VisibilityIsThatOfTheirTriangles)
{
  std::size_t pixels = 0, different = 0, sidesMatter = 0, holesMatter = 0;
  const auto compared = [&](const ShadowLight& light, const Occluders& occluders)
  {
    const ReceiverPixels receivers = receiversOf(occluders);
    const std::vector<float> visibility = trace(light, occluders, receivers);
    pixels += visibility.size();
    different += countDifferent(visibility, trace(light, expanded(occluders), receivers));
    EXPECT_GT(std::count(visibility.begin(), visibility.end(), 0.0f), 5000);
    return visibility;
  };
  for (const bool mirrored : { false, true })
  {
    for (const ShadowLight& light :
      { directionalLight({ 0.4, 0.3, -1.0 }), pointLight({ 1.0, 2.0, 9.0 }) })
    {
      Occluders perforated = cupsOverFloor(mirrored, false);
      const std::vector<float> bothSides = compared(light, perforated);
      sidesMatter += countDifferent(bothSides, compared(light, cupsOverFloor(mirrored, true)));
      perforate(perforated);
      holesMatter += countDifferent(bothSides, compared(light, perforated));
    }
  }
  EXPECT_GT(sidesMatter, 1000u) << "one side and both cast different shadows";
  EXPECT_GT(holesMatter, 4000u) << "light falls through the holes";
  EXPECT_LE(different, pixels / 100000) << "rays that meet an edge to within rounding";
}

/// No triangle of an instance shadows itself, from half of the shadow ray's offset on. That holds
/// for all matrices that stretch, shear (within their limit) and move it.
TEST(Instances, TheOffsetHoldsThroughTheirMatrices)
{
  Random random(11);
  EmbreeTracer tracer;
  int rays = 0, dark = 0, darkWithout = 0; // without instanceNoise()
  while (rays < 20000)
  {
    const double size = std::pow(10.0, uniform(random, -2.0, 2.0));
    const glm::dvec3 a = inCube(random), b = a + inCube(random);
    glm::dmat4 shear(1.0);
    shear[1].x = uniform(random, -1.0, 1.0);
    shear[2] = glm::dvec4(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 1.0, 0.0);
    glm::dmat4 instance =
      glm::scale(turned(random, 0.0) * shear * turned(random, 1.0), glm::dvec3(size));
    instance[3] = glm::dvec4(inCube(random, 20.0), 1.0);
    if (!isRegular(glm::dmat3(instance)))
    {
      continue;
    }
    Occluders occluders =
      makeOccluders({ { { { a, b, 0.5 * (a + b) + 0.3 * inCube(random) }, { { 0, 1, 2 } } } } });
    makeInstanced(occluders, 0, { instance });
    const glm::mat4x3 matrix = occluders.surfaces[0].centredFromSource[0];
    std::array<glm::dvec3, 3> source, corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      source[i] = occluders.positionsCentred[i];
      corners[i] = glm::dmat4x3(matrix) * glm::dvec4(source[i], 1.0);
    }
    const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double doubleArea = glm::length(areaVector);
    const glm::vec3 normal(areaVector / doubleArea);
    const auto& [p, q, r] = corners;
    const float plane =
      planeNoise(normal, glm::max(glm::abs(p), glm::max(glm::abs(q), glm::abs(r))),
        glm::max(p, glm::max(q, r)) - glm::min(p, glm::min(q, r)), static_cast<float>(doubleArea));
    const float noise = plane + instanceNoise(normal, corners, source, matrix, doubleArea);

    const double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0 - u);
    const glm::vec3 position((1.0 - u - v) * p + u * q + v * r);
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(normal)) + 0.9 * unitVector(random);
    tracer.update(occluders);
    std::vector<float> visibility;
    tracer.trace(directionalLight(-toLight), occluders,
      rowOf({ { position, normal, noise }, { position, normal, 0.25f * plane } }), visibility);
    ++rays;
    dark += visibility[0] == 0.0f ? 1 : 0;
    darkWithout += visibility[1] == 0.0f ? 1 : 0;
  }
  EXPECT_EQ(dark, 0);
  EXPECT_GT(darkWithout, 100) << "so that the bound is needed";
}

/// `penumbra` has no edges of instances, and traces receivers that may see one.
TEST(Instances, SoftShadowsByEdgesAreThoseOfAllRays)
{
  for (const bool oneSided : { false, true })
  {
    const Occluders occluders = cupsOverFloor(false, oneSided);
    const ReceiverPixels receivers = receiversOf(occluders, 120);
    const ShadowLight light = withArea(pointLight({ 1.0, 2.0, 30.0 }), ballArea(0.5), 16);
    EmbreeTracer tracer;
    tracer.update(occluders);
    EdgeTree tree;
    tree.update(occluders);
    const PenumbraChooser chooser(tree, light, occluders.frame.centre);
    std::vector<float> truth, visibility;
    const std::size_t all = tracer.traceArea(light, occluders, receivers, truth);
    const std::size_t rays =
      tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
    EXPECT_EQ(countDifferent(visibility, truth), 0u);
    EXPECT_LT(rays, all);
  }
}

/// Of instances that are left out, nothing is met or seen.
TEST(Instances, LeftOutOnesAreNeitherMetNorReceivers)
{
  Occluders occluders = cupsOverFloor(false, false);
  const View view = makeView(expanded(occluders), { { 9.0, -14.0, 12.0 } });
  Surface& cups = occluders.surfaces[1];
  std::fill(cups.centredFromSource.begin(), cups.centredFromSource.end(), glm::mat4x3(0.0f));
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  EXPECT_EQ(std::count(receivers.surface.begin(), receivers.surface.end(), 1u), 0);
  const std::vector<float> visibility =
    trace(directionalLight({ 0.4, 0.3, -1.0 }), occluders, receivers);
  EXPECT_EQ(std::count(visibility.begin(), visibility.end(), 0.0f), 0);
  EXPECT_TRUE(
    instancesBounds(occluders.positionsCentred.data(), 3, cups.centredFromSource).empty());
}

TEST(Instances, BoundsAreThoseOfTheirTriangles)
{
  const Occluders occluders = cupsOverFloor(true, false);
  const Occluders triangles = expanded(occluders);
  Bounds exact;
  for (std::uint32_t i = 0; i < triangles.surfaces[1].vertexCount; ++i)
  {
    exact.add(glm::dvec3(triangles.positionsCentred[triangles.surfaces[1].firstVertex + i]));
  }
  const Surface& surface = occluders.surfaces[1];
  const glm::vec3* positions = occluders.positionsCentred.data() + surface.firstVertex;
  const Bounds bounds = instancesBounds(positions, surface.vertexCount, surface.centredFromSource);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(bounds.lower[axis], exact.lower[axis], 1e-6);
    EXPECT_NEAR(bounds.upper[axis], exact.upper[axis], 1e-6);
  }
  EXPECT_TRUE(instancesBounds(positions, 0, surface.centredFromSource).empty());
}

TEST(Instances, MatricesThatAreTooSkewOrTooLargeAreNotRegular)
{
  EXPECT_DOUBLE_EQ(skewness(glm::dmat3(1.0)), 1.0);
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.7, { 1.0, 2.0, 3.0 }));
  const glm::dmat3 stretch(glm::scale(glm::dmat4(1.0), { 1e-6, 3.0, -1e5 }));
  EXPECT_NEAR(skewness(turn * stretch), 1.0, 1e-9);
  EXPECT_TRUE(isRegular(turn * stretch));
  EXPECT_FALSE(isRegular(stretch * turn)) << "stretched after turning is a shear";
  EXPECT_FALSE(isRegular(glm::dmat3(0.0)));
  EXPECT_FALSE(isRegular(1e-13 * turn));
  EXPECT_FALSE(isRegular(1e13 * turn));
  EXPECT_FALSE(isRegular(std::numeric_limits<double>::quiet_NaN() * turn));
  EXPECT_FALSE(isRegular({ { 1.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } }));
}

} // namespace
} // namespace gnomon::test
