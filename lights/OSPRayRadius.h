#pragma once

#include "lights/vtkGnomonVersions.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationDoubleKey;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// vtkOSPRayLightNode::RADIUS(), a light's size: of a positional light the radius, of a directional
/// one the whole angle in degrees. It is found by its name, since the module that it belongs to is
/// not in every VTK; null where that is not loaded.
vtkInformationDoubleKey* ospRayRadiusKey();

} // namespace gnomon
