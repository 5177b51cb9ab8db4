#pragma once

#include <vtkCommand.h>
#include <vtkObject.h>

namespace gnomon
{

/// Tells a pass's observers of frames that refine what is shown: a ProgressEvent, whose call data
/// is the share that is shown, with each of them, and an EndEvent with the one that completes it.
/// @param before, shown the shares in [0, 1] of the frame before and of this one
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
