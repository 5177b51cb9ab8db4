// Maps by all rules for the same receivers. Those with bounds are never wrong. All decide the more,
// the more they know of neighbours.

#include "shadowtech/exact/ConservativeMaps.h"
#include "shadowtech/published/PublishedMap.h"

#include "RandomScenes.h"

#include "shadowtech/tracing/EmbreeTracer.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

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
