#include "ComparisonRun.h"

#include "Commands.h"
#include "Errors.h"
#include "TestFiles.h"

#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

namespace gnomon::tool
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

using Json = nlohmann::ordered_json;

constexpr int routeInline = vtkGnomonShadowPass::ROUTE_INLINE;
constexpr int routeImage = vtkGnomonShadowPass::ROUTE_IMAGE;

const Json& variant(const ComparisonResults& results, const std::string& name)
{
  for (const Json& candidate : results.json.at("variants"))
  {
    if (candidate.at("name") == name)
    {
      return candidate;
    }
  }
  throw std::runtime_error("no variant " + name);
}

double number(const ComparisonResults& results, const std::string& name, const char* key)
{
  return variant(results, name).at("error").at(key);
}

double rms(const ComparisonResults& results, const std::string& name)
{
  return number(results, name, "rms_error");
}

/// A plan without timed frames, with a square window: vtkShadowMapPass is wrong in others.
ComparisonPlan smallPlan(std::vector<std::string> techniques, int mapSizeTexels = 256,
  int side = 64, std::vector<int> routes = { routeImage })
{
  ComparisonPlan plan;
  plan.techniques = std::move(techniques);
  plan.mapSizesTexels = { mapSizeTexels };
  plan.routes = std::move(routes);
  plan.width = side;
  plan.height = side;
  plan.frames = 0;
  return plan;
}

ComparisonPlan cubePlan()
{
  return smallPlan({ "nsm" }, 256, 140, { routeInline, routeImage });
}

ComparisonResults compareCube(
  const ComparisonPlan& plan, const std::map<std::string, std::string>& settings = {})
{
  ComparisonPlan changed = plan;
  changed.settings = settings;
  return runComparison(loadScene("cube"), changed, {});
}

std::vector<std::string> namesOf(const ComparisonResults& results)
{
  std::vector<std::string> names;
  for (const Json& of : results.json.at("variants"))
  {
    names.push_back(of.at("name"));
  }
  return names;
}

/// One small comparison for several tests. It reports rising shares of its work.
const ComparisonResults& cubeResults()
{
  static const ComparisonResults results = []
  {
    ComparisonPlan plan = cubePlan();
    plan.frames = 2;
    std::vector<double> shares;
    std::vector<std::string> steps;
    ComparisonEvents events;
    events.progress = [&](double share, const std::string& step)
    {
      shares.push_back(share);
      steps.push_back(step);
    };
    ComparisonResults found = runComparison(loadScene("cube"), plan, events);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()) && shares.at(0) > 0.0);
    EXPECT_DOUBLE_EQ(shares.back(), 1.0);
    EXPECT_EQ(steps.at(0), "set up 1 of 5 rows");
    EXPECT_THAT(steps, testing::Contains("timing 5 rows, camera moving"));
    EXPECT_EQ(steps.back(), "5 of 5 rows done");
    return found;
  }();
  return results;
}

TEST(ComparisonRun, MeasuresErrorsAgainstTheTruth)
{
  const ComparisonResults& results = cubeResults();
  EXPECT_THAT(namesOf(results),
    ElementsAre(
      "plain VTK", "vtkShadowMapPass 256", "nsm 256 inline", "nsm 256 image", "raytraced"));
  EXPECT_EQ(results.json.at("truth"), "raytraced");
  EXPECT_EQ(results.json.at("casting_lights"), 1);
  EXPECT_GE(results.json.at("triangles"), 14); // a cube on a plane
  EXPECT_GT(number(results, "raytraced", "facing_pixels"), 3000);
  EXPECT_EQ(number(results, "raytraced", "mean_absolute_error"), 0.0);

  // Without shadows, exactly the pixels in shadow are wrong.
  const double inShadow = number(results, "plain VTK", "wrong_share");
  EXPECT_GT(inShadow, 0.02);
  EXPECT_EQ(number(results, "plain VTK", "false_shadow_pixels"), 0.0);
  EXPECT_DOUBLE_EQ(number(results, "plain VTK", "mean_absolute_error"), inShadow);
  for (const char* name : { "vtkShadowMapPass 256", "nsm 256 inline", "nsm 256 image" })
  {
    EXPECT_LT(number(results, name, "wrong_share"), inShadow / 2) << name;
  }
  // Visibility is exported by one route, and measured from pictures by the other.
  for (const char* key : { "false_light_pixels", "false_shadow_pixels" })
  {
    EXPECT_NEAR(number(results, "nsm 256 image", key), number(results, "nsm 256 inline", key), 3.0);
  }
}

TEST(ComparisonRun, MeasuresTimesStagesAndMemory)
{
  for (const Json& of : cubeResults().json.at("variants"))
  {
    for (const char* motion : motionKeys)
    {
      EXPECT_GT(of.at("times").at(motion).at("frame_ms"), 0.0) << of.at("name");
    }
  }
  const Json& image = variant(cubeResults(), "nsm 256 image");
  const double share = image.at("times").at("static").at("stage_share");
  EXPECT_TRUE(share > 0.5 && share <= 1.01) << share; // a small frame is mostly overhead
  EXPECT_GE(image.at("memory_bytes").at("maps"), 256 * 256 * 4);
  EXPECT_GT(image.at("memory_bytes").at("images"), 0);
  EXPECT_FALSE(variant(cubeResults(), "plain VTK").at("times").at("static").contains("stages_ms"));

  // Without timed frames, the rest is the same.
  const ComparisonResults untimed = compareCube(cubePlan());
  for (std::size_t i = 0; i < untimed.pictures.size(); ++i)
  {
    const Json& of = untimed.json.at("variants")[i];
    EXPECT_FALSE(of.contains("times"));
    EXPECT_EQ(of.at("error"), cubeResults().json.at("variants")[i].at("error"));
    EXPECT_EQ(untimed.pictures[i].picture.rgb, cubeResults().pictures[i].picture.rgb);
  }
}

TEST(ComparisonRun, ShowsThreePanelsFirst)
{
  struct Seen
  {
  };
  std::vector<Panel> panels;
  ComparisonEvents events;
  events.firstPanels = [&panels](const std::vector<Panel>& first)
  {
    panels = first;
    throw Seen();
  };
  ComparisonPlan plan = cubePlan();
  plan.width = 2 * firstPanelPixels;
  plan.height = firstPanelPixels;
  EXPECT_THROW(runComparison(loadScene("cube"), plan, events), Seen);
  ASSERT_EQ(panels.size(), 3u);
  const char* const titles[] = { "plain VTK", "vtkShadowMapPass", "raytraced" };
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_THAT(panels[i].title, HasSubstr(titles[i]));
    EXPECT_EQ(panels[i].picture.width, firstPanelPixels) << titles[i];
    EXPECT_EQ(panels[i].picture.height, firstPanelPixels / 2) << titles[i];
    EXPECT_NE(panels[i].picture.rgb, panels[(i + 1) % 3].picture.rgb) << titles[i];
  }
}

/// Though lights have moved before, so that maps are stale.
TEST(ComparisonRun, PixelsAreCountedAsTheMapDecidesThem)
{
  ComparisonPlan plan = smallPlan({ "silhouette" }, 1024, 140);
  plan.frames = 1;
  const ComparisonResults results = compareCube(plan);
  const Json& silhouette = variant(results, "silhouette 1024");
  const int traced = silhouette.at("traced_pixels");
  EXPECT_LT(2 * traced, variant(results, "raytraced").at("traced_pixels"));
  // Frames are timed once the map is baked, which has a million texels of several numbers.
  EXPECT_GT(silhouette.at("memory_bytes").at("maps"), 1 << 24);
}

TEST(ComparisonRun, StagesAreNineTenthsOfAFrame)
{
  ComparisonPlan plan = smallPlan({ "nsm", "coherence", "crsm" }, 512, 512);
  plan.frames = 3;
  const ComparisonResults results = runComparison(loadScene("posts"), plan, {});
  for (const Json& of : results.json.at("variants"))
  {
    // The best of the motions: other work of the machine comes between stages.
    double share = 0.0;
    for (const Json& timing : of.at("times"))
    {
      share = std::max(share, timing.value("stage_share", 0.0));
    }
    EXPECT_TRUE(share == 0.0 || share >= 0.9) << of.at("name") << ": " << share;
  }
}

TEST(ComparisonRun, AllTechniquesCountTheSamePixels)
{
  const ComparisonResults results = runComparison(
    loadScene("posts"), smallPlan(allTechniques(), 128, 64, { routeInline, routeImage }), {});
  EXPECT_GE(results.pictures.size(), registry().size() + 2) << "with the peers";
  const Json& ofTruth = variant(results, "raytraced").at("class_pixels");
  std::set<std::string> tell;
  for (const Json& of : results.json.at("variants"))
  {
    const Json& classes = of.at("class_pixels");
    if (classes.empty())
    {
      continue;
    }
    std::int64_t all = 0;
    for (const std::int64_t pixels : classes)
    {
      all += pixels;
    }
    const std::int64_t away = classes.at("turned away from the light");
    const std::int64_t none = classes.at("no receiver");
    EXPECT_TRUE(away > 0 && none > 0) << of.at("name");
    EXPECT_EQ(all, 64 * 64) << of.at("name");
    EXPECT_EQ(all - away - none, of.at("error").at("facing_pixels")) << of.at("name");
    EXPECT_EQ(away, ofTruth.at("turned away from the light")) << of.at("name");
    EXPECT_EQ(none, ofTruth.at("no receiver")) << of.at("name");
    tell.insert(of.at("technique"));
  }
  EXPECT_THAT(tell,
    ElementsAre("coherence", "crsm", "crsma", "montecarlo", "pcss", "penumbra", "raytraced",
      "selective", "silhouette"));
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
  results.pictures.insert(results.pictures.end(), soft.pictures.begin(), soft.pictures.end());
  for (const Json& of : soft.json.at("variants"))
  {
    results.json["variants"].push_back(of);
  }
  std::set<std::string> kinds;
  for (std::size_t i = 0; i < results.pictures.size(); ++i)
  {
    const Json& of = results.json.at("variants")[i];
    SCOPED_TRACE(of.at("name"));
    std::map<std::array<int, 3>, std::int64_t> errors = coloursOf(results.pictures[i].errors);
    EXPECT_EQ((errors[{ 64, 128, 255 }]), of.at("error").at("false_light_pixels"));
    EXPECT_EQ((errors[{ 255, 48, 48 }]), of.at("error").at("false_shadow_pixels"));
    std::int64_t purple = 0; // shows the picture beneath
    for (const auto& [colour, pixels] : errors)
    {
      purple += colour[0] - colour[1] == 68 && colour[2] - colour[1] == 95 ? pixels : 0;
    }
    EXPECT_EQ(purple, of.at("traced_pixels"));
    // Each class has a colour of its own, and there is no other.
    std::map<std::array<int, 3>, std::int64_t> colours = coloursOf(results.pictures[i].classes);
    const TechniqueEntry* const entry = findTechnique(of.at("technique").get<std::string>());
    std::int64_t ofClasses = 0;
    for (const PixelClass& each :
      entry ? entry->estimator->info.classes : std::vector<PixelClass>())
    {
      const std::int64_t drawn = colours[{ each.colour[0], each.colour[1], each.colour[2] }];
      EXPECT_EQ(drawn, of.at("class_pixels").value(each.name, 0)) << each.name;
      ofClasses += drawn;
      kinds.insert(entry->name + (drawn > 0 ? ", " + std::string(each.name) : ""));
    }
    EXPECT_EQ(ofClasses, static_cast<std::int64_t>(results.pictures[i].classes.pixelCount()));
  }
  EXPECT_GT(kinds.size(), 20u);
}

TEST(ComparisonRun, MeasuresSoftShadowsAgainstManySamples)
{
  const ComparisonResults results = runComparison(loadScene("soft-stack"),
    smallPlan({ "nsm", "raytraced:light_samples=4", "raytraced:light_samples=64" }), {});
  EXPECT_THAT(results.json.at("notes").dump(),
    HasSubstr("The truth has 4096 samples of each area light for every pixel, with light_seed 1."));
  const double few = rms(results, "raytraced light_samples=4");
  const double many = rms(results, "raytraced light_samples=64");
  EXPECT_GT(rms(results, "nsm 256 image"), 2.0 * few);
  EXPECT_GT(few, 2.0 * many);
  EXPECT_TRUE(many > 0.0 && many < 0.02) << many;
}

TEST(ComparisonRun, TheLightsHaveOneSizeForAllVariantsAndTheTruth)
{
  ComparisonPlan plan = smallPlan({ "nsm", "planar", "penumbra" });
  const ComparisonResults results =
    compareCube(plan, { { "light_radius", "10" }, { "light_samples", "16" } });
  EXPECT_EQ(results.json.at("settings").at("Of all lights"), "light_radius 10");
  const double traced = rms(results, "raytraced light_samples=16");
  EXPECT_GT(traced, 0.0);
  EXPECT_EQ(rms(results, "penumbra light_samples=16"), traced);
  EXPECT_GT(rms(results, "nsm 256 image"), 3.0 * traced);
  EXPECT_GT(rms(results, "nsm 256 image"), 3.0 * rms(results, "planar light_samples=16"));

  // The scene's own lights may have it, and the plan overrides them and their kernel.
  Scene scene = loadScene("cube");
  scene.lights.at(0).settings = { { "light_radius", "1" }, { "kernel_size", "32" } };
  plan.settings = { { "light_radius", "10" }, { "light_samples", "16" } };
  EXPECT_EQ(runComparison(scene, plan, {}).json.at("variants")[4].at("error"),
    results.json.at("variants")[4].at("error"));
}

TEST(ComparisonRun, TheTruthHasSamplesOfItsOwn)
{
  ComparisonPlan plan = smallPlan({ "raytraced:light_seed=2" });
  plan.truthSamples = 64;
  const ComparisonResults results = compareCube(plan,
    { { "light_radius", "10" }, { "light_samples", "1" }, { "light_seed", "1" },
      { "light_sampling", "random" } });
  EXPECT_THAT(results.json.at("notes").dump(),
    testing::AllOf(HasSubstr("The truth has 64 samples"), HasSubstr("with light_seed 3")));
  EXPECT_GT(rms(results, "raytraced light_samples=1 light_sampling=random light_seed=1"), 0.02);
}

TEST(ComparisonRun, SettingsReachTheTechniquesThatHaveThem)
{
  EXPECT_THAT(namesOf(compareCube(smallPlan({ "nsm", "planar", "raytraced" }),
                { { "planes", "2" }, { "bias_constant", "0.5" } })),
    ElementsAre("plain VTK", "vtkShadowMapPass 256", "nsm bias_constant=0.5 256 image",
      "planar planes=2", "raytraced"));
  const ComparisonResults results = compareCube(smallPlan({ "nsm" }), { { "estimator", "crsm" } });
  EXPECT_EQ(number(results, "nsm estimator=crsm 256", "wrong_pixels"), 0.0);
  EXPECT_GT(variant(results, "nsm estimator=crsm 256").at("traced_pixels"), 0);
}

TEST(ComparisonRun, NamesBadInput)
{
  const auto refusal = [](const char* technique, const std::map<std::string, std::string>& settings)
  { return messageOf<BadInput>([&] { compareCube(smallPlan({ technique }), settings); }); };
  EXPECT_THAT(
    refusal("nsm",
      { { "light_radius", "10" }, { "light_samples", "5" }, { "light_sampling", "jittered" } }),
    testing::AllOf(HasSubstr("raytraced, the truth"), HasSubstr("jittered")));
  EXPECT_THAT(refusal("pcss:light_radius=3", {}),
    testing::AllOf(HasSubstr("pcss:light_radius=3"), HasSubstr("--light-radius")));
  EXPECT_THAT(refusal("nsm", { { "planes", "2" } }), HasSubstr("--planes"));
  Scene scene = loadScene("cube");
  scene.lights.at(0).intensity = 0.0;
  EXPECT_THAT(messageOf<BadInput>([&] { runComparison(scene, smallPlan({ "nsm" }), {}); }),
    HasSubstr("no light casts a shadow"));
}

TEST(PictureSize, BeyondTheLimitsOfOpenGlNamesThem)
{
  EXPECT_NO_THROW(requireDrawable({ 4096, 2048 }, 4096, 4096, 2048));
  EXPECT_THROW(requireDrawable({ 16, 2049 }, 4096, 4096, 2048), BadInput);
  EXPECT_EQ(messageOf<BadInput>(
              [] {
                requireDrawable({ 5000, 16 }, 4096, 8192, 2048);
              }),
    "--size: found 5000x16, and OpenGL draws no more than 4096x2048 here (GL_MAX_TEXTURE_SIZE "
    "4096, GL_MAX_VIEWPORT_DIMS 8192 x 2048)");
}

/// Run `gnomon compare` with these options.
void compare(const std::string& options)
{
  CLI::App app("gnomon");
  addCompareCommand(app);
  app.parse("compare " + options);
}

/// The names of the variants that a small comparison has in its results.csv.
std::vector<std::string> comparedRows(const std::string& options)
{
  const TestFolder folder;
  compare(
    options + " --size 32x32 --map-sizes 64 --frames 0 --truth-samples 4 -o " + folder.path());
  for (const char* name : { "first.png", "report.html", "results.json", "raytraced-classes.png" })
  {
    EXPECT_GT(readBytes(folder / name).size(), 0u) << name;
  }
  std::istringstream table(readBytes(folder / "results.csv"));
  std::vector<std::string> names;
  for (std::string line; std::getline(table, line);)
  {
    names.push_back(line.substr(0, line.find(',')));
  }
  names.erase(names.begin());
  return names;
}

TEST(CompareCommand, ComparesWhatAUserWouldChooseAmong)
{
  EXPECT_THAT(comparedRows("cube"),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "pcf 64 inline",
      "vsm 64 inline", "pssm 64 inline", "silhouette 64", "raytraced"));
  EXPECT_THAT(comparedRows("cube --light-radius 5"),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "pcf 64 inline",
      "pcss 64 image", "sampled 64", "penumbra", "raytraced"));
  EXPECT_THAT(comparedRows("cube --techniques nsm"),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "nsm 64 image", "raytraced"));
  EXPECT_THAT(comparedRows("cube --techniques nsm --route image"),
    ElementsAre("plain VTK", "vtkShadowMapPass 64", "nsm 64 image", "raytraced"));
  const std::vector<std::string> all = comparedRows("cube --all");
  EXPECT_THAT(all,
    testing::IsSupersetOf({ "plain VTK", "vtkShadowMapPass 64", "nsm 64 inline", "nsm 64 image",
      "pcss 64 image", "montecarlo 64", "planar", "raytraced" }));
  std::set<std::string> techniques;
  for (const std::string& row : all)
  {
    techniques.insert(row.substr(0, row.find(' ')));
  }
  EXPECT_EQ(techniques.size(), registry().size() + 2) << "with the peers";
}

} // namespace
} // namespace gnomon::tool
