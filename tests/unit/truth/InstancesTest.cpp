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

Camera cupsCamera()
{
  Camera camera;
  camera.position = { 9.0, -14.0, 12.0 };
  camera.width = camera.height = 400;
  return camera;
}

TEST(Instances, ReceiversAreThoseOfTheirTriangles)
{
  for (const bool mirrored : { false, true })
  {
    const Occluders instanced = cupsOverFloor(mirrored, false);
    const Occluders triangles = expanded(instanced);
    const View view = makeView(triangles, cupsCamera());
    ReceiverPixels expected;
    ReceiverPixels receivers;
    Receivers(view.images, view.drawnSurfaces, triangles, expected).all();
    Receivers(view.images, view.drawnSurfaces, instanced, receivers).all();
    EXPECT_EQ(receivers.surface, expected.surface);
    std::size_t ofInstances = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      if (receivers.surface[i] == ReceiverPixels::notCovered)
      {
        continue;
      }
      ofInstances += receivers.surface[i];
      const glm::dvec3 off(receivers.positionX[i] - expected.positionX[i],
        receivers.positionY[i] - expected.positionY[i],
        receivers.positionZ[i] - expected.positionZ[i]);
      // Rays meet silhouettes at a flat angle.
      ASSERT_LT(glm::length(off), 2e-3);
      const glm::dvec3 normal(expected.normalX[i], expected.normalY[i], expected.normalZ[i]);
      const glm::dvec3 own(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);
      ASSERT_LT(std::abs(glm::dot(off, normal)), 4e-6);
      ASSERT_GT(glm::dot(own, normal), 0.9999);
      ASSERT_GE(
        receivers.offset[i], expected.offset[i] * (receivers.surface[i] == 0 ? 1.0f : 0.99f));
      ASSERT_LT(receivers.offset[i], expected.offset[i] + 2e-4f);
    }
    EXPECT_GT(ofInstances, 10000u);
  }
}

TEST(Instances, VisibilityIsThatOfTheirTriangles)
{
  std::size_t pixels = 0;
  std::size_t different = 0;
  std::size_t sidesMatter = 0;
  std::size_t holesMatter = 0;
  for (const bool mirrored : { false, true })
  {
    std::vector<float> bothSides;
    for (const bool oneSided : { false, true })
    {
      const Occluders instanced = cupsOverFloor(mirrored, oneSided);
      const Occluders triangles = expanded(instanced);
      Occluders perforated = instanced;
      perforate(perforated);
      const Occluders perforatedTriangles = expanded(perforated);
      const View view = makeView(triangles, cupsCamera());
      ReceiverPixels receivers;
      Receivers(view.images, view.drawnSurfaces, instanced, receivers).all();
      for (const ShadowLight& light :
        { directionalLight({ 0.4, 0.3, -1.0 }), pointLight({ 1.0, 2.0, 9.0 }) })
      {
        const std::vector<float> visibility = trace(light, instanced, receivers);
        const std::vector<float> expected = trace(light, triangles, receivers);
        pixels += visibility.size();
        different += countDifferent(visibility, expected);
        sidesMatter +=
          oneSided && light.kind == LightKind::Point ? countDifferent(visibility, bothSides) : 0;
        bothSides = visibility;
        EXPECT_GT(std::count(visibility.begin(), visibility.end(), 0.0f), 10000);
        const std::vector<float> withHoles = trace(light, perforated, receivers);
        pixels += withHoles.size();
        different += countDifferent(withHoles, trace(light, perforatedTriangles, receivers));
        holesMatter += countDifferent(withHoles, visibility);
      }
    }
  }
  RecordProperty("different", static_cast<int>(different));
  RecordProperty("pixels", static_cast<int>(pixels));
  EXPECT_GT(sidesMatter, 1000u) << "one side and both cast different shadows";
  EXPECT_GT(holesMatter, 8000u) << "light falls through the holes";
  EXPECT_LE(different, pixels / 100000) << "rays that meet an edge to within rounding";
}

/// No triangle of an instance shadows itself, from half of the shadow ray's offset on. That holds
/// for all matrices that stretch, shear (within their limit) and move it.
TEST(Instances, TheOffsetHoldsThroughTheirMatrices)
{
  SignedRandom random(11);
  EmbreeTracer tracer;
  int rays = 0;
  int dark = 0;
  int darkWithout = 0; // without instanceNoise()
  while (rays < 20000)
  {
    const double size = std::pow(10.0, 2.0 * random.uniform());
    Mesh mesh;
    const glm::dvec3 a = random.vector();
    const glm::dvec3 b = a + random.vector();
    mesh.points = { a, b, 0.5 * (a + b) + 0.3 * random.vector() };
    mesh.triangles = { { 0, 1, 2 } };
    const glm::dmat4 shear(glm::dvec4(1.0, 0.0, 0.0, 0.0),
      glm::dvec4(random.uniform(), 1.0, 0.0, 0.0),
      glm::dvec4(random.uniform(), random.uniform(), 1.0, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    glm::dmat4 instance =
      glm::scale(random.turned(0.0) * shear * random.turned(1.0), glm::dvec3(size));
    instance[3] = glm::dvec4(20.0 * random.vector(), 1.0);
    if (!isRegular(glm::dmat3(instance)))
    {
      continue;
    }
    Occluders occluders = makeOccluders({ { mesh } });
    makeInstanced(occluders, 0, { instance });
    const glm::mat4x3 matrix = occluders.surfaces[0].centredFromSource[0];
    std::array<glm::dvec3, 3> source;
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      source[i] = occluders.positionsCentred[i];
      corners[i] = glm::dmat4x3(matrix) * glm::dvec4(source[i], 1.0);
    }
    const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double doubleArea = glm::length(areaVector);
    const glm::vec3 normal(areaVector / doubleArea);
    const glm::vec3 largest =
      glm::max(glm::abs(corners[0]), glm::max(glm::abs(corners[1]), glm::abs(corners[2])));
    const glm::vec3 extent = glm::max(corners[0], glm::max(corners[1], corners[2])) -
      glm::min(corners[0], glm::min(corners[1], corners[2]));
    const float plane = planeNoise(normal, largest, extent, static_cast<float>(doubleArea));
    const float noise = plane + instanceNoise(normal, corners, source, matrix, doubleArea);

    const double u = 0.5 + 0.5 * random.uniform();
    const double v = (0.5 + 0.5 * random.uniform()) * (1.0 - u);
    const glm::dvec3 position = (1.0 - u - v) * corners[0] + u * corners[1] + v * corners[2];
    ReceiverPixels receivers;
    receivers.resize(2, 1);
    for (std::size_t i = 0; i < 2; ++i)
    {
      receivers.positionX[i] = static_cast<float>(position.x);
      receivers.positionY[i] = static_cast<float>(position.y);
      receivers.positionZ[i] = static_cast<float>(position.z);
      receivers.normalX[i] = normal.x;
      receivers.normalY[i] = normal.y;
      receivers.normalZ[i] = normal.z;
      receivers.surface[i] = 0;
    }
    receivers.offset = { noise, 0.25f * plane };
    const glm::dvec3 toLight =
      glm::normalize(glm::dvec3(normal)) + 0.9 * glm::normalize(random.vector());
    std::vector<float> visibility;
    tracer.update(occluders);
    tracer.trace(directionalLight(-toLight), occluders, receivers, visibility);
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
    Camera camera = cupsCamera();
    camera.width = camera.height = 120;
    const View view = makeView(expanded(occluders), camera);
    ReceiverPixels receivers;
    Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
    ShadowLight light = pointLight({ 1.0, 2.0, 30.0 });
    light.area = ballArea(0.5);
    light.lightSamples = 16;
    EmbreeTracer tracer;
    tracer.update(occluders);
    EdgeTree tree;
    tree.update(occluders);
    const PenumbraChooser chooser(tree, light, occluders.frame.centre);
    std::vector<float> truth;
    std::vector<float> visibility;
    const std::size_t all = tracer.traceArea(light, occluders, receivers, truth);
    const std::size_t rays =
      tracer.traceArea(light, occluders, receivers, visibility, nullptr, nullptr, &chooser);
    EXPECT_EQ(countDifferent(visibility, truth), 0u);
    EXPECT_LT(rays, all);
  }
}

TEST(Instances, MovingThemRefitsOnlyTheirPlaces)
{
  Occluders occluders = cupsOverFloor(false, false);
  const View view = makeView(expanded(occluders), cupsCamera());
  const ShadowLight light = directionalLight({ 0.4, 0.3, -1.0 });
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  EmbreeTracer tracer;
  std::vector<float> visibility;
  const auto expectUpdate = [&](int builds, int refits)
  {
    const EmbreeTracer::Update update = tracer.update(occluders);
    EXPECT_EQ(update.builds, builds);
    EXPECT_EQ(update.refits, refits);
    tracer.trace(light, occluders, receivers, visibility);
    EXPECT_EQ(visibility, trace(light, occluders, receivers));
  };
  expectUpdate(2, 0);
  const std::vector<float> before = visibility;
  for (glm::mat4x3& instance : occluders.surfaces[1].centredFromSource)
  {
    instance[3] += glm::vec3(0.7f, 0.2f, 0.1f);
  }
  occluders.surfaces[1].positionsVersion = occluders.positionsVersion += 1000000;
  expectUpdate(0, 1);
  EXPECT_GT(countDifferent(before, visibility), 1000u);

  // One instance is left out, as if another surface had it; the triangles' new version states that.
  occluders.surfaces[1].centredFromSource[7] = glm::mat4x3(0.0f);
  occluders.surfaces[1].topologyVersion = occluders.topologyVersion += 1000000;
  expectUpdate(1, 0);
  occluders.surfaces[1].casts = false;
  occluders.topologyVersion += 1000000;
  expectUpdate(0, 0);
  EXPECT_EQ(std::count(visibility.begin(), visibility.end(), 0.0f),
    std::count_if(receivers.normalZ.begin(), receivers.normalZ.end(),
      [&, i = std::size_t(0)](float) mutable
      {
        const std::size_t pixel = i++;
        const glm::vec3 normal(
          receivers.normalX[pixel], receivers.normalY[pixel], receivers.normalZ[pixel]);
        return receivers.surface[pixel] != ReceiverPixels::notCovered &&
          !facesLight(normal, ShadowRayLight(light, glm::dvec3(0.0)).toLight);
      }));
}

TEST(Instances, LeftOutOnesAreNeitherMetNorReceivers)
{
  Occluders occluders = cupsOverFloor(false, false);
  const Occluders triangles = expanded(occluders);
  const View view = makeView(triangles, cupsCamera());
  std::fill(occluders.surfaces[1].centredFromSource.begin(),
    occluders.surfaces[1].centredFromSource.end(), glm::mat4x3(0.0f));
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  EXPECT_EQ(std::count(receivers.surface.begin(), receivers.surface.end(), 1u), 0);
  const std::vector<float> visibility =
    trace(directionalLight({ 0.4, 0.3, -1.0 }), occluders, receivers);
  EXPECT_EQ(std::count(visibility.begin(), visibility.end(), 0.0f), 0);
  EXPECT_TRUE(
    instancesBounds(occluders.positionsCentred.data(), 3, occluders.surfaces[1].centredFromSource)
      .empty());
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
