#pragma once

#include "lights/vtkGnomonVersions.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkVolume;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return why a volume's samples can show no shadows; null if they can: VTK casts the volume's rays
/// on the GPU, and lights what it composes, with lights numbered as those of surfaces.
const char* reasonAgainst(vtkVolume* volume);

} // namespace gnomon
