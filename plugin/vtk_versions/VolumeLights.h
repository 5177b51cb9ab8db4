#pragma once

#include "lights/vtkGnomonVersions.h"

namespace gnomon
{

/// True if VTK's shaders number the lights of volumes as those of surfaces. From 9.2, lights with a
/// place come first.
inline constexpr bool numbersLightsAlike = VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0);

} // namespace gnomon
