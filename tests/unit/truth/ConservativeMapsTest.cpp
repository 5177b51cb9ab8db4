// Conservative maps against ray tracing: what they say for certain is never wrong.

#include "shadowtech/conservative/ConservativeMaps.h"

#include "RandomScenes.h"

#include "lights/ShadowSettings.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <string>

namespace gnomon::test
{
namespace
{

/// What a run found.
struct Tally
{
  std::size_t receivers = 0; ///< that get a shadow ray
  std::size_t traced = 0;
  std::size_t leftOut = 0; ///< decided before they were made
  std::size_t wrong = 0;
};

/// How a map and a full trace differ.
Tally compareWithTruth(const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const Receivers& receivers, Covering covering = Covering::Silhouette)
{
  ConservativeMaps maps;
  maps.bake(light, views, occluders, certainRule(covering));
  EmbreeTracer tracer;
  tracer.update(occluders);
  Tally tally;
  std::vector<float> truth, visibility;
  tally.receivers = tracer.trace(light, occluders, receivers, truth);
  tally.traced = tracer.trace(light, occluders, receivers, visibility, &maps);
  tally.wrong = countDifferent(truth, visibility);
  std::atomic<std::size_t> leftOut{ 0 };
  receivers.visitTiles(
    [&](const ReceiverTile& tile)
    {
      leftOut += static_cast<std::size_t>(std::count_if(
        tile.known.begin(), tile.known.end(), [](Certainty known) { return isDecided(known); }));
    },
    &maps);
  tally.leftOut = leftOut;
  return tally;
}

/// One picture of one scene in one light, by maps of one size.
Tally run(const std::string& name, unsigned int seed, Covering covering,
  const glm::dmat4& world = glm::dmat4(1.0))
{
  const RandomPicture picture = makeRandomPicture(name, seed, world);
  const ShadowLight& light = picture.light;
  // Not yet made, so that maps are asked about triangles and lines, too.
  ReceiverPixels stored;
  const Receivers receivers(
    picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
  const Tally tally =
    compareWithTruth(light, picture.views, picture.occluders, receivers, covering);
  if (tally.wrong > 0)
  {
    ADD_FAILURE() << tally.wrong << " wrong pixels of " << picture.description;
  }
  return tally;
}

class ConservativeMapsIn : public testing::TestWithParam<std::tuple<const char*, Covering>>
{
};

TEST_P(ConservativeMapsIn, areNeverWrong)
{
  const auto& [name, covering] = GetParam();
  Tally sum;
  for (unsigned int seed = 1; seed <= exactRuns(); ++seed)
  {
    const Tally tally = run(name, seed, covering);
    sum.receivers += tally.receivers;
    sum.traced += tally.traced;
    sum.wrong += tally.wrong;
    sum.leftOut += tally.leftOut;
  }
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_GT(sum.leftOut, sum.receivers / 20) << "triangles and lines are asked about";
  EXPECT_GT(sum.receivers, exactRuns() * 300u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4); // it does decide something
  std::cout << name << ": left out " << sum.leftOut << ", traced "
            << 100.0 * static_cast<double>(sum.traced) / static_cast<double>(sum.receivers)
            << " % of " << sum.receivers << std::endl;
}

std::string nameOfRun(const testing::TestParamInfo<ConservativeMapsIn::ParamType>& run)
{
  const char* const coverings[] = { "Triangle", "Ring", "Fan", "Silhouette" };
  return lettersOf(std::get<0>(run.param)) + coverings[static_cast<int>(std::get<1>(run.param))];
}

INSTANTIATE_TEST_SUITE_P(Scenes, ConservativeMapsIn,
  testing::Combine(testing::ValuesIn(randomSceneNames()),
    testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan, Covering::Silhouette)),
  nameOfRun);

TEST(ConservativeMaps, areNeverWrongFarAwayAndAtAnyScale)
{
  const glm::dmat4 worlds[] = { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
    at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) };
  for (const glm::dmat4& world : worlds)
  {
    for (const char* name : randomSceneNames())
    {
      for (unsigned int seed = 100; seed < 100 + exactRuns() / 4; ++seed)
      {
        EXPECT_EQ(run(name, seed, Covering::Silhouette, world).wrong, 0u);
      }
    }
  }
}

/// Receivers that are put where a test wants them.
struct ChosenReceivers
{
  ReceiverPixels pixels;

  /// @param surface that they count as points of
  explicit ChosenReceivers(int count, std::uint32_t surface)
  {
    this->pixels.resize(count, 1);
    std::fill(this->pixels.surface.begin(), this->pixels.surface.end(), surface);
  }
  void set(std::size_t i, const glm::dvec3& centred, const glm::dvec3& normal, float offset)
  {
    this->pixels.positionX[i] = static_cast<float>(centred.x);
    this->pixels.positionY[i] = static_cast<float>(centred.y);
    this->pixels.positionZ[i] = static_cast<float>(centred.z);
    this->pixels.normalX[i] = static_cast<float>(normal.x);
    this->pixels.normalY[i] = static_cast<float>(normal.y);
    this->pixels.normalZ[i] = static_cast<float>(normal.z);
    this->pixels.offset[i] = offset;
  }
};

/// Its sides are one surface, or two that meet in a seam.
class Valley : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(ConservativeMaps, Valley, testing::Bool(),
  [](const testing::TestParamInfo<bool>& sides) { return sides.param ? "seam" : "edge"; });

TEST_P(Valley, isNeverWrongInItsBottom)
{
  // Both sides face the light, and rays from one start behind the other near the bottom.
  for (const double steepness : { 0.5, 1.0, 3.0 })
  {
    const double side = 2.0;
    Mesh valley;
    for (const double y : { -1.0, 1.0 })
    {
      valley.points.emplace_back(-side, y, steepness * side);
      valley.points.emplace_back(0.0, y, 0.0);
      valley.points.emplace_back(side, y, steepness * side);
    }
    valley.triangles = { { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 } };
    std::vector<Prop> props{ { valley } };
    if (this->GetParam())
    {
      props.push_back({ valley });
      props[0].mesh.triangles.resize(2);
      props[1].mesh.triangles.erase(
        props[1].mesh.triangles.begin(), props[1].mesh.triangles.begin() + 2);
    }
    const Occluders occluders = makeOccluders(props);
    ShadowLight light = directionalLight({ 0.05, 0.02, -1.0 });
    light.mapSizeTexels = 32;
    constexpr int count = 4000;
    ChosenReceivers chosen(count, 0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(steepness, 0.0, 1.0));
    for (int i = 0; i < count; ++i)
    {
      const double x = -std::pow(10.0, -8.0 + 8.0 * i / count);
      const double y = -0.9 + 1.8 * std::fmod(0.618 * i, 1.0);
      chosen.set(static_cast<std::size_t>(i),
        glm::dvec3(x, y, -steepness * x) - occluders.centreWorld, normal, 3e-5f);
    }
    const Tally tally = compareWithTruth(light,
      fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
      occluders, chosen.pixels);
    EXPECT_EQ(tally.wrong, 0u) << steepness;
    EXPECT_LT(tally.traced, tally.receivers) << steepness;
  }
}

TEST(ConservativeMaps, areNeverWrongWhereEdgesLieOnTexelsBorders)
{
  // A row of plates whose edges lie exactly between texels, high above receivers that lie there, too. The
  // light's direction is rounded for shadow rays, which counts over the distance.
  ShadowLight light = directionalLight({ 0.3, -0.2, -1.0 });
  light.mapSizeTexels = 64;
  const std::vector<Prop> corners{ { makeBox(glm::dvec3(-500.0), glm::dvec3(-499.0)) },
    { makeBox(glm::dvec3(499.0), glm::dvec3(500.0)) } };
  const Occluders frame = makeOccluders(corners);
  const LightViews views =
    fitLightViews(light, frame.centreWorld, frame.castersCentred, light.mapSizeTexels);
  const LightView& view = views.views.front();
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, light.mapSizeTexels));
  const auto centred = [&](double texelX, double texelY, double z)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, { texelX, texelY });
    return glm::dvec3(centredFromView * glm::dvec4(across, z, 1.0));
  };
  // The middle of the box as seen by the light.
  const double middle = (view.rays.viewFromCentred * glm::dvec4(0.0, 0.0, 0.0, 1.0)).z;
  Mesh plates;
  for (int x = 24; x < 40; x += 8)
  {
    const auto first = static_cast<unsigned int>(plates.points.size());
    for (const auto& [cornerX, cornerY] :
      { std::pair(x, 24), { x + 4, 24 }, { x + 4, 40 }, { x, 40 } })
    {
      plates.points.push_back(centred(cornerX, cornerY, middle - 300.0) + frame.centreWorld);
    }
    plates.triangles.emplace_back(first, first + 1, first + 2);
    plates.triangles.emplace_back(first, first + 2, first + 3);
  }
  // What receives is no caster, so that it may be anywhere.
  const Prop receiver{ makePlane(1.0), glm::dmat4(1.0), false };
  const Occluders occluders = makeOccluders({ corners[0], corners[1], { plates }, receiver });
  ASSERT_EQ(occluders.castersCentred.upper, frame.castersCentred.upper);
  constexpr int count = 20000;
  ChosenReceivers chosen(count, 3);
  Random random(5);
  for (int i = 0; i < count; ++i)
  {
    const double beside = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -8.0, -0.4));
    chosen.set(static_cast<std::size_t>(i),
      centred(24.0 + static_cast<double>(random() % 16) + beside, uniform(random, 25.0, 39.0),
        middle + 300.0),
      -light.directionWorld, 1e-4f);
  }
  const Tally tally = compareWithTruth(light, views, occluders, chosen.pixels);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_LT(tally.traced, tally.receivers);
}

TEST(ConservativeMaps, areNeverWrongWhereCastersTouchTheLight)
{
  // A lamp that lies in the ceiling, and a box of light that begins in a plate, where rays end to within rounding.
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.3, { 1.0, 0.5, 0.2 });
  for (const glm::dmat4& world : { glm::dmat4(1.0), turn })
  {
    const glm::dvec3 lamp(world * glm::dvec4(0.31, 0.12, 2.0, 1.0));
    const glm::dvec3 floor(world * glm::dvec4(0.3, 0.1, 0.0, 1.0));
    const Occluders occluders =
      makeOccluders({ { makePlane(4.0), world }, { makePlane(3.0), world * at({ 0.0, 0.0, 2.0 }) },
        { makeSphere(8, 12), world * at({ 0.4, 0.3, 0.7 }, 0.3) } });
    Camera camera;
    camera.width = camera.height = 96;
    camera.position = glm::dvec3(world * glm::dvec4(0.5, -5.0, 1.5, 1.0));
    camera.target = floor;
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    std::vector<ShadowLight> lights{ pointLight(lamp), spotLight(lamp, floor, 30.0),
      spotLight(lamp, floor, 75.0) };
    for (const double before : { 0.0, 1e-8, 3e-8, 1e-7 })
    {
      // Along the plate's normal, so that its near face lies in the plate all over.
      const glm::dvec3 normal(world * glm::dvec4(0.0, 0.0, -1.0, 0.0));
      lights.push_back(boxLight(normal, lamp - before * normal, { 2.0, 2.0, 3.0 }));
      lights.back().box->upWorld = glm::dvec3(world * glm::dvec4(0.0, 1.0, 0.0, 0.0));
    }
    for (ShadowLight light : lights)
    {
      light.mapSizeTexels = 128;
      const Tally tally = compareWithTruth(light,
        fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
        occluders, receivers);
      EXPECT_GT(tally.receivers, 500u);
      EXPECT_EQ(tally.wrong, 0u) << static_cast<int>(light.kind) << " " << light.coneAngleDegrees;
    }
  }
}

} // namespace
} // namespace gnomon::test
