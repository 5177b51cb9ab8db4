// The whole table of compositions: those that exist, and those that are refused.

#include "shadowtech/Registry.h"

#include "lights/SettingsTable.h"
#include "lights/ShadowLight.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::test
{
namespace
{

ShadowLight lightOf(LightKind kind, double coneAngleDegrees = 0.0)
{
  ShadowLight light;
  light.kind = kind;
  light.coneAngleDegrees = coneAngleDegrees;
  return light;
}

/// "" if the light can have it, else a word of the reason.
struct Verdicts
{
  const char* sun;
  const char* spot;
  const char* wideSpot;
  const char* point;
};

void expectVerdict(ShadowLight light, const std::string& word, const std::string& what)
{
  try
  {
    compose(light);
    EXPECT_EQ(word, "") << what << " is taken";
  }
  catch (const CompositionError& error)
  {
    EXPECT_NE(word, "") << what << ": " << error.what();
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

void expectVerdicts(
  const ShadowSettings& settings, const Verdicts& verdicts, const std::string& what)
{
  const auto check = [&](ShadowLight light, const char* word)
  {
    static_cast<ShadowSettings&>(light) = settings;
    expectVerdict(light, word, what);
  };
  check(lightOf(LightKind::Directional), verdicts.sun);
  check(lightOf(LightKind::Spot, 30.0), verdicts.spot);
  check(lightOf(LightKind::Spot, 70.0), verdicts.wideSpot);
  check(lightOf(LightKind::Point), verdicts.point);
}

TEST(Registry, hasEveryTechniqueOnceAndItsEstimator)
{
  for (const TechniqueEntry& technique : registry())
  {
    EXPECT_EQ(findTechnique(technique.name), &technique);
    ASSERT_TRUE(technique.estimator) << technique.name;
    EXPECT_FALSE(technique.summary.empty());
    EXPECT_FALSE(baseOf(technique.estimator->create()).bytesOfMaps() > (1u << 20));
  }
  for (const EstimatorEntry& estimator : estimators())
  {
    EXPECT_EQ(findEstimator(estimator.info.name), &estimator);
  }
  EXPECT_EQ(findTechnique("magic"), nullptr);
  EXPECT_EQ(findTechnique(automaticTechnique), nullptr) << "it stands for others";
  EXPECT_TRUE(findTechnique(plainTechnique)->estimator->info.isPointwise());
}

TEST(Registry, knowsWhichEstimatorsAreFunctionsOfThePoint)
{
  for (const EstimatorEntry& estimator : estimators())
  {
    ShadowLight light = lightOf(LightKind::Directional);
    light.estimator = estimator.info.name;
    compose(light);
    const AnyTechnique technique = estimator.create();
    EXPECT_EQ(technique.index(), static_cast<std::size_t>(estimator.info.evaluation));
    if (const auto* pointwise = std::get_if<std::unique_ptr<PointwiseTechnique>>(&technique))
    {
      EXPECT_NE((*pointwise)->visibilityGlsl(light), "") << estimator.info.name;
    }
  }
  EXPECT_EQ(findEstimator("planar")->info.evaluation, Evaluation::ScreenGpu);
  EXPECT_EQ(findEstimator("montecarlo")->info.evaluation, Evaluation::ScreenGpu);
  EXPECT_EQ(findEstimator("sampled")->info.evaluation, Evaluation::ScreenGpu);
  EXPECT_EQ(findEstimator("raytraced")->info.evaluation, Evaluation::ScreenCpu);
}

TEST(Registry, takesOrRefusesEveryComposition)
{
  const Verdicts all{ "", "", "", "" };
  const Verdicts single{ "", "", "faces of a cube", "faces of a cube" };
  const Verdicts cube{ "directional", "", "", "" };
  const char* camera = "holds all casters";
  const Verdicts allCasters{ camera, camera, camera, camera };
  const char* points = "uniform and cube";
  const Verdicts uniform{ points, points, points, points };
  for (const TechniqueEntry& technique : registry())
  {
    ShadowSettings settings;
    settings.technique = technique.name;
    const bool warps =
      technique.estimator->info.bakesMap() && technique.projection != Projection::Uniform;
    expectVerdicts(settings, warps ? single : all, technique.name);

    for (const EstimatorEntry& estimator : estimators())
    {
      settings.estimator = estimator.info.name;
      const bool map = estimator.info.bakesMap();
      const std::string what = technique.name + " with " + settings.estimator;
      const auto expectOf = [&](Projection projection, const Verdicts& verdicts)
      {
        settings.projection = projection;
        expectVerdicts(settings, map ? verdicts : all,
          what + ", projection " + findSetting("projection")->get(settings));
      };
      expectOf(Projection::Uniform, all);
      const Verdicts& divided = settings.estimator == "sampled" ? uniform
        : settings.estimator == "montecarlo"                    ? allCasters
                                                                : single;
      expectOf(Projection::Lispsm, divided);
      expectOf(Projection::Trapezoid, divided);
      expectOf(Projection::Splits, divided);
      expectOf(Projection::Cube, cube);
    }
  }
}

/// Return a setting's choices as a list.
std::string choicesOf(const char* setting)
{
  return listOf(std::get<ChoiceSetting>(findSetting(setting)->values).names);
}

TEST(Registry, settingsNameItsEntries)
{
  EXPECT_EQ(choicesOf("technique"), techniqueNames());
  EXPECT_EQ(choicesOf("estimator"), estimatorNames());
}

TEST(Registry, keysHoldTheSettingsOfAnEstimatorAndOfItsMap)
{
  const TechniqueInfo& info = findEstimator("pcf")->info;
  const auto changesKey = [&](const char* setting, const char* value, SettingsOf of)
  {
    ShadowSettings settings;
    EXPECT_TRUE(findSetting(setting)->set(settings, value));
    return settingsOf(info, of, settings) != settingsOf(info, of, ShadowSettings());
  };
  EXPECT_TRUE(changesKey("kernel_size", "5", SettingsOf::Estimator));
  EXPECT_FALSE(changesKey("kernel_size", "5", SettingsOf::Map));
  EXPECT_TRUE(changesKey("bias_slope", "2", SettingsOf::Estimator));
  EXPECT_TRUE(changesKey("bias_slope", "2", SettingsOf::Map));
  EXPECT_FALSE(changesKey("mc_rays", "5", SettingsOf::Estimator));
  EXPECT_FALSE(changesKey("mc_layers", "eye", SettingsOf::Map));
}

TEST(Registry, listsTheTechniquesOfASetting)
{
  EXPECT_EQ(
    whoHas(*findSetting("map_samples")), "the setting 'map_samples' is for: esm, vsm, evsm, msm");
  EXPECT_EQ(
    whoHas(*findSetting("as_published")), "the setting 'as_published' is for: pcss, crsm, crsma");
  for (const EstimatorEntry& estimator : estimators())
  {
    const TechniqueInfo& info = estimator.info;
    EXPECT_TRUE(has(info, "technique") && has(info, "light_radius")) << info.name;
    EXPECT_FALSE(has(info, "magic")) << info.name;
    EXPECT_EQ(has(info, "map_size"), info.bakesMap()) << info.name;
    EXPECT_EQ(has(info, "bake"), info.mapIsOptional) << info.name;
    EXPECT_TRUE(!info.mapIsOptional || (info.exact && info.bakesMap())) << info.name;
    EXPECT_EQ(has(info, "as_published"), !info.asPublished.empty()) << info.name;
  }
}

TEST(Registry, refusesSettingsThatDoNotGoTogether)
{
  using Settings = std::vector<std::pair<const char*, const char*>>;
  struct Case
  {
    const char* technique;
    Settings settings;
    const char* verdict;
  };
  const Settings nothing{ { "coherence", "off" }, { "neighbours", "off" }, { "adjacency", "off" } };
  Settings nothingLit = nothing;
  nothingLit.emplace_back("leftovers", "lit");
  std::vector<Case> cases = {
    { "coherence", { { "coherence", "off" } }, "takes 4 or 9" },
    { "coherence", { { "coherence", "9" } }, "" },
    { "coherence", { { "contour", "image" }, { "outside", "check" } }, "" }, // are selective's
    { "selective", { { "contour", "image" }, { "outside", "check" } }, "nothing is outside" },
    { "selective", { { "outside", "check" } }, "" },
    { "selective", { { "coherence", "off" }, { "contour", "image" } }, "" },
    { "selective", nothing, "" }, // all of the contour is traced
    { "selective", nothingLit, "all of them would be lit" },
    { "nsm", nothingLit, "" },
    { "montecarlo", { { "mc_layers", "peeled" }, { "mc_search", "hierarchical" } }, "" },
    { "montecarlo", { { "mc_layers", "peeled" }, { "mc_search", "linear" } },
      "one solid in a texel" },
    { "montecarlo", { { "mc_layers", "near_far" }, { "mc_search", "hierarchical" } }, "" },
    { "montecarlo", { { "mc_layers", "near_far" }, { "mc_search", "linear" } }, "" },
    { "montecarlo", { { "mc_layers", "near" }, { "mc_search", "hierarchical" } }, "" },
    { "montecarlo", { { "mc_layers", "near" }, { "mc_search", "linear" } }, "" },
    { "montecarlo", { { "mc_layers", "eye" }, { "mc_search", "hierarchical" } },
      "asks the camera" },
    { "montecarlo", { { "mc_layers", "eye" }, { "mc_search", "linear" } }, "" },
    { "montecarlo", { { "fit", "once" } }, "'fit' once" },
    { "montecarlo", { { "fit", "frame" } }, "'fit' frame" },
    { "nsm", { { "mc_layers", "eye" }, { "fit", "frame" } }, "" }, // are montecarlo's
    { "pcss", { { "early_out", "ring" } }, "exact or none" },
    { "pcss", { { "early_out", "none" } }, "" },
    { "nsm", { { "early_out", "ring" } }, "" },
  };
  // Tables sum moments that integers hold.
  for (const char* name : { "single_exponential", "variance", "exponential", "moments" })
  {
    const char* const tooLarge =
      std::string(name).find("exponential") != std::string::npos ? "32-bit integers" : nullptr;
    const Settings table{ { "estimator", name }, { "blur", "sat" } };
    Settings levels = table;
    levels.emplace_back("mip_maps", "on");
    cases.push_back({ "nsm", table, tooLarge ? tooLarge : "" });
    cases.push_back({ "nsm", levels, tooLarge ? tooLarge : "no levels" });
  }
  for (const Case& each : cases)
  {
    ShadowSettings settings;
    settings.technique = each.technique;
    std::string what = each.technique;
    for (const auto& [name, value] : each.settings)
    {
      ASSERT_TRUE(findSetting(name)->set(settings, value)) << name;
      what += std::string(", ") + name + " " + value;
    }
    expectVerdicts(settings, { each.verdict, each.verdict, each.verdict, each.verdict }, what);
  }
}

TEST(Registry, putsSamplesIntoTheCellsOfSquareGridsOnly)
{
  const auto expectSamples = [](int count, LightSampling sampling, const std::string& word,
                               const char* technique = "raytraced", bool hasArea = true)
  {
    ShadowLight light = lightOf(LightKind::Spot);
    light.technique = technique;
    light.lightSamples = count;
    light.lightSampling = sampling;
    if (hasArea)
    {
      light.area = diskArea({ 0.0, 0.0, -1.0 }, 1.0);
    }
    expectVerdict(light, word, std::to_string(count));
  };
  for (const int count : { 1, 4, 9, 64, 4096, 65536 })
  {
    expectSamples(count, LightSampling::Jittered, "");
  }
  expectSamples(64, LightSampling::Jittered, "opposite pairs", "sampled");
  expectSamples(64, LightSampling::Random, "", "sampled");
  for (const int count : { 2, 8, 63, 65, 65535 })
  {
    expectSamples(count, LightSampling::Jittered, "no " + std::to_string(count) + ";");
    expectSamples(count, LightSampling::Random, "");
    expectSamples(count, LightSampling::Sobol, "");
    expectSamples(count, LightSampling::Jittered, "", "raytraced", false); // a point
    expectSamples(count, LightSampling::Jittered, "", "nsm");              // takes none
  }
}

TEST(Registry, composesAsPublished)
{
  for (const std::string name : { "crsm", "crsma" })
  {
    ShadowLight light = lightOf(LightKind::Directional);
    light.technique = name;
    EXPECT_TRUE(compose(light).info.exact);
    light.asPublished = true;
    // Also for a light that was composed already.
    for (int i = 0; i < 2; ++i)
    {
      const TechniqueInfo& info = compose(light).info;
      EXPECT_EQ(info.name, name + "_as_published");
      EXPECT_FALSE(info.exact);
      EXPECT_EQ(light.estimator, info.name);
    }
  }
  EXPECT_TRUE(findEstimator("silhouette")->info.asPublished.empty());
}

/// Without a technique it is that of a picture at rest: exact, unless an estimator is named.
TEST(Registry, completesLights)
{
  struct Case
  {
    const char* technique;
    const char* estimator;
    bool hasArea;
    const char* completedTechnique;
    const char* completedEstimator;
    Projection projection = Projection::Uniform;
  };
  for (const Case& each :
    { Case{ "", "", false, "silhouette", "silhouette" },
      { "auto", "", false, "silhouette", "silhouette" }, { "", "", true, "penumbra", "penumbra" },
      { "auto", "", true, "penumbra", "penumbra" }, { "", "pcf", false, "nsm", "pcf" },
      { "auto", "pcf", false, "nsm", "pcf" }, { "nsm", "", false, "nsm", "compare" },
      { "lispsm", "pcf", false, "lispsm", "pcf", Projection::Lispsm } })
  {
    ShadowLight light = lightOf(LightKind::Directional);
    light.technique = each.technique;
    light.estimator = each.estimator;
    if (each.hasArea)
    {
      light.area = diskArea(light.directionWorld, 0.1);
    }
    const bool named = *each.estimator != '\0' || light.technique == "nsm";
    EXPECT_EQ(isAutomatic(light), !named);
    EXPECT_EQ(&compose(light), findEstimator(each.completedEstimator));
    EXPECT_EQ(light.technique, each.completedTechnique);
    EXPECT_EQ(light.estimator, each.completedEstimator);
    EXPECT_EQ(light.projection, each.projection);
    EXPECT_FALSE(isAutomatic(light));
  }
}

TEST(Registry, namesTechniquesAndEstimators)
{
  ShadowLight light = lightOf(LightKind::Directional);
  light.technique = "magic";
  expectVerdict(light, techniqueNames(), "magic");
  light.technique = "nsm";
  light.estimator = "magic";
  expectVerdict(light, estimatorNames(), "magic");
}

TEST(ShadowSettings, refuseWhatTheyDoNotTakeAndStayAsTheyAre)
{
  ShadowSettings settings;
  for (const char* text : { "", "15", "16385", "64.5", "64 ", " 64", "0x40", "99999999999", "nan" })
  {
    EXPECT_FALSE(findSetting("map_size")->set(settings, text)) << text;
    EXPECT_EQ(settings.mapSizeTexels, 1024);
  }
  EXPECT_EQ(findSetting("map_size")->expected(), "an integer in [16, 16384]");
  for (const char* text : { "", "Box", "box ", "1" })
  {
    EXPECT_FALSE(findSetting("kernel")->set(settings, text)) << text;
    EXPECT_EQ(settings.pcf.kernel, FilterKernel::Bilinear);
  }
  EXPECT_TRUE(findSetting("kernel")->set(settings, "poisson"));
  EXPECT_EQ(settings.pcf.kernel, FilterKernel::Poisson);
}

TEST(ShadowSettings, takeEveryChoiceAndGiveItBack)
{
  for (const gnomon::Setting* each : shadowSettings())
  {
    const gnomon::Setting& setting = *each;
    const auto* choice = std::get_if<ChoiceSetting>(&setting.values);
    for (std::size_t i = 0; choice && i < choice->names.size(); ++i)
    {
      ShadowSettings settings;
      EXPECT_TRUE(setting.set(settings, choice->names[i])) << setting.name;
      EXPECT_EQ(setting.get(settings), choice->names[i]) << setting.name;
    }
  }
  ShadowSettings settings;
  EXPECT_TRUE(findSetting("contour")->set(settings, "6"));
  EXPECT_EQ(settings.chain.contourPixels, 6);
  EXPECT_TRUE(findSetting("contour")->set(settings, "image"));
  EXPECT_EQ(settings.chain.contourPixels, 0);
  EXPECT_TRUE(findSetting("map_samples")->set(settings, "8"));
  EXPECT_EQ(settings.momentMap.samples, 8);
}

} // namespace
} // namespace gnomon::test
