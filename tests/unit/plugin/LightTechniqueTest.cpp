// When a light's optional map is baked, used and dropped.

#include "plugin/frame/LightTechnique.h"

#include "plugin/frame/BakeBackoff.h"
#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "shadowtech/base/BakeSettings.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <gmock/gmock.h>

#include <vtkNew.h>

#include <memory>

namespace gnomon::test
{
namespace
{

using testing::HasSubstr;

/// Has a map or has none.
class Mapped : public CpuScreenTechnique
{
public:
  void bake(const MapInput&) override { this->hasMap = true; }
  void dropMaps() override { this->hasMap = false; }
  void computeVisibility(const ScreenInput&, std::vector<float>&, LightReport&) override {}

  bool hasMap = false;
};

EstimatorEntry mappedEstimator(bool mapIsOptional)
{
  TechniqueInfo info;
  info.name = "mapped";
  info.evaluation = Evaluation::ScreenCpu;
  info.settings = { &viewSettings(), &bakeSettings() };
  info.mapIsOptional = mapIsOptional;
  return { info, [] { return std::make_unique<Mapped>(); } };
}

/// A sun over a box, and frames of it.
class OptionalMap : public testing::Test
{
protected:
  OptionalMap()
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
    this->occluders_.castersCentred = { glm::dvec3(-1.0), glm::dvec3(1.0) };
    this->occluders_.allCentred = this->occluders_.castersCentred;
    this->light_.mapSizeTexels = 64;
  }

  /// Draws a frame. @return what is said of the map
  std::string draw()
  {
    LightReport report;
    this->frame_ = FrameReport();
    this->technique_.updateMaps(this->light_,
      { this->camera_, this->occluders_, this->buffers_, {}, this->shaders_, this->receivers_,
        glm::dmat4(1.0), 0, this->frame_ },
      report);
    EXPECT_EQ(this->technique_.usesMap(), report.mapReason.empty());
    EXPECT_EQ(this->hasMap(), this->technique_.usesMap());
    return report.mapReason;
  }
  /// Draws a frame in which the light or its settings changed, and those until its map is baked.
  void expectBakedAfter(int restingFrames)
  {
    for (int frame = 0; frame <= restingFrames; ++frame)
    {
      EXPECT_THAT(this->draw(), HasSubstr("so far " + std::to_string(frame) + ")"));
      EXPECT_EQ(this->frame_.mapBakes, 0);
    }
    EXPECT_EQ(this->draw(), "");
    EXPECT_EQ(this->frame_.mapBakes, 1);
  }
  void turnLight()
  {
    this->light_.directionWorld =
      glm::normalize(this->light_.directionWorld + glm::dvec3(0.1, 0.05, 0.0));
  }
  bool hasMap() const { return static_cast<const Mapped&>(this->technique_.technique()).hasMap; }

  vtkNew<vtkGnomonEGLRenderWindow> window_; // outlives what is in its context
  const EstimatorEntry estimator_ = mappedEstimator(true);
  LightTechnique technique_{ this->estimator_ };
  ShadowLight light_;
  FrameReport frame_; ///< of the last frame

private:
  CameraView camera_;
  Occluders occluders_;
  OccluderBuffers buffers_;
  ShaderLibrary shaders_;
  ReceiverTarget receivers_;
};

TEST_F(OptionalMap, isBakedOnceNothingChanged)
{
  this->expectBakedAfter(BakeBackoff::leastPatience);
  for (int frame = 0; frame < 100; ++frame)
  {
    EXPECT_EQ(this->draw(), "");
    EXPECT_EQ(this->frame_.mapBakes, 0);
  }
}

TEST_F(OptionalMap, isAwaitedForLongerWhereItWentStaleSoon)
{
  this->expectBakedAfter(BakeBackoff::leastPatience);
  this->turnLight();
  this->expectBakedAfter(2 * BakeBackoff::leastPatience);
  this->light_.mapSizeTexels = 128;
  this->expectBakedAfter(4 * BakeBackoff::leastPatience);
}

TEST_F(OptionalMap, thatIsAlwaysBakedIsNeverAwaited)
{
  this->light_.of<BakeSettings>().time = BakeTime::Always;
  for (int frame = 0; frame < 100; ++frame)
  {
    if (frame % 2 == 0)
    {
      this->turnLight();
    }
    EXPECT_EQ(this->draw(), "");
    EXPECT_EQ(this->frame_.mapBakes, frame % 2 == 0 ? 1 : 0);
  }
  // What is there is used, and what went stale before was not the backoff's.
  this->light_.of<BakeSettings>().time = BakeTime::Settled;
  EXPECT_EQ(this->draw(), "");
  EXPECT_EQ(this->frame_.mapBakes, 0);
}

/// Where the picture depends on the map.
TEST(NeededMap, isAlwaysUsed)
{
  const EstimatorEntry needed = mappedEstimator(false);
  const LightTechnique technique(needed);
  EXPECT_TRUE(technique.usesMap());
  for (const EstimatorEntry& entry : estimators())
  {
    EXPECT_TRUE(!entry.info.mapIsOptional || (entry.info.exact && entry.info.bakesMap()))
      << entry.info.name;
  }
}

} // namespace
} // namespace gnomon::test
