#pragma once

#include "lights/CameraView.h"
#include "plugin/frame/CastingLights.h"
#include "plugin/frame/Clock.h"
#include "plugin/frame/FrameWishes.h"
#include "plugin/frame/Route.h"
#include "plugin/frame/ViewValues.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon
{

/// What all stages of a frame know of it.
struct Frame
{
  FrameWishes wishes;
  FrameReport report;
  CastingLights lights;
  glm::ivec2 size{ 0 }; ///< of the picture, in pixels
  CameraView camera;    ///< that it is drawn by
  ReceiverSpace space;  ///< the camera's
  Route route = Route::Inline;
  ViewValues* view = nullptr; ///< what the view keeps that is drawn
  bool severalViews = false;  ///< whether the pass draws others beside it
  double start = 0.0;         ///< by steadyMilliseconds()
  double stageStart = 0.0;    ///< likewise

  /// Ends the clock of a stage, or of a part of it, if stages are measured.
  void endStage(const std::string& name);
  /// Says in the report whether a value was reused.
  /// @param changes what it was not reused for; empty: it was
  void tellReuse(const std::string& value, const std::string& changes);
};

} // namespace gnomon
