// Ray-traced shadows of area lights, compared with known values.

#include "HalfPlane.h"
#include "SyntheticScene.h"

#include "lights/LightArea.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

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
