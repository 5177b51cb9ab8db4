#pragma once

#include "lights/vtkGnomonVersions.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkOpenGLRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Load the functions of the current OpenGL context for a window.
/// @param find returns a function by its name, or null
/// @return why that failed; empty on success
std::string loadOpenGl(vtkOpenGLRenderWindow* window, void (*(*find)(const char* name))());

/// Tell a window that OpenGL's functions are loaded.
void noteLoaded(vtkOpenGLRenderWindow* window);

} // namespace gnomon
