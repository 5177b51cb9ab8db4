#include "shadowtech/tracing/EmbreeTracer.h"

#include "SyntheticScene.h"

#include "shadowtech/base/CutoutMask.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/penumbra/Bvh.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

namespace gnomon::test
{
namespace
{

struct TestScene
{
  std::string name;
  std::vector<Prop> props;
  Camera camera;
};

/// Scenes small enough for brute force.
std::vector<TestScene> smallScenes()
{
  const Camera camera{ { 3.0, -5.0, 4.0 }, { 0.0, 0.0, 0.4 } };
  const Prop plane{ makePlane(6.0) };
  const Prop sphere{ makeSphere(12, 24), at({ 0.0, 0.0, 1.0 }) };
  Prop oneSided{ makePlane(1.5), glm::rotate(at({ 0.0, 0.0, 1.2 }), 0.7, { 1.0, 0.3, 0.0 }) };
  Prop turnedOver{ makePlane(1.0), glm::rotate(at({ 1.4, 0.6, 0.8 }), 3.0, { 1.0, 0.0, 0.0 }) };
  oneSided.oneSided = turnedOver.oneSided = true;
  Prop castsNothing{ makePlane(1.0), at({ -1.3, 0.5, 0.9 }) };
  castsNothing.casts = false;
  Prop showsNothing{ makePlane(1.0), at({ -0.5, -1.5, 0.3 }) };
  showsNothing.receives = false;
  // Rays go through the holes of the upper plane to the lower one, which is one-sided.
  const glm::dmat4 tilted = glm::rotate(at({ 0.0, 0.0, 1.0 }), 0.2, { 1.0, 0.3, 0.0 });
  const Prop upper = makePerforatedPlane(1.6, 3, glm::translate(tilted, { 0.1, 0.2, 0.3 }));
  Prop lower = makePerforatedPlane(1.8, 2, tilted);
  lower.oneSided = true;
  // Points, needles, and many equal triangles.
  Prop degenerate{ makePlane(1.0), at({ 0.0, 0.0, 1.0 }) };
  std::vector<glm::uvec3>& triangles = degenerate.mesh.triangles;
  degenerate.mesh.points.emplace_back(0.25, -0.5 + 1e-14, 0.0);
  triangles.insert(triangles.end(), 20, triangles[0]);
  triangles.insert(triangles.end(), { { 0, 0, 0 }, { 0, 1, 1 }, { 0, 1, 4 } });
  return {
    { "cube", { plane, { makeBox({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 1.0 }) } }, camera },
    { "sphere", { plane, sphere }, camera },
    { "soup", { plane, { makeTriangleSoup(400, 7), at({ 0.0, 0.0, 1.5 }) } }, camera },
    { "sides and flags", { plane, oneSided, turnedOver, castsNothing, showsNothing }, camera },
    { "perforated", { plane, upper, lower }, camera },
    { "degenerate", { plane, degenerate, { Mesh() } }, camera },
  };
}

std::vector<ShadowLight> lightsOfSmallScenes()
{
  return { directionalLight({ -1.0, 0.5, -1.5 }), directionalLight({ 0.0, 0.0, -1.0 }),
    spotLight({ 2.0, 1.0, 5.0 }, { 0.0, 0.0, 0.0 }, 25.0), pointLight({ -1.5, 0.7, 2.2 }),
    boxLight({ -1.0, 0.5, -1.5 }, { 0.9, -0.6, 1.1 }, { 1.7, 2.3, 3.1 }) };
}

/// Scenes whose pictures show the effect of rounding.
std::vector<TestScene> largeScenes()
{
  std::vector<TestScene> scenes = smallScenes();
  scenes.erase(scenes.begin() + 2); // hundreds of slivers are no fair sample of pixels
  scenes.push_back({ "terrain",
    { { makeTerrain(1000.0, 150, 20.0) },
      { makeBox({ -15.0, -250.0, 0.0 }, { 5.0, -240.0, 45.0 }) } },
    { { 0.0, -300.0, 22.0 }, { 0.0, 0.0, 10.0 } } });
  return scenes;
}

/// Return visibility by every triangle against every ray, in double precision.
std::vector<float> traceBruteForce(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  const std::vector<CastingTriangle> triangles = castingTriangles(occluders);
  const auto stops = [&](const CastingTriangle& triangle, const ShadowRay& ray, float rayFar)
  {
    const Surface& surface = occluders.surfaces[triangle.surface];
    const auto hit = meet(triangle, glm::dvec3(ray.origin), glm::dvec3(ray.direction));
    if (!hit || !hit->isInside() || hit->at < 0.0 || hit->at > static_cast<double>(rayFar) ||
      (surface.oneSided && hit->cosine < 0.0))
    {
      return false;
    }
    glm::dvec2 place(0.0);
    for (int k = 0; surface.cutout && k < 3; ++k)
    {
      const std::uint32_t corner = occluders.triangles[triangle.triangle][k] - surface.firstVertex;
      place += hit->weights[k] * glm::dvec2(surface.textureCoordinates[corner]);
    }
    return !surface.cutout || surface.cutout->isDrawn(place);
  };
  std::vector<float> visibility(receivers.size(), 1.0f);
  visitShadowRays(ShadowRayLight(light, occluders.frame.centre),
    [&](const auto& makeRay, float rayFar)
    {
      tbb::parallel_for(std::size_t(0), receivers.size(),
        [&](std::size_t i)
        {
          const std::uint32_t surface = receivers.surface[i];
          if (surface != ReceiverPixels::notCovered && occluders.surfaces[surface].receives)
          {
            const ShadowRay ray =
              makeRay(receivers.position(i), receivers.normal(i), receivers.offset[i]);
            const bool lit = ray.traced &&
              std::none_of(triangles.begin(), triangles.end(),
                [&](const CastingTriangle& triangle) { return stops(triangle, ray, rayFar); });
            visibility[i] = lit ? 1.0f : 0.0f;
          }
        });
    });
  return visibility;
}

/// Return the same receivers with the offset of their shadow rays multiplied.
ReceiverPixels withOffset(const ReceiverPixels& receivers, float factor)
{
  ReceiverPixels result = receivers;
  for (float& offset : result.offset)
  {
    offset *= factor;
  }
  return result;
}

/// Count the pixels that have a shadow ray to trace, one by one.
std::size_t countReached(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  return visitShadowRays(ShadowRayLight(light, occluders.frame.centre),
    [&](const auto& makeRay, float)
    {
      return countBelow(receivers.size(),
        [&](std::size_t i)
        {
          const std::uint32_t surface = receivers.surface[i];
          return surface != ReceiverPixels::notCovered && occluders.surfaces[surface].receives &&
            makeRay(receivers.position(i), receivers.normal(i), receivers.offset[i]).traced;
        });
    });
}

/// Images of all shapes: each pixel is traced once.
TEST(EmbreeTracer, AgreesWithBruteForceOnImagesOfAnyShape)
{
  using Shapes = std::vector<std::pair<int, int>>;
  for (TestScene& scene : smallScenes())
  {
    SCOPED_TRACE(scene.name);
    const Occluders occluders = makeOccluders(scene.props);
    EmbreeTracer tracer;
    tracer.update(occluders);
    for (const auto& [width, height] : scene.name == "cube"
        ? Shapes{ { 256, 256 }, { 1, 1 }, { 3, 70 }, { 65, 5 }, { 200, 130 } }
        : Shapes{ { 256, 256 } })
    {
      scene.camera.width = width;
      scene.camera.height = height;
      const ReceiverPixels receivers = makeReceivers(occluders, scene.camera);
      std::vector<float> visibility;
      for (const ShadowLight& light : lightsOfSmallScenes())
      {
        EXPECT_EQ(tracer.trace(light, occluders, receivers, visibility),
          countReached(light, occluders, receivers));
        EXPECT_EQ(visibility, traceBruteForce(light, occluders, receivers));
        const auto lit = std::count(visibility.begin(), visibility.end(), 1.0f);
        const std::ptrdiff_t least = width == 256 ? 100 : 0;
        EXPECT_GE(lit, least);
        EXPECT_LE(lit, static_cast<std::ptrdiff_t>(receivers.size()) - least);
      }
    }
  }
}

/// The scene, its camera and its light under a similarity.
std::pair<TestScene, ShadowLight> moved(
  TestScene scene, ShadowLight light, const glm::dmat4& matrix)
{
  for (Prop& prop : scene.props)
  {
    prop.worldFromMesh = matrix * prop.worldFromMesh;
  }
  for (glm::dvec3* const point :
    { &scene.camera.position, &scene.camera.target, &light.positionWorld })
  {
    *point = glm::dvec3(matrix * glm::dvec4(*point, 1.0));
  }
  if (light.box)
  {
    const double scale = std::cbrt(glm::determinant(glm::dmat3(matrix)));
    light.box->width *= scale;
    light.box->height *= scale;
    light.box->depth *= scale;
  }
  return { scene, light };
}

TEST(EmbreeTracer, VisibilityIsStableUnderOffsetsAndSimilarities)
{
  for (const TestScene& scene : largeScenes())
  {
    const Occluders occluders = makeOccluders(scene.props);
    const ReceiverPixels receivers = makeReceivers(occluders, scene.camera);
    for (const ShadowLight& light : lightsOfSmallScenes())
    {
      const std::vector<float> visibility = trace(light, occluders, receivers);
      const auto expectSame = [&](const std::vector<float>& other)
      {
        EXPECT_LE(
          countDifferent(visibility, other), 1e-4 * static_cast<double>(countCovered(receivers)))
          << scene.name;
      };
      expectSame(trace(light, occluders, withOffset(receivers, 0.5f)));
      expectSame(trace(light, occluders, withOffset(receivers, 2.0f)));
      for (const glm::dmat4& matrix : { at({ 4e6, -4e6, 4e6 }), at({}, 1e-4), at({}, 1e4) })
      {
        const auto [there, lightThere] = moved(scene, light, matrix);
        const Occluders movedOccluders = makeOccluders(there.props);
        expectSame(trace(lightThere, movedOccluders, makeReceivers(movedOccluders, there.camera)));
      }
    }
  }
}

/// Expect the first surface's pixels to be lit if they face the light by more than the rounding
/// that facesLight() allows, and lie inside its cone by more than the rounding of a float.
/// @return their number
std::ptrdiff_t expectFacingPixelsLit(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  const std::vector<float> visibility = trace(light, occluders, receivers);
  const double cosineOfCone = std::cos(glm::radians(light.coneAngleDegrees));
  std::ptrdiff_t facing = 0, dark = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const bool spot = light.kind == LightKind::Spot;
    const glm::dvec3 toLight = spot ? glm::normalize(light.positionWorld - occluders.frame.centre -
                                        glm::dvec3(receivers.position(i)))
                                    : -light.directionWorld;
    const bool inCone = !spot || glm::dot(-toLight, light.directionWorld) > cosineOfCone + 1e-6;
    const bool counts = receivers.surface[i] == 0 && inCone &&
      glm::dot(glm::dvec3(receivers.normal(i)), toLight) > 2e-6;
    facing += counts ? 1 : 0;
    dark += counts && visibility[i] != 1.0f ? 1 : 0;
  }
  EXPECT_EQ(dark, 0);
  return facing;
}

/// A lit plane does not shadow itself, at any place, size and angle of the light.
TEST(EmbreeTracer, LitPlanesHaveNoAcne)
{
  for (const double tilt : { 0.0, 0.3, 1.1 })
  {
    const glm::dmat4 turn =
      glm::rotate(glm::rotate(glm::dmat4(1.0), 0.4, { 0.0, 0.0, 1.0 }), tilt, { 1.0, 0.2, 0.0 });
    const auto turned = [&](const glm::dvec4& vector) { return glm::dvec3(turn * vector); };
    const Camera camera{ turned({ 0.1, -3.0, 2.0, 1.0 }), glm::dvec3(0.0),
      turned({ 0.0, 0.0, 1.0, 0.0 }) };
    for (const double side : { 4.0, 20000.0 })
    {
      for (const int cells : { 1, 9 })
      {
        // A far surface below moves the centred frame's origin away from the plane.
        const Occluders occluders = makeOccluders({ { makePlane(side, cells), turn },
          { makeBox(glm::dvec3(-0.01), glm::dvec3(0.01)),
            turn * at({ 3.0 * side, side, -2.0 * side }) } });
        const ReceiverPixels receivers = withOffset(makeReceivers(occluders, camera), 0.5f);
        const auto ofPlane = std::count(receivers.surface.begin(), receivers.surface.end(), 0u);
        for (const double degrees : { 0.0, 15.0, 45.0, 80.0, 89.0, 89.9 })
        {
          const double angle = glm::radians(degrees);
          const glm::dvec3 toLight =
            turned({ std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle), 0.0 });
          SCOPED_TRACE(
            testing::Message() << degrees << " degrees, side " << side << ", tilt " << tilt);
          EXPECT_EQ(
            expectFacingPixelsLit(directionalLight(-toLight), occluders, receivers), ofPlane);
          // The light's cone ends inside the plane where it grazes.
          EXPECT_GT(expectFacingPixelsLit(
                      spotLight(0.4 * side * toLight, glm::dvec3(0.0), 89.0), occluders, receivers),
            20000);
        }
      }
    }
  }
}

/// From one receiver on the ground below a square roof at height 1.
TEST(EmbreeTracer, SpotLightsReachTheirConeAndNoFurtherThanThemselves)
{
  const Occluders occluders =
    makeOccluders({ { makePlane(4.0) }, { makePlane(1.0), at({ 0.0, 0.0, 1.0 }) } });
  const auto visibility = [&](const glm::dvec3& lamp, const glm::dvec3& target, double degrees)
  {
    return trace(spotLight(lamp, target, degrees), occluders,
      rowOf({ { { 0.1f, 0.2f, -0.5f }, { 0.0f, 0.0f, 1.0f }, 1e-5f } }))[0];
  };
  // Above the roof, below the roof, and below it but aimed elsewhere.
  EXPECT_EQ(visibility({ 0.1, 0.2, 3.0 }, { 0.1, 0.2, 0.0 }, 10.0), 0.0f);
  EXPECT_EQ(visibility({ 0.1, 0.2, 0.9 }, { 0.1, 0.2, 0.0 }, 10.0), 1.0f);
  EXPECT_EQ(visibility({ 0.1, 0.2, 0.9 }, { 2.0, 0.2, 0.0 }, 10.0), 0.0f);
  EXPECT_EQ(visibility({ 0.1, 0.2, 0.9 }, { 0.1, 0.2, 2.0 }, 89.0), 0.0f);
}

/// Rays through the inner edges of a wavy surface find no crack: along the diagonals and the lower
/// sides of all quads but those on the border.
TEST(EmbreeTracer, SurfacesAreWatertight)
{
  constexpr unsigned int cells = 40, inner = cells - 1;
  const Occluders occluders = makeOccluders(
    { { makeTerrain(2.0, cells, 0.3), glm::rotate(glm::dmat4(1.0), 0.3, { 1.0, 0.7, 0.2 }) } });
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(0.2, -0.3, 1.0));
  const auto corner = [&](unsigned int column, unsigned int row)
  { return glm::dvec3(occluders.positionsCentred[row * (cells + 1) + column]); };
  std::vector<PlacedReceiver> receivers; // their shadow rays start exactly there
  for (unsigned int i = 0; i < inner * inner * 98; ++i)
  {
    const unsigned int quad = i / 98, step = 1 + i % 98 / 2, up = i % 2;
    const unsigned int column = 1 + quad % inner, row = 1 + quad / inner;
    const glm::dvec3 onEdge =
      glm::mix(corner(column, row), corner(column + 1, row + up), step / 50.0);
    receivers.push_back({ onEdge - (1.0 + 0.01 * step) * toLight, { 0.0f, 0.0f, 1.0f }, 0.0f });
  }
  const std::vector<float> visibility =
    trace(directionalLight(-toLight), occluders, rowOf(receivers));
  EXPECT_EQ(std::count(visibility.begin(), visibility.end(), 1.0f), 0);
}

TEST(EmbreeTracer, EmptyInputsGiveEmptyOrLitImages)
{
  EmbreeTracer tracer;
  const Occluders nothing;
  ReceiverPixels receivers;
  std::vector<float> visibility{ 0.5f };
  tracer.update(nothing);
  EXPECT_EQ(tracer.trace(directionalLight({ 0, 0, -1 }), nothing, receivers, visibility), 0u);
  EXPECT_TRUE(visibility.empty());

  receivers.resize(70, 5);
  std::fill(receivers.surface.begin(), receivers.surface.end(), ReceiverPixels::notCovered);
  EXPECT_EQ(tracer.trace(directionalLight({ 0, 0, -1 }), nothing, receivers, visibility), 0u);
  EXPECT_EQ(visibility, std::vector<float>(350, 1.0f));
}

TEST(EmbreeTracer, UpdatesWhatChanged)
{
  const Prop cube{ makeBox(glm::dvec3(-0.5), glm::dvec3(0.5)), at({ 0.0, 0.0, 1.0 }) };
  Prop second = cube;
  second.worldFromMesh = at({ 1.2, 0.0, 0.6 });
  Occluders occluders = makeOccluders({ { makePlane(6.0, 5) }, cube, second });
  const Camera camera{ { 3.0, -5.0, 4.0 } };
  const ShadowLight light = lightsOfSmallScenes()[0];
  EmbreeTracer tracer;
  std::vector<float> visibility;
  const auto expectUpdate = [&](int builds, int refits)
  {
    const EmbreeTracer::Update update = tracer.update(occluders);
    EXPECT_EQ(update.builds, builds);
    EXPECT_EQ(update.refits, refits);
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    tracer.trace(light, occluders, receivers, visibility);
    EXPECT_EQ(visibility, traceBruteForce(light, occluders, receivers));
  };
  expectUpdate(3, 0);
  EXPECT_GT(tracer.bytes(), 0u);
  expectUpdate(0, 0);
  for (int step = 0; step < 5; ++step)
  {
    moveSurface(occluders, 1, { 0.1, -0.3, 0.05 });
    expectUpdate(0, 1);
  }
  expectUpdate(0, 0);

  // The plane is removed: the other surfaces keep their triangles, and move in memory.
  Occluders fewer = makeOccluders({ cube, second });
  for (std::size_t i = 0; i < 2; ++i)
  {
    fewer.surfaces[i].topologyVersion = occluders.surfaces[i + 1].topologyVersion;
  }
  occluders = fewer;
  expectUpdate(0, 2);

  // An edit of one surface, and a change of sides of another.
  occluders.surfaces[0].topologyVersion = occluders.surfaces[0].positionsVersion += 1000;
  occluders.topologyVersion = occluders.positionsVersion += 1000;
  expectUpdate(1, 0);
  occluders.surfaces[1].oneSided = true;
  occluders.topologyVersion += 1000;
  expectUpdate(1, 0);

  // No surface casts any more.
  occluders.surfaces[0].casts = occluders.surfaces[1].casts = false;
  occluders.topologyVersion += 1000;
  expectUpdate(0, 0);
}

TEST(EmbreeTracer, CutoutsComeChangeAndGo)
{
  Prop roof = makePerforatedPlane(2.0, 2, at({ 0.0, 0.0, 1.0 }));
  Occluders occluders = makeOccluders({ { makePlane(6.0) }, roof });
  Surface& surface = occluders.surfaces[1];
  const ReceiverPixels receivers = makeReceivers(occluders, { { 3.0, -5.0, 4.0 } });
  const ShadowLight light = lightsOfSmallScenes()[0];
  EmbreeTracer tracer;
  const auto darkAfter = [&](int builds)
  {
    occluders.topologyVersion += 1000;
    EXPECT_EQ(tracer.update(occluders).builds, builds);
    std::vector<float> visibility;
    tracer.trace(light, occluders, receivers, visibility);
    EXPECT_EQ(visibility, traceBruteForce(light, occluders, receivers));
    return std::count(visibility.begin(), visibility.end(), 0.0f);
  };
  const auto perforated = darkAfter(2);
  CutoutMask mask = *roof.cutout;
  mask.interpolated = false; // the holes grow
  surface.cutout = std::make_shared<const CutoutMask>(mask);
  EXPECT_LT(darkAfter(0), perforated);
  surface.oneSided = true; // its front faces the light
  EXPECT_LT(darkAfter(1), perforated);
  surface.cutout = nullptr;
  EXPECT_GT(darkAfter(1), perforated);
  surface.oneSided = false;
  surface.cutout = roof.cutout;
  EXPECT_EQ(darkAfter(1), perforated);
}

// Embree's triangles ignore such casters, and its builder ends the process.
TEST(EmbreeRange, RejectsCastersBeyondIt)
{
  for (const double far : { 1.0, 1e18, 4e18, 1e25, 1e30 })
  {
    SCOPED_TRACE(far);
    const Occluders scene = makeOccluders({ { makePlane(far) } });
    const std::vector<BvhRecord> records(6);
    const auto box = [far](const BvhRecord&) {
      return Bounds{ glm::dvec3(-1.0), glm::dvec3(far) };
    };
    EmbreeTracer tracer;
    if (far < 1.8e18)
    {
      EXPECT_NO_THROW(tracer.update(scene));
      EXPECT_NO_THROW(buildBvh(records, box));
      continue;
    }
    EXPECT_THROW(tracer.update(scene), std::runtime_error);
    EXPECT_THROW(buildBvh(records, box), std::runtime_error);
  }
}

// Where a texture has alpha: known answers, and a twin that sums weights.

CutoutMask makeMask(TextureWrap wrap, bool interpolated)
{
  CutoutMask mask;
  mask.width = 4;
  mask.height = 3;
  mask.texels = { 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0 };
  mask.wrap = wrap;
  mask.interpolated = interpolated;
  return mask;
}

/// Return the texel of a wrapped index (OpenGL 4.5, table 8.20); negative for the border.
int wrapped(int i, int size, TextureWrap wrap)
{
  const auto modulo = [](int a, int b) { return ((a % b) + b) % b; };
  switch (wrap)
  {
    case TextureWrap::ClampToEdge:
      return i < 0 ? 0 : i >= size ? size - 1 : i;
    case TextureWrap::ClampToBorder:
      return i < 0 || i >= size ? -1 : i;
    case TextureWrap::MirroredRepeat:
    {
      const int a = modulo(i, 2 * size) - size;
      return size - 1 - (a >= 0 ? a : -(1 + a));
    }
    case TextureWrap::Repeat:
      break;
  }
  return modulo(i, size);
}

/// Return the filtered alpha (OpenGL 4.5, 8.14.2).
double alphaAt(const CutoutMask& mask, const glm::dvec2& coordinates)
{
  const auto texel = [&](int x, int y)
  {
    const int i = wrapped(x, mask.width, mask.wrap);
    const int j = wrapped(y, mask.height, mask.wrap);
    return i < 0 || j < 0 ? (mask.borderDrawn ? 1.0 : 0.0)
                          : mask.texels.at(static_cast<std::size_t>(j * mask.width + i)) / 255.0;
  };
  const glm::dvec2 place = coordinates * glm::dvec2(mask.width, mask.height);
  if (!mask.interpolated)
  {
    return texel(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
  }
  const glm::dvec2 first = glm::floor(place - 0.5);
  const glm::dvec2 weight = place - 0.5 - first;
  const int x = static_cast<int>(first.x);
  const int y = static_cast<int>(first.y);
  return (1.0 - weight.x) * (1.0 - weight.y) * texel(x, y) +
    weight.x * (1.0 - weight.y) * texel(x + 1, y) + (1.0 - weight.x) * weight.y * texel(x, y + 1) +
    weight.x * weight.y * texel(x + 1, y + 1);
}

constexpr TextureWrap allWraps[] = { TextureWrap::ClampToEdge, TextureWrap::Repeat,
  TextureWrap::MirroredRepeat, TextureWrap::ClampToBorder };

TEST(CutoutMask, AgreesWithTheFilteredAlpha)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-2.0f, 3.0f);
  for (const TextureWrap wrap : allWraps)
  {
    for (const bool interpolated : { false, true })
    {
      for (const bool borderDrawn : { false, true })
      {
        CutoutMask mask = makeMask(wrap, interpolated);
        mask.borderDrawn = borderDrawn;
        int drawn = 0;
        for (int i = 0; i < 20000; ++i)
        {
          const glm::vec2 coordinates(anywhere(random), anywhere(random));
          const bool expected = alphaAt(mask, coordinates) > 0.0;
          drawn += expected ? 1 : 0;
          EXPECT_EQ(mask.isDrawn(coordinates), expected) << coordinates.x << " " << coordinates.y;
        }
        EXPECT_GT(drawn, 100);
        EXPECT_LT(drawn, 19900);
      }
    }
  }
}

TEST(CutoutMask, AnyCoordinatesHaveAnAnswer)
{
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr float large = std::numeric_limits<float>::max();
  constexpr float tiny = std::numeric_limits<float>::denorm_min();
  for (const TextureWrap wrap : allWraps)
  {
    for (const bool interpolated : { false, true })
    {
      const CutoutMask mask = makeMask(wrap, interpolated);
      for (const float x : { infinite, -infinite, large, -large, tiny, -tiny, 0.0f, 1.0f, -1.0f,
             std::nextafter(1.0f, 0.0f), std::numeric_limits<float>::quiet_NaN() })
      {
        for (const float y : { 0.5f, x })
        {
          mask.isDrawn({ x, y });
          mask.isDrawn({ y, x });
        }
      }
    }
  }
  // A border extends without end.
  CutoutMask mask = makeMask(TextureWrap::ClampToBorder, true);
  EXPECT_FALSE(mask.isDrawn({ large, 0.0f }));
  EXPECT_FALSE(mask.isDrawn({ 0.5f, -infinite }));
  mask.borderDrawn = true;
  EXPECT_TRUE(mask.isDrawn({ large, 0.0f }));
  EXPECT_TRUE(mask.isDrawn({ 0.5f, -infinite }));
}

} // namespace
} // namespace gnomon::test
