#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Loads the functions of the OpenGL context that is current, one of EGL's, for a window.
/// @return why that failed; empty if it did not
std::string loadOpenGl(vtkOpenGLRenderWindow* window);

/// Tells a window that OpenGL's functions are loaded.
void noteLoaded(vtkOpenGLRenderWindow* window);

} // namespace gnomon
