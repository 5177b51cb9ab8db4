#include "ComparisonRun.h"

#include "Commands.h"
#include "Errors.h"
#include "PictureVisibility.h"
#include "TestFiles.h"

#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

namespace gnomon::tool
{
namespace
{

using testing::HasSubstr;

const VariantResult& variant(const ComparisonResults& results, std::string_view name)
{
  const auto found = std::find_if(results.variants.begin(), results.variants.end(),
    [&name](const VariantResult& candidate) { return candidate.name == name; });
  if (found == results.variants.end())
  {
    throw std::runtime_error("no variant " + std::string(name));
  }
  return *found;
}

/// Of one size of map, without timed frames, in a square: vtkShadowMapPass is wrong in all other
/// windows.
ComparisonPlan smallPlan(std::vector<std::string> techniques, int mapSizeTexels = 256,
  int side = 64, bool inlineRoute = false)
{
  ComparisonPlan plan;
  plan.techniques = std::move(techniques);
  plan.mapSizesTexels = { mapSizeTexels };
  plan.inlineRoute = inlineRoute;
  plan.width = side;
  plan.height = side;
  plan.frames = 0;
  return plan;
}

ComparisonPlan cubePlan()
{
  return smallPlan({ "nsm" }, 256, 140, true);
}

std::vector<std::string> namesOf(const ComparisonResults& results)
{
  std::vector<std::string> names;
  for (const VariantResult& result : results.variants)
  {
    names.push_back(result.name);
  }
  return names;
}

/// One small comparison for all tests of this file.
const ComparisonResults& cubeResults()
{
  static const ComparisonResults results = []
  {
    ComparisonPlan plan = cubePlan();
    plan.frames = 2;
    return runComparison(loadScene("cube"), plan, {});
  }();
  return results;
}

TEST(ComparisonRun, ListsPeersRoutesAndTheTruth)
{
  EXPECT_THAT(namesOf(cubeResults()),
    testing::ElementsAre(
      "plain VTK", "vtkShadowMapPass 256", "nsm 256 inline", "nsm 256 image", "raytraced"));
  EXPECT_EQ(cubeResults().truth, "raytraced");
  EXPECT_EQ(cubeResults().lights, 1);
  EXPECT_GE(cubeResults().triangles, 14u); // a cube on a plane
}

TEST(ComparisonRun, MeasuresErrorsAgainstTheTruth)
{
  const VisibilityError truth = variant(cubeResults(), "raytraced").error;
  EXPECT_GT(truth.facingPixels, 3000);
  EXPECT_EQ(truth.wrongPixels(), 0);
  EXPECT_EQ(truth.meanAbsolute, 0.0);

  // Without shadows, exactly the pixels in shadow are wrong, and nothing else.
  const VisibilityError plain = variant(cubeResults(), "plain VTK").error;
  EXPECT_EQ(plain.facingPixels, truth.facingPixels);
  EXPECT_GT(plain.share(plain.falseLight), 0.02);
  EXPECT_EQ(plain.falseShadow, 0);
  EXPECT_DOUBLE_EQ(plain.meanAbsolute, plain.share(plain.falseLight));

  for (const char* name : { "vtkShadowMapPass 256", "nsm 256 inline", "nsm 256 image" })
  {
    const VisibilityError error = variant(cubeResults(), name).error;
    EXPECT_EQ(error.facingPixels, truth.facingPixels) << name;
    EXPECT_LT(error.wrongPixels(), plain.wrongPixels() / 2) << name;
  }
}

TEST(ComparisonRun, WithoutTimedFramesErrorsAreTheSame)
{
  const ComparisonResults results = runComparison(loadScene("cube"), cubePlan(), {});
  EXPECT_TRUE(timedMotions(results).empty());
  ASSERT_EQ(results.variants.size(), cubeResults().variants.size());
  for (const VariantResult& result : results.variants)
  {
    const VariantResult& timed = variant(cubeResults(), result.name);
    EXPECT_EQ(result.error.falseLight, timed.error.falseLight) << result.name;
    EXPECT_EQ(result.error.falseShadow, timed.error.falseShadow) << result.name;
    EXPECT_EQ(result.picture.rgb, timed.picture.rgb) << result.name;
  }
}

TEST(ComparisonRun, ShowsThreePanelsFirst)
{
  ComparisonPlan plan = cubePlan();
  plan.mapSizesTexels = { 256, 128 };
  plan.width = 2 * firstPanelPixels; // twice as large as panels may be
  plan.height = firstPanelPixels;
  std::vector<Panel> panels;
  struct Seen
  {
  };
  ComparisonEvents events;
  events.firstPanels = [&panels](const std::vector<Panel>& first)
  {
    panels = first;
    throw Seen();
  };
  EXPECT_THROW(runComparison(loadScene("cube"), plan, events), Seen);
  ASSERT_EQ(panels.size(), 3u);
  const char* const titles[] = { "plain VTK", "vtkShadowMapPass", "raytraced" };
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_THAT(panels[i].title, HasSubstr(titles[i]));
    EXPECT_EQ(panels[i].picture.width, firstPanelPixels) << titles[i];
    EXPECT_EQ(panels[i].picture.height, firstPanelPixels / 2) << titles[i];
    EXPECT_EQ(panels[i].picture.rgb.size(), 3 * panels[i].picture.pixelCount()) << titles[i];
    EXPECT_NE(panels[i].picture.rgb, panels[(i + 1) % 3].picture.rgb) << titles[i];
  }
}

TEST(ComparisonRun, FirstPanelsAreOfTheRowsPictures)
{
  std::vector<Panel> panels;
  ComparisonEvents events;
  events.firstPanels = [&panels](const std::vector<Panel>& first) { panels = first; };
  ComparisonPlan plan = cubePlan();
  plan.settings = { { "light_radius", "10" } };
  plan.truthSamples = 4;
  const ComparisonResults results = runComparison(loadScene("cube"), plan, events);
  ASSERT_EQ(panels.size(), 3u);
  EXPECT_EQ(panels[0].picture.rgb, variant(results, "plain VTK").picture.rgb);
  EXPECT_EQ(panels[1].picture.rgb, variant(results, "vtkShadowMapPass 256").picture.rgb);
  EXPECT_EQ(panels[2].picture.rgb, variant(results, "raytraced").picture.rgb);
}

TEST(ComparisonRun, TellsHowManyRowsAreDone)
{
  std::vector<double> shares;
  std::vector<std::string> steps;
  ComparisonEvents events;
  events.progress = [&](double share, const std::string& step)
  {
    shares.push_back(share);
    steps.push_back(step);
  };
  ComparisonPlan plan = cubePlan();
  plan.frames = 1;
  runComparison(loadScene("cube"), plan, events);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.at(0), 0.0);
  EXPECT_DOUBLE_EQ(shares.back(), 1.0);
  EXPECT_EQ(steps.at(0), "set up 1 of 5 rows");
  EXPECT_THAT(steps, testing::Contains("timing 5 rows, camera moving"));
  EXPECT_THAT(steps, testing::Contains("4 of 5 rows done"));
  EXPECT_EQ(steps.back(), "5 of 5 rows done");
}

TEST(ComparisonRun, TechniquesToChooseAmongExistAndEndWithTheTruth)
{
  for (const bool soft : { false, true })
  {
    const std::vector<std::string> usual = usualTechniques(soft);
    EXPECT_LE(usual.size() + 2, 10u) << "with the peers";
    EXPECT_EQ(std::set<std::string>(usual.begin(), usual.end()).size(), usual.size());
    EXPECT_EQ(usual.back(), truthTechnique);
    for (const std::string& name : usual)
    {
      EXPECT_TRUE(findTechnique(name)) << name;
    }
  }
}

TEST(ComparisonRun, LightsOrThePlanMakeShadowsSoft)
{
  ComparisonPlan plan = cubePlan();
  EXPECT_FALSE(castsSoftShadows(plan, loadScene("cube")));
  EXPECT_TRUE(castsSoftShadows(plan, loadScene("soft-stack")));
  plan.settings = { { "light_radius", "10" } };
  EXPECT_TRUE(castsSoftShadows(plan, loadScene("cube")));
}

TEST(ComparisonRun, ThePlanSaysTheKernelAndNotTheScene)
{
  Scene scene = loadScene("cube");
  scene.lights.at(0).settings = { { "kernel", "poisson" }, { "kernel_size", "32" } };
  ComparisonPlan plan = smallPlan({ "pcf" }, 64, 140);
  const auto errorOf = [&](int kernelTexels)
  {
    const std::string size = std::to_string(kernelTexels);
    plan.settings = { { "kernel", "box" }, { "kernel_size", size } };
    const std::string name = "pcf kernel=box kernel_size=" + size + " 64 image";
    return variant(runComparison(scene, plan, {}), name).error.meanAbsolute;
  };
  EXPECT_LT(1.5 * errorOf(1), errorOf(9));
}

/// Though lights have moved before, so that maps are stale.
TEST(ComparisonRun, PixelsAreCountedAsTheMapDecidesThem)
{
  ComparisonPlan plan = smallPlan({ "silhouette" }, 1024, 140);
  plan.frames = 1;
  const ComparisonResults results = runComparison(loadScene("cube"), plan, {});
  EXPECT_LT(2 * variant(results, "silhouette 1024").tracedPixels,
    variant(results, "raytraced").tracedPixels);
  // Frames are timed once the map is baked, which has a million texels of several numbers.
  EXPECT_GT(variant(results, "silhouette 1024").memory.maps, std::size_t(1) << 24);
}

TEST(ComparisonRun, VisibilityReadOffPicturesAgreesWithTheImage)
{
  // The same technique by both routes: one image is handed out, the other read off pictures.
  const VisibilityError image = variant(cubeResults(), "nsm 256 image").error;
  const VisibilityError pictures = variant(cubeResults(), "nsm 256 inline").error;
  EXPECT_NEAR(static_cast<double>(image.falseLight), static_cast<double>(pictures.falseLight), 3.0);
  EXPECT_NEAR(
    static_cast<double>(image.falseShadow), static_cast<double>(pictures.falseShadow), 3.0);
}

TEST(ComparisonRun, MeasuresTimesStagesAndMemory)
{
  for (const VariantResult& result : cubeResults().variants)
  {
    for (const MotionTiming& timing : result.timings)
    {
      EXPECT_GT(timing.milliseconds, 0.0) << result.name;
    }
  }
  const VariantResult& image = variant(cubeResults(), "nsm 256 image");
  for (const MotionTiming& timing : image.timings)
  {
    EXPECT_GT(timing.stageShare, 0.5); // a frame this small is mostly overhead
    EXPECT_LE(timing.stageShare, 1.01);
  }
  EXPECT_GE(image.memory.maps, 256u * 256u * 4u);
  EXPECT_GT(image.memory.images, 0u);
  EXPECT_TRUE(variant(cubeResults(), "plain VTK").timings[0].stages.empty());
}

TEST(ComparisonRun, StagesAreNineTenthsOfAFrame)
{
  ComparisonPlan plan = smallPlan({ "nsm", "coherence", "crsm" }, 512, 512);
  plan.frames = 3;
  for (const VariantResult& result : runComparison(loadScene("posts"), plan, {}).variants)
  {
    // Of the motions the best: what else the machine does comes between stages and takes from their
    // share.
    double share = 0.0;
    for (const MotionTiming& timing : result.timings)
    {
      share = std::max(share, timing.stageShare);
    }
    EXPECT_TRUE(result.timings[0].stages.empty() || share >= 0.9) << result.name << ": " << share;
  }
}

TEST(ComparisonRun, AllTechniquesCountTheSamePixels)
{
  ComparisonPlan plan = smallPlan({}, 128, 64, true);
  for (const TechniqueEntry& technique : registry())
  {
    plan.techniques.push_back(technique.name);
  }
  const ComparisonResults results = runComparison(loadScene("posts"), plan, {});
  EXPECT_GE(results.variants.size(), registry().size() + 2) << "with the peers";

  // By the classes of each technique that tells them: of those that only read maps `pcss`, whose
  // shader decides as the others' do what the light reaches.
  std::set<std::string> tell;
  for (const VariantResult& result : results.variants)
  {
    if (result.classes.empty())
    {
      continue;
    }
    std::int64_t all = 0;
    for (const auto& [name, pixels] : result.classes)
    {
      all += pixels;
    }
    const std::int64_t* const away = findNamed(result.classes, "turned away from the light");
    const std::int64_t* const none = findNamed(result.classes, "no receiver");
    ASSERT_TRUE(away && none) << result.name;
    EXPECT_GT(*away, 0) << result.name;
    EXPECT_GT(*none, 0) << result.name;
    EXPECT_EQ(all, 64 * 64) << result.name;
    // By the truth's normals.
    EXPECT_EQ(all - *away - *none, result.error.facingPixels) << result.name;
    const VariantResult& truth = variant(results, "raytraced");
    EXPECT_EQ(*away, *findNamed(truth.classes, "turned away from the light")) << result.name;
    EXPECT_EQ(*none, *findNamed(truth.classes, "no receiver")) << result.name;
    tell.insert(result.name.substr(0, result.name.find(' ')));
  }
  EXPECT_THAT(tell,
    testing::ElementsAre("coherence", "crsm", "crsma", "montecarlo", "pcss", "penumbra",
      "raytraced", "selective", "silhouette"));
}

/// How many pixels of a picture have each colour.
std::map<std::array<int, 3>, std::int64_t> coloursOf(const Picture& picture)
{
  std::map<std::array<int, 3>, std::int64_t> pixels;
  for (std::size_t i = 0; i < picture.pixelCount(); ++i)
  {
    const unsigned char* const of = &picture.rgb[3 * i];
    ++pixels[{ of[0], of[1], of[2] }];
  }
  return pixels;
}

TEST(ComparisonRun, ColoursOfPicturesAreItsNumbers)
{
  ComparisonResults results = runComparison(loadScene("posts"),
    smallPlan({ "crsm:as_published=on", "coherence", "selective", "silhouette" }, 64, 160), {});
  const ComparisonResults soft = runComparison(loadScene("soft-stack"),
    smallPlan({ "montecarlo", "montecarlo:mc_classify=off" }, 256, 100), {});
  results.variants.insert(results.variants.end(), soft.variants.begin(), soft.variants.end());
  std::int64_t falseLight = 0, falseShadow = 0;
  std::set<std::string> kinds;
  for (const VariantResult& result : results.variants)
  {
    // Blue: false light. Red: false shadow. Purple, through which the picture shines: traced, hence
    // right. Other pixels are grey.
    std::map<std::array<int, 3>, std::int64_t> errors = coloursOf(result.errors);
    EXPECT_EQ((errors[{ 64, 128, 255 }]), result.error.falseLight) << result.name;
    EXPECT_EQ((errors[{ 255, 48, 48 }]), result.error.falseShadow) << result.name;
    std::int64_t purple = 0;
    for (const auto& [colour, pixels] : errors)
    {
      purple += colour[0] - colour[1] == 68 && colour[2] - colour[1] == 95 ? pixels : 0;
    }
    EXPECT_EQ(purple, result.tracedPixels) << result.name;
    falseLight += result.error.falseLight;
    falseShadow += result.error.falseShadow;

    // Each class has a colour of its own, and there is no other.
    if (result.classes.empty())
    {
      continue;
    }
    const std::string technique = result.name.substr(0, result.name.find(' '));
    std::map<std::array<int, 3>, std::int64_t> colours = coloursOf(result.classPicture);
    std::int64_t ofClasses = 0;
    for (const PixelClass& each : findTechnique(technique)->estimator->info.classes)
    {
      const std::int64_t* const counted = findNamed(result.classes, each.name);
      const std::int64_t drawn = colours[{ each.colour[0], each.colour[1], each.colour[2] }];
      EXPECT_EQ(drawn, counted ? *counted : 0) << each.name << " of " << result.name;
      ofClasses += drawn;
      kinds.insert(drawn > 0 ? technique + ", " + each.name : technique);
    }
    EXPECT_EQ(ofClasses, static_cast<std::int64_t>(result.classPicture.pixelCount()));
  }
  EXPECT_GT(falseLight, 0);
  EXPECT_GT(falseShadow, 0);
  EXPECT_GT(kinds.size(), 20u);
}

TEST(ComparisonRun, MeasuresSoftShadowsAgainstManySamples)
{
  const ComparisonResults results = runComparison(loadScene("soft-stack"),
    smallPlan({ "nsm", "raytraced:light_samples=4", "raytraced:light_samples=64" }), {});
  EXPECT_THAT(
    results.notes, testing::Contains(HasSubstr("The truth has 4096 samples of each area light")));
  const VisibilityError hard = variant(results, "nsm 256 image").error;
  const VisibilityError few = variant(results, "raytraced light_samples=4").error;
  const VisibilityError many = variant(results, "raytraced light_samples=64").error;
  EXPECT_GT(hard.rootMeanSquare, 2.0 * few.rootMeanSquare);
  EXPECT_GT(few.rootMeanSquare, 2.0 * many.rootMeanSquare);
  EXPECT_GT(many.rootMeanSquare, 0.0);
  EXPECT_LT(many.rootMeanSquare, 0.02);
  EXPECT_GT(few.meanAbsolute, 2.0 * many.meanAbsolute);
}

TEST(ComparisonRun, TheLightsHaveOneSizeForAllVariantsAndTheTruth)
{
  ComparisonPlan plan = smallPlan({ "nsm", "planar", "penumbra" });
  plan.settings = { { "light_radius", "10" }, { "light_samples", "16" } };
  const ComparisonResults results = runComparison(loadScene("cube"), plan, {});
  EXPECT_THAT(results.notes, testing::Contains(HasSubstr("4096 samples of each area")));
  EXPECT_THAT(
    results.settings, testing::Contains(testing::Pair("Of all lights", "light_radius 10")));
  const VisibilityError hard = variant(results, "nsm 256 image").error;
  const VisibilityError traced = variant(results, "raytraced light_samples=16").error;
  const VisibilityError counted = variant(results, "penumbra light_samples=16").error;
  const VisibilityError planar = variant(results, "planar light_samples=16").error;
  EXPECT_GT(traced.rootMeanSquare, 0.0);
  EXPECT_EQ(counted.rootMeanSquare, traced.rootMeanSquare);
  EXPECT_GT(hard.rootMeanSquare, 3.0 * traced.rootMeanSquare);
  EXPECT_GT(hard.rootMeanSquare, 3.0 * planar.rootMeanSquare);

  // The scene's own lights say it as well; the plan overrides them.
  Scene scene = loadScene("cube");
  scene.lights.at(0).settings = { { "light_radius", "10" } };
  plan.settings = { { "light_samples", "16" } };
  EXPECT_EQ(
    variant(runComparison(scene, plan, {}), "raytraced light_samples=16").error.rootMeanSquare,
    traced.rootMeanSquare);
  scene.lights.at(0).settings = { { "light_radius", "1" } };
  plan.settings["light_radius"] = "10";
  EXPECT_EQ(
    variant(runComparison(scene, plan, {}), "raytraced light_samples=16").error.rootMeanSquare,
    traced.rootMeanSquare);
}

TEST(ComparisonRun, TheTruthHasSamplesOfItsOwn)
{
  ComparisonPlan plan = smallPlan({ "raytraced:light_seed=2" });
  plan.settings = { { "light_radius", "10" }, { "light_samples", "1" }, { "light_seed", "1" },
    { "light_sampling", "random" } };
  const ComparisonResults results = runComparison(loadScene("cube"), plan, {});
  EXPECT_THAT(results.notes, testing::Contains(HasSubstr("with light_seed 3")));
  const VariantResult& single =
    variant(results, "raytraced light_samples=1 light_sampling=random light_seed=1");
  EXPECT_GT(single.error.rootMeanSquare, 0.02); // one of 4,096 samples is far from all of them
  EXPECT_EQ(single.errorSource, "From its visibility image, one number per pixel and light.");
}

TEST(ComparisonRun, TheTruthHasAsManySamplesAsTheyAskFor)
{
  ComparisonPlan plan = smallPlan({ "nsm" });
  plan.settings = { { "light_radius", "10" } };
  plan.truthSamples = 32;
  const ComparisonResults results = runComparison(loadScene("cube"), plan, {});
  EXPECT_THAT(results.notes, testing::Contains(HasSubstr("The truth has 32 samples")));
  EXPECT_GT(variant(results, "raytraced").error.rootMeanSquare, 0.001)
    << "as far from 64 others as so few are";
}

TEST(ComparisonRun, NamesWhatTheTruthDoesNotTake)
{
  ComparisonPlan plan = smallPlan({ "nsm" });
  plan.settings = { { "light_radius", "10" }, { "light_samples", "5" },
    { "light_sampling", "jittered" } };
  EXPECT_THAT(messageOf<BadInput>([&] { runComparison(loadScene("cube"), plan, {}); }),
    testing::AllOf(HasSubstr("raytraced, the truth"), HasSubstr("jittered")));
}

TEST(ComparisonRun, SettingsConcernWhatTheOthersMakeOfATechnique)
{
  ComparisonPlan plan = smallPlan({ "nsm" });
  plan.inlineRoute = true;
  plan.settings = { { "estimator", "crsm" } };
  const ComparisonResults results = runComparison(loadScene("cube"), plan, {});
  const VariantResult& exact = variant(results, "nsm estimator=crsm 256");
  EXPECT_EQ(exact.error.wrongPixels(), 0);
  EXPECT_GT(exact.tracedPixels, 0);
}

TEST(ComparisonRun, SettingsReachThoseWhomTheyConcern)
{
  ComparisonPlan plan = smallPlan({ "nsm", "planar", "raytraced" });
  plan.settings = { { "planes", "2" }, { "bias_constant", "0.5" }, { "kernel", "" } };
  EXPECT_THAT(namesOf(runComparison(loadScene("cube"), plan, {})),
    testing::ElementsAre("plain VTK", "vtkShadowMapPass 256", "nsm bias_constant=0.5 256 image",
      "planar planes=2", "raytraced"));
}

TEST(ComparisonRun, ATechniqueHasNoLightOfItsOwn)
{
  const ComparisonPlan plan = smallPlan({ "pcss:light_radius=3" });
  EXPECT_THAT(messageOf<BadInput>([&] { runComparison(loadScene("cube"), plan, {}); }),
    testing::AllOf(HasSubstr("pcss:light_radius=3"), HasSubstr("--light-radius")));
}

TEST(ComparisonRun, ASceneWithoutCastingLightsIsBadInput)
{
  Scene scene = loadScene("cube");
  for (SceneLight& light : scene.lights)
  {
    light.intensity = 0.0;
  }
  EXPECT_THAT(messageOf<BadInput>([&] { runComparison(scene, smallPlan({ "nsm" }), {}); }),
    HasSubstr("no light casts a shadow"));
}

/// `gnomon compare` with these arguments.
void compare(std::vector<std::string> arguments)
{
  CLI::App app("gnomon");
  addCompareCommand(app);
  arguments.insert(arguments.begin(), "compare");
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes vectors
  app.parse(arguments);
}

TEST(PictureSize, BeyondTheLimitsOfOpenGlNamesThem)
{
  EXPECT_NO_THROW(requireDrawable({ 4096, 2048 }, 4096, 4096, 2048));
  EXPECT_THROW(requireDrawable({ 4097, 16 }, 4096, 8192, 8192), BadInput);
  EXPECT_THROW(requireDrawable({ 16, 2049 }, 4096, 4096, 2048), BadInput);
  EXPECT_EQ(messageOf<BadInput>(
              [] {
                requireDrawable({ 5000, 16 }, 4096, 8192, 2048);
              }),
    "--size: found 5000x16, and OpenGL draws no more than 4096x2048 here (GL_MAX_TEXTURE_SIZE "
    "4096, GL_MAX_VIEWPORT_DIMS 8192 x 2048)");
}

/// The names of the variants that a small comparison without timed frames has in its results.csv.
std::vector<std::string> comparedRows(std::vector<std::string> arguments)
{
  const TestFolder folder;
  for (const char* more :
    { "-o", "", "--size", "32x32", "--map-sizes", "64", "--frames", "0", "--truth-samples", "4" })
  {
    arguments.push_back(*more ? more : folder.path());
  }
  compare(arguments);
  std::istringstream table(readBytes(folder / "results.csv"));
  std::vector<std::string> names;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line))
  {
    names.push_back(line.substr(0, line.find(',')));
  }
  return names;
}

TEST(CompareCommand, ComparesWhatAUserWouldChooseAmong)
{
  EXPECT_THAT(comparedRows({ "cube" }),
    testing::ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "pcf 64 inline",
      "vsm 64 inline", "pssm 64 inline", "silhouette 64", "raytraced"));
  EXPECT_THAT(comparedRows({ "cube", "--light-radius", "5" }),
    testing::ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "pcf 64 inline",
      "pcss 64 image", "sampled 64", "penumbra", "raytraced"));
  EXPECT_THAT(comparedRows({ "cube", "--techniques", "nsm" }),
    testing::ElementsAre(
      "plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "nsm 64 image", "raytraced"));
}

/// Pointwise techniques by both routes, and those with a map with its size.
TEST(CompareCommand, ComparesAllIfAskedTo)
{
  const std::vector<std::string> rows = comparedRows({ "cube", "--all" });
  EXPECT_THAT(rows,
    testing::IsSupersetOf({ "plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "nsm 64 image",
      "pcss 64 image", "montecarlo 64", "planar", "raytraced" }));
  std::set<std::string> techniques;
  for (const std::string& row : rows)
  {
    techniques.insert(row.substr(0, row.find(' ')));
  }
  EXPECT_EQ(techniques.size(), registry().size() + 2) << "with the peers";
}

TEST(CompareCommand, RefusesBadInputBeforeDrawing)
{
  const TestFolder folder;
  writeBytes(folder / "file", "text");
  const std::string report = folder / "report";
  EXPECT_THROW(compare({ "cube", "-o", folder / "file" }), BadInput);
  EXPECT_THROW(compare({ "no-such-scene", "-o", report }), BadInput);
  EXPECT_THROW(compare({ "cube", "-o", report, "--size", "0x10" }), BadInput);
  EXPECT_THROW(compare({ "cube", "-o", report, "--techniques", "nsm,magic" }), BadInput);
  EXPECT_THROW(compare({ "cube", "-o", report, "--map-sizes", "7" }), CLI::ParseError);
  EXPECT_THROW(compare({ "cube", "-o", report, "--frames", "-1" }), CLI::ParseError);
  EXPECT_THROW(compare({ "cube", "-o", report, "--route", "scenic" }), CLI::ParseError);
  EXPECT_THROW(compare({ "cube", "-o", report, "--all", "--techniques", "nsm" }), CLI::ParseError);
  EXPECT_THROW(compare({ "cube" }), CLI::ParseError);
}

TEST(CompareCommand, WritesAReport)
{
  const TestFolder folder;
  compare({ "cube", "-o", folder / "report", "--techniques", "nsm", "--map-sizes", "64,128",
    "--size", "64x48", "--frames", "1", "--route", "image" });
  for (const char* name :
    { "report/first.png", "report/report.html", "report/results.csv", "report/results.json",
      "report/chart.png", "report/nsm-64-image.png", "report/nsm-128-image-errors.png",
      "report/vtkShadowMapPass-128.png", "report/raytraced.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

} // namespace
} // namespace gnomon::tool
