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

TEST(Registry, saysWhoHasASetting)
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

TEST(Registry, sumsOnlyMomentsThatIntegersHold)
{
  for (const char* name : { "single_exponential", "variance", "exponential", "moments" })
  {
    ShadowSettings settings;
    settings.estimator = name;
    settings.momentMap.blur = MapBlur::Sat;
    const char* verdict =
      settings.estimator.find("exponential") != std::string::npos ? "32-bit integers" : "";
    expectVerdicts(settings, { verdict, verdict, verdict, verdict }, name);
    settings.momentMap.mipMaps = true;
    verdict =
      settings.estimator.find("exponential") != std::string::npos ? "32-bit integers" : "no levels";
    expectVerdicts(settings, { verdict, verdict, verdict, verdict }, name);
  }
}

TEST(Registry, refusesARingOfPointsThatThereIsNot)
{
  for (const EstimatorEntry& estimator : estimators())
  {
    ShadowSettings settings;
    settings.estimator = estimator.info.name;
    settings.earlyOut = EarlyOut::Ring;
    const char* verdict = estimator.info.name == "pcss" ? "exact or none" : "";
    expectVerdicts(settings, { verdict, verdict, verdict, verdict }, settings.estimator);
    settings.earlyOut = EarlyOut::None;
    expectVerdicts(settings, { "", "", "", "" }, settings.estimator);
  }
}

TEST(Registry, refusesChainsOfTestsThatMakeNoSense)
{
  struct Case
  {
    const char* technique;
    std::vector<std::pair<const char*, const char*>> settings;
    const char* verdict;
  };
  const std::vector<std::pair<const char*, const char*>> nothing{ { "coherence", "off" },
    { "neighbours", "off" }, { "adjacency", "off" } };
  auto nothingLit = nothing;
  nothingLit.emplace_back("leftovers", "lit");
  const Case cases[] = {
    { "coherence", { { "coherence", "off" } }, "takes 4 or 9" },
    { "coherence", { { "coherence", "9" } }, "" },
    { "coherence", { { "contour", "image" }, { "outside", "check" } }, "" }, // are selective's
    { "selective", { { "contour", "image" }, { "outside", "check" } }, "nothing is outside" },
    { "selective", { { "outside", "check" } }, "" },
    { "selective", { { "coherence", "off" }, { "contour", "image" } }, "" },
    { "selective", nothing, "" }, // all of the contour is traced
    { "selective", nothingLit, "all of them would be lit" },
    { "nsm", nothingLit, "" },
  };
  for (const Case& each : cases)
  {
    ShadowSettings settings;
    settings.technique = each.technique;
    for (const auto& [name, value] : each.settings)
    {
      ASSERT_TRUE(findSetting(name)->set(settings, value)) << name;
    }
    expectVerdicts(
      settings, { each.verdict, each.verdict, each.verdict, each.verdict }, each.technique);
  }
}

TEST(Registry, refusesRaysThatCannotBeFollowed)
{
  struct Case
  {
    const char* technique;
    const char* layers;
    const char* search;
    const char* fit;
    const char* verdict;
  };
  const Case cases[] = {
    { "montecarlo", "peeled", "hierarchical", "off", "" },
    { "montecarlo", "peeled", "linear", "off", "one solid in a texel" },
    { "montecarlo", "near_far", "hierarchical", "off", "" },
    { "montecarlo", "near_far", "linear", "off", "" },
    { "montecarlo", "near", "hierarchical", "off", "" },
    { "montecarlo", "near", "linear", "off", "" },
    { "montecarlo", "eye", "hierarchical", "off", "asks the camera" },
    { "montecarlo", "eye", "linear", "off", "" },
    { "montecarlo", "peeled", "hierarchical", "once", "'fit' once" },
    { "montecarlo", "peeled", "hierarchical", "frame", "'fit' frame" },
    { "nsm", "eye", "hierarchical", "frame", "" }, // are montecarlo's
  };
  for (const Case& each : cases)
  {
    ShadowSettings settings;
    settings.technique = each.technique;
    ASSERT_TRUE(findSetting("mc_layers")->set(settings, each.layers));
    ASSERT_TRUE(findSetting("mc_search")->set(settings, each.search));
    ASSERT_TRUE(findSetting("fit")->set(settings, each.fit));
    expectVerdicts(
      settings, { each.verdict, each.verdict, each.verdict, each.verdict }, each.technique);
  }
}

TEST(Registry, putsSamplesIntoTheCellsOfSquareGridsOnly)
{
  const auto refusalOf = [](int count, LightSampling sampling, bool hasArea,
                           const char* technique = "raytraced") -> std::string
  {
    ShadowLight light = lightOf(LightKind::Spot);
    light.technique = technique;
    light.lightSamples = count;
    light.lightSampling = sampling;
    if (hasArea)
    {
      light.area = diskArea({ 0.0, 0.0, -1.0 }, 1.0);
    }
    try
    {
      compose(light);
    }
    catch (const CompositionError& error)
    {
      return error.what();
    }
    return {};
  };
  for (const int count : { 1, 4, 9, 64, 4096, 65536 })
  {
    EXPECT_EQ(refusalOf(count, LightSampling::Jittered, true), "") << count;
  }
  EXPECT_NE(refusalOf(64, LightSampling::Jittered, true, "sampled").find("opposite pairs"),
    std::string::npos);
  EXPECT_EQ(refusalOf(64, LightSampling::Random, true, "sampled"), "");
  for (const int count : { 2, 8, 63, 65, 65535 })
  {
    const std::string refusal = refusalOf(count, LightSampling::Jittered, true);
    EXPECT_NE(refusal.find("no " + std::to_string(count) + ";"), std::string::npos) << refusal;
    EXPECT_EQ(refusalOf(count, LightSampling::Random, true), "") << count;
    EXPECT_EQ(refusalOf(count, LightSampling::Sobol, true), "") << count;
    EXPECT_EQ(refusalOf(count, LightSampling::Jittered, false), "") << "of a light that is a point";
    EXPECT_EQ(refusalOf(count, LightSampling::Jittered, true, "nsm"), "") << "who takes none";
  }
}

TEST(Registry, followsAPublicationWhereThereIsOneThatIsNotExact)
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

// For a picture at rest: exact, unless an estimator is named.
TEST(Registry, completesLightsThatLeaveTheirTechniqueToThePass)
{
  for (const char* const name : { "", "auto" })
  {
    ShadowLight hard = lightOf(LightKind::Directional);
    hard.technique = name;
    EXPECT_TRUE(isAutomatic(hard));
    EXPECT_EQ(&compose(hard), findEstimator("silhouette"));
    EXPECT_EQ(hard.technique, "silhouette");
    EXPECT_FALSE(isAutomatic(hard));

    ShadowLight soft = lightOf(LightKind::Point);
    soft.technique = name;
    soft.area = ballArea(0.1);
    EXPECT_EQ(&compose(soft), findEstimator("penumbra"));
    EXPECT_EQ(soft.technique, "penumbra");

    ShadowLight filtered = lightOf(LightKind::Directional);
    filtered.technique = name;
    filtered.estimator = "pcf";
    EXPECT_FALSE(isAutomatic(filtered));
    EXPECT_EQ(&compose(filtered), findEstimator("pcf"));
    EXPECT_EQ(filtered.technique, "nsm");
  }
}

TEST(Registry, completesTheLight)
{
  ShadowLight light = lightOf(LightKind::Directional);
  light.technique = "nsm";
  EXPECT_EQ(&compose(light), findEstimator("compare"));
  EXPECT_EQ(light.technique, "nsm");
  EXPECT_EQ(light.estimator, "compare");
  EXPECT_EQ(light.projection, Projection::Uniform);

  light = lightOf(LightKind::Directional);
  light.technique = "lispsm";
  light.estimator = "pcf";
  EXPECT_EQ(&compose(light), findEstimator("pcf"));
  EXPECT_EQ(light.projection, Projection::Lispsm);
}

TEST(Registry, namesWhatThereIs)
{
  ShadowLight light = lightOf(LightKind::Directional);
  light.technique = "magic";
  expectVerdict(light, techniqueNames(), "magic");
  light.technique = "nsm";
  light.estimator = "magic";
  expectVerdict(light, estimatorNames(), "magic");
}

} // namespace
} // namespace gnomon::test
