// selective and coherence through the pass, in built-in scenes: exact where they say so, and every pixel
// has its class.

#include "BuiltinScenes.h"
#include "Scene.h"

#include "plugin/VisibilityImages.h"
#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/base/FrameReport.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

class SelectiveScenes : public testing::TestWithParam<const char*>
{
protected:
  void SetUp() override
  {
    this->renderer_ = tool::makeRenderer(tool::loadScene(this->GetParam()), 1.0);
    this->window_->SetMultiSamples(0);
    this->window_->SetSize(256, 256);
    this->window_->AddRenderer(this->renderer_);
    this->pass_->KeepVisibilityOn();
    this->renderer_->SetPass(this->pass_);
  }

  /// Draws a frame by a technique.
  const VisibilityImages& draw(const char* technique)
  {
    this->pass_->SetTechnique(technique);
    this->window_->Render();
    return this->pass_->GetVisibility();
  }

  vtkSmartPointer<vtkRenderer> renderer_;
  vtkNew<vtkGnomonEGLRenderWindow> window_;
  vtkNew<vtkGnomonShadowPass> pass_;
};

INSTANTIATE_TEST_SUITE_P(Builtin, SelectiveScenes,
  testing::Values("primitives", "cups", "room", "screens", "office", "terrain", "posts"),
  [](const auto& scene) { return std::string(scene.param); });

TEST_P(SelectiveScenes, areTracedBitForBitWithoutCoherence)
{
  const std::vector<std::vector<float>> truth = this->draw("raytraced").visibility;
  this->pass_->SetSetting("coherence", "off");
  this->pass_->SetSetting("contour", "image");
  EXPECT_EQ(this->draw("selective").visibility, truth);

  this->pass_->SetSetting("contour", "4");
  const VisibilityImages& contour = this->draw("selective");
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

TEST_P(SelectiveScenes, haveAClassForEveryPixel)
{
  for (const char* technique : { "coherence", "selective" })
  {
    this->draw(technique);
    for (const LightReport& light : this->pass_->GetReport().lights)
    {
      if (!light.casts)
      {
        continue;
      }
      std::int64_t pixels = 0, traced = 0;
      for (const ClassCount& count : light.classes)
      {
        pixels += count.pixels;
        traced += count.name.find("traced") != std::string::npos ? count.pixels : 0;
      }
      EXPECT_EQ(pixels, 256 * 256) << technique;
      EXPECT_EQ(traced, light.tracedPixels) << technique;
    }
  }
}

} // namespace
} // namespace gnomon::test
