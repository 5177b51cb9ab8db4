// Which rasterizer bakes conservative maps, how it is reported, and when maps are baked again.

#include "plugin/frame/MapRasterizer.h"

#include "LiveObjects.h"
#include "PassScene.h"

#include "plugin/vtkGnomonShadowPass.h"

#include <gmock/gmock.h>

#include <sstream>
#include <stdexcept>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

constexpr int automatic = vtkGnomonShadowPass::RASTERIZER_AUTO;
constexpr int cpu = vtkGnomonShadowPass::RASTERIZER_CPU;
constexpr int gpuWished = vtkGnomonShadowPass::RASTERIZER_GPU;

TEST(RasterizerChoice, isWhatWasAskedFor)
{
  for (const RasterizerWish wished : { RasterizerWish::Cpu, RasterizerWish::Gpu })
  {
    const RasterizerChoice choice = chooseRasterizer(wished, "");
    EXPECT_EQ(choice.gpu, wished == RasterizerWish::Gpu);
    EXPECT_EQ(choice.reason, "asked for");
  }
}

TEST(RasterizerChoice, isTheCpuWhereNothingWasAskedFor)
{
  for (const char* gpuLacks : { "", "it lacks this" })
  {
    const RasterizerChoice choice = chooseRasterizer(RasterizerWish::Auto, gpuLacks);
    EXPECT_FALSE(choice.gpu);
    EXPECT_EQ(choice.reason, "drawing by compute shaders is not measured faster");
  }
}

TEST(RasterizerChoice, tellsWhatTheGpuLacks)
{
  EXPECT_FALSE(chooseRasterizer(RasterizerWish::Cpu, "it lacks this").gpu);
  try
  {
    chooseRasterizer(RasterizerWish::Gpu, "it lacks this");
    FAIL() << "it cannot";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "the rasterizer on the GPU was asked for, but it lacks this");
  }
}

/// A box over a floor.
class Rasterizers : public testing::Test
{
protected:
  void SetUp() override
  {
    this->scene_.addFloor(4.0, 0.0);
    this->scene_.addBox({ -0.5, -0.5, 0.5 }, { 0.5, 0.5, 1.0 });
    this->scene_.addSun({ 0.4, 0.3, -1.0 });
    this->scene_.lookDown(3.0);
    this->scene_.pass->SetTechnique("crsm");
  }
  const LightReport& render()
  {
    this->scene_.render();
    return this->scene_.report().lights.at(0);
  }

  PassScene scene_{ 64, 64 };
};

TEST_F(Rasterizers, areInTheReport)
{
  EXPECT_EQ(this->render().rasterizer, "cpu");
  EXPECT_THAT(this->render().rasterizerReason, HasSubstr("not measured faster"));
  this->scene_.pass->SetRasterizer(gpuWished);
  EXPECT_EQ(this->render().rasterizer, "gpu");
  EXPECT_EQ(this->render().rasterizerReason, "asked for");
  this->scene_.pass->SetTechnique("silhouette");
  EXPECT_EQ(this->render().rasterizer, "cpu");
  EXPECT_THAT(this->render().rasterizerReason, HasSubstr("one after another"));
  this->scene_.pass->SetTechnique("raytraced");
  EXPECT_EQ(this->render().rasterizer, "");
  EXPECT_EQ(this->render().rasterizerReason, "");
  this->scene_.pass->SetTechnique("nsm");
  EXPECT_EQ(this->render().rasterizer, "");
  std::ostringstream text;
  this->scene_.pass->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Rasterizer: gpu"));
}

TEST_F(Rasterizers, drawMapsAnewOnlyWhereTheyChange)
{
  this->scene_.pass->SetRasterizer(cpu);
  this->render();
  EXPECT_EQ(this->scene_.report().mapBakes, 1);
  this->scene_.pass->SetRasterizer(gpuWished);
  this->render();
  EXPECT_EQ(this->scene_.report().mapBakes, 1);
  this->render();
  EXPECT_EQ(this->scene_.report().mapBakes, 0);
  EXPECT_EQ(this->scene_.report().programCompiles, 0);
}

TEST_F(Rasterizers, areThereForTheReasonOfThisFrame)
{
  EXPECT_NE(this->render().rasterizerReason, "asked for");
  this->scene_.pass->SetRasterizer(cpu);
  EXPECT_EQ(this->render().rasterizerReason, "asked for");
  EXPECT_EQ(this->scene_.report().mapBakes, 0);
  this->scene_.pass->SetRasterizer(automatic);
  EXPECT_NE(this->render().rasterizerReason, "asked for");
  EXPECT_EQ(this->scene_.report().mapBakes, 0);
}

TEST_F(Rasterizers, areTheCpuForMapsAsPublished)
{
  this->scene_.pass->SetRasterizer(gpuWished);
  this->scene_.pass->SetSetting("as_published", "on");
  for (const char* technique : { "crsm", "crsma" })
  {
    this->scene_.pass->SetTechnique(technique);
    EXPECT_EQ(this->render().rasterizer, "cpu") << technique;
    EXPECT_EQ(this->render().rasterizerReason,
      "maps by the letter of the publication are drawn by the CPU alone");
  }
}

TEST_F(Rasterizers, leaveNothingOnTheGpu)
{
  this->scene_.pass->SetRasterizer(cpu);
  this->render();
  this->scene_.pass->SetRasterizer(gpuWished);
  this->render(); // programs stay compiled
  this->scene_.pass->SetRasterizer(cpu);
  this->render();
  const LiveObjects before = countLiveObjects(this->scene_.window);
  for (const int rasterizer : { gpuWished, cpu, gpuWished })
  {
    this->scene_.pass->SetRasterizer(rasterizer);
    this->render();
  }
  EXPECT_EQ(countLiveObjects(this->scene_.window), before);
}

} // namespace
} // namespace gnomon::test
