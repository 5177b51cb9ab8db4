// `penumbra` equals all rays of `raytraced`, bit for bit.

#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "lights/LightArea.h"
#include "lights/LightSpace.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::test
{
namespace
{

struct Outcome
{
  std::size_t different = 0;
  std::size_t raysOfTruth = 0;
  std::size_t rays = 0;
};

/// Compare a light's visibility with that of all of its rays.
Outcome compareWithTruth(
  const ShadowLight& light, const Occluders& occluders, const Receivers& receivers)
{
  EmbreeTracer tracer;
  tracer.update(occluders);
  EdgeTree tree;
  tree.update(occluders);
  const PenumbraChooser chooser(tree, light, occluders.frame.centre);
  std::vector<float> truth;
  std::vector<float> visibility;
  Outcome outcome;
  outcome.raysOfTruth = tracer.traceArea(light, occluders, receivers, truth);
  outcome.rays =
    tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
  outcome.different = countDifferent(visibility, truth);
  return outcome;
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

class RandomPenumbras : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(OfScenes, RandomPenumbras, testing::ValuesIn(randomSceneNames()),
  [](const testing::TestParamInfo<const char*>& name) { return lettersOf(name.param); });

TEST_P(RandomPenumbras, areThoseOfAllRays)
{
  std::size_t rays = 0;
  std::size_t raysOfTruth = 0;
  for (unsigned int seed = 0; seed < exactRuns(); ++seed)
  {
    RandomPicture picture = makeRandomPicture(GetParam(), 5000 + seed);
    Random random(seed);
    ShadowLight& light = picture.light;
    light.area = makeRandomArea(light, 1.0, random);
    const int counts[] = { 16, 64, 64, 23 };
    light.lightSamples = counts[random() % 4];
    light.lightSeed = static_cast<int>(random() % 100);
    ReceiverPixels stored;
    Receivers receivers(picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
    receivers.all();
    const Outcome outcome = compareWithTruth(light, picture.occluders, receivers);
    EXPECT_EQ(outcome.different, 0u)
      << picture.description << ", shape " << static_cast<int>(light.area->shape) << ", "
      << light.lightSamples << " samples";
    rays += outcome.rays;
    raysOfTruth += outcome.raysOfTruth;
  }
  EXPECT_LT(rays, raysOfTruth);
}

/// Receivers with a shadow ray each, from any start. They fill squares of 8 x 8 pixels one by one.
/// Receivers of a square should be close to each other: distant ones have too many blockers between
/// them, and are only traced.
struct Starts
{
  static constexpr std::size_t side = 8;
  static constexpr std::size_t ofSquare = side * side;

  ReceiverPixels receivers;
  std::size_t count = 0;

  Starts() { this->receivers.resize(64, 64); }
  bool full() const { return this->count == this->receivers.size(); }
  bool beginsSquare() const { return this->count % ofSquare == 0; }
  /// @param start centred
  void add(const glm::dvec3& start, const glm::dvec3& normal, double offset)
  {
    const std::size_t square = this->count / ofSquare;
    const std::size_t in = this->count % ofSquare;
    const std::size_t pixel =
      (square / side * side + in / side) * 64 + square % side * side + in % side;
    const glm::dvec3 position = start - offset * normal;
    this->receivers.positionX[pixel] = static_cast<float>(position.x);
    this->receivers.positionY[pixel] = static_cast<float>(position.y);
    this->receivers.positionZ[pixel] = static_cast<float>(position.z);
    this->receivers.normalX[pixel] = static_cast<float>(normal.x);
    this->receivers.normalY[pixel] = static_cast<float>(normal.y);
    this->receivers.normalZ[pixel] = static_cast<float>(normal.z);
    this->receivers.offset[pixel] = static_cast<float>(offset);
    this->receivers.surface[pixel] = 0;
    ++this->count;
  }
};

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
  const glm::uvec3 triangle =
    occluders.triangles[soup.firstTriangle + random() % soup.triangleCount];
  return { occluders.positionsCentred[triangle.x], occluders.positionsCentred[triangle.y],
    occluders.positionsCentred[triangle.z] };
}

/// Rays that pass edges to within a rounding are traced.
TEST(Penumbra, isThatOfAllRaysWhereTheseGoAlongEdges)
{
  Random random(1);
  for (unsigned int scene = 0; scene < 10; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    const glm::dvec3 place(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), 5.0);
    const glm::dvec3 placeCentred = place - occluders.frame.centre;
    const double floor = -occluders.frame.centre.z;
    Starts starts;
    std::array<glm::dvec3, 3> triangle{};
    double along = 0.0;
    while (!starts.full())
    {
      if (starts.beginsSquare())
      {
        triangle = anyTriangle(occluders, random);
        along = uniform(random, 0.0, 1.0);
      }
      const glm::dvec3 on =
        glm::mix(triangle[0], triangle[1], along + uniform(random, -0.02, 0.02));
      const double share = (floor + 1e-5 - on.z) / (on.z - placeCentred.z);
      starts.add(on + share * (on - placeCentred), upwards, 1e-5);
    }
    for (const double size : { 1e-7, 1e-6, 1e-5, 1e-3, 0.3 })
    {
      ShadowLight light = pointLight(place);
      light.area = rectangleArea(-upwards, { 0.0, 1.0, 0.0 }, { size, size });
      light.lightSamples = 16;
      EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
        << "scene " << scene << ", size " << size;
    }
  }
}

/// Rays that start on a triangle other than the receiver's own are traced, too.
TEST(Penumbra, isThatOfAllRaysWhereTheseStartOnTriangles)
{
  Random random(2);
  for (unsigned int scene = 0; scene < 10; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    Starts starts;
    while (!starts.full())
    {
      const std::array<glm::dvec3, 3> triangle = anyTriangle(occluders, random);
      const double a = uniform(random, 0.0, 1.0);
      const double b = uniform(random, 0.0, 1.0 - a);
      const double off = std::pow(10.0, uniform(random, -9.0, -5.0));
      starts.add(
        (1.0 - a - b) * triangle[0] + a * triangle[1] + b * triangle[2] + off * unitVector(random),
        upwards, 1e-7);
    }
    for (const double size : { 1e-3, 0.1, 1.0 })
    {
      ShadowLight light = pointLight({ 0.3, 0.2, 5.0 });
      light.area = diskArea(-upwards, size);
      light.lightSamples = 64;
      EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
        << "scene " << scene << ", size " << size;
    }
  }
}

/// Rays that end on a triangle, or near one, are traced, too.
TEST(Penumbra, isThatOfAllRaysWhereTheseEndOnTriangles)
{
  Random random(3);
  for (unsigned int scene = 0; scene < 12; ++scene)
  {
    const Occluders occluders = makeSoupOverFloor(scene);
    Starts starts;
    glm::dvec3 square(0.0);
    while (!starts.full())
    {
      if (starts.beginsSquare())
      {
        square = { uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5), 1e-5 };
      }
      const glm::dvec3 off(uniform(random, -0.02, 0.02), uniform(random, -0.02, 0.02), 0.0);
      starts.add(square + off - occluders.frame.centre, upwards, 1e-5);
    }
    const std::array<glm::dvec3, 3> triangle = anyTriangle(occluders, random);
    const glm::dvec3 place =
      occluders.frame.centre + (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    for (const double size : { 1e-4, 0.02, 0.2 })
    {
      for (const LightArea& area : { diskArea(-upwards, size), ballArea(size),
             rectangleArea(unitVector(random), { 0.1, 0.9, 0.4 }, { size, 0.3 * size }) })
      {
        ShadowLight light = pointLight(place + size * uniform(random, -1.0, 1.0) * upwards);
        light.area = area;
        light.lightSamples = 16;
        EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
          << "scene " << scene << ", size " << size;
      }
    }
  }
}

/// A triangle whose edge nearly points at the starts, and a light beside it: in that view, rounding
/// reaches far around its edges.
TEST(Penumbra, isThatOfAllRaysWhereEdgesPointAtTheLight)
{
  Random random(4);
  for (const bool fromSide : { false, true })
  {
    for (const double offLine : { 1e-3, 1e-4, 1e-5, 3e-6 })
    {
      for (int scene = 0; scene < 8; ++scene)
      {
        const glm::dvec3 along = unitVector(random);
        const glm::dvec3 x = glm::normalize(glm::cross(along, unitVector(random)));
        const glm::dvec3 y = glm::cross(along, x);
        const glm::dvec3 place = 2.0 * unitVector(random);
        const double nearest = uniform(random, 0.5, 2.0);
        const double farthest = nearest + uniform(random, 2.0, 5.0);
        const Mesh mesh{ { place + nearest * along, place + farthest * along,
                           place + uniform(random, 1.0, 5.0) * along +
                             uniform(random, 1.0, 3.0) * x },
          { { 0, 1, 2 } } };
        const Occluders occluders = makeOccluders({ { mesh } });
        Starts starts;
        while (!starts.full())
        {
          const double angle = (random() % 2 ? glm::pi<double>() : 0.0) +
            (fromSide ? uniform(random, -0.02, 0.02) : uniform(random, 0.3, 2.8));
          const double off = offLine * farthest * uniform(random, 0.2, 1.0);
          starts.add(
            place - occluders.frame.centre + off * (std::cos(angle) * x + std::sin(angle) * y),
            along, 1e-7);
        }
        const double side = scene % 2 == 0 ? 1.0 : -1.0;
        const bool directional = scene % 4 < 2;
        const double distance = 10.0;
        const double half = uniform(random, 2e-5, 1e-4);
        const glm::dvec3 towards = glm::normalize(along + side * uniform(random, 3e-4, 1.5e-3) * x);
        ShadowLight light =
          directional ? directionalLight(-towards) : pointLight(place + distance * towards);
        light.area = rectangleArea(
          -towards, axisAcross(-towards), glm::dvec2(half * (directional ? 1.0 : distance)));
        light.lightSamples = 16;
        EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
          << "scene " << scene << ", " << offLine << " off the line, from its side " << fromSide;
      }
    }
  }
}

/// Starts lie in a triangle's plane. A light lies in it, too, beyond the triangle's tip.
TEST(Penumbra, isThatOfAllRaysWhereTheseGoAlongTriangles)
{
  Random random(5);
  for (const double offPlane : { 0.0, 1e-6, 1e-5, 1e-4 })
  {
    for (const double angle : { 1e-3, 1e-2, 1e-1 })
    {
      for (const double half : { 1e-5, 1e-3 })
      {
        for (int scene = 0; scene < 6; ++scene)
        {
          const glm::dvec3 normal = unitVector(random);
          const glm::dvec3 x = glm::normalize(glm::cross(normal, unitVector(random)));
          const glm::dvec3 y = glm::cross(normal, x);
          const glm::dvec3 place = 2.0 * unitVector(random);
          const auto at = [&](double distance, double direction)
          { return place + distance * (std::cos(direction) * x + std::sin(direction) * y); };
          const Mesh mesh{ { at(uniform(random, 2.0, 5.0), 0.0),
                             at(uniform(random, 1.0, 6.0), uniform(random, 0.1, 1.0)),
                             at(uniform(random, 1.0, 6.0), uniform(random, 0.1, 1.0)) },
            { { 0, 1, 2 } } };
          const Occluders occluders = makeOccluders({ { mesh } });
          const glm::dvec3 towards = std::cos(angle) * x - std::sin(angle) * y;
          Starts starts;
          while (!starts.full())
          {
            const double off = uniform(random, -offPlane, offPlane);
            const double offX = uniform(random, -1e-3, 1e-3);
            const double offY = angle * uniform(random, -1e-3, 1e-3);
            starts.add(
              place - occluders.frame.centre + off * normal + offX * x + offY * y, towards, 1e-7);
          }
          ShadowLight light = pointLight(place + 10.0 * towards);
          light.area = rectangleArea(-towards, normal, glm::dvec2(10.0 * half));
          light.lightSamples = 64;
          EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
            << "scene " << scene << ", " << offPlane << " off the plane, " << angle << ", " << half;
        }
      }
    }
  }
}

/// Starts lie in the plane of a triangle of any slant, or on the triangle, to within rounding. Rays
/// go along it, to it or away from it.
TEST(Penumbra, isThatOfAllRaysWhereTheseLeaveTriangles)
{
  Random random(7);
  for (const double distance : { 0.0, 1.5, 10.0 })
  {
    for (const double off : { 1e-7, 1e-6, 1e-5, 1e-3 })
    {
      for (const double slope : { 1e-7, 1e-6, 1e-5, 1e-4, 1e-2 })
      {
        for (int scene = 0; scene < 6; ++scene)
        {
          const glm::dvec3 normal = unitVector(random);
          const glm::dvec3 x = glm::normalize(glm::cross(normal, unitVector(random)));
          const glm::dvec3 y = glm::cross(normal, x);
          const glm::dvec3 start = 3.0 * unitVector(random);
          const glm::dvec3 place = start + distance * y;
          const double size = uniform(random, 0.5, 2.0);
          const Mesh mesh{ { place - size * x, place + size * (x + 0.3 * y),
                             place + size * uniform(random, 0.1, 2.0) * y },
            { { 0, 1, 2 } } };
          // A second triangle keeps the middle of all coordinates away from the first.
          const Occluders occluders =
            makeOccluders({ { mesh }, { makePlane(0.1), at({ 9.0, -7.0, 8.0 }) } });
          const glm::dvec3 towards = glm::normalize(
            uniform(random, -0.2, 0.2) * x + y + uniform(random, -3.0, 3.0) * slope * normal);
          const double spread = distance > 0.0 ? 0.02 : size;
          Starts starts;
          while (!starts.full())
          {
            const glm::dvec3 from = start + spread * uniform(random, -1.0, 1.0) * x +
              spread * uniform(random, -0.5, 1.0) * y;
            starts.add(from - occluders.frame.centre + off * uniform(random, 0.5, 1.0) * normal,
              towards, 1e-9);
          }
          ShadowLight light = pointLight(place + 20.0 * towards);
          light.area = rectangleArea(-towards, normal, glm::dvec2(20.0 * slope));
          light.lightSamples = 16;
          EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u)
            << "scene " << scene << ", " << distance << " away, " << off << " off the plane, slope "
            << slope;
        }
      }
    }
  }
}

/// A ray that starts closer to the near face of a light's box than its offset goes beyond the face.
TEST(Penumbra, isThatOfAllRaysWhereTheseGoBeyondTheBoxOfTheLight)
{
  Random random(6);
  const Occluders occluders =
    makeOccluders({ { makePlane(6.0) }, { makePlane(0.2), at({ 0.1, 0.0, 0.512 }) } });
  Starts starts;
  while (!starts.full())
  {
    const glm::dvec3 start(uniform(random, -0.003, 0.003), uniform(random, -0.003, 0.003), 0.506);
    starts.add(start - occluders.frame.centre, upwards, 0.01);
  }
  ShadowLight light = boxLight(-upwards, { 0.0, 0.0, 0.507 }, { 4.0, 4.0, 4.0 });
  light.box = LightBox{ 4.0, 4.0, 4.0, { 0.0, 1.0, 0.0 } };
  light.area = diskArea(-upwards, 0.3);
  light.lightSamples = 16;
  EXPECT_EQ(compareWithTruth(light, occluders, starts.receivers).different, 0u);
}

/// The same edges decide samples that are unevenly spread.
TEST(Penumbra, isThatOfAllRaysWhicheverPointsOfTheLightTheyGoTo)
{
  const Occluders occluders =
    makeOccluders({ { makePlane(12.0) }, { makeSphere(12, 24), at({ 0.0, 0.0, 1.5 }) } });
  Camera camera;
  camera.position = { 2.0, -6.0, 5.0 };
  const ReceiverPixels receivers = makeReceivers(occluders, camera);
  for (const LightSampling sampling : { LightSampling::Jittered, LightSampling::Random })
  {
    ShadowLight light = pointLight({ 1.0, 1.0, 6.0 });
    light.area = rectangleArea(-upwards, { 0.0, 1.0, 0.0 }, { 0.5, 0.5 });
    light.lightSamples = 64;
    light.lightSampling = sampling;
    const Outcome outcome = compareWithTruth(light, occluders, receivers);
    EXPECT_EQ(outcome.different, 0u);
    EXPECT_LT(outcome.rays, outcome.raysOfTruth / 20);
  }
}

/// A pixel costs one ray if it sees no edge, and few if it sees some.
TEST(Penumbra, takesOneRayOfAllPixelsWhereNothingIsInTheWay)
{
  const Occluders occluders = makeOccluders({ { makePlane(20.0) } });
  Camera camera;
  camera.position = { 2.0, -6.0, 5.0 };
  const ReceiverPixels receivers = makeReceivers(occluders, camera);
  ShadowLight light = pointLight({ 1.0, 1.0, 6.0 });
  light.area = diskArea(-upwards, 0.5);
  light.lightSamples = 64;
  const Outcome outcome = compareWithTruth(light, occluders, receivers);
  EXPECT_EQ(outcome.different, 0u);
  EXPECT_EQ(outcome.rays, outcome.raysOfTruth / 64);
}

TEST(Penumbra, takesFewRaysOfSpheres)
{
  const Occluders occluders =
    makeOccluders({ { makePlane(12.0) }, { makeSphere(12, 24), at({ 0.0, 0.0, 1.5 }) } });
  Camera camera;
  camera.position = { 2.0, -6.0, 5.0 };
  const ReceiverPixels receivers = makeReceivers(occluders, camera);
  ShadowLight light = pointLight({ 1.0, 1.0, 6.0 });
  light.area = rectangleArea(-upwards, { 0.0, 1.0, 0.0 }, { 0.5, 0.5 });
  light.lightSamples = 64;
  const Outcome outcome = compareWithTruth(light, occluders, receivers);
  EXPECT_EQ(outcome.different, 0u);
  EXPECT_LT(outcome.rays, outcome.raysOfTruth / 55);
}

/// Moved casters are found again.
TEST(Penumbra, followsCastersThatMove)
{
  Occluders occluders =
    makeOccluders({ { makePlane(12.0) }, { makeSphere(12, 24), at({ 0.0, 0.0, 1.5 }) } });
  Camera camera;
  camera.position = { 2.0, -6.0, 5.0 };
  ShadowLight light = pointLight({ 1.0, 1.0, 6.0 });
  light.area = ballArea(0.5);
  light.lightSamples = 16;
  EmbreeTracer tracer;
  EdgeTree tree;
  for (int step = 0; step < 3; ++step)
  {
    tracer.update(occluders);
    tree.update(occluders);
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    const PenumbraChooser chooser(tree, light, occluders.frame.centre);
    std::vector<float> truth;
    std::vector<float> visibility;
    tracer.traceArea(light, occluders, receivers, truth);
    tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
    EXPECT_EQ(visibility, truth);
    moveSurface(occluders, 1, { 0.4, 0.2, 0.1 });
  }
}

} // namespace
} // namespace gnomon::test
