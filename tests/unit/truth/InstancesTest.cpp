// Surfaces stored as instances, against the triangles of all instances.

#include "shadowtech/base/Instances.h"

#include "InstancedScene.h"
#include "SyntheticScene.h"

#include "lights/LightArea.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/penumbra/PenumbraChooser.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::test
{
namespace
{

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
