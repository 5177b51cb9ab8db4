// Shadow rays on the GPU, against Embree, and against known answers where Embree has cracks.

#include "shadowtech/tracing/GpuTracer.h"

#include "InstancedScene.h"
#include "SyntheticScene.h"

#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include "vtkGnomonEGLRenderWindow.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Return a random point of a triangle.
glm::dvec3 randomPointOf(const std::array<glm::dvec3, 3>& corners, SignedRandom& random)
{
  const double v = 0.5 * (1.0 + random.uniform());
  const double w = 0.5 * (1.0 + random.uniform()) * (1.0 - v);
  return corners[0] + v * (corners[1] - corners[0]) + w * (corners[2] - corners[0]);
}

/// Return receivers anywhere around the casters, with normals that face the light more or less. As
/// many lie on triangles that are not instances', where shadow rays start.
ReceiverPixels randomReceivers(
  const ShadowLight& light, const Occluders& occluders, std::size_t count, SignedRandom& random)
{
  const ShadowRayLight rayLight(light, occluders.centreWorld);
  const auto towardsLight = [&](const glm::vec3& from)
  { return light.kind == LightKind::Directional ? rayLight.toLight : rayLight.position - from; };
  const double radius = occluders.allCentred.radius();
  const glm::dvec3 centre = occluders.allCentred.centre();
  std::vector<PlacedReceiver> receivers;
  while (receivers.size() < count)
  {
    const glm::vec3 position(centre + radius * random.vector());
    receivers.push_back({ position,
      glm::normalize(glm::normalize(towardsLight(position)) + 0.9f * glm::vec3(random.vector())),
      static_cast<float>(1e-6 * radius) });

    const auto triangle = static_cast<std::uint32_t>(
      0.4999 * (1.0 + random.uniform()) * static_cast<double>(occluders.triangles.size()));
    const auto surface = std::find_if(occluders.surfaces.begin(), occluders.surfaces.end(),
      [&](const Surface& of) { return triangle < of.firstTriangle + of.triangleCount; });
    const std::array<glm::dvec3, 3> corners = centredCorners(occluders, *surface, 0, triangle);
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double doubleArea = glm::length(area);
    if (surface->isInstanced() || !(doubleArea > 0.0))
    {
      continue;
    }
    const glm::vec3 on(randomPointOf(corners, random));
    glm::vec3 normal(area / doubleArea);
    normal = glm::dot(normal, towardsLight(on)) < 0.0f ? -normal : normal;
    receivers.push_back({ on, normal,
      shadowRayOffset(
        noiseOf(occluders, *surface, 0, triangle, corners, normal, doubleArea), 0.0f) });
  }
  return rowOf(receivers);
}

/// Return the rays of all receivers that have one.
std::vector<TracedRay> raysOf(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  const ShadowRayLight rayLight(light, occluders.centreWorld);
  std::vector<TracedRay> rays;
  visitShadowRays(rayLight,
    [&](const auto& makeRay, float far)
    {
      for (std::size_t i = 0; i < receivers.size(); ++i)
      {
        const ShadowRay ray =
          makeRay(glm::vec3(receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i]),
            glm::vec3(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]),
            receivers.offset[i]);
        if (ray.traced)
        {
          rays.push_back({ ray.origin, far, ray.direction, static_cast<std::uint32_t>(i) });
        }
      }
      return 0;
    });
  return rays;
}

/// True if rays close beside a receiver's ray are not all blocked or all unblocked. The ray then
/// passes an edge of a triangle or a hole, or ends on a surface, to within rounding.
bool isUndecided(EmbreeTracer& tracer, const ShadowLight& light, const Occluders& occluders,
  const ReceiverPixels& receivers, std::size_t pixel, double nearness)
{
  SignedRandom random(1);
  const glm::dvec3 position(
    receivers.positionX[pixel], receivers.positionY[pixel], receivers.positionZ[pixel]);
  const glm::vec3 normal(
    receivers.normalX[pixel], receivers.normalY[pixel], receivers.normalZ[pixel]);
  std::vector<PlacedReceiver> around;
  for (int i = 0; i < 256; ++i)
  {
    around.push_back(
      { glm::vec3(position + nearness * random.vector()), normal, receivers.offset[pixel] });
  }
  std::vector<float> visibility;
  tracer.trace(light, occluders, rowOf(around), visibility);
  const auto lit = std::count(visibility.begin(), visibility.end(), 1.0f);
  return lit > 0 && lit < 256;
}

/// Counts of compared rays.
struct RayTally
{
  std::size_t rays = 0;
  std::size_t blocked = 0;
  std::size_t different = 0;

  void add(const RayTally& other)
  {
    this->rays += other.rays;
    this->blocked += other.blocked;
    this->different += other.different;
  }
  /// Tracers may differ on one ray in a million: rays that pass an edge to within rounding.
  void expectAlike() const { EXPECT_LE(this->different, this->rays / 1000000 + 1); }
};

class GpuTracerTest : public testing::Test
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
    ASSERT_EQ(GpuTracer::whyUnsupported(), "");
  }
  void TearDown() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

  /// Trace with new buffers and a new tracer, independent of earlier traces.
  std::vector<std::uint8_t> trace(const Occluders& occluders, const std::vector<TracedRay>& rays)
  {
    OccluderBuffers buffers;
    buffers.update(occluders);
    GpuTracer tracer;
    tracer.update(occluders, buffers);
    std::vector<std::uint8_t> blocked;
    tracer.trace(rays.data(), rays.size(), this->shaders_, blocked);
    return blocked;
  }

  std::ptrdiff_t countBlocked(const Occluders& occluders, const std::vector<TracedRay>& rays)
  {
    const std::vector<std::uint8_t> blocked = this->trace(occluders, rays);
    return std::count(blocked.begin(), blocked.end(), 1);
  }

  /// Compare random rays with Embree.
  RayTally compare(const std::string& name, const Occluders& occluders, const ShadowLight& light,
    const ReceiverPixels& receivers)
  {
    EmbreeTracer tracer;
    tracer.update(occluders);
    std::vector<float> visibility;
    tracer.trace(light, occluders, receivers, visibility);
    const std::vector<TracedRay> rays = raysOf(light, occluders, receivers);
    const std::vector<std::uint8_t> blocked = this->trace(occluders, rays);
    RayTally tally;
    tally.rays = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      tally.blocked += blocked[i];
      if ((blocked[i] != 0) == (visibility[rays[i].pixel] == 0.0f))
      {
        continue;
      }
      ++tally.different;
      const double nearness = 1e-6 * occluders.allCentred.radius();
      EXPECT_TRUE(isUndecided(tracer, light, occluders, receivers, rays[i].pixel, nearness))
        << name << ", ray " << i;
      if (tally.different > 5)
      {
        ADD_FAILURE() << name << ": too many rays differ from Embree's";
        break;
      }
    }
    return tally;
  }

  vtkNew<vtkGnomonEGLRenderWindow> window_;
  ShaderLibrary shaders_;
};

struct TracedScene
{
  std::string name;
  Occluders occluders;
};

/// Casters of all kinds, in a world that is turned, moved and scaled.
std::vector<TracedScene> scenes(const glm::dmat4& world)
{
  const auto make = [&](std::vector<Prop> props)
  {
    for (Prop& prop : props)
    {
      prop.worldFromMesh = world * prop.worldFromMesh;
    }
    return makeOccluders(props);
  };
  Mesh slivers = makeTriangleSoup(2000, 5);
  for (std::size_t i = 2; i < slivers.points.size(); i += 3)
  {
    slivers.points[i] =
      glm::mix(0.3 * slivers.points[i - 2] + 0.7 * slivers.points[i - 1], slivers.points[i], 0.02);
  }
  Prop oneSided{ makeSphere(20, 30, 0.3), at({ 0.4, 0.2, 0.3 }) };
  oneSided.oneSided = true;
  Prop holes =
    makePerforatedPlane(2.0, 3, glm::rotate(at({ 0.0, 0.0, 0.3 }), 0.3, { 1.0, 0.3, 0.0 }));
  Prop nearest = makePerforatedPlane(1.5, 2, at({ 0.2, 0.1, -0.4 }));
  CutoutMask mask = *nearest.cutout;
  mask.interpolated = false;
  mask.wrap = TextureWrap::MirroredRepeat;
  nearest.cutout = std::make_shared<const CutoutMask>(mask);
  nearest.oneSided = true;
  return {
    { "soup", make({ { makeTriangleSoup(3000, 7) } }) },
    { "slivers", make({ { slivers } }) },
    { "closed", make({ { makeSphere(60, 90, 0.2) }, { makePlane(4.0), at({ 0.0, 0.0, -1.1 }) } }) },
    { "terrain",
      make({ { makeTerrain(8.0, 80, 1.0) }, { makeBox(glm::dvec3(-0.5), glm::dvec3(0.5)) } }) },
    { "one-sided", make({ oneSided, { makeBox({ -1.0, -1.0, -1.0 }, { 0.0, 0.0, 0.0 }) } }) },
    { "holes", make({ holes, nearest }) },
  };
}

std::vector<ShadowLight> lightsOfWorld(const glm::dmat4& world)
{
  const auto point = [&](const glm::dvec3& at) { return glm::dvec3(world * glm::dvec4(at, 1.0)); };
  const auto along = [&](const glm::dvec3& of) { return glm::dvec3(world * glm::dvec4(of, 0.0)); };
  const double scale = glm::length(glm::dvec3(world[0]));
  return { directionalLight(along({ -1.0, 0.5, -1.5 })),
    directionalLight(along({ 0.0, 0.0, -1.0 })),
    spotLight(point({ 1.0, 0.5, 2.0 }), point({ 0.0, 0.0, 0.0 }), 50.0),
    pointLight(point({ -0.5, 0.3, 1.2 })),
    boxLight(
      along({ -1.0, 0.5, -1.5 }), point({ 0.9, -0.6, 1.1 }), scale * glm::dvec3(2.7, 2.3, 3.1)) };
}

const TracedRay upToOneTriangle{ { -0.3f, -0.2f, 0.0f }, infinite, { 0.0f, 0.0f, 1.0f } };

/// A triangle in the plane z = 1, counter-clockwise from above.
Occluders oneTriangle()
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { -1.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 } };
  Occluders occluders = makeOccluders({ { mesh } });
  for (glm::vec3& position : occluders.positionsCentred)
  {
    position.z = 1.0f;
  }
  return occluders;
}

/// At all scales, and far away.
TEST_F(GpuTracerTest, AnswersAsEmbreeDoes)
{
  SignedRandom random(3);
  RayTally all;
  const glm::dmat4 turned = glm::rotate(at({ 4e6, -4e6, 4e6 }), 0.7, { 1.0, 0.3, 0.2 });
  for (const glm::dmat4& world : { glm::dmat4(1.0), at({}, 1e-4), at({}, 1e4), turned })
  {
    const int count = world == glm::dmat4(1.0) ? 30000 : 5000;
    for (const TracedScene& scene : scenes(world))
    {
      for (const ShadowLight& light : lightsOfWorld(world))
      {
        const RayTally tally = this->compare(scene.name, scene.occluders, light,
          randomReceivers(light, scene.occluders, count, random));
        EXPECT_GT(tally.rays, 0.06 * count) << scene.name;
        EXPECT_GT(tally.blocked, 0.001 * count) << scene.name;
        EXPECT_LT(tally.blocked, tally.rays - 0.001 * count) << scene.name;
        all.add(tally);
      }
    }
  }
  EXPECT_GT(all.rays, 300000u);
  EXPECT_GT(all.blocked, 30000u);
  all.expectAlike();
}

/// Far from the origin floats are coarse, for boxes and triangles alike.
TEST_F(GpuTracerTest, AnswersAsEmbreeDoesInACornerOfALargeScene)
{
  SignedRandom random(7);
  const Occluders occluders = makeOccluders({ { makeSphere(60, 90, 0.2), at({ 3e3, 2e3, -1e3 }) },
    { makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)), at({ -3e3, -2e3, 1e3 }) } });
  RayTally all;
  for (const ShadowLight& light :
    { directionalLight({ -1.0, 0.5, -1.5 }), pointLight({ 3e3 + 0.3, 2e3 - 0.2, -1e3 + 4.0 }) })
  {
    // Around the sphere, where the casters are.
    Occluders sphere = occluders;
    sphere.allCentred = {};
    for (std::uint32_t i = 0; i < occluders.surfaces[0].vertexCount; ++i)
    {
      sphere.allCentred.add(glm::dvec3(occluders.positionsCentred[i]));
    }
    const ReceiverPixels receivers = randomReceivers(light, sphere, 50000, random);
    const RayTally tally = this->compare("far", occluders, light, receivers);
    EXPECT_GT(tally.blocked, 5000u);
    all.add(tally);
  }
  all.expectAlike();
}

TEST_F(GpuTracerTest, AnswersAsEmbreeDoesOfInstances)
{
  SignedRandom random(9);
  RayTally all;
  for (const bool mirrored : { false, true })
  {
    for (const bool oneSided : { false, true })
    {
      Occluders occluders = cupsOverFloor(mirrored, oneSided);
      occluders.allCentred = { glm::dvec3(-8.0, -8.0, -3.0), glm::dvec3(8.0, 8.0, 4.0) };
      Occluders perforated = occluders;
      perforate(perforated);
      for (const ShadowLight& light :
        { directionalLight({ 0.4, 0.3, -1.0 }), pointLight({ 1.0, 2.0, 9.0 }) })
      {
        const ReceiverPixels receivers = randomReceivers(light, occluders, 40000, random);
        const RayTally whole = this->compare("cups", occluders, light, receivers);
        const RayTally holes = this->compare("cups with holes", perforated, light, receivers);
        EXPECT_LT(holes.blocked, whole.blocked);
        all.add(whole);
        all.add(holes);
      }
    }
  }
  EXPECT_GT(all.blocked, 20000u);
  all.expectAlike();
}

/// A lit plane does not shadow itself, from half of the shadow ray's offset on. That holds at any
/// place and size, for a near eye and a low light.
TEST_F(GpuTracerTest, LitPlanesHaveNoAcne)
{
  SignedRandom random(19);
  for (const double tilt : { 0.0, 0.3, 1.1 })
  {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), tilt, { 1.0, 0.2, 0.1 });
    for (const double side : { 4.0, 20000.0 })
    {
      // A level plane is one of the centred frame's own planes, without noise. For other planes, a
      // far surface below moves the frame's origin away from it.
      std::vector<Prop> props{ { makePlane(side, 3), turn } };
      if (tilt > 0.0)
      {
        props.push_back({ makeBox(glm::dvec3(-0.01), glm::dvec3(0.01)),
          turn * at({ 3.0 * side, side, -2.0 * side }) });
      }
      const Occluders occluders = makeOccluders(props);
      std::vector<TracedRay> rays;
      for (std::uint32_t triangle = 0; triangle < occluders.surfaces[0].triangleCount; ++triangle)
      {
        const auto corners = centredCorners(occluders, occluders.surfaces[0], 0, triangle);
        const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::vec3 normal = glm::normalize(area);
        const float noise = noiseOf(
          occluders, occluders.surfaces[0], 0, triangle, corners, normal, glm::length(area));
        const float offset = 0.5f * shadowRayOffsetInside(noise, static_cast<float>(1e-7 * side));
        for (const double degrees : { 0.0, 15.0, 45.0, 80.0, 89.0, 89.9 })
        {
          const double angle = glm::radians(degrees);
          const glm::dvec3 toLight(
            turn * glm::dvec4(std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle), 0.0));
          for (int i = 0; i < 200; ++i)
          {
            rays.push_back({ glm::vec3(randomPointOf(corners, random)) + offset * normal, infinite,
              glm::vec3(toLight) });
          }
        }
      }
      EXPECT_EQ(this->countBlocked(occluders, rays), 0) << tilt << ", " << side;
    }
  }
}

/// Rays from inside are aimed at corners and edges, where cracks would be.
TEST_F(GpuTracerTest, NoRayLeavesAClosedSurface)
{
  SignedRandom random(11);
  for (const double scale : { 1e-4, 1.0, 1e4 })
  {
    for (const glm::dvec3& place : { glm::dvec3(0.0), glm::dvec3(900.0, -700.0, 400.0) })
    {
      // The second prop moves the centre away, so corners are as coarse as in a large scene.
      const glm::dvec3 position = scale * place;
      const Occluders occluders = makeOccluders({ { makeSphere(60, 90, 0.2), at(position, scale) },
        { makeBox(glm::dvec3(-0.01), glm::dvec3(0.01)), at(-position, scale) } });
      std::vector<TracedRay> rays;
      const auto aim = [&](const glm::dvec3& target)
      {
        const glm::vec3 origin(position - occluders.centreWorld + 0.4 * scale * random.vector());
        rays.push_back({ origin, infinite, glm::vec3(target - glm::dvec3(origin)) });
      };
      for (const glm::uvec3& triangle : occluders.triangles)
      {
        for (int i = 0; i < 6; ++i)
        {
          const glm::dvec3 a(occluders.positionsCentred[triangle[i % 3]]);
          const glm::dvec3 b(occluders.positionsCentred[triangle[(i + 1) % 3]]);
          aim(a);
          aim(glm::mix(a, b, 0.5 + 0.5 * random.uniform()));
        }
      }
      ASSERT_GT(rays.size(), 100000u);
      EXPECT_EQ(this->countBlocked(occluders, rays), std::ptrdiff_t(rays.size())) << scale;
    }
  }
}

/// If corners lie exactly on a ray, edges have no sign.
TEST_F(GpuTracerTest, NoRayLeavesABoxThroughTheCornersOfItsGrid)
{
  constexpr int cells = 16;
  std::vector<Prop> sides;
  for (int i = 0; i < 6; ++i)
  {
    const glm::dvec3 axis = i < 4 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const double turns = i < 4 ? 0.25 * i : 0.5 * i - 1.75;
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), glm::two_pi<double>() * turns, axis);
    sides.push_back({ makePlane(2.0, cells) });
    for (glm::dvec3& point : sides.back().mesh.points) // exactly, without the rotation's rounding
    {
      point = glm::round(512.0 * glm::dvec3(turn * glm::dvec4(point.x, point.y, 1.0, 1.0))) / 512.0;
    }
  }
  const Occluders occluders = makeOccluders(sides);
  std::vector<TracedRay> rays;
  for (int x = 1 - cells; x < cells; ++x)
  {
    for (int y = 1 - cells; y < cells; ++y)
    {
      // Corners, middles of edges, and diagonals, along the axes and from the centre.
      const glm::vec2 place(glm::vec2(x, y) / static_cast<float>(cells));
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const float side : { -1.0f, 1.0f })
        {
          glm::vec3 origin(0.0f);
          glm::vec3 along(0.0f);
          origin[(axis + 1) % 3] = place.x;
          origin[(axis + 2) % 3] = place.y;
          along[axis] = side;
          rays.push_back({ origin, infinite, along });
          rays.push_back({ glm::vec3(0.0f), infinite, origin + along });
        }
      }
    }
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    rays.push_back({ glm::vec3(0.0f), infinite,
      glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1) });
  }
  EXPECT_EQ(this->countBlocked(occluders, rays), std::ptrdiff_t(rays.size()));
}

/// A needle that points at a ray has two edges whose lines pass the ray by a rounding, on either
/// side. A tracer that treats a rounded-away sign as "on the edge" would find a hit far beyond the
/// needle's tip. These needles slant along the ray, so the ray meets their boxes.
TEST_F(GpuTracerTest, NeedlesThatPointAtARayDoNotBlockIt)
{
  SignedRandom random(17);
  const glm::dvec3 direction(1.0, 1.9, 1.5);
  Occluders occluders = oneTriangle();
  occluders.positionsCentred.clear();
  occluders.triangles.clear();
  for (unsigned int i = 0; i < 2000; ++i)
  {
    const glm::dvec3 along = glm::dvec3(1.0) + 0.15 * random.vector();
    const glm::dvec3 across = 3e-8 * random.vector();
    for (const glm::dvec3& corner : { along, 2.0 * along + across, 2.1 * along - across })
    {
      occluders.positionsCentred.emplace_back(corner);
    }
    occluders.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  occluders.surfaces[0].vertexCount = 6000;
  occluders.surfaces[0].triangleCount = 2000;
  std::vector<TracedRay> rays;
  for (int i = 0; i < 64; ++i)
  {
    rays.push_back({ glm::vec3((-0.1 - 0.01 * i) * direction), infinite, glm::vec3(direction) });
  }
  EXPECT_EQ(this->countBlocked(occluders, rays), 0);
}

TEST_F(GpuTracerTest, RaysCountFromTheirOriginToTheirEnd)
{
  const glm::vec3 below(-0.3f, -0.2f, 0.0f), up(0.0f, 0.0f, 1.0f), along(1.0f, 0.0f, 0.0f);
  const float beyond = std::nextafter(1.0f, 2.0f);
  const float before = std::nextafter(1.0f, 0.0f);
  // At a slant, where the corners lie on both sides of both ends.
  const glm::vec3 slanted(1.0f, 0.0f, 0.0625f);
  const glm::vec3 from(-0.75f, -0.5f, 1.0f - 0.0625f);
  const std::pair<TracedRay, bool> cases[] = { { { below, infinite, up }, true },
    { { below, 1.0f, up }, true }, // at the end itself
    { { below, beyond, up }, true }, { { below, before, up }, false },
    { { below, 0.25f, 4.0f * up }, true }, { { below, infinite, -up }, false },
    { { below + up, infinite, up }, true }, // at the origin itself
    { { below + up, infinite, -up }, true }, { { below + up, 0.0f, up }, true },
    { { below + beyond * up, infinite, up }, false },
    { { below + before * up, infinite, up }, true }, { { from, 1.0f, slanted }, true },
    { { from, 0.9999999f, slanted }, false },
    { { { from.x, from.y, beyond }, 1.0f, slanted }, false },
    { { from, infinite, -slanted }, false }, { { below, infinite, along }, false }, // along it
    { { below + up, infinite, along }, false } };                                   // in it
  for (const auto& [ray, isBlocked] : cases)
  {
    EXPECT_EQ(this->countBlocked(oneTriangle(), { ray }), isBlocked ? 1 : 0)
      << &isBlocked - &cases[0].second;
  }
}

TEST_F(GpuTracerTest, BadRaysAndTrianglesDoNoHarm)
{
  const float none = std::numeric_limits<float>::quiet_NaN();
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const glm::vec3 below(-0.3f, -0.2f, 0.0f);
  Occluders occluders = oneTriangle();
  EXPECT_EQ(this->trace(occluders,
              { { below, infinite, glm::vec3(0.0f) }, { below, infinite, glm::vec3(none) },
                { glm::vec3(none), infinite, up }, { glm::vec3(infinite), infinite, up },
                { below, infinite, { 0.0f, 0.0f, infinite } }, { below, none, up },
                { below, -1.0f, up }, { below, infinite, up } }),
    std::vector<std::uint8_t>({ 0, 0, 0, 0, 0, 0, 0, 1 }));

  // Points, lines, and a triangle that is there many times.
  occluders.positionsCentred.insert(occluders.positionsCentred.begin() + 3,
    { glm::vec3(0.1f, 0.1f, 0.5f), glm::vec3(0.2f, 0.1f, 0.5f), glm::vec3(0.3f, 0.1f, 0.5f) });
  occluders.triangles.insert(occluders.triangles.end(), { { 3, 3, 3 }, { 3, 4, 4 }, { 3, 4, 5 } });
  occluders.triangles.insert(occluders.triangles.end(), 40, occluders.triangles[0]);
  occluders.surfaces[0].vertexCount = 6;
  occluders.surfaces[0].triangleCount = 44;
  EXPECT_EQ(
    this->trace(occluders,
      { { below, infinite, up }, { { 0.1f, 0.1f, 0.0f }, 0.9f, up },
        { { 0.15f, 0.1f, 0.0f }, 0.9f, up }, { { 0.0f, 0.1f, 0.5f }, 0.9f, { 1.0f, 0.0f, 0.0f } },
        { { 0.9f, 0.9f, 0.0f }, infinite, up } }),
    std::vector<std::uint8_t>({ 1, 0, 0, 0, 0 }));
}

TEST_F(GpuTracerTest, NothingBlocksWhereNothingCasts)
{
  const TracedRay& up = upToOneTriangle;
  EXPECT_TRUE(this->trace(Occluders(), {}).empty());
  EXPECT_EQ(this->trace(Occluders(), { up, up }), std::vector<std::uint8_t>({ 0, 0 }));
  Occluders occluders = oneTriangle();
  EXPECT_TRUE(this->trace(occluders, {}).empty());

  // It stops casting, and is removed, while a tracer is reused.
  OccluderBuffers buffers;
  GpuTracer tracer;
  std::vector<std::uint8_t> blocked;
  const auto blockedAfter = [&]
  {
    occluders.topologyVersion += 1000000;
    buffers.update(occluders);
    tracer.update(occluders, buffers);
    tracer.trace(&up, 1, this->shaders_, blocked);
    return blocked;
  };
  EXPECT_EQ(blockedAfter(), std::vector<std::uint8_t>{ 1 });
  for (const bool casts : { false, true })
  {
    occluders.surfaces[0].casts = casts;
    EXPECT_EQ(blockedAfter()[0] != 0, casts);
  }
  occluders.surfaces.clear();
  EXPECT_EQ(blockedAfter(), std::vector<std::uint8_t>{ 0 });
}

/// Answers depend on the rays and triangles alone: a refitted tree gives the same as a built one,
/// ray by ray.
TEST_F(GpuTracerTest, FollowsWhatMoves)
{
  SignedRandom random(15);
  const ShadowLight light = lightsOfWorld(glm::dmat4(1.0))[0];
  Occluders occluders = makeOccluders({ { makePlane(4.0, 4), at({ 0.0, 0.0, -1.1 }) },
    { makeSphere(30, 40, 0.2), at({}, 0.7) }, { makeTriangleSoup(500, 3) } });
  OccluderBuffers buffers;
  GpuTracer tracer;
  std::vector<std::uint8_t> blocked;
  const auto update = [&]
  {
    buffers.update(occluders);
    const CasterBvh::Change change = tracer.update(occluders, buffers);
    const std::vector<TracedRay> rays =
      raysOf(light, occluders, randomReceivers(light, occluders, 20000, random));
    tracer.trace(rays.data(), rays.size(), this->shaders_, blocked);
    EXPECT_EQ(blocked, this->trace(occluders, rays)) << "as if built";
    return change;
  };
  EXPECT_EQ(update(), CasterBvh::Change::Built);
  EXPECT_EQ(update(), CasterBvh::Change::None);
  for (int step = 0; step < 4; ++step)
  {
    moveSurface(occluders, 1, { 0.01, -0.02, 0.005 });
    EXPECT_EQ(update(), CasterBvh::Change::Refitted);
  }
  occluders.surfaces[2].oneSided = true;
  occluders.topologyVersion += 1000000;
  EXPECT_EQ(update(), CasterBvh::Change::Built);

  occluders = cupsOverFloor(false, false);
  occluders.allCentred = { glm::dvec3(-8.0, -8.0, -3.0), glm::dvec3(8.0, 8.0, 4.0) };
  EXPECT_EQ(update(), CasterBvh::Change::Built);
  for (glm::mat4x3& instance : occluders.surfaces[1].centredFromSource)
  {
    instance[3] += glm::vec3(0.3f, -0.2f, 0.1f);
  }
  occluders.surfaces[1].positionsVersion = occluders.positionsVersion += 1000000;
  EXPECT_EQ(update(), CasterBvh::Change::Refitted);
}

/// More rays than one batch holds, with a pattern of answers.
TEST_F(GpuTracerTest, AnswersKeepTheOrderOfTheRays)
{
  const Occluders occluders = oneTriangle();
  OccluderBuffers buffers;
  buffers.update(occluders);
  const auto isHit = [](std::size_t i) { return (i * 2654435761u >> 7) % 3 == 0; };
  for (const RayTransfer transfer : { RayTransfer::Mapped, RayTransfer::Copied })
  {
    GpuTracer tracer(transfer);
    tracer.update(occluders, buffers);
    for (const std::size_t count : { std::size_t(1), std::size_t(33), RayBatch::mostRays,
           4 * RayBatch::mostRays + 77, RayBatch::mostRays + 1 })
    {
      std::vector<TracedRay> rays;
      for (std::size_t i = 0; i < count; ++i)
      {
        rays.push_back(upToOneTriangle);
        rays.back().direction.z = isHit(i) ? 1.0f : -1.0f;
      }
      std::vector<std::uint8_t> blocked{ 1, 1, 1 };
      tracer.trace(rays.data(), rays.size(), this->shaders_, blocked);
      ASSERT_EQ(blocked.size(), count);
      for (std::size_t i = 0; i < count; ++i)
      {
        ASSERT_EQ(blocked[i] != 0, isHit(i)) << i << " of " << count;
      }
    }
  }
}

TEST_F(GpuTracerTest, LeavesBuffersBoundAsTheyWere)
{
  GlBuffer own;
  allocateStorage(own, 4096, nullptr, "the test's buffer");
  for (GLuint binding = 0; binding < 8; ++binding)
  {
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, own.name(), 256 * binding, 64);
  }
  for (int time = 0; time < 2; ++time)
  {
    this->trace(cupsOverFloor(false, false), { 2, upToOneTriangle });
    GLint value = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &value);
    EXPECT_EQ(value, 0);
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &value);
    EXPECT_EQ(value, static_cast<GLint>(own.name()));
    for (GLuint binding = 0; binding < 8; ++binding)
    {
      GLint64 start = 0, size = 0;
      glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &value);
      glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, binding, &start);
      glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, binding, &size);
      EXPECT_EQ(value, static_cast<GLint>(own.name()));
      EXPECT_EQ(start, 256 * binding);
      EXPECT_EQ(size, 64);
    }
  }
}

TEST(GpuTracer, KnowsSoftwareByItsName)
{
  for (const auto& [name, isSoftware] :
    { std::pair("llvmpipe (LLVM 15.0.6, 256 bits)", true), { "Google SwiftShader", true },
      { "GDI Generic", true }, { "NVIDIA GeForce RTX 4090/PCIe/SSE2", false },
      { "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", false },
      { "AMD Radeon RX 6800 (radeonsi, navi21, LLVM 15.0.6)", false } })
  {
    EXPECT_EQ(isSoftwareRenderer(name), isSoftware) << name;
  }
}

} // namespace
} // namespace gnomon::test
