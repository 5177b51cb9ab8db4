// The published construction of conservative shadow maps: its offset lines, its eroded triangles,
// and its neighbours.

#include "shadowtech/published/PublishedMap.h"

#include "RandomScenes.h"
#include "TexelPolygons.h"

#include "shadowtech/base/Receivers.h"
#include "shadowtech/exact/ConservativeMaps.h"
#include "shadowtech/mesh/CasterEdges.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int width = 32;

std::set<std::size_t> texelsOf(const TexelRegion& region)
{
  std::set<std::size_t> texels;
  for (int y = 0; y < width; ++y)
  {
    const Span row = region.row(y, width);
    for (int x = row.first; x <= row.last; ++x)
    {
      texels.insert(static_cast<std::size_t>(y * width + x));
    }
  }
  return texels;
}

/// Return a point's distance into an eroded triangle, case by case: each side stays or moves. The
/// corner between two sides that stay is cut off where each meets the other one moved.
double depthInEroded(
  const Corners& corners, const SharedSides& shared, double offset, const glm::dvec2& point)
{
  const double inwards = doubleAreaOf(corners) > 0.0 ? 1.0 : -1.0;
  std::array<Line, 3> own, moved;
  for (std::size_t k = 0; k < 3; ++k)
  {
    own[k] = lineBetween(corners[k], corners[(k + 1) % 3], inwards);
    moved[k] = { own[k].normal, own[k].c + offset };
  }
  double least = infinity;
  for (std::size_t out = 0; out < 3; ++out)
  {
    const std::size_t in = (out + 2) % 3;
    least = std::min(least, (shared[out] ? own : moved)[out].distance(point));
    if (shared[in] && shared[out])
    {
      const Line cut =
        lineBetween(crossing(own[in], moved[out]), crossing(own[out], moved[in]), 1.0);
      const double side = cut.distance(corners[out]) > 0.0 ? -1.0 : 1.0;
      least = std::min(least, side * cut.distance(point));
    }
  }
  return least;
}

SharedSides sharedBy(int combination)
{
  return { { (combination & 1) != 0, (combination & 2) != 0, (combination & 4) != 0 } };
}

TEST(PublishedMap, holdsTexelsWhoseCentresLieBetweenMovedSides)
{
  EXPECT_NEAR(publishedOffset(2.0), 2.0 * std::sqrt(0.5), 1e-15);
  Random random(1);
  std::size_t held = 0, emptied = 0;
  for (int i = 0; i < 600; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    const double offset = publishedOffset(std::array{ 0.5, 1.0, 2.0 }[i % 3]);
    const MapPolygon polygon = polygonWith(corners);
    const auto expectTexels = [&](const TexelRegion& region, const auto& depthAt)
    {
      const std::set<std::size_t> texels = texelsOf(region);
      for (std::size_t texel = 0; texel < width * width; ++texel)
      {
        const double depth = depthAt(glm::dvec2(texel % width, texel / width) + 0.5);
        if (std::abs(depth) > 1e-6) // rounding decides on the border
        {
          ASSERT_EQ(texels.count(texel) == 1, depth > 0.0) << i;
        }
      }
      held += texels.size();
      emptied += texels.empty() ? 1 : 0;
    };
    for (int combination = 0; combination < 8; ++combination)
    {
      const SharedSides shared = sharedBy(combination);
      expectTexels(erodedRegion(polygon, shared, offset),
        [&](const glm::dvec2& point) { return depthInEroded(corners, shared, offset, point); });
    }
    const auto [a, b, c] = corners;
    const glm::dvec2 low = glm::min(a, glm::min(b, c)) - 0.5;
    const glm::dvec2 high = glm::max(a, glm::max(b, c)) + 0.5;
    expectTexels(dilatedRegion(polygon, offset),
      [&](const glm::dvec2& point)
      {
        const glm::dvec2 inBox = glm::min(point - low, high - point);
        return std::min({ depthInEroded(corners, {}, -offset, point), inBox.x, inBox.y });
      });
  }
  EXPECT_GT(held, 20000u);
  EXPECT_GT(emptied, 500u);
}

/// Return receivers at texels' centres, at this distance along the view.
ReceiverPixels receiversAt(
  const LightView& view, const std::function<double(const glm::dvec2&)>& depthAt)
{
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, width));
  ReceiverPixels receivers;
  receivers.resize(width, width);
  for (int i = 0; i < width * width; ++i)
  {
    const glm::dvec2 texel(i % width + 0.5, i / width + 0.5);
    const glm::dvec4 point =
      centredFromView * glm::dvec4(mapped(acrossFromTexel, texel), depthAt(texel), 1.0);
    receivers.put(static_cast<std::size_t>(i), point, glm::vec3(0.0f), 0.0f, 0);
  }
  return receivers;
}

/// A triangle in the middle of the map and one across each side. Some of them face away from the
/// light.
struct Flaps
{
  Occluders occluders;
  LightView view;

  explicit Flaps(const SharedSides& away)
  {
    Mesh mesh;
    mesh.points = { { -1.0, -0.9, 0.0 }, { 0.1, 1.0, 0.0 }, { 1.0, -0.8, 0.0 }, { -1.1, 0.5, 0.1 },
      { 1.2, 0.4, 0.1 }, { 0.1, -1.6, 0.1 } };
    // Clockwise from above, where the light is: it faces away.
    mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 2, 1, 4 }, { 0, 2, 5 } };
    for (std::size_t k = 0; k < 3; ++k)
    {
      glm::uvec3& flap = mesh.triangles[k + 1];
      flap = away[k] ? flap : glm::uvec3(flap.y, flap.x, flap.z);
    }
    this->occluders = makeOccluders({ { mesh } });
    this->view =
      viewsOf(withMap(directionalLight({ 0.0, 0.0, -1.0 }), width), this->occluders).views.front();
  }

  MapPolygon polygon(std::uint32_t triangle) const
  {
    return polygonOf(casterScene(this->view, false, width, this->occluders),
      this->occluders.surfaces.front(), 0, triangle);
  }

  /// Return the texels in which receivers far below are certain, by the map's rule.
  std::vector<Certainty> ask(PublishedLayers layers) const
  {
    const ReceiverPixels receivers =
      receiversAt(this->view, [](const glm::dvec2&) { return 100.0; });
    CasterEdges edges;
    edges.update(this->occluders);
    std::vector<Certainty> certain(receivers.size(), Certainty::Uncertain);
    publishedRule(layers)(this->view, false, width, this->occluders, edges)
      .ask(receivers, 0, receivers.size(), { 0, 1 }, certain.data());
    return certain;
  }
};

TEST(PublishedMap, sharesSidesWithNeighboursThatFaceAwayAndNoOthers)
{
  for (int combination = 0; combination < 8; ++combination)
  {
    const Flaps flaps(sharedBy(combination));
    const SharedSides shared = sharedBy(combination);
    const double offset = publishedOffset(1.0);
    for (const PublishedLayers layers : { PublishedLayers::Crsm, PublishedLayers::Crsma })
    {
      const bool adjacency = layers == PublishedLayers::Crsma;
      std::set<std::size_t> shadow, met;
      const auto add = [&](std::uint32_t triangle, const SharedSides& sides)
      {
        const MapPolygon polygon = flaps.polygon(triangle);
        shadow.merge(texelsOf(erodedRegion(polygon, adjacency ? sides : SharedSides(), offset)));
        met.merge(texelsOf(dilatedRegion(polygon, offset)));
      };
      add(0, shared);
      for (std::uint32_t k = 0; k < 3; ++k)
      {
        if (shared[k])
        {
          add(k + 1, { { true, false, false } }); // its other neighbours are missing
        }
      }
      EXPECT_GT(shadow.size(), 20u);
      const std::vector<Certainty> certain = flaps.ask(layers);
      for (std::size_t i = 0; i < certain.size(); ++i)
      {
        const Certainty expected = shadow.count(i) ? Certainty::Shadow
          : met.count(i)                           ? Certainty::Uncertain
                                                   : Certainty::Lit;
        EXPECT_EQ(certain[i], expected) << combination << ", texel " << i;
      }
    }
  }
}

/// A triangle that faces away from the light, askew.
struct Askew
{
  Occluders occluders;
  LightView view;
  Corners corners; ///< in texels, and z along the view

  explicit Askew(const ShadowLight& light = directionalLight({ 0.0, 0.0, -1.0 }))
  {
    Mesh mesh;
    mesh.points = { { -1.0, -0.9, 0.0 }, { 0.1, 1.0, 0.7 }, { 1.0, -0.8, 0.3 } };
    mesh.triangles = { { 0, 1, 2 } };
    this->occluders = makeOccluders({ { mesh } });
    this->view = viewsOf(withMap(light, width), this->occluders).views.front();
    const glm::dmat3 texels = texelFromAcross(this->view, width);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec3 point(this->view.rays.viewFromCentred *
        glm::dvec4(glm::dvec3(this->occluders.positionsCentred[k]), 1.0));
      const glm::dvec3 texel = texels * glm::dvec3(glm::dvec2(point), 1.0);
      this->corners[k] = glm::dvec3(glm::dvec2(texel) / texel.z, point.z);
    }
  }

  ConservativeMap map() const
  {
    CasterEdges edges;
    edges.update(this->occluders);
    return publishedRule(PublishedLayers::Crsm)(this->view, false, width, this->occluders, edges);
  }

  /// Return the map's answers for points at texels' centres, so far behind the triangle's plane.
  std::vector<Certainty> ask(double behind, bool onCaster) const
  {
    const auto depthAt = depthOf(this->corners);
    const ReceiverPixels receivers =
      receiversAt(this->view, [&](const glm::dvec2& texel) { return depthAt(texel) + behind; });
    std::vector<Certainty> certain(receivers.size(), Certainty::Uncertain);
    const std::uint8_t casts = onCaster ? 1 : 0;
    this->map().ask(receivers, 0, receivers.size(), { 0, casts }, certain.data());
    return certain;
  }
};

TEST(PublishedMap, comparesWithATrianglesPlaneAtTexelsCentres)
{
  Askew askew;
  const MapPolygon polygon = polygonWith(askew.corners);
  const double offset = publishedOffset(1.0);
  const std::set<std::size_t> met = texelsOf(dilatedRegion(polygon, offset));
  const std::set<std::size_t> covered = texelsOf(erodedRegion(polygon, {}, offset));
  EXPECT_GT(covered.size(), 100u);
  for (const bool onCaster : { false, true })
  {
    const std::vector<Certainty> before = askew.ask(-1e-4, onCaster);
    const std::vector<Certainty> behind = askew.ask(1e-4, onCaster);
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_EQ(before[i], Certainty::Lit) << i;
      EXPECT_EQ(behind[i],
        covered.count(i) ? Certainty::Shadow
          : met.count(i) ? Certainty::Uncertain
                         : Certainty::Lit)
        << i;
    }
  }
}

TEST(PublishedMap, isUncertainBelowCutouts)
{
  Askew askew;
  askew.occluders.surfaces.front().cutout = makePerforatedPlane(1.0, 1).cutout;
  const std::vector<Certainty> certain = askew.ask(1.0, false);
  EXPECT_EQ(std::count(certain.begin(), certain.end(), Certainty::Shadow), 0);
  EXPECT_GT(std::count(certain.begin(), certain.end(), Certainty::Uncertain), 100);
}

TEST(PublishedMap, isEmptyWithTheLightInACaster)
{
  EXPECT_GT(Askew(spotLight({ 0.1, 0.0, 2.0 }, { 0.0, 0.0, 0.0 }, 40.0)).map().bytes(), 0u);
  // A light in the middle of the triangle.
  EXPECT_EQ(
    Askew(spotLight({ 0.1 / 3.0, -0.7 / 3.0, 1.0 / 3.0 }, { 0.0, 0.0, -5.0 }, 55.0)).map().bytes(),
    0u);
}

// Maps by all rules for the same receivers. Those with bounds are never wrong. All decide the more,
// the more they know of neighbours.

enum Rule
{
  Crsm,
  Crsma,
  Fan,
  Silhouette,
  PublishedCrsm,
  PublishedCrsma
};
constexpr Rule allRules[] = { Crsm, Crsma, Fan, Silhouette, PublishedCrsm, PublishedCrsma };

/// A map's answers for receivers.
struct Answers
{
  std::vector<TracedClass> classes;
  std::size_t wrong = 0;

  std::size_t count(TracedClass of) const
  {
    return static_cast<std::size_t>(std::count(this->classes.begin(), this->classes.end(), of));
  }
};
/// @param truth the receivers' visibility without the map
Answers ask(Rule rule, const ShadowLight& light, const LightViews& views,
  const Occluders& occluders, const Receivers& receivers, const std::vector<float>& truth)
{
  static const MapRule rules[] = { certainRule(Covering::Triangle), certainRule(Covering::Ring),
    certainRule(Covering::Fan), certainRule(Covering::Silhouette),
    publishedRule(PublishedLayers::Crsm), publishedRule(PublishedLayers::Crsma) };
  ConservativeMaps maps;
  maps.bake(light, views, occluders, rules[rule]);
  EmbreeTracer tracer;
  tracer.update(occluders);
  std::vector<float> visibility;
  std::vector<std::uint8_t> numbers;
  const std::size_t traced = tracer.trace(light, occluders, receivers, visibility, &maps, &numbers);
  Answers answers;
  for (const std::uint8_t number : numbers)
  {
    answers.classes.push_back(static_cast<TracedClass>(number));
  }
  answers.wrong = countDifferent(visibility, truth);
  EXPECT_TRUE(rule >= PublishedCrsm || answers.wrong == 0u) << rule;
  EXPECT_EQ(traced, answers.count(TracedClass::Traced)) << "a ray for each of them, and no other";
  return answers;
}

using RulesIn = testing::TestWithParam<const char*>;

INSTANTIATE_TEST_SUITE_P(Scenes, RulesIn, testing::ValuesIn(randomSceneNames()), byLetters);

TEST_P(RulesIn, areRightWithBoundsAndLessUncertainTheMoreIsKnownOfNeighbours)
{
  std::map<Rule, std::size_t> traced, wrong;
  std::size_t needRays = 0;
  for (unsigned int seed = 1; seed <= exactRuns(); ++seed)
  {
    const RandomPicture picture = makeRandomPicture(GetParam(), seed);
    SCOPED_TRACE(picture.description);
    ReceiverPixels stored;
    const Receivers receivers(
      picture.view.images, picture.view.drawnSurfaces, picture.occluders, stored);
    EmbreeTracer tracer;
    tracer.update(picture.occluders);
    std::vector<float> truth;
    needRays += tracer.trace(picture.light, picture.occluders, receivers, truth);
    std::map<Rule, std::size_t> lit;
    for (const Rule rule : allRules)
    {
      const Answers answers =
        ask(rule, picture.light, picture.views, picture.occluders, receivers, truth);
      traced[rule] += answers.count(TracedClass::Traced);
      wrong[rule] += answers.wrong;
      lit[rule] = answers.count(TracedClass::Lit);
    }
    if (picture.views.views.size() == 1) // triangles across several views are undecided
    {
      EXPECT_EQ(lit[Crsma], lit[Crsm]);
      EXPECT_EQ(lit[Fan], lit[Crsm]);
      EXPECT_EQ(lit[PublishedCrsma], lit[PublishedCrsm]);
    }
  }
  EXPECT_GT(needRays, exactRuns() * 300u);
  EXPECT_LT(traced[Crsm], needRays * 3 / 4);
  EXPECT_LE(traced[Crsma], traced[Crsm]);
  EXPECT_LE(traced[Fan], traced[Crsma]);
  EXPECT_LE(traced[Silhouette], traced[Crsma]);
  EXPECT_LE(traced[PublishedCrsma], traced[PublishedCrsm]);
  EXPECT_GT(wrong[PublishedCrsm], 0u); // false shadows, and false light of open surfaces
  EXPECT_GT(wrong[PublishedCrsma], 0u);
}

/// Count the uncertain receivers of a fine grid under a plate that faces down, away from its outer
/// edges. It is off the map's grid, of triangles around its middle or of two triangles.
/// @param within of its middle, in units
std::size_t uncertainUnderPlate(bool hasMiddle, Rule rule, double within = 1.0)
{
  Mesh plate{ { { -0.52, -0.47, 0.0 }, { 0.49, -0.51, 0.0 }, { 0.53, 0.48, 0.0 },
                { -0.5, 0.54, 0.0 }, { 0.013, 0.021, 0.0 } },
    { { 1, 0, 3 }, { 1, 3, 2 } } };
  if (hasMiddle)
  {
    plate.triangles = { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } };
  }
  // It receives nothing, because its other side is visible.
  const Occluders occluders =
    makeOccluders({ { makePlane(2.0) }, { plate, at({ 0.0, 0.0, 0.5 }), true, false } });
  const ShadowLight light = withMap(directionalLight({ 0.0, 0.0, -1.0 }), 64);
  constexpr int count = 400;
  std::vector<PlacedReceiver> placed;
  for (int i = 0; i < count * count; ++i)
  {
    const glm::dvec2 place = 0.8 * (glm::dvec2(i % count, i / count) / double(count) - 0.5);
    if (glm::distance(place, { 0.013, 0.021 }) <= within)
    {
      placed.push_back(
        { glm::dvec3(place, 0.0) - occluders.frame.centre, { 0.0f, 0.0f, 1.0f }, 1e-6f });
    }
  }
  const ReceiverPixels receivers = rowOf(placed);
  const std::vector<float> dark(placed.size(), 0.0f);
  return ask(rule, light, viewsOf(light, occluders), occluders, Receivers(receivers), dark)
    .count(TracedClass::Traced);
}

TEST(Rules, decideMuchMoreAroundSpheresByTheirSilhouette)
{
  std::vector<Prop> props{ { makePlane(2.0) } };
  for (int i = 0; i < 9; ++i)
  {
    const glm::dvec3 place(0.5 * (i % 3) - 0.5, 0.5 * (i / 3) - 0.5, 0.4 + 0.1 * (i * 4 % 9));
    props.push_back({ makeSphere(20, 40), at(place, 0.2 + 0.005 * i) });
  }
  const Occluders occluders = makeOccluders(props);
  const ShadowLight light = withMap(directionalLight({ 0.1, 0.07, -1.0 }), 64);
  const ReceiverPixels receivers =
    makeReceivers(occluders, { { 2.0, -1.2, 3.2 }, { 0.0, 0.0, 0.4 }, { 0.0, 0.0, 1.0 }, 36.0 });
  const std::vector<float> truth = trace(light, occluders, receivers);
  const auto uncertain = [&](Rule rule, bool onGround)
  {
    const Answers answers =
      ask(rule, light, viewsOf(light, occluders), occluders, Receivers(receivers), truth);
    return static_cast<double>(countBelow(truth.size(),
      [&](std::size_t i) {
        return answers.classes[i] == TracedClass::Traced &&
          (receivers.surface[i] == 0 || !onGround);
      }));
  };
  EXPECT_LE(uncertain(Silhouette, true), 0.45 * uncertain(Crsm, true));
  // For receivers on the spheres, which cast with both sides, neither rule decides many at this
  // size.
  EXPECT_LE(uncertain(Silhouette, false), 0.62 * uncertain(Crsm, false));
}

TEST(Rules, haveNoSeamBetweenTwoTrianglesThatKnowEachOther)
{
  for (const Rule rule : allRules)
  {
    EXPECT_EQ(uncertainUnderPlate(false, rule) == 0u, rule != Crsm && rule != PublishedCrsm)
      << rule;
  }
}

TEST(Rules, haveAHoleWhereTrianglesMeetInACornerButForFansAndSilhouettes)
{
  for (const Rule rule : { Crsma, PublishedCrsma })
  {
    EXPECT_GT(uncertainUnderPlate(true, rule, 2.0 / 64.0), 0u) << rule;
  }
  EXPECT_EQ(uncertainUnderPlate(true, Fan), 0u);
  EXPECT_EQ(uncertainUnderPlate(true, Silhouette), 0u);
}

} // namespace
} // namespace gnomon::test
