// Hybrid techniques with conservative maps on characteristic scenes: seams between triangles, holes
// at vertices, slivers, thin plates, open cups, poles. Exact techniques are never wrong. Those as
// published are wrong where their construction is.

#include "shadowtech/exact/ConservativeMaps.h"
#include "shadowtech/published/PublishedMap.h"

#include "RandomScenes.h"

#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr double pi = 3.14159265358979;
constexpr int mapSizes[] = { 64, 256, 1024 };

/// A sphere whose points are moved along their radii by up to half of `noise`.
Mesh makeRoughSphere(int rings, double noise, Random& random)
{
  Mesh mesh = makeSphere(rings, 2 * rings);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    // Each ring begins at the poles with one place, which stays one.
    const bool isPole = i < static_cast<std::size_t>(2 * rings) ||
      i >= mesh.points.size() - static_cast<std::size_t>(2 * rings);
    mesh.points[i] *= isPole ? 1.0 : 1.0 + noise * uniform(random, -0.5, 0.5);
  }
  return mesh;
}

/// Make bodies over a plane that do not touch each other.
/// @param radii of spheres around them, the least and the most
/// @param make called for each body; it lies within the unit sphere
std::vector<Prop> scatteredMeshes(
  int count, const glm::dvec2& radii, Random& random, const std::function<Mesh()>& make)
{
  std::vector<Prop> props{ { makePlane(2.0) } };
  std::vector<glm::dvec4> taken;
  while (count > 0)
  {
    const double radius = uniform(random, radii.x, radii.y);
    const glm::dvec3 place(uniform(random, -0.75, 0.75), uniform(random, -0.75, 0.75),
      uniform(random, 0.05 + radius, 1.6 - radius));
    if (std::all_of(taken.begin(), taken.end(),
          [&](const glm::dvec4& other)
          { return glm::distance(place, glm::dvec3(other)) > 1.05 * (radius + other.w); }))
    {
      taken.emplace_back(place, radius);
      props.push_back({ make(),
        glm::rotate(at(place, radius), uniform(random, 0.0, 2.0 * pi), unitVector(random)) });
      --count;
    }
  }
  return props;
}

Mesh scaled(Mesh mesh, const glm::dvec3& by)
{
  for (glm::dvec3& point : mesh.points)
  {
    point *= by;
  }
  return mesh;
}

std::vector<Prop> makeSpheres()
{
  Random random(100);
  return scatteredMeshes(
    12, { 0.1, 0.24 }, random, [&] { return makeRoughSphere(20, 0.002, random); });
}

std::vector<Prop> makeSlivers()
{
  Random random(101);
  return scatteredMeshes(60, { 0.06, 0.16 }, random,
    [&]
    {
      const double height = uniform(random, 0.15, 0.45);
      return scaled(makeRoughSphere(9, 0.5, random), { 1.0, 1.0, height });
    });
}

std::vector<Prop> makeThinPlates()
{
  Random random(102);
  return scatteredMeshes(16, { 0.18, 0.2 }, random,
    [&]
    {
      const double breadth = uniform(random, 0.1, 0.3);
      return scaled(makeRoughSphere(5, 0.0, random), { 1.0, breadth, 0.05 });
    });
}

/// Open at the bottom, so most of the surface faces the light.
std::vector<Prop> makeDomes()
{
  Random random(103);
  std::vector<Prop> props{ { makePlane(2.0) } };
  for (int i = 0; i < 9; ++i)
  {
    const glm::dmat4 place =
      at({ 0.5 * (i % 3) - 0.5, 0.5 * (i / 3) - 0.5, uniform(random, 0.3, 0.9) },
        uniform(random, 0.1, 0.22));
    props.push_back({ makeCup(16, 32), glm::rotate(place, pi, { 1.0, 0.0, 0.0 }) });
  }
  return props;
}

/// Make a plate that faces down, off the map's grid, of triangles around its middle or of two
/// triangles. It receives nothing, because its other side is visible.
std::vector<Prop> makePlate(bool withMiddle)
{
  Mesh plate;
  plate.points = { { -0.52, -0.47, 0.0 }, { 0.49, -0.51, 0.0 }, { 0.53, 0.48, 0.0 },
    { -0.5, 0.54, 0.0 }, { 0.013, 0.021, 0.0 } };
  plate.triangles = withMiddle
    ? std::vector<glm::uvec3>{ { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } }
    : std::vector<glm::uvec3>{ { 1, 0, 3 }, { 1, 3, 2 } };
  return { { makePlane(2.0) }, { plate, at({ 0.0, 0.0, 0.5 }), true, false } };
}

/// A map's answers for a scene's receivers, against the truth.
struct Verdict
{
  double uncertain = 0.0; ///< share of the receivers that face the light
  std::size_t falseLight = 0;
  std::size_t falseShadow = 0;
  std::vector<std::uint8_t> classes; ///< each receiver's TracedClass
  bool is(std::size_t receiver, TracedClass what) const
  {
    return static_cast<TracedClass>(this->classes[receiver]) == what;
  }
  std::size_t wrong() const { return this->falseLight + this->falseShadow; }
};

/// A scene, its receivers, and the truth.
class HybridScene
{
public:
  explicit HybridScene(
    const std::vector<Prop>& props, const glm::dvec3& direction = { 0.1, 0.07, -1.0 })
    : light_(directionalLight(direction))
    , occluders_(makeOccluders(props))
  {
    this->receivers_ = makeReceivers(
      this->occluders_, { { 2.0, -1.2, 3.2 }, { 0.0, 0.0, 0.4 }, { 0.0, 0.0, 1.0 }, 36.0 });
    this->tracer_.update(this->occluders_);
  }

  ReceiverPixels& receivers() { return this->receivers_; }
  const Occluders& occluders() const { return this->occluders_; }

  std::vector<float> truth()
  {
    std::vector<float> truth;
    this->tracer_.trace(this->light_, this->occluders_, this->receivers_, truth);
    return truth;
  }

  Verdict ask(const MapRule& rule, int size)
  {
    const ShadowLight light = withMap(this->light_, size);
    ConservativeMaps maps;
    maps.bake(light, viewsOf(light, this->occluders_), this->occluders_, rule);
    Verdict verdict;
    std::vector<float> visibility;
    const std::vector<float> truth = this->truth();
    const std::size_t traced = this->tracer_.trace(
      light, this->occluders_, this->receivers_, visibility, &maps, &verdict.classes);
    const auto count = [&](const auto& holds) { return countBelow(truth.size(), holds); };
    const std::size_t all = count(
      [&](std::size_t i) {
        return !verdict.is(i, TracedClass::Unreached) && !verdict.is(i, TracedClass::NoReceiver);
      });
    EXPECT_EQ(traced, count([&](std::size_t i) { return verdict.is(i, TracedClass::Traced); }))
      << "a ray for each of them, and no other";
    verdict.uncertain = static_cast<double>(traced) / static_cast<double>(all);
    verdict.falseLight = count([&](std::size_t i) { return visibility[i] > truth[i]; });
    verdict.falseShadow = count([&](std::size_t i) { return visibility[i] < truth[i]; });
    return verdict;
  }

private:
  ShadowLight light_;
  Occluders occluders_;
  ReceiverPixels receivers_;
  EmbreeTracer tracer_;
};

const MapRule crsm = certainRule(Covering::Triangle);
const MapRule crsma = certainRule(Covering::Ring);
const MapRule fan = certainRule(Covering::Fan);
const MapRule silhouette = certainRule(Covering::Silhouette);
const MapRule publishedCrsm = publishedRule(PublishedLayers::Crsm);
const MapRule publishedCrsma = publishedRule(PublishedLayers::Crsma);

struct NamedScene
{
  const char* name;
  std::vector<Prop> (*make)();
};
const NamedScene closedScenes[] = { { "two triangles", [] { return makePlate(false); } },
  { "fan", [] { return makePlate(true); } }, { "spheres", makeSpheres }, { "slivers", makeSlivers },
  { "thin plates", makeThinPlates } };

bool sameLight(const Verdict& a, const Verdict& b)
{
  return countBelow(a.classes.size(),
           [&](std::size_t i)
           { return a.is(i, TracedClass::Lit) != b.is(i, TracedClass::Lit); }) == 0;
}

TEST(HybridScenes, areRightWithBoundsAndLessUncertainTheMoreIsKnownOfNeighbours)
{
  for (const NamedScene& named : closedScenes)
  {
    HybridScene scene(named.make());
    for (const int size : mapSizes)
    {
      const std::string what = std::string(named.name) + ", map " + std::to_string(size);
      const auto askExact = [&](const MapRule& rule)
      {
        const Verdict verdict = scene.ask(rule, size);
        EXPECT_EQ(verdict.wrong(), 0u) << what;
        return verdict;
      };
      const Verdict alone = askExact(crsm), ring = askExact(crsma), corners = askExact(fan),
                    edges = askExact(silhouette);
      EXPECT_LE(ring.uncertain, alone.uncertain) << what;
      EXPECT_LE(corners.uncertain, ring.uncertain) << what;
      EXPECT_LE(edges.uncertain, ring.uncertain) << what;
      EXPECT_TRUE(sameLight(alone, ring)) << what;
      EXPECT_TRUE(sameLight(alone, corners)) << what;
      const Verdict published = scene.ask(publishedCrsm, size);
      const Verdict publishedRing = scene.ask(publishedCrsma, size);
      EXPECT_LE(publishedRing.uncertain, published.uncertain) << what;
      EXPECT_TRUE(sameLight(published, publishedRing)) << what;
    }
  }
}

TEST(HybridScenes, ofSliversAreSometimesWrongAsPublished)
{
  HybridScene scene(makeSlivers());
  const Verdict verdict = scene.ask(publishedCrsm, 64);
  EXPECT_GT(verdict.wrong(), 0u);
  EXPECT_LT(verdict.wrong(), verdict.classes.size() / 100);
}

TEST(HybridScenes, ofThinPlatesHaveFalseShadowsWithNeighboursAsPublished)
{
  // A neighbour thinner than the texel does not cover the rest of the texel.
  HybridScene scene(makeThinPlates());
  EXPECT_GT(scene.ask(publishedCrsma, 256).falseShadow, 0u);
}

TEST(HybridScenes, ofSpheresAreMuchLessUncertainByTheirSilhouette)
{
  HybridScene scene(makeSpheres());
  const auto uncertainOnGround = [&](const Verdict& verdict)
  {
    return static_cast<double>(countBelow(verdict.classes.size(),
      [&](std::size_t i)
      { return scene.receivers().surface[i] == 0 && verdict.is(i, TracedClass::Traced); }));
  };
  const Verdict edges = scene.ask(silhouette, 64);
  const Verdict alone = scene.ask(crsm, 64);
  EXPECT_LE(uncertainOnGround(edges), 0.45 * uncertainOnGround(alone));
  // For receivers on the spheres, which cast with both sides, neither rule decides many at this
  // size.
  EXPECT_LE(edges.uncertain, 0.62 * alone.uncertain);
}

TEST(HybridScenes, withOpenDomesHaveFalseLightAsPublishedTheMoreTheFinerTheMap)
{
  // The domes face the light, and no surface lies behind them: both layers agree that nothing
  // casts.
  HybridScene scene(makeDomes());
  std::size_t before = 0;
  for (const int size : mapSizes)
  {
    for (const MapRule& rule : { crsm, crsma, fan, silhouette })
    {
      EXPECT_EQ(scene.ask(rule, size).wrong(), 0u) << size;
    }
    const std::size_t falseLight = scene.ask(publishedCrsm, size).falseLight;
    EXPECT_GT(falseLight, 0u) << size;
    EXPECT_GE(falseLight, before) << size;
    EXPECT_GE(scene.ask(publishedCrsma, size).falseLight, 1u) << size;
    before = falseLight;
  }
}

TEST(HybridScenes, withAPoleThinnerThanATexelHaveItsShadowTraced)
{
  HybridScene scene(
    { { makePlane(2.0) }, { makeBox({ -0.004, -0.004, 0.05 }, { 0.004, 0.004, 0.9 }) } },
    { 0.7, 0.2, -1.0 });
  const std::vector<float> truth = scene.truth();
  for (const MapRule& rule : { crsm, publishedCrsm })
  {
    const Verdict verdict = scene.ask(rule, 64);
    EXPECT_EQ(verdict.wrong(), 0u);
    const auto countOnGround = [&](const auto& holds)
    {
      return countBelow(
        truth.size(), [&](std::size_t i) { return scene.receivers().surface[i] == 0 && holds(i); });
    };
    EXPECT_GT(countOnGround([&](std::size_t i) { return truth[i] == 0.0f; }), 50u);
    EXPECT_EQ(countOnGround([&](std::size_t i) { return verdict.is(i, TracedClass::Shadow); }), 0u);
  }
}

/// Count the uncertain receivers of a fine grid under a plate, away from its outer edges.
/// @param within of its middle; else everywhere
std::size_t uncertainUnder(HybridScene& scene, const MapRule& rule, int size, double within)
{
  constexpr int count = 400;
  ReceiverPixels& receivers = scene.receivers();
  receivers.resize(count, count);
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const glm::dvec3 centred = glm::dvec3(0.8 * (static_cast<double>(i % count) / count - 0.5),
                                 0.8 * (static_cast<double>(i / count) / count - 0.5), 0.0) -
      scene.occluders().frame.centre;
    receivers.put(i, centred, { 0.0f, 0.0f, 1.0f }, 1e-6f, 0);
  }
  const Verdict verdict = scene.ask(rule, size);
  EXPECT_EQ(verdict.wrong(), 0u);
  return countBelow(receivers.size(),
    [&](std::size_t i)
    {
      const glm::dvec3 at = glm::dvec3(receivers.position(i)) + scene.occluders().frame.centre;
      return glm::distance(glm::dvec2(at), { 0.013, 0.021 }) <= within &&
        verdict.is(i, TracedClass::Traced);
    });
}

TEST(HybridScenes, haveNoSeamBetweenTwoTrianglesThatKnowEachOther)
{
  HybridScene scene(makePlate(false), { 0.0, 0.0, -1.0 });
  for (const MapRule& rule : { crsm, publishedCrsm })
  {
    EXPECT_GT(uncertainUnder(scene, rule, 64, 1.0), 0u);
  }
  for (const MapRule& rule : { crsma, fan, silhouette, publishedCrsma })
  {
    EXPECT_EQ(uncertainUnder(scene, rule, 64, 1.0), 0u);
  }
}

TEST(HybridScenes, haveAHoleWhereTrianglesMeetInACornerButForFansAndSilhouettes)
{
  HybridScene scene(makePlate(true), { 0.0, 0.0, -1.0 });
  const double texel = 2.0 / 64.0;
  for (const MapRule& rule : { publishedCrsma, crsma })
  {
    EXPECT_GT(uncertainUnder(scene, rule, 64, texel), 0u);
  }
  for (const MapRule& rule : { fan, silhouette })
  {
    EXPECT_EQ(uncertainUnder(scene, rule, 64, 1.0), 0u);
  }
}

} // namespace
} // namespace gnomon::test
