// Who draws conservative maps, what the report says of it, and when they are drawn anew.

#include "plugin/MapRasterizer.h"

#include "LiveObjects.h"
#include "PassScene.h"

#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/TextureMemory.h"

#include <gmock/gmock.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;
using testing::StartsWith;

const std::string geforceRenderer = "NVIDIA GeForce RTX 4090/PCIe/SSE2";
const std::string llvmpipe = "llvmpipe (LLVM 15.0.6, 256 bits)";
constexpr int automatic = vtkGnomonShadowPass::RASTERIZER_AUTO;
constexpr int cpu = vtkGnomonShadowPass::RASTERIZER_CPU;
constexpr int gpuWished = vtkGnomonShadowPass::RASTERIZER_GPU;

TEST(RasterizerChoice, isWhatWasAskedFor)
{
  for (const std::string& renderer : { llvmpipe, geforceRenderer })
  {
    const RasterizerChoice asCpu = chooseRasterizer(cpu, "", "", renderer);
    EXPECT_FALSE(asCpu.gpu);
    EXPECT_TRUE(asCpu.asked);
    EXPECT_EQ(asCpu.reason, "asked for");
    EXPECT_EQ(chooseRasterizer(gpuWished, "", "", renderer).gpu, CellPath::Extension);
    EXPECT_EQ(chooseRasterizer(gpuWished, "", "no extension", renderer).gpu, CellPath::Compute);
  }
}

TEST(RasterizerChoice, isTheGpuWhereOpenGlIsHardwareAndHasAnExtension)
{
  const RasterizerChoice hardware = chooseRasterizer(automatic, "", "", geforceRenderer);
  EXPECT_EQ(hardware.gpu, CellPath::Extension);
  EXPECT_FALSE(hardware.asked);
  EXPECT_EQ(hardware.reason, "OpenGL draws by hardware: " + geforceRenderer);
  const RasterizerChoice without = chooseRasterizer(automatic, "", "no extension", geforceRenderer);
  EXPECT_FALSE(without.gpu);
  EXPECT_EQ(without.reason, "no extension");
  const RasterizerChoice software = chooseRasterizer(automatic, "", "", llvmpipe);
  EXPECT_FALSE(software.gpu);
  EXPECT_EQ(software.reason, "OpenGL draws by software: " + llvmpipe);
}

TEST(RasterizerChoice, tellsWhatTheGpuLacks)
{
  EXPECT_FALSE(chooseRasterizer(automatic, "it lacks this", "it lacks that", geforceRenderer).gpu);
  EXPECT_FALSE(chooseRasterizer(cpu, "it lacks this", "it lacks that", geforceRenderer).gpu);
  try
  {
    chooseRasterizer(gpuWished, "it lacks this", "it lacks that", geforceRenderer);
    FAIL() << "it cannot";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "the rasterizer on the GPU was asked for, but it lacks this");
  }
}

/// Draws maps, but not on the GPU.
class WithoutRoomOnGpu : public Technique
{
public:
  void bake(const MapInput& input) override
  {
    ++this->bakes;
    if (input.cellsOnGpu)
    {
      throw TextureMemoryError("no room");
    }
  }

  int bakes = 0;
};

TEST(RasterizerChoice, isTheCpuWhereTheGpuHasNoRoomAndWasNotAskedFor)
{
  const ShadowLight light;
  const LightViews views;
  const Occluders occluders;
  const OccluderBuffers buffers;
  ShaderLibrary shaders;
  const auto bake = [&](WithoutRoomOnGpu& technique, const RasterizerChoice& choice) {
    return bakeMaps(technique, { light, views, occluders, buffers, shaders }, choice);
  };
  WithoutRoomOnGpu automatically, asked, onCpu;
  const RasterizerChoice taken = bake(automatically, { CellPath::Compute, false, "hardware" });
  EXPECT_FALSE(taken.gpu);
  EXPECT_EQ(taken.reason, "drawing maps on the GPU failed: no room");
  EXPECT_EQ(automatically.bakes, 2);
  EXPECT_THROW(bake(asked, { CellPath::Compute, true, "asked for" }), TextureMemoryError);
  EXPECT_EQ(asked.bakes, 1);
  EXPECT_EQ(bake(onCpu, { std::nullopt, true, "asked for" }).reason, "asked for");
  EXPECT_EQ(onCpu.bakes, 1);
}

TEST(RasterizerChoice, isTheCpuWhereOpenGlFailsAndWasNotAskedFor)
{
  class Failing : public Technique
  {
  public:
    void bake(const MapInput& input) override
    {
      if (input.cellsOnGpu)
      {
        throw std::runtime_error("OpenGL fails");
      }
    }
  } technique;
  const ShadowLight light;
  const LightViews views;
  const Occluders occluders;
  const OccluderBuffers buffers;
  ShaderLibrary shaders;
  EXPECT_EQ(bakeMaps(technique, { light, views, occluders, buffers, shaders },
              { CellPath::Compute, false, "hardware" })
              .reason,
    "drawing maps on the GPU failed: OpenGL fails");
}

TEST(RasterizerChoice, isWhatMapsAreDrawnAnewFor)
{
  const RasterizerChoice byCpu{ std::nullopt, true, "asked for" };
  const RasterizerChoice byGpu{ CellPath::Extension, true, "asked for" };
  const RasterizerChoice hardware{ CellPath::Extension, false, "hardware" };
  const RasterizerChoice failed{ std::nullopt, false, "no room" };
  EXPECT_TRUE(servesChoice(byCpu, byCpu, byCpu));
  EXPECT_FALSE(servesChoice(byCpu, byCpu, byGpu));
  EXPECT_FALSE(servesChoice(byCpu, byCpu, hardware));
  EXPECT_TRUE(servesChoice(hardware, hardware, byGpu));
  EXPECT_FALSE(servesChoice(hardware, hardware, byCpu));
  EXPECT_TRUE(servesChoice(hardware, failed, hardware)) << "it would fail again";
  EXPECT_FALSE(servesChoice(hardware, failed, byGpu)) << "it is to be drawn, or to be an error";
  EXPECT_TRUE(servesChoice(hardware, failed, byCpu));
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
  const LightReport first = this->render();
  const RasterizerChoice choice = chooseRasterizer(automatic, whyUnsupported(CellPath::Compute),
    whyUnsupported(CellPath::Extension), reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  EXPECT_EQ(first.rasterizer, choice.gpu ? std::string("gpu: ") + nameOf(*choice.gpu) : "cpu");
  EXPECT_EQ(first.rasterizerReason, choice.reason);
  this->scene_.pass->SetRasterizer(gpuWished);
  EXPECT_THAT(this->render().rasterizer, StartsWith("gpu: "));
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
  const bool byCpu = this->render().rasterizer == "cpu";
  EXPECT_NE(this->scene_.report().lights.at(0).rasterizerReason, "asked for");
  this->scene_.pass->SetRasterizer(byCpu ? cpu : gpuWished);
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
  this->render(); // programs stay
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
