// Which tracer a frame uses, and when the other one's data are dropped.

#include "plugin/frame/FrameTracer.h"

#include "SyntheticScene.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <vtkNew.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

const std::string geforce = "NVIDIA GeForce RTX 4090/PCIe/SSE2";

TEST(TracerChoice, isWhatWasAskedFor)
{
  for (const std::string& renderer : { std::string("llvmpipe (LLVM 15.0.6, 256 bits)"), geforce })
  {
    for (const TracerWish wished : { TracerWish::Embree, TracerWish::Gpu })
    {
      const TracerChoice choice = chooseTracer(wished, "", renderer);
      EXPECT_EQ(choice.gpu, wished == TracerWish::Gpu);
      EXPECT_TRUE(choice.asked);
      EXPECT_EQ(choice.reason, "asked for");
    }
  }
}

TEST(TracerChoice, isTheGpuWhereThereIsOneUnlessAskedOtherwise)
{
  const TracerChoice hardware = chooseTracer(TracerWish::Auto, "", geforce);
  EXPECT_TRUE(hardware.gpu);
  EXPECT_FALSE(hardware.asked);
  EXPECT_EQ(hardware.reason, "OpenGL draws by hardware: " + geforce);
  const TracerChoice software =
    chooseTracer(TracerWish::Auto, "", "llvmpipe (LLVM 15.0.6, 256 bits)");
  EXPECT_FALSE(software.gpu);
  EXPECT_THAT(software.reason, HasSubstr("by software: llvmpipe"));
}

TEST(TracerChoice, tellsWhatTheGpuLacks)
{
  const TracerChoice choice = chooseTracer(TracerWish::Auto, "it lacks this", geforce);
  EXPECT_FALSE(choice.gpu);
  EXPECT_EQ(choice.reason, "it lacks this");
  EXPECT_FALSE(chooseTracer(TracerWish::Embree, "it lacks this", geforce).gpu);
  try
  {
    chooseTracer(TracerWish::Gpu, "it lacks this", geforce);
    FAIL() << "it cannot";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "the tracer on the GPU was asked for, but it lacks this");
  }
}

/// A box over a floor, in a context.
class FrameTracers : public testing::Test
{
protected:
  FrameTracers()
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
  }
  ~FrameTracers() override { this->window_->MakeCurrent(); }

  /// Give the snapshot more vertices than shaders can address. Few of them are ever touched.
  void makeHuge()
  {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    this->occluders_.positionsCentred.resize(
      static_cast<std::size_t>(most) / sizeof(glm::vec3) + 2);
    ++this->occluders_.topologyVersion;
    ++this->occluders_.positionsVersion;
  }
  std::vector<float> trace()
  {
    Camera camera;
    camera.position = { 3.0, -7.0, 6.0 };
    camera.width = 90;
    camera.height = 70;
    std::vector<float> visibility;
    this->tracer_.tracer().trace(directionalLight({ 0.4, 0.3, -1.0 }), this->occluders_,
      makeReceivers(this->occluders_, camera), visibility);
    return visibility;
  }

  vtkNew<vtkGnomonEGLRenderWindow> window_; // outlives the objects in its context
  Occluders occluders_ =
    makeOccluders({ { makePlane(8.0) }, { makeBox({ -1.0, -1.0, 0.5 }, { 1.0, 1.0, 2.0 }) } });
  const std::size_t vertices_ = this->occluders_.positionsCentred.size();
  OccluderBuffers buffers_;
  ShaderLibrary shaders_;
  FrameTracer tracer_{ this->buffers_, this->shaders_ };
};

const TracerChoice embreeChoice{ false, true, "asked for" };
const TracerChoice gpuChoice{ true, true, "asked for" };
const TracerChoice gpuIfPossible{ true, false, "hardware" };

TEST_F(FrameTracers, oneAtATimeHasAStructure)
{
  EXPECT_EQ(this->tracer_.bytes() + this->tracer_.bytesOfTable() + this->tracer_.bytesOfRays(), 0u);
  EXPECT_EQ(this->tracer_.update(embreeChoice, this->occluders_).builds, 2);
  EXPECT_FALSE(this->tracer_.taken().gpu);
  const std::vector<float> byEmbree = this->trace();
  EXPECT_GT(std::count(byEmbree.begin(), byEmbree.end(), 0.0f), 200);
  const std::size_t bytesOfEmbree = this->tracer_.bytes();
  EXPECT_GT(bytesOfEmbree, 0u);
  EXPECT_GT(this->tracer_.bytesOfTable(), 0u);
  EXPECT_EQ(this->tracer_.bytesOfRays(), 0u);
  EXPECT_EQ(this->tracer_.update(embreeChoice, this->occluders_).builds, 0);

  EXPECT_EQ(this->tracer_.update(gpuChoice, this->occluders_).builds, 1);
  EXPECT_TRUE(this->tracer_.taken().gpu);
  EXPECT_EQ(this->trace(), byEmbree);
  EXPECT_EQ(this->tracer_.bytesOfTable(), 0u);
  // 2 x 5 tiles of 64 x 16 pixels, each pixel with a ray and an answer.
  EXPECT_GE(this->tracer_.bytesOfRays(), 10u * 1024u * 32u);
  EXPECT_EQ(this->tracer_.update(gpuChoice, this->occluders_).builds, 0);

  EXPECT_EQ(this->tracer_.update(embreeChoice, this->occluders_).builds, 2);
  EXPECT_EQ(this->tracer_.bytesOfRays(), 0u);
  EXPECT_EQ(this->trace(), byEmbree);
}

TEST_F(FrameTracers, whatTheGpuHasNoRoomForIsAnErrorWhereItWasAskedFor)
{
  this->makeHuge();
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_THROW(this->tracer_.update(gpuChoice, this->occluders_), TextureMemoryError);
    EXPECT_EQ(this->tracer_.bytes(), 0u);
  }
  EXPECT_EQ(this->tracer_.update(embreeChoice, this->occluders_).builds, 2);
}

TEST_F(FrameTracers, embreeTakesOverWhatTheGpuHasNoRoomFor)
{
  this->makeHuge();
  EXPECT_EQ(this->tracer_.update(gpuIfPossible, this->occluders_).builds, 2);
  EXPECT_FALSE(this->tracer_.taken().gpu);
  EXPECT_THAT(this->tracer_.gpuFailure(), HasSubstr("vertices need "));
  EXPECT_EQ(
    this->tracer_.taken().reason, "tracing on the GPU failed: " + this->tracer_.gpuFailure());
  const std::vector<float> visibility = this->trace();
  EXPECT_GT(std::count(visibility.begin(), visibility.end(), 0.0f), 200);

  // The GPU is not tried again for the same snapshot, and Embree's structure is reused.
  ++this->occluders_.positionsVersion;
  EXPECT_EQ(this->tracer_.update(gpuIfPossible, this->occluders_).builds, 0);
  EXPECT_FALSE(this->tracer_.taken().gpu);
  EXPECT_NE(this->tracer_.gpuFailure(), "");

  this->occluders_.positionsCentred.resize(this->vertices_);
  ++this->occluders_.topologyVersion;
  ++this->occluders_.positionsVersion;
  EXPECT_EQ(this->tracer_.update(gpuIfPossible, this->occluders_).builds, 1);
  EXPECT_TRUE(this->tracer_.taken().gpu);
  EXPECT_EQ(this->tracer_.gpuFailure(), "");
  EXPECT_EQ(this->tracer_.taken().reason, "hardware");
  EXPECT_EQ(this->trace(), visibility);
}

TEST_F(FrameTracers, nothingIsTracedWhereNothingCasts)
{
  this->occluders_ = makeOccluders({});
  for (const TracerChoice& choice : { embreeChoice, gpuChoice })
  {
    EXPECT_EQ(this->tracer_.update(choice, this->occluders_).builds, 0);
    EXPECT_EQ(this->trace(), std::vector<float>(90 * 70, 1.0f));
    EXPECT_EQ(this->tracer_.bytesOfRays(), 0u);
  }
}

} // namespace
} // namespace gnomon::test
