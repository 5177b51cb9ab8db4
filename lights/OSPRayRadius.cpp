#include "lights/OSPRayRadius.h"

#include <vtkInformationDoubleKey.h>
#include <vtkInformationKeyLookup.h>

namespace gnomon
{

vtkInformationDoubleKey* ospRayRadiusKey()
{
  return vtkInformationDoubleKey::SafeDownCast(
    vtkInformationKeyLookup::Find("RADIUS", "vtkOSPRayLightNode"));
}

} // namespace gnomon
