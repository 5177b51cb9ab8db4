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

class ExactScenes : public testing::TestWithParam<std::string>
{
};

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
  scene.pass->SetSetting("bake", "always");

  scene.pass->SetTechnique("raytraced");
  scene.window->Render();
  const std::vector<std::vector<float>> truth = scene.pass->GetVisibility().visibility;
  ASSERT_FALSE(truth.empty());
  EXPECT_GT(scene.pass->GetReport().numbersChecked, 0);
  EXPECT_EQ(scene.pass->GetReport().numbersWrong, 0);
  for (const TechniqueEntry& technique : registry())
  {
    if (!technique.estimator->info.exact || !technique.estimator->info.bakesMap())
    {
      continue;
    }
    scene.pass->SetTechnique(technique.name.c_str());
    for (const int size : { 1024, 256 })
    {
      scene.pass->SetMapSize(size);
      scene.window->Render();
      const std::string what = technique.name + ", map " + std::to_string(size);
      const std::vector<std::vector<float>>& visibility = scene.pass->GetVisibility().visibility;
      ASSERT_EQ(visibility.size(), truth.size()) << what;
      for (std::size_t light = 0; light < truth.size(); ++light)
      {
        std::size_t different = 0;
        for (std::size_t i = 0; i < truth[light].size(); ++i)
        {
          different += visibility[light][i] != truth[light][i] ? 1 : 0;
        }
        EXPECT_EQ(different, 0u) << what << ", light " << light;
      }
    }
  }
}

/// Cameras and lights that no scene's author intended: also inside surfaces, and with lamps that
/// touch them.
class ExactScenesFromAnywhere : public testing::TestWithParam<const char*>
{
};

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

  scene.pass->SetSetting("bake", "always");
  // `selective` is exact if its contour is the whole picture and it accepts no texel by coherence.
  scene.pass->SetSetting("contour", "image");
  scene.pass->SetSetting("coherence", "off");
  const std::array<std::string, 4> techniques = { "crsm", "crsma", "silhouette", "selective" };
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

    scene.pass->SetTechnique("raytraced");
    scene.window->Render();
    const std::vector<std::vector<float>> truth = scene.pass->GetVisibility().visibility;
    ASSERT_EQ(truth.size(), 1u);
    sumReceivers += scene.pass->GetReport().lights.at(0).tracedPixels;
    for (std::size_t number = 0; number < techniques.size(); ++number)
    {
      scene.pass->SetTechnique(techniques[number].c_str());
      scene.window->Render();
      const std::vector<std::vector<float>>& visibility = scene.pass->GetVisibility().visibility;
      ASSERT_EQ(visibility.size(), 1u);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < truth[0].size(); ++i)
      {
        wrong += visibility[0][i] != truth[0][i] ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0u) << techniques[number] << ", run " << run << ", map "
                           << scene.pass->GetMapSize() << ", light of kind " << kind;
      sumsTraced[number] += scene.pass->GetReport().lights.at(0).tracedPixels;
    }
  }
  EXPECT_GT(sumReceivers, 0);
  for (std::size_t number = 0; number < techniques.size(); ++number)
  {
    // `selective` may have to trace both pictures whole.
    if (techniques[number] != "selective")
    {
      EXPECT_LT(sumsTraced[number], sumReceivers) << techniques[number];
    }
  }
}

/// A lit face's texels hold other layers, too: faces of its own solid that are turned away from the
/// light, and the ground. Their noise must not force rays.
TEST(ExactFaces, areDecidedWhateverTheNoiseOfWhatIsBehindThem)
{
  for (const char* name : { "long-cube", "stack" })
  {
    const BuiltinPass scene(name, 512);
    scene.pass->SetMapSize(1024);
    scene.pass->SetSetting("bake", "always");
    const auto traced = [&](const char* technique)
    {
      scene.pass->SetTechnique(technique);
      scene.window->Render();
      return scene.pass->GetReport().lights[0].tracedPixels;
    };
    const auto all = traced("raytraced");
    const std::vector<std::vector<float>> truth = scene.pass->GetVisibility().visibility;
    ASSERT_FALSE(truth.empty());
    for (const char* technique : { "crsma", "silhouette" })
    {
      EXPECT_LT(20 * traced(technique), all) << technique << ", " << name;
      EXPECT_EQ(scene.pass->GetVisibility().visibility, truth) << technique << ", " << name;
    }
  }
}

class ExactSoftScenes : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Builtin, ExactSoftScenes,
  testing::Values("soft-stack", "soft-panels", "soft-plates", "soft-long-cube", "bunny", "posts",
    "plates", "screens", "cups", "office", "room", "terrain", "bench-side", "atrium"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

/// All exact techniques equal tracing all rays.
TEST_P(ExactSoftScenes, showWhatAllRaysShow)
{
  const BuiltinPass scene(GetParam(), 160);
  scene.pass->SetSetting("light_samples", "16");
  if (std::string(GetParam()).rfind("soft-", 0) != 0)
  {
    scene.pass->SetSetting("light_radius", "3"); // degrees, or world units
  }
  scene.pass->SetTechnique("raytraced");
  scene.window->Render();
  const std::vector<std::vector<float>> truth = scene.pass->GetVisibility().visibility;
  scene.pass->SetTechnique("penumbra");
  scene.window->Render();
  const std::vector<std::vector<float>>& visibility = scene.pass->GetVisibility().visibility;
  ASSERT_FALSE(truth.empty());
  ASSERT_EQ(visibility.size(), truth.size());
  for (std::size_t light = 0; light < truth.size(); ++light)
  {
    EXPECT_EQ(std::count(truth[light].begin(), truth[light].end(), 1.0f),
      std::count(visibility[light].begin(), visibility[light].end(), 1.0f));
    EXPECT_TRUE(visibility[light] == truth[light]) << "light " << light;
  }
}

/// Every pixel has a class, and the counts are of traced pixels. Without coherence `selective` is
/// the truth inside its contour.
class SelectiveScenes : public testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(Builtin, SelectiveScenes,
  testing::Values("primitives", "cups", "room", "screens", "office", "terrain", "posts"),
  [](const testing::TestParamInfo<const char*>& scene) { return testNameOf(scene.param); });

TEST_P(SelectiveScenes, areTracedInsideTheContour)
{
  const BuiltinPass scene(GetParam(), 256);
  const auto draw = [&](const char* technique) -> const VisibilityImages&
  {
    scene.pass->SetTechnique(technique);
    scene.window->Render();
    return scene.pass->GetVisibility();
  };
  for (const char* technique : { "coherence", "selective" })
  {
    draw(technique);
    for (const LightReport& light : scene.pass->GetReport().lights)
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
  const std::vector<std::vector<float>> truth = draw("raytraced").visibility;
  scene.pass->SetTechnique("selective");
  scene.pass->SetSetting("coherence", "off");
  scene.pass->SetSetting("contour", "4");
  const VisibilityImages& contour = draw("selective");
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
