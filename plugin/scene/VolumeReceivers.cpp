#include "plugin/scene/VolumeReceivers.h"

#include "plugin/vtk_versions/VolumeLights.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

namespace gnomon
{
namespace
{

bool isCastOnGpu(vtkAbstractVolumeMapper* mapper)
{
  if (auto* const smart = vtkSmartVolumeMapper::SafeDownCast(mapper))
  {
    const int mode = smart->GetRequestedRenderMode();
    return mode == vtkSmartVolumeMapper::DefaultRenderMode ||
      mode == vtkSmartVolumeMapper::GPURenderMode;
  }
  return mapper && mapper->IsA("vtkGPUVolumeRayCastMapper");
}

} // namespace

const char* reasonAgainst(vtkVolume* volume)
{
  vtkAbstractVolumeMapper* const mapper = volume->GetMapper();
  if (!numbersLightsAlike || !isCastOnGpu(mapper))
  {
    return "mapper not served";
  }
  if (volume->IsA("vtkMultiVolume"))
  {
    return "several volumes in one";
  }
  if (!volume->GetProperty()->GetShade())
  {
    return "ShadeOff";
  }
  return static_cast<vtkVolumeMapper*>(mapper)->GetBlendMode() == vtkVolumeMapper::COMPOSITE_BLEND
    ? nullptr
    : "not blended by opacity";
}

} // namespace gnomon
