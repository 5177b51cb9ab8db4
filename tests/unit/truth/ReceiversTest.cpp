#include "shadowtech/base/Receivers.h"

#include "SyntheticScene.h"

#include "shadowtech/base/ShadowRay.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::test
{
namespace
{

/// A plane and a cube far from the world's origin, none of them along an axis. The cube is inside
/// out, so that the camera sees the back of its triangles.
Occluders turnedScene()
{
  const glm::dmat4 turn = glm::rotate(at({ 1e5, -2e5, 3e5 }), 0.5, { 1.0, 0.4, 0.2 });
  Mesh box = makeBox(glm::dvec3(-0.5), glm::dvec3(0.5));
  for (glm::uvec3& triangle : box.triangles)
  {
    std::swap(triangle.y, triangle.z);
  }
  return makeOccluders({ { makePlane(6.0, 3), turn }, { box, turn } });
}
Camera turnedCamera()
{
  Camera camera;
  camera.position = { 1e5 + 3.0, -2e5 - 5.0, 3e5 + 4.0 };
  camera.target = { 1e5, -2e5, 3e5 };
  return camera;
}

ReceiverPixels project(const View& view, const Occluders& occluders)
{
  ReceiverPixels receivers;
  projectReceivers(view.images, view.drawnSurfaces, occluders, receivers);
  return receivers;
}

/// Fields of a pixel that is not covered, and no number that is not finite.
void expectNotCovered(const ReceiverPixels& receivers, std::size_t i)
{
  EXPECT_EQ(receivers.surface[i], ReceiverPixels::notCovered);
  for (const std::vector<float>* plane :
    { &receivers.positionX, &receivers.positionY, &receivers.positionZ, &receivers.normalX,
      &receivers.normalY, &receivers.normalZ, &receivers.offset })
  {
    EXPECT_EQ((*plane)[i], 0.0f);
  }
}

TEST(Receivers, LieOnTheirTriangles)
{
  const Occluders occluders = turnedScene();
  for (const double parallelHeight : { 0.0, 8.0 })
  {
    Camera camera = turnedCamera();
    camera.parallelHeight = parallelHeight;
    const View view = makeView(occluders, camera);
    const ReceiverPixels receivers = project(view, occluders);
    const glm::dvec3 eye(view.images.centredFromView[3]);
    const glm::dvec3 backward(view.images.centredFromView[2]);
    ASSERT_GT(countCovered(receivers), 20000u);
    for (std::size_t i = 0; i < receivers.size(); ++i)
    {
      const auto drawn = static_cast<std::uint32_t>(view.images.drawn[i]);
      if (drawn == 0)
      {
        expectNotCovered(receivers, i);
        continue;
      }
      ASSERT_EQ(receivers.surface[i], drawn - 1);
      const Surface& surface = occluders.surfaces[drawn - 1];
      const glm::uvec3 corners = occluders.triangles[surface.firstTriangle +
        static_cast<std::uint32_t>(view.images.positionView[i].w)];
      const glm::dvec3 a(occluders.positionsCentred[corners.x]);
      const glm::dvec3 b(occluders.positionsCentred[corners.y]);
      const glm::dvec3 c(occluders.positionsCentred[corners.z]);
      const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
      const glm::dvec3 position(
        receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i]);
      const glm::dvec3 facing(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);

      // Off the plane by no more than rounding the position explains.
      const double rounding = std::ldexp(1.0, -24) * glm::dot(glm::abs(normal), glm::abs(position));
      ASSERT_LE(std::abs(glm::dot(position - a, normal)), 1.001 * rounding);
      // The pixel's own point, but for what the rasteriser made of it.
      const glm::dvec3 seen(
        view.images.centredFromView * glm::dvec4(glm::dvec3(view.images.positionView[i]), 1.0));
      ASSERT_LT(glm::length(seen - position), 1e-5);

      ASSERT_NEAR(std::abs(glm::dot(facing, normal)), 1.0, 1e-6);
      ASSERT_NEAR(glm::length(facing), 1.0, 1e-6);
      ASSERT_GT(glm::dot(facing, parallelHeight > 0.0 ? backward : eye - position), 0.0);

      const auto footprint = static_cast<float>(
        view.images.pixelSize * (parallelHeight > 0.0 ? 1.0 : -view.images.positionView[i].z));
      ASSERT_GT(receivers.offset[i], shadowRayOffset(0.0f, footprint));
      ASSERT_LT(receivers.offset[i], shadowRayOffset(0.0f, footprint) + 1e-4f);
    }
  }
}

TEST(Receivers, FindTheirTrianglesThroughTables)
{
  const Occluders plain = turnedScene();
  View view = makeView(plain, turnedCamera());
  const ReceiverPixels expected = project(view, plain);

  // One drawn surface holds both, the cube first, with a gap in VTK's numbers.
  View shared = view;
  const std::uint32_t planeTriangles = plain.surfaces[0].triangleCount;
  shared.drawnSurfaces = { { { { 3, 12, 1 }, { 20, planeTriangles, 0 } } } };
  for (std::size_t i = 0; i < shared.images.drawn.size(); ++i)
  {
    float& drawn = shared.images.drawn[i];
    shared.images.positionView[i].w += drawn == 1.0f ? 20.0f : 3.0f;
    drawn = drawn > 0.0f ? 1.0f : 0.0f;
  }
  EXPECT_EQ(project(shared, plain).surface, expected.surface);
  EXPECT_EQ(project(shared, plain).positionX, expected.positionX);

  // Numbers outside of both blocks.
  for (const float primitive : { 2.0f, 15.0f, 19.0f, 20.0f + planeTriangles, -1.0f, 1e30f })
  {
    View astray = shared;
    astray.images.positionView[0].w = primitive;
    astray.images.drawn[0] = 1.0f;
    expectNotCovered(project(astray, plain), 0);
  }

  // VTK draws a triangle that the snapshot dropped in front of the plane's.
  Occluders dropped = plain;
  dropped.surfaces[0].triangleOfDrawn.push_back(Surface::noTriangle);
  for (std::uint32_t k = 0; k < planeTriangles; ++k)
  {
    dropped.surfaces[0].triangleOfDrawn.push_back(k);
  }
  View later = view;
  later.drawnSurfaces[0].blocks[0].primitiveCount = planeTriangles + 1;
  for (std::size_t i = 0; i < later.images.drawn.size(); ++i)
  {
    later.images.positionView[i].w += later.images.drawn[i] == 1.0f ? 1.0f : 0.0f;
  }
  EXPECT_EQ(project(later, dropped).surface, expected.surface);
  later.images.drawn[0] = 1.0f;
  later.images.positionView[0].w = 0.0f;
  expectNotCovered(project(later, dropped), 0);
}

TEST(Receivers, OfPropsThatDoNotReceiveAreCoveredAllTheSame)
{
  const Occluders occluders = turnedScene();
  View view = makeView(occluders, turnedCamera());
  const ReceiverPixels expected = project(view, occluders);
  for (float& drawn : view.images.drawn)
  {
    drawn = -drawn;
  }
  EXPECT_EQ(project(view, occluders).surface, expected.surface);
}

TEST(Receivers, BrokenFragmentsAreNotCovered)
{
  const Occluders occluders = turnedScene();
  const View view = makeView(occluders, turnedCamera());
  const auto middle = static_cast<std::size_t>(128 * 256 + 128);
  ASSERT_NE(project(view, occluders).surface[middle], ReceiverPixels::notCovered);
  for (const float broken : { std::numeric_limits<float>::quiet_NaN(),
         std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity() })
  {
    for (int component = 0; component < 4; ++component)
    {
      View astray = view;
      astray.images.positionView[middle][component] = broken;
      expectNotCovered(project(astray, occluders), middle);
    }
    View astray = view;
    astray.images.drawn[middle] = broken;
    expectNotCovered(project(astray, occluders), middle);
  }
  View astray = view;
  for (const float drawn : { 3.0f, 1e20f, 0.5f })
  {
    astray.images.drawn[middle] = drawn;
    expectNotCovered(project(astray, occluders), middle);
  }
}

/// Where the triangle has no normal, the direction to the camera counts.
TEST(Receivers, TrianglesWithoutAreaFaceTheCamera)
{
  Occluders occluders = turnedScene();
  const View view = makeView(occluders, turnedCamera());
  const ReceiverPixels expected = project(view, occluders);
  const auto middle = static_cast<std::size_t>(128 * 256 + 128);
  ASSERT_EQ(expected.surface[middle], 1u);
  for (std::uint32_t k = 0; k < 12; ++k)
  {
    glm::uvec3& triangle = occluders.triangles[occluders.surfaces[1].firstTriangle + k];
    triangle.z = triangle.y;
  }
  const ReceiverPixels receivers = project(view, occluders);
  EXPECT_EQ(receivers.surface[middle], 1u);
  const glm::dvec3 eye(view.images.centredFromView[3]);
  const glm::dvec3 toCamera = glm::normalize(eye -
    glm::dvec3(expected.positionX[middle], expected.positionY[middle], expected.positionZ[middle]));
  EXPECT_NEAR(receivers.normalX[middle], toCamera.x, 1e-5);
  EXPECT_NEAR(receivers.normalY[middle], toCamera.y, 1e-5);
  EXPECT_NEAR(receivers.normalZ[middle], toCamera.z, 1e-5);
  EXPECT_NEAR(receivers.positionX[middle], expected.positionX[middle], 1e-5);
  EXPECT_GT(receivers.offset[middle], 0.0f);
}

TEST(Receivers, EmptyInputs)
{
  ReceiverPixels receivers;
  receivers.resize(3, 3);
  projectReceivers({}, {}, {}, receivers);
  EXPECT_EQ(receivers.size(), 0u);

  View view = makeView(turnedScene(), turnedCamera());
  EXPECT_EQ(countCovered(project(view, Occluders())), 0u);
  view.drawnSurfaces = { {}, {} };
  EXPECT_EQ(countCovered(project(view, turnedScene())), 0u);
}

} // namespace
} // namespace gnomon::test
