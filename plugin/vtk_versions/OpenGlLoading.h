#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Load the functions of the current OpenGL context, one of EGL's, for a window.
/// @return why that failed; empty on success
std::string loadOpenGl(vtkOpenGLRenderWindow* window);

/// Tell a window that OpenGL's functions are loaded.
void noteLoaded(vtkOpenGLRenderWindow* window);

} // namespace gnomon
