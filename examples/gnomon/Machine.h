#pragma once

#include "lights/vtkGnomonVersions.h"

#include <cstdint>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// The memory of this process that is in RAM at this moment, in bytes; 0 where it cannot be told.
std::int64_t residentBytes();

/// The processor's model and the number of its hardware threads.
std::string processorName();

/// Renderer and version of a window's OpenGL.
std::string openGlName(vtkRenderWindow* window);

/// What pages say they were measured on: "AMD EPYC, 2 processors; OpenGL by software (llvmpipe)".
std::string machineLine(vtkRenderWindow* window);

} // namespace gnomon::tool
