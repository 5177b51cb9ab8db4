#pragma once

#include "lights/CameraView.h"
#include "plugin/frame/CastingLights.h"
#include "plugin/frame/ViewValues.h"
#include "plugin/plan/FramePlan.h"
#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/Clock.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon
{

class ReceiversOnCpu;

/// The values that all stages of a frame share.
struct Frame
{
  FrameWishes wishes;
  Ranks* ranks = nullptr;          ///< the processes that draw the picture
  Scene scene;                     ///< what there is
  FramePlan plan;                  ///< what is decided
  CastingLights lights;            ///< the plan's, with their techniques
  FrameCounts counts;              ///< what the stages did
  glm::ivec2 size{ 0 };            ///< of the picture, in pixels
  CameraView camera;               ///< that draws it
  ReceiverSpace space;             ///< the camera's
  ViewValues* view = nullptr;      ///< cached values of the view
  ReceiversOnCpu* onCpu = nullptr; ///< its receivers
  double start = 0.0;              ///< by steadyMilliseconds()
  double stageStart = 0.0;         ///< as start

  Route route() const { return this->plan.picture.route.route; }
  /// End the clock of a stage, or of a part of it, if stages are measured.
  void endStage(const std::string& name);
  /// Note whether a value was reused.
  /// @param changes why it was not reused; empty if it was
  void noteReuse(const std::string& value, const std::string& changes);
};

} // namespace gnomon
