#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// Return this process' resident memory in bytes; 0 if it is unknown.
std::int64_t residentBytes();

/// Return the processor's model and its number of hardware threads.
std::string processorName();

/// Return renderer and version of a window's OpenGL.
std::string openGlName(vtkRenderWindow* window);

} // namespace gnomon::tool
