// What becomes of a light's map that only saves time, by what a clock says that is not the real one.

#include "plugin/LightTechnique.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"
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

double now = 0.0; ///< in milliseconds

constexpr double mapMilliseconds = 8.0;

/// Has a map or has none.
class Timed : public Technique
{
public:
  void bake(const MapInput&) override
  {
    now += mapMilliseconds;
    this->hasMap = true;
  }
  void dropMaps() override { this->hasMap = false; }

  bool hasMap = false;
};

EstimatorEntry timedEstimator(bool mapIsOptional)
{
  TechniqueInfo info;
  info.name = "timed";
  info.evaluation = Evaluation::ScreenCpu;
  info.needsMap = true;
  info.mapIsOptional = mapIsOptional;
  return { info, []() -> std::unique_ptr<Technique> { return std::make_unique<Timed>(); } };
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
    this->bakes_ = 0;
    this->technique_.updateMaps(this->light_,
      { this->camera_, this->occluders_, this->buffers_, {}, this->shaders_, this->receivers_,
        glm::dmat4(1.0), 0, [] { return now; }, this->bakes_ },
      report);
    this->technique_.visibilityTook(this->technique_.usesMap() ? this->mapped_ : 1.0);
    EXPECT_EQ(this->technique_.usesMap(), report.mapReason.empty());
    EXPECT_GE(this->hasMap(), this->technique_.usesMap());
    return report.mapReason;
  }
  void drawFrames(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->draw();
    }
  }
  void turnLight()
  {
    this->light_.directionWorld =
      glm::normalize(this->light_.directionWorld + glm::dvec3(0.1, 0.05, 0.0));
  }
  bool hasMap() const { return static_cast<const Timed&>(this->technique_.technique()).hasMap; }

  vtkNew<vtkGnomonEGLRenderWindow> window_; // outlives what is in its context
  const EstimatorEntry estimator_ = timedEstimator(true);
  LightTechnique technique_{ this->estimator_ };
  ShadowLight light_;
  double mapped_ = 0.5; ///< what visibility takes with the map; without it takes 1
  int bakes_ = 0;       ///< of the last frame

private:
  CameraView camera_;
  Occluders occluders_;
  OccluderBuffers buffers_;
  ShaderLibrary shaders_;
  ReceiverTarget receivers_;
};

/// A light that has moved has its map when tracing has taken as long as it takes to draw, and what the map before still owed.
TEST_F(OptionalMap, isDrawnAgainWhenTracingHasTakenAsLong)
{
  EXPECT_THAT(this->draw(), HasSubstr("once nothing has changed for a frame"));
  EXPECT_EQ(this->draw(), "");
  EXPECT_EQ(this->bakes_, 1);
  this->turnLight();
  EXPECT_THAT(this->draw(), HasSubstr("taken 16 ms"));
  EXPECT_FALSE(this->hasMap());
  for (int frame = 0; frame < 16; ++frame)
  {
    EXPECT_THAT(this->draw(), HasSubstr("all is traced")) << frame;
  }
  EXPECT_EQ(this->draw(), "");
  EXPECT_EQ(this->bakes_, 1);
}

TEST_F(OptionalMap, ofAnotherSizeIsDrawnAsIfItWereTheFirst)
{
  this->drawFrames(2);
  this->light_.mapSizeTexels = 128;
  EXPECT_THAT(this->draw(), HasSubstr("once nothing has changed for a frame"));
  EXPECT_EQ(this->draw(), "");
  EXPECT_EQ(this->bakes_, 1);
}

TEST_F(OptionalMap, isGivenUpWhereItDoesNotPay)
{
  this->mapped_ = 1.02;
  this->drawFrames(100);
  EXPECT_THAT(this->draw(), HasSubstr("with it visibility took 1.02 ms, and without it 1.00 ms"));
  EXPECT_FALSE(this->hasMap());
  EXPECT_EQ(this->bakes_, 0);
}

TEST_F(OptionalMap, thatPaysIsKept)
{
  this->drawFrames(100);
  EXPECT_EQ(this->draw(), "");
  EXPECT_TRUE(this->hasMap());
}

TEST_F(OptionalMap, thatIsAlwaysDrawnIsNotQuestioned)
{
  this->light_.bake = BakeTime::Always;
  this->mapped_ = 2.0;
  for (int frame = 0; frame < 100; ++frame)
  {
    if (frame % 2 == 0)
    {
      this->turnLight();
    }
    EXPECT_EQ(this->draw(), "");
    EXPECT_EQ(this->bakes_, frame % 2 == 0 ? 1 : 0);
  }
}

/// Where the picture depends on the map.
TEST(NeededMap, isNotQuestioned)
{
  const EstimatorEntry needed = timedEstimator(false);
  const LightTechnique technique(needed);
  EXPECT_TRUE(technique.usesMap());
  for (const EstimatorEntry& entry : estimators())
  {
    EXPECT_TRUE(!entry.info.mapIsOptional || (entry.info.exact && entry.info.needsMap))
      << entry.info.name;
  }
}

} // namespace
} // namespace gnomon::test
