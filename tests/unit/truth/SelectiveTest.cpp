// `coherence` and `selective`, stage by stage, and against ray tracing.

#include "shadowtech/selective/CertainHit.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/LightInCaster.h"
#include "shadowtech/selective/StatusContour.h"

#include "RandomScenes.h"

#include "lights/LightSpace.h"
#include "lights/ShadowSettings.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

/// Return the casters of a light with a box, as TriangleMap takes them.
std::optional<glm::dvec4> keptFromCentred(const RandomPicture& picture)
{
  return picture.light.box
    ? std::optional(nearFaceCentred(picture.light, picture.occluders.frame.centre))
    : std::nullopt;
}

// Lights in casters

TEST(LightInCaster, IsOnATriangle)
{
  const Occluders occluders = makeOccluders({ { makePlane(4.0), at({ 10.1, 20.2, 30.3 }) } });
  const auto liesIn = [&](const glm::dvec3& place, const LightArea* area = nullptr)
  { return liesInCaster(place - occluders.frame.centre, area, occluders); };
  EXPECT_TRUE(liesIn({ 10.9, 19.0, 30.3 }));
  EXPECT_TRUE(liesIn({ 12.1, 22.2, 30.3 })) << "a corner";
  EXPECT_FALSE(liesIn({ 12.2, 20.2, 30.3 })) << "in its plane, beside it";
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.301 }));
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.299 }));

  const LightArea flat = diskArea({ 0.0, 0.0, -1.0 }, 0.5);
  EXPECT_TRUE(liesIn({ 10.9, 19.0, 30.3 }, &flat));
  EXPECT_TRUE(liesIn({ 12.5, 20.2, 30.3 }, &flat)) << "its rim does";
  EXPECT_FALSE(liesIn({ 12.7, 20.2, 30.3 }, &flat));
  const LightArea standing = diskArea({ 1.0, 0.0, 0.0 }, 0.5);
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.3 }, &standing)) << "it crosses the plane";
  const LightArea ball = ballArea(0.5);
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.3 }, &ball)) << "likewise";
  Prop ground{ makePlane(4.0) };
  ground.casts = false;
  EXPECT_FALSE(liesInCaster({ 0.0, 0.0, 0.0 }, nullptr, makeOccluders({ ground })));
  EXPECT_FALSE(liesInCaster({ 0.0, 0.0, 0.0 }, nullptr, Occluders()));
}

// The contour

/// Brute force: a pixel belongs if it has a status, and the other status is near.
TEST(StatusContour, isWhereBothStatusesAreWithinTheRadius)
{
  Random random(3);
  for (const auto& [width, height] : { std::pair(64, 40), { 7, 3 }, { 1, 1 }, { 0, 0 } })
  {
    std::vector<PixelStatus> statuses;
    for (int i = 0; i < width * height; ++i)
    {
      const unsigned int number = random() % 100;
      statuses.push_back(number < 2 ? PixelStatus::Shadow
          : number < 40             ? PixelStatus::None
                                    : PixelStatus::Lit);
    }
    for (int radius = 1; radius <= 4; ++radius)
    {
      const std::vector<std::uint8_t> contour = contourOf(statuses, width, height, radius);
      ASSERT_EQ(contour.size(), statuses.size());
      for (int i = 0; i < width * height; ++i)
      {
        const PixelStatus status = statuses[static_cast<std::size_t>(i)];
        bool isNear = false;
        for (int k = 0; k < width * height; ++k)
        {
          const PixelStatus other = statuses[static_cast<std::size_t>(k)];
          isNear |= status != PixelStatus::None && other != PixelStatus::None && other != status &&
            std::abs(i % width - k % width) <= radius && std::abs(i / width - k / width) <= radius;
        }
        ASSERT_EQ(contour[static_cast<std::size_t>(i)] != 0, isNear) << i << ", radius " << radius;
      }
    }
  }
}

// Texels and triangles around

TEST(Neighbourhood, ofFourIsTheBilinearFootprintAndOfNineItsSurroundings)
{
  using Texels = std::vector<std::pair<int, int>>;
  Random random(7);
  for (int run = 0; run < 20000; ++run)
  {
    MapPlace place;
    place.x = uniform(random, 0.0, 1024.0);
    place.y = uniform(random, 0.0, 1024.0);
    place.column = static_cast<int>(place.x);
    place.row = static_cast<int>(place.y);
    const auto expectVisits = [&](Neighbourhood neighbourhood, double left, double lower, int side)
    {
      Texels visited, expected;
      EXPECT_FALSE(visitNeighbourhood(neighbourhood, place,
        [&](int column, int row)
        {
          visited.emplace_back(column, row);
          return false;
        }));
      ASSERT_EQ(visited.front(), std::pair(place.column, place.row));
      for (int i = 0; i < side * side; ++i)
      {
        expected.emplace_back(
          std::floor(place.x - left) + i % side, std::floor(place.y - lower) + i / side);
      }
      ASSERT_THAT(visited, testing::UnorderedElementsAreArray(expected));
    };
    expectVisits(Neighbourhood::Centre, 0.0, 0.0, 1);
    expectVisits(Neighbourhood::Four, 0.5, 0.5, 2);
    expectVisits(Neighbourhood::Nine, 1.0, 1.0, 3);
  }
}

/// Brute force: triangles are adjacent by the number of places, not vertices, that they share.
TEST(TriangleFans, haveAllTrianglesThatShareAnEdgeOrAVertex)
{
  Mesh manyAtAnEdge;
  manyAtAnEdge.points = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 },
    { -1.0, 1.0, 0.0 }, { -1.0, -1.0, 0.0 }, { 0.0, 0.0, 3.0 }, { 0.0, 1.0, 3.0 } };
  manyAtAnEdge.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 }, { 1, 5, 6 } };
  const Mesh sheet = apart(makeTerrain(2.0, 9, 0.4));
  // The first surface shifts the others' numbers from those of the snapshot.
  const Occluders occluders =
    makeOccluders({ { makePlane(1.0, 2) }, { manyAtAnEdge }, { sheet }, { makeSphere(9, 14) } });
  TriangleFans all;
  all.update(occluders, updateFans);
  const auto commonPlaces = [&](std::uint32_t one, std::uint32_t other)
  {
    int common = 0;
    for (int i = 0; i < 9; ++i)
    {
      common += occluders.positionsCentred[occluders.triangles[one][i / 3]] ==
          occluders.positionsCentred[occluders.triangles[other][i % 3]]
        ? 1
        : 0;
    }
    return common;
  };
  for (std::size_t k = 1; k < occluders.surfaces.size(); ++k)
  {
    const Surface& surface = occluders.surfaces[k];
    const std::uint32_t end = surface.firstTriangle + surface.triangleCount;
    for (std::uint32_t triangle = surface.firstTriangle; triangle < end; ++triangle)
    {
      for (const auto& [adjacency, least] :
        { std::pair(Adjacency::Edges, 2), { Adjacency::Vertices, 1 } })
      {
        std::set<std::uint32_t> expected{ triangle };
        for (std::uint32_t other = surface.firstTriangle; other < end; ++other)
        {
          if (commonPlaces(triangle, other) >= least)
          {
            expected.insert(other);
          }
        }
        std::vector<std::uint32_t> found;
        EXPECT_FALSE(visitAdjacent(all.of(k), triangle, adjacency,
          [&](std::uint32_t other)
          {
            found.push_back(other);
            return false;
          }));
        EXPECT_EQ(found.front(), triangle);
        EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected)) << "surface " << k;
      }
    }
  }
}

// The map

/// The first hit of a light's ray, of all casters.
struct FirstHit
{
  CasterTriangle caster;
  double along = std::numeric_limits<double>::infinity();
  double margin = 0.0; ///< the least barycentric coordinate
};
FirstHit firstHit(
  const Occluders& occluders, const glm::dvec3& origin, const glm::dvec3& direction, double begin)
{
  FirstHit first;
  for (const CastingTriangle& triangle : castingTriangles(occluders))
  {
    const auto hit = meet(triangle, origin, direction);
    const bool isMet = hit && hit->isInside() && hit->at > begin && hit->at < first.along;
    if (isMet && !(occluders.surfaces[triangle.surface].oneSided && hit->cosine > 0.0))
    {
      first = { { triangle.surface, 0, triangle.triangle }, hit->at, hit->leastWeight() };
    }
  }
  return first;
}

TEST(TriangleMap, hasTheFirstTriangleAtEveryTexelsCentre)
{
  std::size_t found = 0, empty = 0;
  for (const char* name : { "spheres", "soup", "cups", "terrain", "one-sided", "crossing boxes" })
  {
    for (unsigned int seed = 1; seed <= 12; ++seed)
    {
      RandomPicture picture = makeRandomPicture(name, seed);
      const int size = std::min(picture.light.mapSizeTexels, 24);
      const bool positional = picture.light.kind != LightKind::Directional;
      const double begin = picture.light.box ? 0.0 : positional ? 1e-6 : -1e6;
      for (const LightView& view : picture.views.views)
      {
        const TriangleMap map(view, keptFromCentred(picture), size, picture.occluders);
        for (int row = 0; row < size; ++row)
        {
          for (int column = 0; column < size; ++column)
          {
            const LightRay ray = rayAt(view, size, { column + 0.5, row + 0.5 });
            const FirstHit expected = firstHit(picture.occluders, ray.origin, ray.direction, begin);
            const TriangleTexel& texel = map.texel(column, row);
            if (!(texel.caster == expected.caster))
            {
              // Rounding may decide at edges, and where triangles touch.
              const bool atEdge = expected.caster.exists() && expected.margin < 1e-6;
              const FirstHit behind =
                firstHit(picture.occluders, ray.origin, ray.direction, expected.along + 1e-12);
              const bool touches = behind.along - expected.along < 1e-5;
              EXPECT_TRUE(atEdge || touches)
                << picture.description << ", texel " << column << " " << row;
            }
            else if (expected.caster.exists())
            {
              // Depths range over 1, from the light to the farthest caster.
              const std::optional<MapPlace> hit =
                map.placeOf(ray.origin + expected.along * ray.direction, ray.direction);
              ASSERT_TRUE(hit);
              EXPECT_NEAR(texel.depth, hit->depth, 1e-5)
                << picture.description << ", texel " << column << " " << row;
            }
            found += expected.caster.exists() ? 1 : 0;
            empty += expected.caster.exists() ? 0 : 1;
          }
        }
        EXPECT_FALSE(map.texel(-1, 0).caster.exists());
        EXPECT_FALSE(map.texel(0, size).caster.exists());
      }
    }
  }
  EXPECT_GT(found, 10000u);
  EXPECT_GT(empty, 10000u);
}

// Hits that are certain

TEST(CertainHit, isAMarginAwayFromEdgesAndEnds)
{
  const Mesh triangle{ { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } },
    { { 0, 1, 2 } } };
  const Occluders occluders = makeOccluders({ { triangle } });
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const float never = std::numeric_limits<float>::infinity();
  struct Case
  {
    glm::vec3 origin, direction;
    float rayFar;
    bool hits;
  };
  for (const auto& [origin, direction, rayFar, expected] :
    { Case{ { 0.0f, 0.0f, -1.0f }, up, never, true }, { { 0.0f, 0.0f, 1.0f }, -up, never, true },
      // Beside, on and just inside an edge.
      { { 0.0f, -1.001f, -1.0f }, up, never, false }, { { 0.0f, -1.0f, -1.0f }, up, never, false },
      { { 0.0f, -0.9999999f, -1.0f }, up, never, false },
      { { 0.0f, -0.999f, -1.0f }, up, never, true },
      // Rays that start behind the triangle, on it or just before it.
      { { 0.0f, 0.0f, 1.0f }, up, never, false }, { { 0.0f, 0.0f, 0.0f }, up, never, false },
      { { 0.0f, 0.0f, -1e-7f }, up, never, false }, { { 0.0f, 0.0f, -1e-3f }, up, never, true },
      // Rays that end before the triangle, on it or just behind it.
      { { 0.0f, 0.0f, -2.0f }, up, 1.0f, false }, { { 0.0f, 0.0f, -1.0f }, up, 1.0f, false },
      { { 0.0f, 0.0f, -0.9999999f }, up, 1.0f, false }, { { 0.0f, 0.0f, -0.999f }, up, 1.0f, true },
      // Rays along the triangle.
      { { 0.0f, -3.0f, 0.0f }, { 0.0f, 1.0f, 0.0f }, never, false } })
  {
    EXPECT_EQ(certainlyStops(occluders, { 0, 0, 0 }, { origin, direction, true }, rayFar), expected)
      << origin.y << " " << origin.z << " " << rayFar;
  }
}

TEST(CertainHit, isNotOnTheBackOfOneSidedCastersAndNotOnCutouts)
{
  Prop plane{ makePlane(2.0) };
  plane.oneSided = true;
  const Occluders oneSided = makeOccluders({ plane });
  const Occluders perforated = makeOccluders({ makePerforatedPlane(2.0, 1) });
  const float never = std::numeric_limits<float>::infinity();
  const auto hits = [&](const Occluders& occluders, float height)
  {
    const ShadowRay ray{ { 0.3f, 0.1f, height }, { 0.0f, 0.0f, -height }, true };
    return certainlyStops(occluders, { 0, 0, 0 }, ray, never) ||
      certainlyStops(occluders, { 0, 0, 1 }, ray, never);
  };
  EXPECT_TRUE(hits(oneSided, -1.0f)); // the light is above, at the front
  EXPECT_FALSE(hits(oneSided, 1.0f));
  EXPECT_FALSE(hits(perforated, -1.0f));
}

// The chain

using Classes = std::vector<ChainClass>;
const Classes outsideClasses{ ChainClass::OutsideLit, ChainClass::OutsideShadow };
const Classes hintedClasses{ ChainClass::HintedLit, ChainClass::HintedShadow };
const Classes tracedClasses{ ChainClass::TracedLit, ChainClass::TracedShadow };
const Classes confirmedClasses{ ChainClass::ConfirmedByTexel, ChainClass::ConfirmedByNeighbours,
  ChainClass::ConfirmedByAdjacency, ChainClass::Corrected };

/// The result of a chain for a picture.
struct ChainRun
{
  Classes classes;
  std::vector<float> visibility;
  std::size_t traced = 0;

  bool is(std::size_t i, const Classes& of) const
  {
    return std::find(of.begin(), of.end(), this->classes[i]) != of.end();
  }
  std::size_t count(const Classes& of) const
  {
    return countBelow(this->classes.size(), [&](std::size_t i) { return this->is(i, of); });
  }
  /// Count the pixels of a traced class whose texel is wrong.
  std::size_t countWrong(ChainClass of, const std::vector<float>& truth) const
  {
    return countBelow(truth.size(),
      [&](std::size_t i)
      { return this->classes[i] == of && (truth[i] == 0.0f) == (of == ChainClass::TracedLit); });
  }
};

/// A picture with its maps and its truth, for chains of any stages.
class Chained
{
public:
  explicit Chained(RandomPicture picture)
    : picture_(std::move(picture))
    , receivers_(this->picture_.view.images, this->picture_.view.drawnSurfaces,
        this->picture_.occluders, this->stored_)
  {
    this->maps_.bake(this->picture_.views, this->picture_.light.mapSizeTexels,
      this->picture_.occluders, keptFromCentred(this->picture_));
    this->fans_.update(this->picture_.occluders, updateFans);
    this->tracer_.update(this->picture_.occluders);
    this->needRays_ = this->tracer_.trace(
      this->picture_.light, this->picture_.occluders, this->receivers_, this->truth_);
  }

  /// Run stages, and expect the properties of all chains: visibilities are those of their classes,
  /// and are wrong only if the class is no proof.
  ChainRun run(const ChainStages& stages)
  {
    std::vector<std::uint8_t> classes;
    ChainRun run;
    const ViewFitting fitting;
    int mapBakes = 0;
    const std::size_t classCount = classesOfChain().size();
    ScreenInput input{ this->picture_.light, fitting, this->picture_.occluders, this->receivers_,
      this->tracer_, mapBakes };
    input.usesMap = true;
    input.classes = &classes;
    run.traced = Chain(stages, this->maps_, nullptr, this->fans_, input).run(run.visibility);
    for (std::size_t i = 0; i < classes.size(); ++i)
    {
      EXPECT_LT(classes[i], classCount);
      run.classes.push_back(static_cast<ChainClass>(classes[i]));
      const bool saysLit = run.is(i,
        { ChainClass::OutsideLit, ChainClass::HintedLit, ChainClass::LeftLit,
          ChainClass::MajorityLit });
      const bool saysShadow = run.is(
        i, { ChainClass::OutsideShadow, ChainClass::HintedShadow, ChainClass::MajorityShadow });
      EXPECT_EQ(run.visibility[i],
        saysLit                                       ? 1.0f
          : saysShadow || run.is(i, confirmedClasses) ? 0.0f
                                                      : this->truth_[i]);
      EXPECT_TRUE(!run.is(i, confirmedClasses) || this->truth_[i] == 0.0f);
    }
    EXPECT_EQ(run.traced, run.count(tracedClasses));
    EXPECT_EQ(classes.size() - run.count({ ChainClass::NoReceiver, ChainClass::Unreached }),
      this->needRays_);
    return run;
  }

  const std::vector<float>& truth() const { return this->truth_; }
  std::size_t needRays() const { return this->needRays_; }
  const std::string& description() const { return this->picture_.description; }

private:
  RandomPicture picture_;
  ReceiverPixels stored_;
  Receivers receivers_;
  TriangleMaps maps_;
  TriangleFans fans_;
  EmbreeTracer tracer_;
  std::vector<float> truth_;
  std::size_t needRays_ = 0;
};

/// Visit chains of random pictures.
/// @param visit called with each
template <typename Names, typename Visit>
void visitChains(const Names& names, unsigned int seeds, const Visit& visit)
{
  for (const char* name : names)
  {
    for (unsigned int seed = 1; seed <= seeds; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      SCOPED_TRACE(chained.description());
      visit(chained);
    }
  }
}

/// Return all stages that prove, with the rest traced.
ChainStages provenStages(int contourPixels)
{
  ChainStages stages;
  stages.contourPixels = contourPixels;
  stages.neighbourTexels = 9;
  stages.adjacency = Adjacency::Vertices;
  return stages;
}

using ChainIn = testing::TestWithParam<const char*>;

INSTANTIATE_TEST_SUITE_P(Scenes, ChainIn, testing::ValuesIn(randomSceneNames()), byLetters);

TEST_P(ChainIn, withoutCoherenceIsNeverWrong)
{
  std::size_t proven = 0, dark = 0;
  for (unsigned int seed = 1; seed <= exactRuns(); ++seed)
  {
    Chained chained(makeRandomPicture(GetParam(), seed));
    const ChainRun image = chained.run(provenStages(0));
    EXPECT_EQ(countDifferent(image.visibility, chained.truth()), 0u) << chained.description();
    const ChainRun contour = chained.run(provenStages(4));
    for (std::size_t i = 0; i < contour.classes.size(); ++i)
    {
      // A stage that decides a pixel of the contour decides it in the whole image.
      EXPECT_TRUE(contour.is(i, outsideClasses) || contour.classes[i] == image.classes[i]);
      proven += image.is(i, confirmedClasses) ? 1 : 0;
      const bool reached = image.classes[i] != ChainClass::Unreached;
      dark += reached && chained.truth()[i] == 0.0f ? 1 : 0;
    }
  }
  // Hits in surfaces with holes are no proof.
  EXPECT_GE(proven, GetParam() == std::string("perforated") ? 0 : dark / 2);
}

TEST_P(ChainIn, isNeverWrongFarAwayAndAtAnyScale)
{
  for (const glm::dmat4& world : { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
         at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) })
  {
    for (unsigned int seed = 100; seed < 100 + exactRuns() / 6; ++seed)
    {
      Chained chained(makeRandomPicture(GetParam(), seed, world));
      EXPECT_EQ(countDifferent(chained.run(provenStages(0)).visibility, chained.truth()), 0u)
        << chained.description();
    }
  }
}

/// By 1, 4 and 9 texels, by the triangles around the texel's triangle, and by these alone. Stages
/// of texels correct pixels that their own texel calls lit; adjacency alone does not.
TEST(Chain, confirmsMoreWithMoreTriangles)
{
  constexpr std::size_t count = 7;
  constexpr std::pair<std::size_t, std::size_t> more[] = { { 0, 1 }, { 1, 2 }, { 0, 3 }, { 3, 4 },
    { 5, 3 }, { 6, 4 }, { 5, 6 } };
  std::array<ChainStages, count> stages;
  for (std::size_t k = 0; k < count; ++k)
  {
    stages[k].neighbourTexels = std::array{ 1, 4, 9, 1, 1, 0, 0 }[k];
    stages[k].adjacency = k < 3 ? Adjacency::Off
      : k % 2 == 1              ? Adjacency::Edges
                                : Adjacency::Vertices;
  }
  std::array<std::size_t, count> confirmed{}, corrected{};
  std::size_t falseLight = 0, falseShadow = 0;
  visitChains(randomSceneNames(), 3,
    [&](Chained& chained)
    {
      const ChainRun status = chained.run({});
      falseLight += status.countWrong(ChainClass::TracedLit, chained.truth());
      falseShadow += status.countWrong(ChainClass::TracedShadow, chained.truth());
      std::array<ChainRun, count> runs;
      std::transform(stages.begin(), stages.end(), runs.begin(),
        [&](const ChainStages& of) { return chained.run(of); });
      for (std::size_t i = 0; i < chained.truth().size(); ++i)
      {
        for (const auto& [fewer, all] : more)
        {
          EXPECT_TRUE(!runs[fewer].is(i, confirmedClasses) || runs[all].is(i, confirmedClasses));
        }
        // The texel's own triangle is tried first.
        EXPECT_EQ(runs[0].classes[i] == ChainClass::ConfirmedByTexel,
          runs[2].classes[i] == ChainClass::ConfirmedByTexel);
        for (std::size_t k = 0; k < count; ++k)
        {
          const bool isCorrected = runs[k].classes[i] == ChainClass::Corrected;
          EXPECT_EQ(isCorrected,
            runs[k].is(i, confirmedClasses) && status.classes[i] == ChainClass::TracedLit);
          confirmed[k] += runs[k].is(i, confirmedClasses) ? 1 : 0;
          corrected[k] += isCorrected ? 1 : 0;
        }
      }
    });
  for (const auto& [fewer, all] : more)
  {
    EXPECT_LT(confirmed[fewer], confirmed[all]);
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    EXPECT_EQ(corrected[k] > 0, k < 5) << k;
    EXPECT_LT(corrected[k], falseLight) << k;
  }
  EXPECT_GT(falseShadow, 0u);
}

/// Wrong and counted pixels of one setting, over many pictures.
struct ChainSum
{
  std::size_t wrong = 0;
  std::size_t counted = 0;
};

TEST(Chain, stagesChangeOnlyPixelsOfTheirOwn)
{
  ChainSum outside, checked, four, nine;
  visitChains(randomSceneNames(), 6,
    [&](Chained& chained)
    {
      const auto run = [&](ChainStages stages, const auto& set)
      {
        set(stages);
        return chained.run(stages);
      };
      const ChainRun status = chained.run({}), proven = chained.run(provenStages(4));
      const ChainRun byCheck =
        run(provenStages(4), [](ChainStages& of) { of.outside = OutsideContour::Check; });
      const ChainRun byFour = run({}, [](ChainStages& of) { of.coherenceTexels = 4; });
      const ChainRun byNine = run({}, [](ChainStages& of) { of.coherenceTexels = 9; });
      const ChainRun hinted = run(provenStages(4), [](ChainStages& of) { of.coherenceTexels = 4; });
      const ChainRun lit =
        run(provenStages(4), [](ChainStages& of) { of.leftovers = Leftovers::Lit; });
      const ChainRun majority =
        run(provenStages(4), [](ChainStages& of) { of.leftovers = Leftovers::Majority; });
      EXPECT_EQ(lit.traced + majority.traced, 0u);
      for (std::size_t i = 0; i < status.classes.size(); ++i)
      {
        EXPECT_EQ(hinted.is(i, outsideClasses), proven.is(i, outsideClasses));
        EXPECT_TRUE(!byCheck.is(i, outsideClasses) || proven.is(i, outsideClasses));
        EXPECT_TRUE(!byNine.is(i, hintedClasses) || byNine.classes[i] == byFour.classes[i]);
        EXPECT_TRUE(!byFour.is(i, hintedClasses) ||
          (byFour.classes[i] == ChainClass::HintedShadow) ==
            (status.classes[i] == ChainClass::TracedShadow));
        // Pixels that the light does not reach are dark by definition, and need no hint.
        EXPECT_EQ(
          byFour.classes[i] == ChainClass::Unreached, status.classes[i] == ChainClass::Unreached);
        const bool isLeft = proven.is(i, tracedClasses);
        EXPECT_EQ(lit.classes[i], isLeft ? ChainClass::LeftLit : proven.classes[i]);
        EXPECT_TRUE(isLeft ? majority.is(i, { ChainClass::MajorityLit, ChainClass::MajorityShadow })
                           : majority.classes[i] == proven.classes[i]);
      }
      const auto add = [&](ChainSum& sum, const ChainRun& of, const Classes& what)
      {
        sum.wrong += countDifferent(of.visibility, chained.truth());
        sum.counted += of.count(what);
      };
      add(outside, proven, outsideClasses);
      add(checked, byCheck, outsideClasses);
      add(four, byFour, hintedClasses);
      add(nine, byNine, hintedClasses);
    });
  EXPECT_GT(outside.wrong, 0u);
  EXPECT_LE(checked.wrong, outside.wrong);
  EXPECT_LT(checked.counted, outside.counted);
  EXPECT_LT(nine.counted, four.counted);
  EXPECT_LT(nine.wrong, four.wrong);
  EXPECT_GT(nine.wrong, 0u); // texels that agree may be wrong
  EXPECT_LT(four.wrong, four.counted / 50);
}

Chained sunlit(const std::vector<Prop>& props, const glm::dvec3& direction, int mapSize,
  const glm::dvec3& cameraAt)
{
  RandomPicture picture;
  picture.occluders = makeOccluders(props);
  picture.light = directionalLight(direction);
  picture.light.mapSizeTexels = mapSize;
  picture.views = viewsOf(picture.light, picture.occluders);
  Camera camera;
  camera.position = cameraAt;
  picture.view = makeView(picture.occluders, camera);
  return Chained(picture);
}

TEST(Chain, hasNoAcneOnSmoothSurfaces)
{
  // Closed and open, convex and concave bodies, and a plane; outside the contours they are right.
  const Mesh ball = makeSphere(60, 120);
  Mesh bowl = ball; // its rings begin at the top
  bowl.triangles.erase(bowl.triangles.begin(),
    bowl.triangles.begin() + static_cast<std::ptrdiff_t>(bowl.triangles.size() / 2));
  for (const glm::dvec3& direction :
    { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.5, 0.3, -1.0), glm::dvec3(1.0, 0.0, -0.4) })
  {
    Chained chained = sunlit(
      { { makePlane(8.0, 16) }, { ball, at({ 0.0, 1.5, 1.0 }) }, { bowl, at({ 0.0, -1.5, 1.2 }) } },
      direction, 256, { -6.0, -2.0, 7.0 });
    const ChainRun run = chained.run(provenStages(6));
    EXPECT_EQ(countBelow(run.classes.size(),
                [&](std::size_t i)
                { return run.is(i, outsideClasses) && run.visibility[i] < chained.truth()[i]; }),
      0u);
    // Little except shadows' edges is traced.
    EXPECT_LT(run.count(tracedClasses), chained.needRays() / 8);
  }
}

} // namespace
} // namespace gnomon::test
