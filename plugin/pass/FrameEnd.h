#pragma once

#include "plugin/plan/PictureSchedule.h"

#include <optional>
#include <string>

namespace gnomon
{

/// The end of a frame of the pass.
struct FrameEnd
{
  ShownPicture picture;                ///< that is shown; with shadows alone
  std::optional<std::string> whyPlain; ///< why it has no shadows, as a clause; none: it has
  bool isDrawn = false;                ///< VTK has drawn the scene, or there is nothing to draw
  bool isToBeDrawnAgain = false;       ///< its shaders changed while it was drawn
  bool outOfTextureMemory = false;     ///< FrameReport::outOfTextureMemory
  bool measuresProcesses = false;      ///< all processes are to compare what they have drawn
};

} // namespace gnomon
