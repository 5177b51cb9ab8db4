// `penumbra` equals all rays of `raytraced`, bit for bit.

#include "RandomScenes.h"

#include "lights/LightArea.h"
#include "lights/LightSpace.h"
#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Numbers of rays, by edges and of all samples.
struct Rays
{
  std::size_t chosen = 0;
  std::size_t all = 0;
};

/// Expect a light's visibility to be that of all of its rays.
Rays expectThatOfAllRays(const ShadowLight& light, const Occluders& occluders,
  const Receivers& receivers, const std::string& what = "")
{
  EmbreeTracer tracer;
  tracer.update(occluders);
  EdgeTree tree;
  tree.update(occluders);
  const PenumbraChooser chooser(tree, light, occluders.frame.centre);
  std::vector<float> truth;
  std::vector<float> visibility;
  const std::size_t all = tracer.traceArea(light, occluders, receivers, truth);
  const std::size_t chosen =
    tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
  EXPECT_EQ(countDifferent(visibility, truth), 0u) << what;
  return { chosen, all };
}

/// Return an area of any shape for a light, sometimes a very large or very small one.
LightArea makeRandomArea(const ShadowLight& light, double scale, Random& random)
{
  const bool directional = light.kind == LightKind::Directional;
  const glm::dvec3 travel = light.kind == LightKind::Point && random() % 2
    ? unitVector(random)
    : glm::normalize(light.directionWorld);
  const double size =
    (directional ? 0.3 : 0.6 * scale) * std::pow(10.0, uniform(random, -2.0, 0.3));
  switch (random() % 4)
  {
    case 0:
      return rectangleArea(travel, axisAcross(travel), { size, size });
    case 1:
      return rectangleArea(
        travel, axisAcross(travel) + 0.3 * unitVector(random), { size, 0.2 * size });
    case 2:
      return diskArea(travel, size);
    default:
      return directional ? diskArea(travel, size) : ballArea(size);
  }
}

using RandomPenumbras = testing::TestWithParam<const char*>;

INSTANTIATE_TEST_SUITE_P(
  OfScenes, RandomPenumbras, testing::ValuesIn(randomSceneNames()), byLetters);

TEST_P(RandomPenumbras, areThoseOfAllRays)
{
  Rays sum;
  for (unsigned int seed = 0; seed < exactRuns(); ++seed)
  {
    const RandomPicture picture = makeRandomPicture(GetParam(), 5000 + seed);
    Random random(seed);
    ShadowLight light = withArea(picture.light, makeRandomArea(picture.light, 1.0, random),
      std::array{ 16, 64, 64, 23 }[random() % 4]);
    light.lightSeed = static_cast<int>(random() % 100);
    ReceiverPixels stored;
    Receivers receivers(picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
    receivers.all();
    const Rays rays = expectThatOfAllRays(light, picture.occluders, receivers, picture.description);
    sum.chosen += rays.chosen;
    sum.all += rays.all;
  }
  EXPECT_LT(sum.chosen, sum.all);
}

/// A shadow ray's start.
struct Start
{
  glm::dvec3 at; ///< centred
  glm::dvec3 normal;
  double offset;
};

/// Return receivers with a shadow ray each, from any start. They fill squares of 8 x 8 pixels one
/// by one. Receivers of a square should be close to each other: distant ones have too many blockers
/// between them, and are only traced.
/// @param next called for each start, with true if it begins a square
template <typename Next>
ReceiverPixels startingAt(const Next& next)
{
  ReceiverPixels receivers;
  receivers.resize(64, 64);
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const std::size_t square = i / 64, in = i % 64;
    const Start start = next(in == 0);
    receivers.put((square / 8 * 8 + in / 8) * 64 + square % 8 * 8 + in % 8,
      start.at - start.offset * start.normal, start.normal, static_cast<float>(start.offset), 0);
  }
  return receivers;
}

const glm::dvec3 upwards(0.0, 0.0, 1.0);

/// A floor with triangles of all shapes above it.
Occluders makeSoupOverFloor(unsigned int seed)
{
  return makeOccluders(
    { { makePlane(6.0) }, { makeTriangleSoup(40, seed), at({ -0.5, -0.5, 0.4 }) } });
}

/// A triangle of the soup.
std::array<glm::dvec3, 3> anyTriangle(const Occluders& occluders, Random& random)
{
  const Surface& soup = occluders.surfaces[1];
  return castingTriangles(occluders)[soup.firstTriangle + random() % soup.triangleCount].corners;
}

/// Rays that pass edges to within a rounding are traced.
TEST(Penumbra, isThatOfAllRaysAlongEdges)
{
  Random random(1);
  for (unsigned int scene = 0; scene < 10; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    const glm::dvec3 lamp(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 5.0);
    const glm::dvec3 lampCentred = lamp - occluders.frame.centre;
    std::array<glm::dvec3, 3> triangle{};
    double along = 0.0;
    const ReceiverPixels receivers = startingAt(
      [&](bool beginsSquare)
      {
        if (beginsSquare)
        {
          triangle = anyTriangle(occluders, random);
          along = uniform(random, 0.0, 1.0);
        }
        const glm::dvec3 on =
          glm::mix(triangle[0], triangle[1], along + uniform(random, -0.02, 0.02));
        const double share = (1e-5 - occluders.frame.centre.z - on.z) / (on.z - lampCentred.z);
        return Start{ on + share * (on - lampCentred), upwards, 1e-5 };
      });
    for (const double size : { 1e-7, 1e-6, 1e-5, 1e-3, 0.3 })
    {
      expectThatOfAllRays(
        withArea(pointLight(lamp), rectangleArea(-upwards, { 0.0, 1.0, 0.0 }, { size, size }), 16),
        occluders, receivers, std::to_string(size));
    }
  }
}

/// Rays that start on a triangle other than the receiver's own are traced, too.
TEST(Penumbra, isThatOfAllRaysFromTriangles)
{
  Random random(2);
  for (unsigned int scene = 0; scene < 10; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    const ReceiverPixels receivers = startingAt(
      [&](bool)
      {
        const std::array<glm::dvec3, 3> triangle = anyTriangle(occluders, random);
        const double a = uniform(random, 0.0, 1.0), b = uniform(random, 0.0, 1.0 - a);
        const double off = std::pow(10.0, uniform(random, -9.0, -5.0));
        return Start{ (1.0 - a - b) * triangle[0] + a * triangle[1] + b * triangle[2] +
            off * unitVector(random),
          upwards, 1e-7 };
      });
    for (const double size : { 1e-3, 0.1, 1.0 })
    {
      expectThatOfAllRays(withArea(pointLight({ 0.3, 0.2, 5.0 }), diskArea(-upwards, size)),
        occluders, receivers, std::to_string(size));
    }
  }
}

/// Rays that end on a triangle, or near one, are traced, too.
TEST(Penumbra, isThatOfAllRaysToTriangles)
{
  Random random(3);
  for (unsigned int scene = 0; scene < 12; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    glm::dvec3 square(0.0);
    const ReceiverPixels receivers = startingAt(
      [&](bool beginsSquare)
      {
        square = beginsSquare
          ? glm::dvec3(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5), 1e-5)
          : square;
        return Start{ square + inCube(random, 0.02) * glm::dvec3(1.0, 1.0, 0.0) -
            occluders.frame.centre,
          upwards, 1e-5 };
      });
    const std::array<glm::dvec3, 3> triangle = anyTriangle(occluders, random);
    const glm::dvec3 lamp =
      occluders.frame.centre + (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    for (const double size : { 1e-4, 0.02, 0.2 })
    {
      for (const LightArea& area : { diskArea(-upwards, size), ballArea(size),
             rectangleArea(unitVector(random), { 0.1, 0.9, 0.4 }, { size, 0.3 * size }) })
      {
        const ShadowLight light = pointLight(lamp + size * uniform(random, -1.0, 1.0) * upwards);
        expectThatOfAllRays(withArea(light, area, 16), occluders, receivers, std::to_string(size));
      }
    }
  }
}

/// Axes of any direction, around a place that is no coordinate's middle.
struct Axes
{
  glm::dvec3 z, x, y, place;

  explicit Axes(Random& random)
    : z(unitVector(random))
    , x(glm::normalize(glm::cross(z, unitVector(random))))
    , y(glm::cross(z, x))
    , place(2.0 * unitVector(random))
  {
  }
};

Occluders makeTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  // A second triangle keeps the middle of all coordinates away from the first.
  return makeOccluders(
    { { { { a, b, c }, { { 0, 1, 2 } } } }, { makePlane(0.1), at({ 9.0, -7.0, 8.0 }) } });
}

/// Starts lie in the plane of a triangle of any slant, or on the triangle, to within rounding. Rays
/// go along it, to it or away from it.
TEST(Penumbra, isThatOfAllRaysThatLeaveTriangles)
{
  Random random(7);
  for (int run = 0; run < 360; ++run)
  {
    const double distance = std::array{ 0.0, 1.5, 10.0 }[run % 3];
    const double off = std::array{ 1e-7, 1e-6, 1e-5, 1e-3 }[run / 3 % 4];
    const double slope = std::array{ 1e-7, 1e-6, 1e-5, 1e-4, 1e-2 }[run / 12 % 5];
    const Axes axes(random);
    const glm::dvec3 start = 1.5 * axes.place, tip = start + distance * axes.y;
    const double size = uniform(random, 0.5, 2.0);
    const Occluders occluders = makeTriangle(tip - size * axes.x,
      tip + size * (axes.x + 0.3 * axes.y), tip + size * uniform(random, 0.1, 2.0) * axes.y);
    const glm::dvec3 towards = glm::normalize(
      uniform(random, -0.2, 0.2) * axes.x + axes.y + uniform(random, -3.0, 3.0) * slope * axes.z);
    const double spread = distance > 0.0 ? 0.02 : size;
    const ReceiverPixels receivers = startingAt(
      [&](bool)
      {
        const glm::dvec3 from = start + spread * uniform(random, -1.0, 1.0) * axes.x +
          spread * uniform(random, -0.5, 1.0) * axes.y;
        return Start{ from - occluders.frame.centre + off * uniform(random, 0.5, 1.0) * axes.z,
          towards, 1e-9 };
      });
    expectThatOfAllRays(withArea(pointLight(tip + 20.0 * towards),
                          rectangleArea(-towards, axes.z, glm::dvec2(20.0 * slope)), 16),
      occluders, receivers,
      std::to_string(distance) + " away, " + std::to_string(off) + " off the plane");
  }
}

/// A ray that starts closer to the near face of a light's box than its offset goes beyond the face.
TEST(Penumbra, isThatOfAllRaysBeyondTheBoxOfTheLight)
{
  Random random(6);
  const Occluders occluders =
    makeOccluders({ { makePlane(6.0) }, { makePlane(0.2), at({ 0.1, 0.0, 0.512 }) } });
  const ReceiverPixels receivers = startingAt(
    [&](bool)
    {
      const glm::dvec3 start(uniform(random, -0.003, 0.003), uniform(random, -0.003, 0.003), 0.506);
      return Start{ start - occluders.frame.centre, upwards, 0.01 };
    });
  ShadowLight light = boxLight(-upwards, { 0.0, 0.0, 0.507 }, { 4.0, 4.0, 4.0 });
  light.box->upWorld = { 0.0, 1.0, 0.0 };
  expectThatOfAllRays(withArea(light, diskArea(-upwards, 0.3), 16), occluders, receivers);
}

/// Triangles are left from twice the rounding of T on, 11u (r_x YZ + r_y ZX + r_z XY), and from
/// N . D = 128u r^2 |D| on, by docs/theory/exact_penumbrae.md: r is the corners' reach from the
/// start, X, Y and Z the box's sides. They lie around the middle of coordinates and far from it.
TEST(EdgeTriangle, isLeftFromItsBoundsOn)
{
  constexpr double unit = 1.0 / 16777216.0;
  Random random(3);
  for (const double away : { 0.0, 20.0 })
  {
    EdgeTree tree;
    tree.update(makeOccluders({ { makeTriangleSoup(300, 1), at(glm::dvec3(away)) },
      { makePlane(0.1), at(glm::dvec3(-away)) } }));
    for (std::uint32_t number = 0; number < tree.size(); ++number)
    {
      const EdgeTree::Record record = tree.record(number);
      if (record.opaque)
      {
        continue; // a needle
      }
      const EdgeTriangle& triangle = tree.triangle(record.number);
      const auto& [a, b, c] = tree.corners(record.number);
      const glm::dvec3 start =
        glm::dvec3(a + b + c) / 3.0 + static_cast<double>(triangle.height) * inCube(random, 0.1);
      glm::dvec3 reach(0.0);
      for (const glm::vec3& corner : { a, b, c })
      {
        reach = glm::max(reach, glm::abs(glm::dvec3(corner) - start));
      }
      const glm::dvec3 box(glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c)));
      const double length = uniform(random, 0.2, 5.0), longest(triangle.longest);
      const double leastBehind = 22.0 * unit / longest *
        glm::dot(reach, glm::dvec3(box.y * box.z, box.z * box.x, box.x * box.y));
      const double leastAlong = 128.0 * unit / longest * glm::dot(reach, reach) * length;
      // Of ranges of rays, from either side.
      const auto isLeft = [&](const glm::dvec2& behind, const glm::dvec2& along)
      {
        const auto swapped = [](const glm::dvec2& range) { return glm::dvec2(range.y, range.x); };
        const bool left =
          triangle.isLeft(leastBehind * behind, reach, -leastAlong * swapped(along), length);
        EXPECT_EQ(
          triangle.isLeft(-leastBehind * swapped(behind), reach, leastAlong * along, length), left);
        return left;
      };
      EXPECT_TRUE(isLeft({ 1.001, 2.0 }, { 1.001, 2.0 }));
      EXPECT_FALSE(isLeft({ 0.999, 2.0 }, { 1.001, 2.0 }));
      EXPECT_FALSE(isLeft({ 1.001, 2.0 }, { 0.999, 2.0 }));
      EXPECT_FALSE(isLeft({ 1.001, 2.0 }, { -2.0, -1.001 }));
      EXPECT_FALSE(isLeft({ -2.0, -1.001 }, { 1.001, 2.0 }));
    }
  }
}

/// A pixel costs one ray if it sees no edge, and few if it sees some; also of unevenly spread
/// samples, and of casters that moved.
TEST(Penumbra, takesFewRays)
{
  const ShadowLight lamp = pointLight({ 1.0, 1.0, 6.0 });
  const Camera camera{ { 2.0, -6.0, 5.0 } };
  const Occluders open = makeOccluders({ { makePlane(20.0) } });
  const Rays ofPlane =
    expectThatOfAllRays(withArea(lamp, diskArea(-upwards, 0.5)), open, makeReceivers(open, camera));
  EXPECT_EQ(ofPlane.chosen, ofPlane.all / 64);

  Occluders occluders =
    makeOccluders({ { makePlane(12.0) }, { makeSphere(12, 24), at({ 0.0, 0.0, 1.5 }) } });
  ShadowLight light = withArea(lamp, rectangleArea(-upwards, { 0.0, 1.0, 0.0 }, { 0.5, 0.5 }));
  for (const LightSampling sampling :
    { LightSampling::Sobol, LightSampling::Jittered, LightSampling::Random })
  {
    light.lightSampling = sampling;
    const Rays rays = expectThatOfAllRays(light, occluders, makeReceivers(occluders, camera));
    EXPECT_LT(rays.chosen, rays.all / (sampling == LightSampling::Sobol ? 55 : 20));
  }

  EdgeTree kept;
  for (int step = 0; step < 3; ++step)
  {
    kept.update(occluders);
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    const PenumbraChooser chooser(kept, light, occluders.frame.centre);
    EmbreeTracer tracer;
    tracer.update(occluders);
    std::vector<float> truth, visibility;
    tracer.traceArea(light, occluders, receivers, truth);
    tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
    EXPECT_EQ(visibility, truth);
    moveSurface(occluders, 1, { 0.4, 0.2, 0.1 });
  }
}

} // namespace
} // namespace gnomon::test
