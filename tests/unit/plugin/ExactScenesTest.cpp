// Exact techniques equal ray tracing in all built-in scenes but the largest.

#include "BuiltinPass.h"
#include "PassScene.h"
#include "RandomScenes.h"

#include "BuiltinScenes.h"
#include "Scene.h"

#include <vtkBoundingBox.h>

namespace gnomon::test
{
namespace
{

using Layers = std::vector<std::vector<float>>;

/// Expect lights' visibility to be that of another technique, bit for bit.
void expectSame(const Layers& visibility, const Layers& truth)
{
  ASSERT_EQ(visibility.size(), truth.size());
  for (std::size_t light = 0; light < truth.size(); ++light)
  {
    EXPECT_EQ(countDifferences(visibility[light], truth[light]), 0u) << "light " << light;
  }
}

using ExactScenes = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Builtin, ExactScenes,
  testing::ValuesIn(
    []
    {
      std::vector<std::string> names;
      for (const tool::BuiltinScene& scene : tool::builtinScenes())
      {
        // For area lights, these techniques are exact for the centre's shadow.
        // 64 conservative maps of a cube each take 4 GB.
        const bool large =
          scene.name == "city" || scene.name == "molecule" || scene.name == "building";
        if (!large && scene.name.rfind("soft-", 0) != 0)
        {
          names.push_back(scene.name);
        }
      }
      return names;
    }()),
  [](const testing::TestParamInfo<std::string>& scene) { return testNameOf(scene.param); });

TEST_P(ExactScenes, showWhatIsTraced)
{
  const BuiltinPass scene(GetParam(), 400);
  const Layers truth = scene.draw("bake=always raytraced").visibility;
  ASSERT_FALSE(truth.empty());
  EXPECT_GT(scene.report().numbersChecked, 0);
  EXPECT_EQ(scene.report().numbersWrong, 0);
  for (const TechniqueEntry& technique : registry())
  {
    if (!technique.estimator->info.exact || !technique.estimator->info.bakesMap())
    {
      continue;
    }
    for (const char* size : { " map_size=1024", " map_size=256" })
    {
      SCOPED_TRACE(technique.name + size);
      expectSame(scene.draw((technique.name + size).c_str()).visibility, truth);
    }
  }
}

/// Cameras and lights that no scene's author intended: also inside surfaces, and with lamps that
/// touch them.
using ExactScenesFromAnywhere = testing::TestWithParam<const char*>;

INSTANTIATE_TEST_SUITE_P(Builtin, ExactScenesFromAnywhere,
  testing::Values("bunny", "horse", "cat", "office", "room", "terrain", "bench-side", "trees-side",
    "flowers-side", "atrium"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

TEST_P(ExactScenesFromAnywhere, showWhatIsTraced)
{
  const std::string name = GetParam();
  const BuiltinPass scene(name, 256);
  const vtkBoundingBox bounds(scene.renderer->ComputeVisiblePropBounds());
  double lowest[3], highest[3];
  bounds.GetBounds(lowest[0], highest[0], lowest[1], highest[1], lowest[2], highest[2]);
  const glm::dvec3 low = glm::make_vec3(lowest), high = glm::make_vec3(highest);
  // Seeded by the scene, so no two scenes share cameras.
  std::seed_seq seeds(name.begin(), name.end());
  Random random(seeds);
  /// Return a random place in the scene's box, grown by that share of its sides.
  const auto somewhere = [&](double grown)
  {
    const glm::dvec3 share(uniform(random, -grown, 1.0 + grown),
      uniform(random, -grown, 1.0 + grown), uniform(random, -grown, 1.0 + grown));
    return low + share * (high - low);
  };

  // `selective` is exact if its contour is the whole picture and it accepts no texel by coherence.
  scene.choose("bake=always contour=image coherence=off");
  const std::array<const char*, 4> techniques = { "crsm", "crsma", "silhouette", "selective" };
  std::int64_t sumReceivers = 0;
  std::array<std::int64_t, 4> sumsTraced{};
  for (unsigned int run = 0; run < exactRuns(2); ++run)
  {
    vtkCamera* const camera = scene.renderer->GetActiveCamera();
    const glm::dvec3 eye = somewhere(0.5), looksAt = somewhere(0.0);
    camera->SetPosition(glm::value_ptr(eye));
    camera->SetFocalPoint(glm::value_ptr(looksAt));
    camera->SetViewUp(glm::value_ptr(unitVector(random)));
    camera->SetViewAngle(uniform(random, 15.0, 70.0));
    scene.renderer->ResetCameraClippingRange();

    // Four in six are directional.
    const unsigned int kind = random() % 6;
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPositional(kind < 2);
    light->SetConeAngle(kind == 0 ? uniform(random, 10.0, 60.0) : 180.0);
    const glm::dvec3 towards = somewhere(0.0);
    const glm::dvec3 from = light->GetPositional() ? somewhere(0.5) : towards + unitVector(random);
    light->SetPosition(glm::value_ptr(from));
    light->SetFocalPoint(glm::value_ptr(towards));
    scene.renderer->RemoveAllLights();
    scene.renderer->AddLight(light);
    const int mapSizes[] = { 64, 128, 256, 512, 1024, 4096 };
    scene.pass->SetMapSize(mapSizes[random() % 6]);
    scene.pass->SetSetting("fit", random() % 2 ? "frame" : "off");

    const Layers truth = scene.draw("raytraced").visibility;
    ASSERT_EQ(truth.size(), 1u);
    sumReceivers += scene.report().lights.at(0).tracedPixels;
    for (std::size_t number = 0; number < techniques.size(); ++number)
    {
      SCOPED_TRACE(testing::Message() << techniques[number] << ", run " << run << ", map "
                                      << scene.pass->GetMapSize() << ", light of kind " << kind);
      expectSame(scene.draw(techniques[number]).visibility, truth);
      sumsTraced[number] += scene.report().lights.at(0).tracedPixels;
    }
  }
  EXPECT_GT(sumReceivers, 0);
  for (std::size_t number = 0; number < 3; ++number) // `selective` may trace both pictures whole
  {
    EXPECT_LT(sumsTraced[number], sumReceivers) << techniques[number];
  }
}

/// A lit face's texels hold other layers, too: faces of its own solid that are turned away from the
/// light, and the ground. Their noise must not force rays.
TEST(ExactFaces, areDecidedWhateverTheNoiseOfWhatIsBehindThem)
{
  for (const char* name : { "long-cube", "stack" })
  {
    const BuiltinPass scene(name, 512);
    scene.choose("map_size=1024 bake=always");
    const auto traced = [&](const char* technique)
    {
      scene.draw(technique);
      return scene.report().lights[0].tracedPixels;
    };
    const auto all = traced("raytraced");
    const Layers truth = scene.pass->GetVisibility().visibility;
    ASSERT_FALSE(truth.empty());
    for (const char* technique : { "crsma", "silhouette" })
    {
      SCOPED_TRACE(std::string(technique) + ", " + name);
      EXPECT_LT(20 * traced(technique), all);
      expectSame(scene.pass->GetVisibility().visibility, truth);
    }
  }
}

using ExactSoftScenes = testing::TestWithParam<const char*>;

INSTANTIATE_TEST_SUITE_P(Builtin, ExactSoftScenes,
  testing::Values("soft-stack", "soft-panels", "soft-plates", "soft-long-cube", "bunny", "posts",
    "plates", "screens", "cups", "office", "room", "terrain", "bench-side", "atrium"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

/// All exact techniques equal tracing all rays.
TEST_P(ExactSoftScenes, showWhatAllRaysShow)
{
  const BuiltinPass scene(GetParam(), 160);
  const bool isSoft = std::string(GetParam()).rfind("soft-", 0) == 0;
  scene.choose(isSoft ? "" : "light_radius=3"); // degrees, or world units
  const Layers truth = scene.draw("raytraced light_samples=16").visibility;
  ASSERT_FALSE(truth.empty());
  expectSame(scene.draw("penumbra").visibility, truth);
}

/// Every pixel has a class, and the counts are of traced pixels. Without coherence `selective` is
/// the truth inside its contour.
using SelectiveScenes = testing::TestWithParam<const char*>;
INSTANTIATE_TEST_SUITE_P(Builtin, SelectiveScenes,
  testing::Values("primitives", "cups", "room", "screens", "office", "terrain", "posts"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

TEST_P(SelectiveScenes, areTracedInsideTheContour)
{
  const BuiltinPass scene(GetParam(), 256);
  for (const char* technique : { "coherence", "selective" })
  {
    scene.draw(technique);
    for (const LightReport& light : scene.report().lights)
    {
      std::int64_t pixels = 0, traced = 0;
      for (const ClassCount& count : light.classes)
      {
        pixels += count.pixels;
        traced += count.name.find("traced") != std::string::npos ? count.pixels : 0;
      }
      EXPECT_EQ(pixels, light.casts ? 256 * 256 : 0) << technique;
      EXPECT_EQ(traced, light.tracedPixels) << technique;
    }
  }
  const Layers truth = scene.draw("raytraced").visibility;
  const VisibilityImages& contour = scene.draw("selective coherence=off contour=4");
  ASSERT_EQ(contour.visibility.size(), truth.size());
  for (std::size_t light = 0; light < truth.size(); ++light)
  {
    const ClassImage& classes = contour.classes[light];
    std::size_t inside = 0;
    for (std::size_t i = 0; i < truth[light].size(); ++i)
    {
      const std::string& name = classes.classes[classes.ofPixels[i]].name;
      const bool outside = name.find("outside") != std::string::npos;
      inside += outside ? 0 : 1;
      EXPECT_TRUE(outside || contour.visibility[light][i] == truth[light][i]) << name;
    }
    EXPECT_GT(inside, 0u);
  }
}

} // namespace
} // namespace gnomon::test
