#pragma once

#include "lights/vtkGnomonVersions.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkInformationDoubleKey;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return vtkOSPRayLightNode::RADIUS(), the key of a light's size. It is a positional light's
/// radius in world units, or a directional light's whole angle in degrees. The key is looked up by
/// name, as not every VTK has its module. Null if the module is not loaded.
vtkInformationDoubleKey* ospRayRadiusKey();

} // namespace gnomon
