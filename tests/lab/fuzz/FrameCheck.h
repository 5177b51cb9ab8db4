#pragma once

#include "Cases.h"

#include "VtkMessages.h"

#include "plugin/vtkGnomonShadowPass.h"

namespace gnomon::fuzz
{

/// Check a frame of the current OpenGL context.
/// @param messages of VTK during that frame
/// @throws Find for an error of OpenGL, and for a message of VTK that the frame's report lacks.
/// Also for visibilities outside [0, 1] and receivers that are not finite.
void checkFrame(vtkGnomonShadowPass* pass, const tool::VtkMessages& messages);

} // namespace gnomon::fuzz
