#pragma once

#include "lights/CameraView.h"
#include "plugin/frame/CastingLights.h"
#include "plugin/frame/ViewValues.h"
#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/Route.h"
#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/Clock.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon
{

/// The values that all stages of a frame share.
struct Frame
{
  FrameWishes wishes;
  Ranks* ranks = nullptr; ///< the processes that draw the picture; null: this one alone
  FrameReport report;
  bool moves = false;     ///< true if it is one of a moving picture
  bool mayRefine = false; ///< true if more frames at rest follow an unfinished one
  CastingLights lights;
  glm::ivec2 size{ 0 };      ///< of the picture, in pixels
  CameraView camera;         ///< that draws it
  ReceiverSpace space;       ///< the camera's
  std::size_t triangles = 0; ///< of the snapshot, those of instances among them
  Route route = Route::Inline;
  ViewValues* view = nullptr; ///< cached values of the view
  bool severalViews = false;  ///< true if the pass draws other views, too
  double start = 0.0;         ///< by steadyMilliseconds()
  double stageStart = 0.0;    ///< as start

  /// End the clock of a stage, or of a part of it, if stages are measured.
  void endStage(const std::string& name);
  /// Report whether a value was reused.
  /// @param changes why it was not reused; empty if it was
  void tellReuse(const std::string& value, const std::string& changes);
};

} // namespace gnomon
