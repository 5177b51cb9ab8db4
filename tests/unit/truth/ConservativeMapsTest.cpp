// Conservative maps against ray tracing: what they say for certain is never wrong.

#include "shadowtech/exact/ConservativeMaps.h"

#include "ExactRecord.h"
#include "RandomScenes.h"

#include "lights/ShadowSettings.h"
#include "shadowtech/exact/CellsOnGpu.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include "vtkGnomonEGLRenderWindow.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// What runs found.
struct Tally : Compared
{
  std::size_t leftOut = 0; ///< decided before they were made

  void add(const Tally& other)
  {
    Compared::add(other);
    this->leftOut += other.leftOut;
  }
};

/// How a map and a full trace differ.
Tally compareWithTruth(const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const Receivers& receivers,
  const MapRule& rule = certainRule(Covering::Silhouette))
{
  ConservativeMaps maps;
  maps.bake(light, views, occluders, rule);
  EmbreeTracer tracer;
  tracer.update(occluders);
  Tally tally;
  tally.pictures = 1;
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
Tally run(const std::string& name, unsigned int seed, const MapRule& rule,
  const glm::dmat4& world = glm::dmat4(1.0))
{
  const RandomPicture picture = makeRandomPicture(name, seed, world);
  const ShadowLight& light = picture.light;
  // Not yet made, so that maps are asked about triangles and lines, too.
  ReceiverPixels stored;
  const Receivers receivers(
    picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
  const Tally tally = compareWithTruth(light, picture.views, picture.occluders, receivers, rule);
  if (tally.wrong > 0)
  {
    ADD_FAILURE() << tally.wrong << " wrong pixels of " << picture.description;
  }
  return tally;
}

/// By which name and settings a map's rule is known.
std::string techniqueOf(Covering covering)
{
  const char* const techniques[] = { "crsm", "crsma", "crsma, adjacency_ring=vertices",
    "silhouette" };
  return techniques[static_cast<int>(covering)];
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
    sum.add(run(name, seed, certainRule(covering)));
  }
  recordCompared(techniqueOf(covering), name, sum);
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_GT(sum.leftOut, sum.receivers / 20) << "triangles and lines are asked about";
  EXPECT_GT(sum.receivers, exactRuns() * 300u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4); // it does decide something
  std::cout << name << ": left out " << sum.leftOut << ", traced "
            << 100.0 * static_cast<double>(sum.traced) / static_cast<double>(sum.receivers)
            << " % of " << sum.receivers << std::endl;
}

/// The same maps with one of their two answers alone: what they call lit, or what they call in
/// shadow.
MapRule onlyOf(Certainty answer, const MapRule& rule)
{
  return [answer, rule](const LightView& view, bool hasBox, int sizeTexels,
           const Occluders& occluders, const CasterEdges& edges)
  {
    constexpr float never = std::numeric_limits<float>::infinity();
    const ConservativeMap both = rule(view, hasBox, sizeTexels, occluders, edges);
    std::vector<TexelBounds> texels = both.texels();
    for (TexelBounds& texel : texels)
    {
      if (answer == Certainty::Lit)
      {
        texel.shadowFrom = never;
      }
      else
      {
        texel.litUpTo = texel.litUpToOnCasters = -never;
      }
    }
    return ConservativeMap(view, hasBox, both.lookUp(), std::move(texels));
  };
}

/// What maps make of each pixel of a picture.
std::vector<std::uint8_t> classesOf(const RandomPicture& picture, const MapRule& rule)
{
  ConservativeMaps maps;
  maps.bake(picture.light, picture.views, picture.occluders, rule);
  EmbreeTracer tracer;
  tracer.update(picture.occluders);
  ReceiverPixels stored;
  const Receivers receivers(
    picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
  std::vector<float> visibility;
  std::vector<std::uint8_t> classes;
  tracer.trace(picture.light, picture.occluders, receivers, visibility, &maps, &classes);
  return classes;
}

class ConservativeMapsBy : public testing::TestWithParam<Covering>
{
};

TEST_P(ConservativeMapsBy, neverCallAReceiverBothLitAndInShadow)
{
  // Each answer is asked for by itself: a map that says lit does not look whether it would say
  // shadow, too.
  const MapRule rule = certainRule(GetParam());
  std::size_t both = 0, lit = 0, shadow = 0, other = 0;
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 1; seed <= std::max(exactRuns() / 12, 1u); ++seed)
    {
      const RandomPicture picture = makeRandomPicture(name, seed);
      const std::vector<std::uint8_t> classes = classesOf(picture, rule);
      const std::vector<std::uint8_t> byLight = classesOf(picture, onlyOf(Certainty::Lit, rule));
      const std::vector<std::uint8_t> byShadow =
        classesOf(picture, onlyOf(Certainty::Shadow, rule));
      for (std::size_t i = 0; i < classes.size(); ++i)
      {
        const bool isLit = static_cast<TracedClass>(byLight[i]) == TracedClass::Lit;
        const bool isShadow = static_cast<TracedClass>(byShadow[i]) == TracedClass::Shadow;
        lit += isLit ? 1 : 0;
        shadow += isShadow ? 1 : 0;
        both += isLit && isShadow ? 1 : 0;
        // And both together say what the maps say.
        const std::uint8_t expected = isLit ? byLight[i] : byShadow[i];
        other += classes[i] != expected ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(both, 0u);
  EXPECT_EQ(other, 0u);
  EXPECT_GT(lit, 10000u);
  EXPECT_GT(shadow, 10000u);
}

std::string nameOfCovering(Covering covering)
{
  const char* const coverings[] = { "Triangle", "Ring", "Fan", "Silhouette" };
  return coverings[static_cast<int>(covering)];
}

std::string nameOfRun(const testing::TestParamInfo<ConservativeMapsIn::ParamType>& run)
{
  return lettersOf(std::get<0>(run.param)) + nameOfCovering(std::get<1>(run.param));
}

INSTANTIATE_TEST_SUITE_P(Rules, ConservativeMapsBy,
  testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan, Covering::Silhouette),
  [](const testing::TestParamInfo<Covering>& rule) { return nameOfCovering(rule.param); });

INSTANTIATE_TEST_SUITE_P(Scenes, ConservativeMapsIn,
  testing::Combine(testing::ValuesIn(randomSceneNames()),
    testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan, Covering::Silhouette)),
  nameOfRun);

/// Drawn on the GPU, by what covers texels.
class ConservativeMapsOnGpu : public testing::TestWithParam<Covering>
{
};

TEST_P(ConservativeMapsOnGpu, areNeverWrong)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();
  ASSERT_EQ(CellTarget::whyUnsupported(), "");
  ShaderLibrary shaders;
  const CellsOnGpu gpu(shaders);
  Tally sum;
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 200; seed < 200 + std::max(exactRuns() / 4, 1u); ++seed)
    {
      sum.add(run(name, seed, certainRule(GetParam(), &gpu)));
    }
  }
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4);
  recordCompared(techniqueOf(GetParam()) + ", maps drawn on the GPU", "all", sum);
}

INSTANTIATE_TEST_SUITE_P(Rules, ConservativeMapsOnGpu,
  testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan),
  [](const testing::TestParamInfo<Covering>& rule) { return nameOfCovering(rule.param); });

class ConservativeMapsAnywhere : public testing::TestWithParam<Covering>
{
};

TEST_P(ConservativeMapsAnywhere, areNeverWrongFarAwayAndAtAnyScale)
{
  const glm::dmat4 worlds[] = { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
    at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) };
  Tally sum;
  for (const glm::dmat4& world : worlds)
  {
    for (const char* name : randomSceneNames())
    {
      for (unsigned int seed = 100; seed < 100 + std::max(exactRuns() / 4, 1u); ++seed)
      {
        sum.add(run(name, seed, certainRule(GetParam()), world));
      }
    }
  }
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4);
  recordCompared(techniqueOf(GetParam()), "all, far away or at other scales", sum);
}

INSTANTIATE_TEST_SUITE_P(Rules, ConservativeMapsAnywhere,
  testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan, Covering::Silhouette),
  [](const testing::TestParamInfo<Covering>& rule) { return nameOfCovering(rule.param); });

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

Mesh oneTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  Mesh mesh;
  for (const glm::dvec3& corner : { a, b, c })
  {
    mesh.points.push_back(corner);
  }
  mesh.triangles.emplace_back(0, 1, 2);
  return mesh;
}

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

TEST_P(Valley, isNeverWrongWhereManySidesMeetInACorner)
{
  // Two steep sides, and two thin wedges between them that are less steep: each is flat enough
  // against its neighbours, but the steep sides are not against each other, and meet in the corner.
  for (const double halfWedge : { 0.01, 0.03, 0.1 })
  {
    const double steep = std::tan(glm::radians(55.0));
    const double mild = std::tan(glm::radians(18.0));
    const double x = 2.0 * std::cos(halfWedge);
    const double y = 2.0 * std::sin(halfWedge);
    const double border = y * steep;
    const double bottom = y * (steep - mild);
    Mesh near;
    near.points = { { 0.0, 0.0, 0.0 }, { 0.0, -2.0, 2.0 * steep }, { x, -y, border },
      { 2.0, 0.0, bottom }, { x, y, border }, { 0.0, 2.0, 2.0 * steep }, { -x, y, border },
      { -2.0, 0.0, bottom }, { -x, -y, border } };
    Mesh far = near;
    near.triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 7, 8 }, { 0, 8, 1 } };
    far.triangles = { { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 }, { 0, 6, 7 } };
    std::vector<Prop> props{ { near }, { far } };
    if (!this->GetParam())
    {
      props[0].mesh.triangles.insert(
        props[0].mesh.triangles.end(), far.triangles.begin(), far.triangles.end());
      props.pop_back();
    }
    const Occluders occluders = makeOccluders(props);
    ShadowLight light = directionalLight({ 0.03, 0.02, -1.0 });
    light.mapSizeTexels = 33;
    constexpr std::size_t count = 6000;
    ChosenReceivers chosen(count, 0);
    Random random(3);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.0, steep, 1.0));
    for (std::size_t i = 0; i < count; ++i)
    {
      // On the near steep side, close to a wedge and the corner.
      const double along = std::pow(10.0, uniform(random, -6.0, -0.5));
      const double below =
        along * std::tan(halfWedge) * (1.0 + std::pow(10.0, uniform(random, -4.0, 0.5)));
      const glm::dvec3 at(random() % 2 ? along : -along, -below, steep * below);
      chosen.set(i, at - occluders.centreWorld, normal, 3e-4f);
    }
    const Tally tally = compareWithTruth(light,
      fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
      occluders, chosen.pixels);
    EXPECT_EQ(tally.wrong, 0u) << halfWedge;
    EXPECT_GT(tally.receivers, count / 2) << halfWedge;
  }
}

TEST(ConservativeMaps, knowNothingOfLinesWhoseRaysMayStartAboveASheet)
{
  const double height = 1e-3;
  const Occluders occluders =
    makeOccluders({ { makePlane(8.0) }, { makePlane(7.0), at({ 0.0, 0.0, height }) } });
  ShadowLight light = directionalLight({ 0.0, 0.0, -1.0 });
  light.mapSizeTexels = 16;
  ConservativeMaps maps;
  maps.bake(light,
    fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
    occluders, certainRule(Covering::Silhouette));
  const auto known = [&](float mostOffset)
  {
    const ReceiverSegment line{ glm::dvec3(-1.3, 0.2, 0.0) - occluders.centreWorld,
      glm::dvec3(1.2, 0.9, 0.0) - occluders.centreWorld, 1e-6f, mostOffset, 0 };
    return maps.ofSegment(line);
  };
  EXPECT_EQ(known(1e-5f), Certainty::Shadow);
  EXPECT_EQ(known(static_cast<float>(0.9 * height)), Certainty::Shadow);
  EXPECT_EQ(known(static_cast<float>(1.01 * height)), Certainty::Uncertain);
}

TEST(ConservativeMaps, areNeverWrongWhereEdgesLieOnTexelsBorders)
{
  // A row of plates whose edges lie exactly between texels, high above receivers that lie there,
  // too. The light's direction is rounded for shadow rays, which counts over the distance.
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

TEST_P(ConservativeMapsBy, areNeverWrongWhereDepthHardlyChangesFarFromALamp)
{
  // Depth runs as -1 / z from where the map begins, at the lamp if that is among the casters:
  // farther off it hardly changes. What is far away moves the origin off, so that what is computed
  // from places is rounded by more than that. Small plates have their ends all over the floor, so
  // that little but its own triangle says anything of it.
  const MapRule rule = certainRule(GetParam());
  Random random(4);
  Tally sum, seen;
  for (int i = 0; i < 16; ++i)
  {
    const glm::dvec3 lamp(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), 1.0);
    ShadowLight light = pointLight(lamp);
    light.mapSizeTexels = 32;
    Mesh plates;
    for (unsigned int k = 0; k < 3 * 400; k += 3)
    {
      const glm::dvec3 corner(
        uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.01, 0.1));
      plates.points.push_back(corner);
      plates.points.push_back(corner + glm::dvec3(0.01, 0.0, 0.0));
      plates.points.push_back(corner + glm::dvec3(0.0, 0.01, 0.0));
      plates.triangles.emplace_back(k, k + 1, k + 2);
    }
    const glm::dvec3 away = 300.0 * glm::abs(unitVector(random));
    const Occluders occluders =
      makeOccluders({ { makePlane(6.0) }, { plates }, { makeBox(away - 1.0, away + 1.0) } });
    constexpr int count = 4000;
    ChosenReceivers chosen(count, 0);
    for (std::size_t k = 0; k < count; ++k)
    {
      const glm::dvec3 place(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
      chosen.set(k, place - occluders.centreWorld, { 0.0, 0.0, 1.0 }, 4e-6f);
    }
    const LightViews views =
      fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels);
    const Tally tally = compareWithTruth(light, views, occluders, chosen.pixels, rule);
    EXPECT_EQ(tally.wrong, 0u) << i;
    sum.add(tally);

    // And by triangles and lines, as a camera above the floor sees it.
    Camera camera;
    camera.width = camera.height = 96;
    camera.position = { uniform(random, -1.0, 1.0), -3.0, 2.0 };
    const View view = makeView(occluders, camera);
    ReceiverPixels stored;
    const Tally picture = compareWithTruth(
      light, views, occluders, Receivers(view.images, view.drawnSurfaces, occluders, stored), rule);
    EXPECT_EQ(picture.wrong, 0u) << i;
    seen.add(picture);
  }
  EXPECT_LT(sum.traced, sum.receivers);
  EXPECT_GT(seen.leftOut, 0u) << "triangles and lines are asked about";
}

TEST(ConservativeMaps, areNeverWrongWhereCastersTouchTheLight)
{
  // A lamp that lies in the ceiling, and a box of light that begins in a plate, where rays end to
  // within rounding.
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

/// All pixels of a picture show the first triangle, as if they were pieces of it, wherever their
/// rays pass.
View viewOfFirstTriangle(const Occluders& occluders, const Camera& camera)
{
  View view = makeView(occluders, camera);
  std::fill(view.images.fragments.begin(), view.images.fragments.end(), glm::vec2(1.0f, 0.0f));
  return view;
}

Tally compareWithTruth(const ShadowLight& light, const Occluders& occluders, const View& view,
  const MapRule& rule = certainRule(Covering::Silhouette))
{
  ReceiverPixels stored;
  return compareWithTruth(light,
    fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
    occluders, Receivers(view.images, view.drawnSurfaces, occluders, stored), rule);
}

/// Triangles in a ring around a place, whose planes nearly pass through it.
Mesh makeRingOfTriangles(const glm::dvec3& place, Random& random)
{
  Mesh ring;
  for (int i = 0; i < 400; ++i)
  {
    const double angle = uniform(random, 0.0, 6.283185307179586);
    const double radius = uniform(random, 0.3, 0.7);
    const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
    const auto first = static_cast<unsigned int>(ring.points.size());
    for (const glm::dvec2& corner :
      { glm::dvec2(0.0, 0.0), glm::dvec2(0.1, -0.05), glm::dvec2(0.1, 0.05) })
    {
      const glm::dvec2 across =
        (radius + corner.x) * outwards + corner.y * glm::dvec2(-outwards.y, outwards.x);
      ring.points.push_back(place + glm::dvec3(across, uniform(random, -1e-4, 1e-4)));
    }
    ring.triangles.emplace_back(first, first + 1, first + 2);
  }
  return ring;
}

TEST(ConservativeMaps, areNeverWrongAboutTrianglesThatALampIsBeside)
{
  // Far from the origin, so that it is rounding that says on which side of a triangle's plane the
  // lamp is. Maps say how much that is, where there are any: not without casters, or where none of
  // them is in the cone.
  Random random(7);
  Camera camera;
  camera.width = camera.height = 128;
  camera.up = { 0.0, 1.0, 0.0 };
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 lamp = 1000.0 +
      glm::dvec3(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    const Prop ring{ makeRingOfTriangles(lamp, random), glm::dmat4(1.0), false };
    const Prop opposite{ makeBox(-lamp - 1.0, -lamp), glm::dmat4(1.0), false };
    const Prop behind{ makeBox(
      lamp - glm::dvec3(4.0, 1.0, 1.0), lamp - glm::dvec3(3.0, 0.0, 0.0)) };
    const ShadowLight point = pointLight(lamp);
    const ShadowLight spot = spotLight(lamp, lamp + glm::dvec3(1.0, 0.0, 0.0), 50.0);
    const std::pair<ShadowLight, std::vector<Prop>> cases[] = { { point, { ring, opposite } },
      { spot, { ring, opposite, behind } }, { point, { ring, opposite, behind } } };
    camera.target = lamp;
    for (auto [light, props] : cases)
    {
      light.mapSizeTexels = 64;
      const Occluders occluders = makeOccluders(props);
      for (const double height : { -2.0, 2.0 })
      {
        camera.position = lamp + glm::dvec3(0.0, 0.0, height);
        const Tally tally = compareWithTruth(light, occluders, makeView(occluders, camera));
        EXPECT_EQ(tally.wrong, 0u) << i << ", light " << static_cast<int>(light.kind) << ", props "
                                   << props.size() << ", " << height;
      }
    }
  }
}

TEST(ConservativeMaps, areNeverWrongOfPixelsWhoseRaysStartAboveASheet)
{
  // The larger the pixel, the farther off a triangle's edge does its ray start: above the sheet
  // over it, at last.
  const Mesh triangle = oneTriangle({ -0.2, -0.2, 0.0 }, { 2.2, -0.1, 0.0 }, { -0.1, 0.2, 0.0 });
  constexpr int size = 16;
  constexpr double side = 8.0;
  constexpr double texel = side / size;
  ShadowLight light = directionalLight({ 0.0, 0.0, -1.0 });
  light.mapSizeTexels = size;
  std::vector<Camera> cameras(3);
  cameras[0].position = { 0.3, 0.1, 2.0 };
  cameras[0].target = { 0.3, 0.1, 0.0 };
  cameras[0].up = { 0.0, 1.0, 0.0 };
  cameras[0].fovDegrees = 120.0;
  cameras[1].position = { -0.8, 0.1, 0.5 };
  cameras[1].target = { 2.0, 0.0, 0.0 };
  cameras[1].fovDegrees = 60.0;
  cameras[2] = cameras[0];
  cameras[2].parallelHeight = 4.0;
  Tally sum;
  for (const double texels : { 0.3, 0.5, 0.7, 1.1, 1.25, 1.5, 2.0, 4.0 })
  {
    // No ray may start farther beside its receiver than 1/256 of a texel; seen from above, it
    // starts so far up.
    const Occluders occluders = makeOccluders(
      { { triangle }, { makePlane(side, 4), at({ 0.0, 0.0, texels * texel / 256.0 }) } });
    for (Camera camera : cameras)
    {
      for (int pixels = 3; pixels < 40; ++pixels)
      {
        camera.width = camera.height = pixels;
        const Tally tally =
          compareWithTruth(light, occluders, viewOfFirstTriangle(occluders, camera));
        EXPECT_EQ(tally.wrong, 0u) << texels << ", " << pixels;
        sum.add(tally);
      }
    }
  }
  EXPECT_GT(sum.leftOut, 1000u);
  EXPECT_GT(sum.traced, 1000u);
}

TEST(ConservativeMaps, areNeverWrongOfTrianglesWhoseRoundingIsMoreThanTheSheetAboveIsHigh)
{
  // A long, thin triangle askew, of which only rays that start far off it are safe.
  const glm::dmat4 turn =
    glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(0.6, 0.7, 0.1)));
  const Mesh triangle = oneTriangle({ -0.1, -0.09, 0.0 }, { 0.1, 0.09, 0.0 }, { 0.1, 0.0901, 0.0 });
  ShadowLight light = directionalLight(glm::dvec3(turn * glm::dvec4(0.0, 0.0, -1.0, 0.0)));
  light.mapSizeTexels = 512;
  Camera camera;
  camera.width = camera.height = 64;
  camera.fovDegrees = 1.0;
  camera.position = glm::dvec3(turn * glm::dvec4(0.0, 0.0, 3.0, 1.0));
  camera.target = glm::dvec3(0.0);
  Tally sum;
  for (const double height : { 2e-5, 5e-5, 1e-4, 2e-4, 4e-4, 8e-4, 1.6e-3 })
  {
    const Occluders occluders = makeOccluders(
      { { triangle, turn, false }, { makePlane(3.0), turn * at({ 0.0, 0.0, height }) } });
    const Tally tally = compareWithTruth(light, occluders, viewOfFirstTriangle(occluders, camera));
    EXPECT_EQ(tally.wrong, 0u) << height;
    sum.add(tally);
  }
  EXPECT_GT(sum.receivers, 1000u);
}

TEST(ConservativeMaps, areNeverWrongWhereTrianglesTouchTheConeOrTheBox)
{
  // Far from the origin, with a corner in the cone's or the box's side, so that rounding says
  // whether the light reaches it; or well inside, so that maps decide it.
  const glm::dvec3 lamp(1000.4, 1000.3, 1000.9);
  const Prop opposite{ makeBox(-lamp - 1.0, -lamp), glm::dmat4(1.0), false };
  const Prop ground{ makePlane(320.0), at(lamp - glm::dvec3(0.0, 0.0, 160.0)) };
  Random random(8);
  Tally sum;
  for (int i = 0; i < 400; ++i)
  {
    const bool isSpot = i % 2 == 0;
    ShadowLight light = isSpot ? spotLight(lamp, lamp - glm::dvec3(0.0, 0.0, 1.0), 30.0)
                               : boxLight({ 0.0, 0.0, -1.0 }, lamp, { 80.0, 80.0, 200.0 });
    const double angle = uniform(random, 0.0, 6.283185307179586);
    const glm::dvec3 outwards(std::cos(angle), std::sin(angle), 0.0);
    const glm::dvec3 beside(-outwards.y, outwards.x, 0.0);
    if (light.box)
    {
      light.box->upWorld = beside;
    }
    light.mapSizeTexels = 8;
    const double side = isSpot ? 80.0 * std::tan(glm::radians(30.0)) : 40.0;
    const double from = uniform(random, -20.0, 20.0);
    const auto below = [&](double out, double across, double down)
    { return lamp + out * outwards + (from + across) * beside - glm::dvec3(0.0, 0.0, down); };
    // Maps know nothing of what is nearer to a lamp than all casters.
    const glm::dvec3 low = below(-15.0, -from, 41.0);
    const Prop shade{ makeBox(low, low + 1.0) };
    const double inside = i % 4 < 2 ? 1.0 : 0.8;
    const double across = isSpot ? -from : 0.0;
    const Mesh triangle = oneTriangle(
      below(inside * side, across, 80.0), below(5.0, 5.0, 90.0), below(10.0, -5.0, 85.0));
    const Occluders occluders =
      makeOccluders({ { triangle, glm::dmat4(1.0), false }, opposite, ground, shade });
    // Most rays pass the corner by.
    const glm::dvec3 corner = triangle.points[0];
    Camera camera;
    camera.width = camera.height = 32;
    camera.target = corner + 0.003 * (corner - triangle.points[1]);
    camera.position = camera.target + glm::dvec3(0.1, 0.2, 3.0);
    camera.up = { 0.0, 1.0, 0.0 };
    camera.fovDegrees = 4.0;
    const Tally tally = compareWithTruth(light, occluders, viewOfFirstTriangle(occluders, camera));
    EXPECT_EQ(tally.wrong, 0u) << i;
    sum.add(tally);
  }
  EXPECT_GT(sum.leftOut, 100000u);
}

TEST(ConservativeMaps, areNeverWrongOfWhatDoesNotCastOrOnOneSide)
{
  // It is not a layer of the map, so that the nearest one is above it. The plate lies in the middle
  // of the scene, where it has no rounding, as if all rays started far off it.
  const Prop plate{ makePlane(1.5), at({ 0.0, 0.0, 0.5 }) };
  const Prop tower{ makeBox({ 2.0, 2.0, 0.9 }, { 2.5, 2.5, 1.0 }) };
  ShadowLight light = directionalLight({ 0.1, 0.2, -1.0 });
  light.mapSizeTexels = 64;
  Camera camera;
  camera.position = { 0.3, -4.0, 2.0 };
  camera.target = { 0.0, 0.0, 0.0 };
  for (const int cells : { 1, 64 })
  {
    for (const bool casts : { false, true })
    {
      Prop floor{ makePlane(4.0, cells) };
      floor.casts = casts;
      floor.oneSided = casts;
      // Turned over, it casts nothing on the side that is seen.
      floor.worldFromMesh =
        casts ? glm::rotate(glm::dmat4(1.0), 3.14159265358979, { 1.0, 0.0, 0.0 }) : glm::dmat4(1.0);
      const Occluders occluders = makeOccluders({ floor, plate, tower });
      const Tally tally = compareWithTruth(light, occluders, makeView(occluders, camera));
      EXPECT_EQ(tally.wrong, 0u) << cells << (casts ? ", on one side" : "");
      EXPECT_GT(tally.leftOut, 1000u) << cells << (casts ? ", on one side" : "");
    }
  }
}

TEST(ConservativeMaps, areNeverWrongInTheLastTexels)
{
  // Plates that reach over a map's borders, and lines of receivers that end there. Halves of these
  // sides are odd.
  const Bounds seen{ { -1.0, -1.0, -0.5 }, { 1.0, 1.0, 0.5 } };
  ShadowLight light = directionalLight({ 0.0, 0.0, -1.0 });
  Camera camera;
  camera.width = camera.height = 320;
  camera.position = { 0.02, 0.01, 0.4 }; // below the plates
  camera.target = { 0.02, 0.01, 0.0 };
  camera.parallelHeight = 2.4;
  Tally sum;
  for (const int size : { 17, 19, 34, 35, 65, 129 })
  {
    light.mapSizeTexels = size;
    for (const double texels : { -0.3, 0.2, 0.7 })
    {
      const double from = 1.0 - texels * 2.0 / size;
      Mesh plates;
      for (const glm::dvec2& along : { glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0),
             glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, -1.0) })
      {
        const glm::dvec2 across(-along.y, along.x);
        const auto first = static_cast<unsigned int>(plates.points.size());
        for (const glm::dvec2& corner : { glm::dvec2(from, -3.0), glm::dvec2(3.0, -3.0),
               glm::dvec2(3.0, 3.0), glm::dvec2(from, 3.0) })
        {
          plates.points.emplace_back(corner.x * along + corner.y * across, 0.5);
        }
        plates.triangles.emplace_back(first, first + 1, first + 2);
        plates.triangles.emplace_back(first, first + 2, first + 3);
      }
      // Decided by lines of a large triangle, along either axis, and by small triangles.
      for (const auto& [cells, up] : { std::pair(1, glm::dvec3(1.0, 0.0, 0.0)),
             { 1, glm::dvec3(0.0, 1.0, 0.0) }, { 48, glm::dvec3(1.0, 0.0, 0.0) } })
      {
        const Prop floor{ makePlane(6.0, cells), glm::dmat4(1.0), false };
        const Occluders occluders = makeOccluders({ floor, { plates } });
        const LightViews views = fitLightViews(light, occluders.centreWorld, seen, size);
        camera.up = up;
        const View view = makeView(occluders, camera);
        ReceiverPixels stored;
        const Tally tally = compareWithTruth(
          light, views, occluders, Receivers(view.images, view.drawnSurfaces, occluders, stored));
        EXPECT_EQ(tally.wrong, 0u) << "map " << size << ", " << texels;
        sum.add(tally);
      }
    }
  }
  EXPECT_GT(sum.leftOut, sum.receivers / 2);
}

TEST_P(ConservativeMapsBy, areNeverWrongWithMapsOf64To4096)
{
  Camera camera;
  camera.width = 203; // the last tiles are not whole
  camera.height = 117;
  camera.position = { 1.5, -3.0, 2.5 };
  camera.target = { 0.0, 0.0, 0.4 };
  const std::pair<const char*, ShadowLight> pictures[] = {
    { "spheres", spotLight({ -1.0, 0.5, 4.0 }, { 0.0, 0.0, 0.3 }, 25.0) },
    { "touching boxes", directionalLight({ 0.3, -0.2, -1.0 }) }
  };
  for (auto [name, light] : pictures)
  {
    Random random(3);
    const Occluders occluders = makeOccluders(makeRandomScene(name, random));
    const View view = makeView(occluders, camera);
    for (const int size : { 64, 256, 1024, 4096 })
    {
      light.mapSizeTexels = size;
      const Tally tally = compareWithTruth(light, occluders, view, certainRule(GetParam()));
      EXPECT_EQ(tally.wrong, 0u) << name << ", map " << size;
      EXPECT_LT(tally.traced, tally.receivers) << name << ", map " << size;
    }
  }
}

} // namespace
} // namespace gnomon::test
