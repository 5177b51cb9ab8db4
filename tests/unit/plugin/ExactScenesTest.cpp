// Exact techniques equal ray tracing in all built-in scenes but the largest.

#include "BuiltinPass.h"
#include "PassScene.h"

#include "BuiltinScenes.h"
#include "Scene.h"

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
