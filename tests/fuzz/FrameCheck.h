#pragma once

#include "Cases.h"

#include "VtkMessages.h"

#include "plugin/vtkGnomonShadowPass.h"

namespace gnomon::fuzz
{

/// Looks at a frame of the current OpenGL context.
/// @param messages of VTK while it was drawn
/// @throws Find for an error of OpenGL, for what VTK says and the frame's report does not, and for
/// kept numbers that are no visibilities or not finite
void checkFrame(vtkGnomonShadowPass* pass, const tool::VtkMessages& messages);

} // namespace gnomon::fuzz
