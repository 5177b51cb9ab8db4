// `penumbra` equals all rays of `raytraced`, bit for bit.

#include "HalfPlane.h"
#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "lights/LightArea.h"
#include "lights/LightSpace.h"
#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ostream>
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
      const BvhRecord& record = tree.record(number);
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

// Ray-traced shadows of area lights, compared with known values.

std::vector<float> traceArea(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  EmbreeTracer tracer;
  tracer.update(occluders);
  std::vector<float> visibility;
  const std::size_t rays = tracer.traceArea(light, occluders, receivers, visibility);
  EXPECT_EQ(rays % static_cast<std::size_t>(light.lightSamples), 0u);
  EXPECT_TRUE(std::all_of(
    visibility.begin(), visibility.end(), [](float v) { return v >= 0.0f && v <= 1.0f; }));
  return visibility;
}

const glm::dvec3 down(0.0, 0.0, -1.0);

/// A light of each kind and shape, from about the same direction.
std::vector<ShadowLight> areaLights(int samples = 64)
{
  const glm::dvec3 place(2.0, -1.0, 5.0);
  const glm::dvec3 travel = -glm::normalize(place);
  const glm::dvec3 up(0.0, 1.0, 0.3);
  return { withArea(directionalLight(travel), diskArea(travel, 0.1), samples),
    withArea(directionalLight(travel), rectangleArea(travel, up, { 0.1, 0.05 }), samples),
    withArea(boxLight(travel, 0.8 * place, { 4.0, 4.0, 9.0 }), diskArea(travel, 0.1), samples),
    withArea(spotLight(place, {}, 40.0), rectangleArea(travel, up, { 0.5, 0.3 }), samples),
    withArea(pointLight(place), diskArea(travel, 0.5), samples),
    withArea(pointLight(place), ballArea(0.5), samples) };
}

/// Return level receivers in the plane z = 0, at these world x, in a picture of 64 columns.
ReceiverPixels levelReceivers(const Occluders& occluders, const std::vector<double>& x)
{
  ReceiverPixels receivers;
  receivers.resize(64, static_cast<int>(x.size() / 64));
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    receivers.put(
      i, glm::dvec3(x[i], 0.0, 0.0) - occluders.frame.centre, { 0.0f, 0.0f, 1.0f }, 1e-5f, 0);
  }
  return receivers;
}

struct Penumbra
{
  std::string name;
  ShadowLight light;
  /// The visible share of the light from (x, 0, 0), past the edge x = 0, z = 2 of a half plane at x
  /// < 0.
  std::function<double(double x)> exact;
};

/// Prints the name for the tests' names.
std::ostream& operator<<(std::ostream& stream, const Penumbra& penumbra)
{
  return stream << penumbra.name;
}

using Penumbras = testing::TestWithParam<Penumbra>;

std::vector<Penumbra> penumbras()
{
  const double height = 2.0; // of the half plane
  const double lamp = 10.0;
  const glm::dvec3 place(0.0, 0.0, lamp);
  const glm::dvec3 up(0.0, 1.0, 0.0);
  const LampPastEdge lampPastEdge{ height, lamp, 1.0 };
  const SunPastEdge sunPastEdge{ height, 0.1 };
  return {
    { "square", withArea(spotLight(place, {}, 60.0), rectangleArea(down, up, { 1.0, 0.3 })),
      [=](double x) { return lampPastEdge.square(x); } },
    { "disk", withArea(spotLight(place, {}, 60.0), diskArea(down, 1.0)),
      [=](double x) { return lampPastEdge.disk(x); } },
    { "ball", withArea(pointLight(place), ballArea(1.0)),
      [=](double x) { return lampPastEdge.ball(x); } },
    { "sun", withArea(directionalLight(down), diskArea(down, 0.1)),
      [=](double x) { return sunPastEdge.disk(x); } },
    { "window", withArea(directionalLight(down), rectangleArea(down, up, { 0.1, 0.2 })),
      [=](double x) { return sunPastEdge.square(x); } },
  };
}

INSTANTIATE_TEST_SUITE_P(OfHalfPlane, Penumbras, testing::ValuesIn(penumbras()),
  [](const auto& penumbra) { return penumbra.param.name; });

TEST_P(Penumbras, areThoseOfGeometry)
{
  const Penumbra& penumbra = GetParam();
  const Occluders occluders =
    makeOccluders({ { makePlane(200.0) }, { makePlane(80.0), at({ -40.0, 0.0, 2.0 }) } });
  std::vector<double> x(64 * 64);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] = -0.4 + 0.8 * (static_cast<double>(i) + 0.5) / static_cast<double>(x.size());
  }
  ShadowLight light = penumbra.light;
  light.lightSamples = 1024;
  const std::vector<float> seen = traceArea(light, occluders, levelReceivers(occluders, x));
  double width = 0.0;
  double exactWidth = 0.0;
  double mostOff = 0.0;
  double offset = 0.0;
  const double step = 0.8 / static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const double exact = penumbra.exact(x[i]);
    mostOff = std::max(mostOff, std::abs(seen[i] - exact));
    offset += step * (seen[i] - exact);
    // The width from an eighth to seven eighths, at any place.
    width += seen[i] > 0.125f && seen[i] < 0.875f ? step : 0.0;
    exactWidth += exact > 0.125 && exact < 0.875 ? step : 0.0;
    if (exact == 0.0 || exact == 1.0)
    {
      EXPECT_EQ(seen[i], static_cast<float>(exact)) << x[i];
    }
  }
  EXPECT_GT(exactWidth, 0.1);
  EXPECT_NEAR(width, exactWidth, 0.01 * exactWidth);
  EXPECT_LT(mostOff, 0.01);
  EXPECT_LT(std::abs(offset), 1e-4);
}

/// Cube, sphere and sheet over a plane.
Occluders makeThings()
{
  return makeOccluders({ { makePlane(12.0) }, { makeBox({ -1.0, -1.0, 0.0 }, { 0.0, 0.0, 1.0 }) },
    { makeSphere(16, 32), at({ 1.2, 0.3, 0.8 }, 0.6) },
    { makePlane(1.5), glm::rotate(at({ 0.0, 1.4, 0.9 }), 0.5, { 1.0, 0.2, 0.0 }) } });
}

/// Cuts tiles at both borders.
const Camera cameraOfThings{ { 2.0, -6.0, 5.0 }, {}, { 0.0, 0.0, 1.0 }, 40.0, 0.0, 150, 110 };

TEST(AreaShadows, ofALightWithoutSizeAreHardToTheLastBit)
{
  const Occluders occluders = makeThings();
  const ReceiverPixels receivers = makeReceivers(occluders, cameraOfThings);
  for (const int samples : { 1, 7, 16 })
  {
    for (ShadowLight light : areaLights(samples))
    {
      light.area->worldFromUnit = glm::dmat3(0.0);
      EXPECT_EQ(traceArea(light, occluders, receivers), trace(light, occluders, receivers));
    }
  }
}

/// If the floor cuts a light, or a light lies in it, the lower half is behind the floor's plane.
TEST(AreaShadows, ofALightInTheFloorsPlaneAreCleanOnTheFloor)
{
  const Occluders occluders = makeOccluders({ { makePlane(20.0, 5) } });
  const ReceiverPixels receivers = makeReceivers(occluders, cameraOfThings);
  for (const double height : { 0.5, 0.01, 1e-6, 0.0, -0.1 })
  {
    const glm::dvec3 place(3.0, 0.0, height);
    const glm::dvec3 travel(-1.0, 0.0, 0.0);
    const glm::dvec3 up(0.0, 0.0, 1.0);
    for (const double size : { 0.3, 3.0, 1e4 })
    {
      for (const LightArea& area : { rectangleArea(travel, up, { size, size }),
             diskArea(travel, size), diskArea(down, size), ballArea(size) })
      {
        const ShadowLight light = withArea(pointLight(place), area, 16);
        const std::vector<float> soft = traceArea(light, occluders, receivers);
        // The floor does not shadow itself from any part of the light.
        EXPECT_EQ(countDifferent(soft, trace(light, occluders, receivers)), 0u)
          << height << " " << size;
      }
    }
  }
}

TEST(AreaShadows, touchWhatCastsThem)
{
  // A wall stands on the floor, so a nearer receiver has a narrower penumbra.
  const Occluders occluders = makeOccluders({ { makePlane(200.0) },
    { makePlane(80.0),
      glm::rotate(at({ 0.0, 0.0, 0.0 }), glm::half_pi<double>(), { 0.0, 1.0, 0.0 }) } });
  const glm::dvec3 travel = glm::normalize(glm::dvec3(1.0, 0.0, -1.0));
  const ShadowLight light = withArea(directionalLight(travel), diskArea(travel, 0.05));
  std::vector<double> x(64 * 16);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] = (static_cast<double>(i) - 512.0 + 0.5) * 1e-4;
  }
  const std::vector<float> seen = traceArea(light, occluders, levelReceivers(occluders, x));
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_EQ(seen[i], x[i] < 0.0 ? 1.0f : 0.0f) << x[i];
  }
}

} // namespace
} // namespace gnomon::test
