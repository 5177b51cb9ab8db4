// Techniques with soft shadows x area lights of all kinds: near rays, and near closed forms.

#include "AreaLights.h"
#include "HalfPlane.h"

namespace gnomon::test
{
namespace
{

constexpr const char* softTechniques[] = { "raytraced", "penumbra", "sampled", "coherence", "pcss",
  "montecarlo", "planar" };

struct SoftLights : PassTestOf<AreaLight>
{
  SoftLights()
  {
    this->scene.addThings();
    this->light = GetParam().add(this->scene);
  }

  PassScene scene{ 140, 100 };
  vtkLight* light;
};
INSTANTIATE_TEST_SUITE_P(All, SoftLights, testing::ValuesIn(plainAreaLights()), byName);

} // namespace

TEST_P(SoftLights, areNearRaysByEachTechnique)
{
  this->scene.set("light_samples", 1024);
  const std::vector<float> truth = this->scene.visibilityBy("raytraced");
  EXPECT_GT(countBetween(truth), 100u);
  this->scene.set("light_samples", 128);
  const bool hasOneView = !this->light->GetPositional() || this->light->GetConeAngle() <= 60.0;
  for (const auto& [fit, projection] : { std::pair("off", "uniform"), { "frame", "uniform" },
         { "frame", "lispsm" }, { "frame", "tsm" }, { "frame", "pssm" } })
  {
    SCOPED_TRACE(std::string(fit) + " " + projection);
    if (hasOneView || projection == std::string("uniform"))
    {
      this->scene.set("fit", fit);
      this->scene.set("projection", projection);
      const double hard = meanDifference(this->scene.visibilityBy("nsm"), truth);
      const double guessed = meanDifference(this->scene.visibilityBy("pcss"), truth);
      EXPECT_LT(guessed, 0.0015);
      EXPECT_LT(guessed, 0.25 * hard);
      this->scene.set("projection", "technique");
    }
    if (projection == std::string("uniform")) // `sampled` has no other
    {
      EXPECT_LT(meanDifference(this->scene.visibilityBy("sampled"), truth), 0.003);
    }
  }
  this->scene.set("light_samples", 64);
  const std::vector<float> traced = this->scene.visibilityBy("raytraced");
  EXPECT_EQ(this->scene.visibilityBy("penumbra"), traced);
  this->scene.visibilityBy("coherence");
  EXPECT_EQ(this->scene.report().mapBakes, 8);
  const Hints hints = hintsOf(this->scene.pass->GetVisibility(), traced);
  EXPECT_LE(hints.traced, 0.08);
  EXPECT_LE(hints.wrong, 0.0015);
  EXPECT_LE(hints.worst, 0.05);
  const LightReport& report = this->scene.report().lights[0];
  EXPECT_EQ(report.rays, 64 * report.tracedPixels);
}

/// `montecarlo` searches the same points of the light as jittered rays.
TEST_P(SoftLights, areWhatRaysToTheSamePointsShow)
{
  this->scene.choose("light_sampling=jittered light_samples=9");
  const std::vector<float> truth = this->scene.visibilityBy("raytraced");
  this->scene.set("mc_filter", 0);
  const std::vector<float> seen = this->scene.visibilityBy("montecarlo");
  EXPECT_LT(meanDifference(seen, truth), 0.004);
  EXPECT_LT(countDifferences(seen, truth, 0.5), truth.size() / 1000);
}

TEST_P(SoftLights, withoutSizeHaveHardShadows)
{
  scaleArea(this->light, 0.0);
  const std::vector<float> hard = this->scene.visibilityBy("nsm");
  const std::vector<float> traced = this->scene.visibilityBy("raytraced");
  EXPECT_EQ(countBetween(traced), 0u);
  EXPECT_EQ(this->scene.visibilityBy("penumbra"), traced);
  EXPECT_EQ(this->scene.visibilityBy("sampled"), hard);
  EXPECT_EQ(this->scene.visibilityBy("pcss"), hard);
  EXPECT_EQ(countBetween(this->scene.visibilityBy("coherence")), 0u);
  for (const int filter : { 0, 5 })
  {
    this->scene.set("mc_filter", filter);
    EXPECT_LE(countDifferences(this->scene.visibilityBy("montecarlo"), hard, 0.01), 5u) << filter;
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, 1);
  }
}

TEST_P(SoftLights, showTheSameInBatchesOfAnySize)
{
  this->scene.set("light_samples", 13);
  const std::vector<float> seen = this->scene.visibilityBy("sampled");
  for (const int batch : { 1, 3, 5 })
  {
    this->scene.set("batch", batch);
    this->scene.set("light_seed", batch); // nothing is then reused
    this->scene.visibilityBy("sampled");
    this->scene.set("light_seed", 0);
    EXPECT_EQ(this->scene.visibilityBy("sampled"), seen) << batch;
    EXPECT_EQ(this->scene.report().mapBakes, 13);
  }
}

/// Techniques without samples of lights show the centre's shadow.
TEST(HardTechniques, showAreaLightsAsTheirCentre)
{
  PassScene scene(140, 100);
  scene.addThings();
  auto* light = addRectangle(scene, { -2.0, -2.5, 6.0 }, glm::dvec3(0.0), 3.0, 50.0);
  int hard = 0;
  for (const TechniqueEntry& technique : registry())
  {
    if (std::find(std::begin(softTechniques), std::end(softTechniques), technique.name) ==
      std::end(softTechniques))
    {
      ++hard;
      light->SetWidth(3.0);
      const std::vector<float> large = scene.visibilityBy(technique.name.c_str());
      EXPECT_EQ(scene.report().lights[0].lightSamples, 1);
      light->SetWidth(0.0);
      light->SetHeight(0.0);
      EXPECT_EQ(scene.visibilityBy(technique.name.c_str()), large) << technique.name;
      light->SetHeight(1.8);
    }
  }
  EXPECT_GE(hard, 10);
}

namespace
{

/// A light over a half plane, and the share of it that a place of the floor sees.
struct PastEdge
{
  const char* name;
  vtkLight* (*add)(PassScene& scene);
  double (*exact)(double x);
};

/// A technique, with settings that take many samples, and the largest error of a column's mean.
struct Estimate
{
  const char* technique;
  const char* setting;
  int value;
  double mostOff;
  bool hasNoBands;
  bool ofBalls = true; ///< false: a ball's cube map is too coarse, or its points are too few
};

const LampPastEdge lampPastEdge{ HalfPlaneScene::edgeHeight, 10.0, 1.0 };
const SunPastEdge sunPastEdge{ HalfPlaneScene::edgeHeight, std::tan(glm::radians(5.0)) };
const glm::dvec3 overEdge(0.0, 0.0, 10.0);
const PastEdge pastEdges[] = {
  { "rectangle",
    [](PassScene& scene) -> vtkLight*
    {
      vtkGnomonAreaLight* light = addRectangle(scene, overEdge, glm::dvec3(0.0), 2.0, 50.0);
      light->SetUp(0.0, 1.0, 0.0);
      return light;
    },
    [](double x) { return lampPastEdge.square(x); } },
  { "disk",
    [](PassScene& scene) -> vtkLight*
    { return addDisk(scene, overEdge, glm::dvec3(0.0), 1.0, 50.0); },
    [](double x) { return lampPastEdge.disk(x); } },
  { "ball", [](PassScene& scene) { return addBall(scene, overEdge, "1"); },
    [](double x) { return lampPastEdge.ball(x); } },
  { "sun",
    [](PassScene& scene) {
      return addSoftSun(scene, { 0.0, 0.0, -1.0 }, "10");
    },
    [](double x) { return sunPastEdge.disk(x); } },
};
// All pixels see the same points of `sampled` and `planar`: up to 512, they show as bands.
// Without its filter, `montecarlo` ends casters with a texel.
const Estimate estimates[] = { { "raytraced", "light_samples", 256, 0.01, true },
  { "penumbra", "light_samples", 256, 0.01, true },
  { "coherence", "light_samples", 256, 0.01, true, false },
  { "planar", "light_samples", 256, 0.02, false, false },
  { "sampled", "light_samples", 256, 0.02, false }, { "sampled", "light_samples", 512, 0.02, true },
  { "pcss", "map_size", 1024, 0.012, true }, { "pcss", "map_size", 4096, 0.012, true },
  { "montecarlo", "mc_filter", 0, 0.017, false, false },
  { "montecarlo", "mc_filter", 5, 0.02, true, false } };

using Penumbras = testing::TestWithParam<PastEdge>;
INSTANTIATE_TEST_SUITE_P(All, Penumbras, testing::ValuesIn(pastEdges), byName);

} // namespace

/// Mean visibility falls from column to column as the share of the light does, without bands.
TEST_P(Penumbras, areThoseOfGeometry)
{
  HalfPlaneScene scene(200, 200, 1.0);
  GetParam().add(scene);
  std::vector<double> exact;
  double steepest = 0.0;
  for (int x = 0; x < 200; ++x)
  {
    exact.push_back(GetParam().exact(scene.floorAt(x, 0).x));
    steepest = std::max(steepest, x > 0 ? exact[x] - exact[x - 1] : 0.0);
  }
  for (const Estimate& estimate : estimates)
  {
    if (GetParam().name == std::string("ball") && !estimate.ofBalls)
    {
      continue;
    }
    SCOPED_TRACE(std::string(estimate.technique) + " " + std::to_string(estimate.value));
    scene.choose("light_samples=256 map_size=1024");
    scene.set(estimate.setting, estimate.value);
    scene.visibilityBy(estimate.technique);
    const std::vector<double> profile = columnMeans(scene.pass->GetVisibility());
    double mostOff = 0.0;
    double step = 0.0;
    for (std::size_t x = 0; x < exact.size(); ++x)
    {
      mostOff = std::max(mostOff, std::abs(profile[x] - exact[x]));
      step = std::max(step, x > 0 ? std::abs(profile[x] - profile[x - 1]) : 0.0);
    }
    EXPECT_LE(mostOff, estimate.mostOff);
    EXPECT_NEAR(widthOf(profile) / widthOf(exact), 1.0, 0.02);
    // A rectangle's points lie in rows along the edge, which all pixels see alike.
    const bool hasRows =
      GetParam().name == std::string("rectangle") && estimate.technique == std::string("sampled");
    if (estimate.hasNoBands && !hasRows)
    {
      EXPECT_LT(step, 1.4 * steepest);
    }
  }
}

} // namespace gnomon::test
