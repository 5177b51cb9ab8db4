#pragma once

#include <vtkCommand.h>
#include <vtkObject.h>

namespace gnomon
{

/// Notify a pass's observers of frames that refine the picture. Each sends a ProgressEvent, whose
/// call data is the shown share. The one that completes the picture also sends an EndEvent.
/// @param before, shown the shares in [0, 1] of the previous frame and of this one
inline void tellProgress(vtkObject* pass, double before, double shown)
{
  if (before < 1.0 || shown < 1.0)
  {
    pass->InvokeEvent(vtkCommand::ProgressEvent, &shown);
  }
  if (before < 1.0 && shown == 1.0)
  {
    pass->InvokeEvent(vtkCommand::EndEvent);
  }
}

} // namespace gnomon
