// Conservative maps against ray tracing: their certain answers are never wrong.

#include "shadowtech/exact/ConservativeMaps.h"

#include "RandomScenes.h"

#include "lights/ShadowSettings.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// Sums over runs.
struct Tally
{
  std::size_t receivers = 0; ///< receivers that need a shadow ray
  std::size_t traced = 0;    ///< of these, those whose ray was traced
  std::size_t leftOut = 0;   ///< decided before they were computed

  void add(const Tally& other)
  {
    this->receivers += other.receivers;
    this->traced += other.traced;
    this->leftOut += other.leftOut;
  }
};

const MapRule bySilhouette = certainRule(Covering::Silhouette);

/// Expect a trace with the map to equal a full trace.
/// @param what added to failures' messages
Tally compareWithTruth(const std::string& what, const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const Receivers& receivers, const MapRule& rule = bySilhouette)
{
  ConservativeMaps maps;
  maps.bake(light, views, occluders, rule);
  EmbreeTracer tracer;
  tracer.update(occluders);
  Tally tally;
  std::vector<float> truth, visibility;
  tally.receivers = tracer.trace(light, occluders, receivers, truth);
  tally.traced = tracer.trace(light, occluders, receivers, visibility, &maps);
  EXPECT_EQ(countDifferent(truth, visibility), 0u) << what;
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

/// Compare without stored receivers, so maps are looked up for triangles and lines.
Tally compareWithTruth(const std::string& what, const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const View& view, const MapRule& rule = bySilhouette)
{
  ReceiverPixels stored;
  return compareWithTruth(what, light, views, occluders,
    Receivers(view.images, view.drawnSurfaces, occluders, stored), rule);
}

/// Compare by the map of all casters.
template <typename Seen>
Tally compareWithTruth(const std::string& what, const ShadowLight& light,
  const Occluders& occluders, const Seen& seen, const MapRule& rule = bySilhouette)
{
  return compareWithTruth(what, light, viewsOf(light, occluders), occluders, seen, rule);
}

/// One picture of one scene in one light, by maps of one size.
Tally run(const std::string& name, unsigned int seed, const MapRule& rule,
  const glm::dmat4& world = glm::dmat4(1.0))
{
  const RandomPicture picture = makeRandomPicture(name, seed, world);
  return compareWithTruth(
    picture.description, picture.light, picture.views, picture.occluders, picture.view, rule);
}

std::string nameOfCovering(Covering covering)
{
  const char* const coverings[] = { "Triangle", "Ring", "Fan", "Silhouette" };
  return coverings[static_cast<int>(covering)];
}

const auto allCoverings =
  testing::Values(Covering::Triangle, Covering::Ring, Covering::Fan, Covering::Silhouette);

using ConservativeMapsBy = testing::TestWithParam<Covering>;

INSTANTIATE_TEST_SUITE_P(Rules, ConservativeMapsBy, allCoverings,
  [](const testing::TestParamInfo<Covering>& rule) { return nameOfCovering(rule.param); });

TEST_P(ConservativeMapsBy, areNeverWrongFarAwayAndAtAnyScale)
{
  Tally sum;
  for (const glm::dmat4& world : { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
         at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) })
  {
    for (const char* name : randomSceneNames())
    {
      for (unsigned int seed = 100; seed < 100 + std::max(exactRuns(12) / 4, 1u); ++seed)
      {
        sum.add(run(name, seed, certainRule(GetParam()), world));
      }
    }
  }
  EXPECT_GT(sum.leftOut, sum.receivers / 20) << "triangles and lines are asked about";
  EXPECT_GE(sum.receivers, 90000u);
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4);
}

Mesh oneTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  return { { a, b, c }, { { 0, 1, 2 } } };
}

void addQuad(Mesh& mesh, const std::array<glm::dvec3, 4>& corners)
{
  const auto first = static_cast<unsigned int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// A valley that faces the light. Near its bottom, rays from one side start behind another side.
/// The sides are one surface, or two that meet in an edge.
class Valley : public testing::TestWithParam<bool>
{
protected:
  /// @param near,far the triangles of the first and of the second surface
  void makeOf(const std::vector<glm::dvec3>& points, std::vector<glm::uvec3> near,
    const std::vector<glm::uvec3>& far)
  {
    if (!GetParam())
    {
      near.insert(near.end(), far.begin(), far.end());
    }
    std::vector<Prop> props{ { { points, near } } };
    if (GetParam())
    {
      props.push_back({ { points, far } });
    }
    this->occluders_ = makeOccluders(props);
  }
  void add(const glm::dvec3& world, const glm::dvec3& normal, float offset)
  {
    this->receivers_.push_back(
      { world - this->occluders_.frame.centre, glm::normalize(normal), offset });
  }
  Tally compare(const ShadowLight& light, int mapSize, double shape)
  {
    const Tally tally = compareWithTruth(
      std::to_string(shape), withMap(light, mapSize), this->occluders_, rowOf(this->receivers_));
    this->receivers_.clear();
    return tally;
  }

  Occluders occluders_;
  std::vector<PlacedReceiver> receivers_;
};

INSTANTIATE_TEST_SUITE_P(ConservativeMaps, Valley, testing::Bool(),
  [](const testing::TestParamInfo<bool>& sides) { return sides.param ? "surfaces" : "one"; });

TEST_P(Valley, isNeverWrongWhereManySidesMeetInACorner)
{
  // Two steep sides, and two thin wedges between them that are less steep. Each is flat enough
  // against its neighbours. The steep sides are not flat enough against each other, and meet in the
  // corner.
  for (const double halfWedge : { 0.01, 0.03, 0.1 })
  {
    const double steep = std::tan(glm::radians(55.0));
    const double mild = std::tan(glm::radians(18.0));
    const double x = 2.0 * std::cos(halfWedge);
    const double y = 2.0 * std::sin(halfWedge);
    const double border = y * steep;
    const double bottom = y * (steep - mild);
    this->makeOf({ { 0.0, 0.0, 0.0 }, { 0.0, -2.0, 2.0 * steep }, { x, -y, border },
                   { 2.0, 0.0, bottom }, { x, y, border }, { 0.0, 2.0, 2.0 * steep },
                   { -x, y, border }, { -2.0, 0.0, bottom }, { -x, -y, border } },
      { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 7, 8 }, { 0, 8, 1 } },
      { { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 }, { 0, 6, 7 } });
    constexpr std::size_t count = 6000;
    Random random(3);
    for (std::size_t i = 0; i < count; ++i)
    {
      // On the near steep side, close to a wedge and the corner.
      const double along = std::pow(10.0, uniform(random, -6.0, -0.5));
      const double below =
        along * std::tan(halfWedge) * (1.0 + std::pow(10.0, uniform(random, -4.0, 0.5)));
      this->add(
        { random() % 2 ? along : -along, -below, steep * below }, { 0.0, steep, 1.0 }, 3e-4f);
    }
    const Tally tally = this->compare(directionalLight({ 0.03, 0.02, -1.0 }), 33, halfWedge);
    EXPECT_GT(tally.receivers, count / 2) << halfWedge;
  }
}

TEST(ConservativeMaps, knowNothingOfLinesWhoseRaysMayStartAboveASheet)
{
  const double height = 1e-3;
  const Occluders occluders =
    makeOccluders({ { makePlane(8.0) }, { makePlane(7.0), at({ 0.0, 0.0, height }) } });
  const ShadowLight light = withMap(directionalLight({ 0.0, 0.0, -1.0 }), 16);
  ConservativeMaps maps;
  maps.bake(light, viewsOf(light, occluders), occluders, bySilhouette);
  const auto known = [&](float mostOffset)
  {
    const ReceiverSegment line{ glm::dvec3(-1.3, 0.2, 0.0) - occluders.frame.centre,
      glm::dvec3(1.2, 0.9, 0.0) - occluders.frame.centre, 1e-6f, mostOffset, 0 };
    return maps.ofSegment(line);
  };
  EXPECT_EQ(known(1e-5f), Certainty::Shadow);
  EXPECT_EQ(known(static_cast<float>(0.9 * height)), Certainty::Shadow);
  EXPECT_EQ(known(static_cast<float>(1.01 * height)), Certainty::Uncertain);
}

TEST(ConservativeMaps, areNeverWrongWhereEdgesLieOnTexelsBorders)
{
  // A row of plates whose edges lie exactly between texels, high above receivers that lie there,
  // too. The light's direction is rounded for shadow rays, which matters over the distance.
  const ShadowLight light = withMap(directionalLight({ 0.3, -0.2, -1.0 }), 64);
  const std::vector<Prop> corners{ { makeBox(glm::dvec3(-500.0), glm::dvec3(-499.0)) },
    { makeBox(glm::dvec3(499.0), glm::dvec3(500.0)) } };
  const Occluders frame = makeOccluders(corners);
  const LightViews views = viewsOf(light, frame);
  const LightView& view = views.views.front();
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, light.mapSizeTexels));
  const auto centred = [&](double texelX, double texelY, double z)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, { texelX, texelY });
    return glm::dvec3(centredFromView * glm::dvec4(across, z, 1.0));
  };
  // The middle of the box, seen from the light.
  const double middle = (view.rays.viewFromCentred * glm::dvec4(0.0, 0.0, 0.0, 1.0)).z;
  Mesh plates;
  for (int x = 24; x < 40; x += 8)
  {
    const auto corner = [&](int cornerX, int cornerY)
    { return centred(cornerX, cornerY, middle - 300.0) + frame.frame.centre; };
    addQuad(plates, { corner(x, 24), corner(x + 4, 24), corner(x + 4, 40), corner(x, 40) });
  }
  // The receiving surface does not cast, so it may be anywhere.
  const Prop receiver{ makePlane(1.0), glm::dmat4(1.0), false };
  const Occluders occluders = makeOccluders({ corners[0], corners[1], { plates }, receiver });
  ASSERT_EQ(occluders.castersCentred.upper, frame.castersCentred.upper);
  std::vector<PlacedReceiver> receivers;
  Random random(5);
  for (int i = 0; i < 20000; ++i)
  {
    const double beside = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -8.0, -0.4));
    const double x = 24.0 + static_cast<double>(random() % 16) + beside;
    receivers.push_back(
      { centred(x, uniform(random, 25.0, 39.0), middle + 300.0), -light.directionWorld, 1e-4f });
  }
  const Tally tally = compareWithTruth("", light, views, occluders, rowOf(receivers, 3));
  EXPECT_LT(tally.traced, tally.receivers);
}

TEST_P(ConservativeMapsBy, areNeverWrongWhereDepthHardlyChangesFarFromALamp)
{
  // Depth runs as -1 / z from the map's near end, at the lamp if that is among the casters. Farther
  // off it hardly changes. Far surfaces move the origin away, so values computed from places are
  // rounded by more than that. The ends of small plates lie all over the floor, so a receiver is
  // mostly decided by its own triangle alone.
  const MapRule rule = certainRule(GetParam());
  Random random(4);
  Tally sum, seen;
  for (int i = 0; i < 16; ++i)
  {
    const glm::dvec3 lamp(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), 1.0);
    const ShadowLight light = withMap(pointLight(lamp), 32);
    Mesh plates;
    for (int k = 0; k < 400; ++k)
    {
      const glm::dvec3 corner(
        uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), uniform(random, 0.01, 0.1));
      addTriangle(
        plates, corner, corner + glm::dvec3(0.01, 0.0, 0.0), corner + glm::dvec3(0.0, 0.01, 0.0));
    }
    const glm::dvec3 away = 300.0 * glm::abs(unitVector(random));
    const Occluders occluders =
      makeOccluders({ { makePlane(6.0) }, { plates }, { makeBox(away - 1.0, away + 1.0) } });
    std::vector<PlacedReceiver> receivers;
    for (int k = 0; k < 4000; ++k)
    {
      const glm::dvec3 place(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
      receivers.push_back({ place - occluders.frame.centre, { 0.0f, 0.0f, 1.0f }, 4e-6f });
    }
    sum.add(compareWithTruth(std::to_string(i), light, occluders, rowOf(receivers), rule));

    // Also by triangles and lines, for a camera above the floor.
    const Camera camera{ { uniform(random, -1.0, 1.0), -3.0, 2.0 }, {}, { 0.0, 0.0, 1.0 }, 40.0,
      0.0, 96, 96 };
    seen.add(
      compareWithTruth(std::to_string(i), light, occluders, makeView(occluders, camera), rule));
  }
  EXPECT_LT(sum.traced, sum.receivers);
  EXPECT_GT(seen.leftOut, 0u) << "triangles and lines are asked about";
}

TEST(ConservativeMaps, areNeverWrongWhereCastersTouchTheLight)
{
  // A lamp in the ceiling, and a box light that begins in a plate: rays end there to within
  // rounding.
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.3, { 1.0, 0.5, 0.2 });
  for (const glm::dmat4& world : { glm::dmat4(1.0), turn })
  {
    const glm::dvec3 lamp(world * glm::dvec4(0.31, 0.12, 2.0, 1.0));
    const glm::dvec3 floor(world * glm::dvec4(0.3, 0.1, 0.0, 1.0));
    const Occluders occluders =
      makeOccluders({ { makePlane(4.0), world }, { makePlane(3.0), world * at({ 0.0, 0.0, 2.0 }) },
        { makeSphere(8, 12), world * at({ 0.4, 0.3, 0.7 }, 0.3) } });
    const Camera camera{ glm::dvec3(world * glm::dvec4(0.5, -5.0, 1.5, 1.0)), floor,
      { 0.0, 0.0, 1.0 }, 40.0, 0.0, 96, 96 };
    const ReceiverPixels receivers = makeReceivers(occluders, camera);
    std::vector<ShadowLight> lights{ pointLight(lamp), spotLight(lamp, floor, 30.0),
      spotLight(lamp, floor, 75.0) };
    for (const double before : { 0.0, 1e-8, 3e-8, 1e-7 })
    {
      // Along the plate's normal, so all of the box's near face lies in the plate.
      const glm::dvec3 normal(world * glm::dvec4(0.0, 0.0, -1.0, 0.0));
      lights.push_back(boxLight(normal, lamp - before * normal, { 2.0, 2.0, 3.0 }));
      lights.back().box->upWorld = glm::dvec3(world * glm::dvec4(0.0, 1.0, 0.0, 0.0));
    }
    for (const ShadowLight& light : lights)
    {
      const Tally tally = compareWithTruth("light " + std::to_string(static_cast<int>(light.kind)),
        withMap(light, 128), occluders, receivers);
      EXPECT_GT(tally.receivers, 500u);
    }
  }
}

/// Return a view in which all pixels show the first triangle, wherever their rays pass.
View viewOfFirstTriangle(const Occluders& occluders, const Camera& camera)
{
  View view = makeView(occluders, camera);
  std::fill(view.images.fragments.begin(), view.images.fragments.end(), glm::vec2(1.0f, 0.0f));
  return view;
}

/// Return triangles in a ring around a place, whose planes nearly pass through it.
Mesh makeRingOfTriangles(const glm::dvec3& place, Random& random)
{
  Mesh ring;
  for (int i = 0; i < 400; ++i)
  {
    const double angle = uniform(random, 0.0, 6.283185307179586);
    const double radius = uniform(random, 0.3, 0.7);
    const glm::dvec2 outwards(std::cos(angle), std::sin(angle));
    const auto corner = [&](double out, double aside)
    {
      const glm::dvec2 across =
        (radius + out) * outwards + aside * glm::dvec2(-outwards.y, outwards.x);
      return place + glm::dvec3(across, uniform(random, -1e-4, 1e-4));
    };
    addTriangle(ring, corner(0.0, 0.0), corner(0.1, -0.05), corner(0.1, 0.05));
  }
  return ring;
}

TEST(ConservativeMaps, areNeverWrongAboutTrianglesThatALampIsBeside)
{
  // Far from the origin, rounding decides on which side of a triangle's plane the lamp is. Maps
  // know the amount of rounding if they exist: not without casters, or if none of them is in the
  // cone.
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
    for (const auto& [light, props] : cases)
    {
      const Occluders occluders = makeOccluders(props);
      for (const double height : { -2.0, 2.0 })
      {
        camera.position = lamp + glm::dvec3(0.0, 0.0, height);
        compareWithTruth("light " + std::to_string(static_cast<int>(light.kind)) + ", props " +
            std::to_string(props.size()),
          withMap(light, 64), occluders, makeView(occluders, camera));
      }
    }
  }
}

TEST(ConservativeMaps, areNeverWrongOfPixelsWhoseRaysStartAboveASheet)
{
  // With larger pixels, rays start farther off a triangle's edge, and finally above the sheet over
  // it.
  const Mesh triangle = oneTriangle({ -0.2, -0.2, 0.0 }, { 2.2, -0.1, 0.0 }, { -0.1, 0.2, 0.0 });
  constexpr int size = 16;
  constexpr double side = 8.0;
  constexpr double texel = side / size;
  const ShadowLight light = withMap(directionalLight({ 0.0, 0.0, -1.0 }), size);
  const Camera above{ { 0.3, 0.1, 2.0 }, { 0.3, 0.1, 0.0 }, { 0.0, 1.0, 0.0 }, 120.0 };
  Camera parallel = above;
  parallel.parallelHeight = 4.0;
  const Camera cameras[] = { above,
    { { -0.8, 0.1, 0.5 }, { 2.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 60.0 }, parallel };
  Tally sum;
  for (const double texels : { 0.3, 0.5, 0.7, 1.1, 1.25, 1.5, 2.0, 4.0 })
  {
    // A ray may start at most 1/256 of a texel beside its receiver. Seen from above, it starts this
    // far up.
    const Occluders occluders = makeOccluders(
      { { triangle }, { makePlane(side, 4), at({ 0.0, 0.0, texels * texel / 256.0 }) } });
    for (Camera camera : cameras)
    {
      for (int pixels = 3; pixels < 40; ++pixels)
      {
        camera.width = camera.height = pixels;
        sum.add(compareWithTruth(std::to_string(texels) + ", " + std::to_string(pixels), light,
          occluders, viewOfFirstTriangle(occluders, camera)));
      }
    }
  }
  EXPECT_GT(sum.leftOut, 1000u);
  EXPECT_GT(sum.traced, 1000u);
}

TEST(ConservativeMaps, areNeverWrongBelowThinSheets)
{
  // A long, thin, oblique triangle; only rays that start far off it are safe.
  const glm::dmat4 turn =
    glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(0.6, 0.7, 0.1)));
  const Mesh triangle = oneTriangle({ -0.1, -0.09, 0.0 }, { 0.1, 0.09, 0.0 }, { 0.1, 0.0901, 0.0 });
  const ShadowLight light =
    withMap(directionalLight(glm::dvec3(turn * glm::dvec4(0.0, 0.0, -1.0, 0.0))), 512);
  const Camera camera{ glm::dvec3(turn * glm::dvec4(0.0, 0.0, 3.0, 1.0)), {}, { 0.0, 0.0, 1.0 },
    1.0, 0.0, 64, 64 };
  Tally sum;
  for (const double height : { 2e-5, 5e-5, 1e-4, 2e-4, 4e-4, 8e-4, 1.6e-3 })
  {
    const Occluders occluders = makeOccluders(
      { { triangle, turn, false }, { makePlane(3.0), turn * at({ 0.0, 0.0, height }) } });
    sum.add(compareWithTruth(
      std::to_string(height), light, occluders, viewOfFirstTriangle(occluders, camera)));
  }
  EXPECT_GT(sum.receivers, 1000u);
}

TEST(ConservativeMaps, areNeverWrongWhereTrianglesTouchTheConeOrTheBox)
{
  // Far from the origin, with a corner in the cone's or the box's side, so rounding decides whether
  // the light reaches it; or well inside, so maps decide.
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
    const double side = isSpot ? 80.0 * std::tan(glm::radians(30.0)) : 40.0;
    const double from = uniform(random, -20.0, 20.0);
    const auto below = [&](double out, double across, double down)
    { return lamp + out * outwards + (from + across) * beside - glm::dvec3(0.0, 0.0, down); };
    // Maps hold nothing nearer to a lamp than all casters.
    const glm::dvec3 low = below(-15.0, -from, 41.0);
    const Prop shade{ makeBox(low, low + 1.0) };
    const double inside = i % 4 < 2 ? 1.0 : 0.8;
    const double across = isSpot ? -from : 0.0;
    const Mesh triangle = oneTriangle(
      below(inside * side, across, 80.0), below(5.0, 5.0, 90.0), below(10.0, -5.0, 85.0));
    const Occluders occluders =
      makeOccluders({ { triangle, glm::dmat4(1.0), false }, opposite, ground, shade });
    // Most rays pass beside the corner.
    const glm::dvec3 corner = triangle.points[0];
    const glm::dvec3 target = corner + 0.003 * (corner - triangle.points[1]);
    const Camera camera{ target + glm::dvec3(0.1, 0.2, 3.0), target, { 0.0, 1.0, 0.0 }, 4.0, 0.0,
      32, 32 };
    sum.add(compareWithTruth(
      std::to_string(i), withMap(light, 8), occluders, viewOfFirstTriangle(occluders, camera)));
  }
  EXPECT_GT(sum.leftOut, 100000u);
}

TEST(ConservativeMaps, areNeverWrongOfWhatDoesNotCastOrOnOneSide)
{
  // The plate is no layer of the map, so the nearest layer is above it. It lies in the middle of
  // the scene, where it has no rounding, as if all rays started far off it.
  const Prop plate{ makePlane(1.5), at({ 0.0, 0.0, 0.5 }) };
  const Prop tower{ makeBox({ 2.0, 2.0, 0.9 }, { 2.5, 2.5, 1.0 }) };
  const ShadowLight light = withMap(directionalLight({ 0.1, 0.2, -1.0 }), 64);
  const Camera camera{ { 0.3, -4.0, 2.0 } };
  for (const int cells : { 1, 64 })
  {
    for (const bool casts : { false, true })
    {
      Prop floor{ makePlane(4.0, cells) };
      floor.casts = casts;
      floor.oneSided = casts;
      // Turned over, it casts nothing on the visible side.
      floor.worldFromMesh =
        casts ? glm::rotate(glm::dmat4(1.0), 3.14159265358979, { 1.0, 0.0, 0.0 }) : glm::dmat4(1.0);
      const Occluders occluders = makeOccluders({ floor, plate, tower });
      const std::string what = std::to_string(cells) + (casts ? ", on one side" : "");
      const Tally tally = compareWithTruth(what, light, occluders, makeView(occluders, camera));
      EXPECT_GT(tally.leftOut, 1000u) << what;
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
        const auto corner = [&](double x, double y)
        { return glm::dvec3(x * along + y * glm::dvec2(-along.y, along.x), 0.5); };
        addQuad(
          plates, { corner(from, -3.0), corner(3.0, -3.0), corner(3.0, 3.0), corner(from, 3.0) });
      }
      // Decided by lines of a large triangle, along either axis, and by small triangles.
      for (const auto& [cells, up] : { std::pair(1, glm::dvec3(1.0, 0.0, 0.0)),
             { 1, glm::dvec3(0.0, 1.0, 0.0) }, { 48, glm::dvec3(1.0, 0.0, 0.0) } })
      {
        const Prop floor{ makePlane(6.0, cells), glm::dmat4(1.0), false };
        const Occluders occluders = makeOccluders({ floor, { plates } });
        const LightViews views =
          fitLightViews(light, { occluders.frame.centre, seen, {}, { size, 1 }, {} });
        camera.up = up;
        sum.add(compareWithTruth("map " + std::to_string(size) + ", " + std::to_string(texels),
          light, views, occluders, makeView(occluders, camera)));
      }
    }
  }
  EXPECT_GT(sum.leftOut, sum.receivers / 2);
}

} // namespace
} // namespace gnomon::test
