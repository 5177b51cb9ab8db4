#include "vtkGnomonLightKeys.h"

#include "lights/FilterKernel.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"
#include "vtkLight.h"
#include "vtkObjectFactory.h"

#include <cmath>

vtkStandardNewMacro(vtkGnomonLightKeys);
vtkInformationKeyMacro(vtkGnomonLightKeys, CASTS, Integer);
vtkInformationKeyMacro(vtkGnomonLightKeys, TECHNIQUE, String);
vtkInformationKeyMacro(vtkGnomonLightKeys, MAP_SIZE, Integer);
vtkInformationKeyMacro(vtkGnomonLightKeys, KERNEL, String);
vtkInformationKeyMacro(vtkGnomonLightKeys, KERNEL_SIZE, Integer);
vtkInformationKeyMacro(vtkGnomonLightKeys, BOX, DoubleVector);

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetCasts(vtkLight* light, bool casts)
{
  light->GetInformation()->Set(CASTS(), casts ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetTechnique(vtkLight* light, const char* technique)
{
  if (technique && *technique)
  {
    light->GetInformation()->Set(TECHNIQUE(), technique);
  }
  else
  {
    light->GetInformation()->Remove(TECHNIQUE());
  }
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetMapSize(vtkLight* light, int mapSizeTexels)
{
  if (mapSizeTexels > 0)
  {
    light->GetInformation()->Set(MAP_SIZE(), mapSizeTexels);
  }
  else
  {
    light->GetInformation()->Remove(MAP_SIZE());
  }
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetKernel(vtkLight* light, const char* kernel)
{
  if (!kernel || !*kernel)
  {
    light->GetInformation()->Remove(KERNEL());
  }
  else if (gnomon::findKernel(kernel))
  {
    light->GetInformation()->Set(KERNEL(), kernel);
  }
  else
  {
    vtkErrorWithObjectMacro(
      light, "There is no kernel '" << kernel << "'. There are: " << gnomon::kernelNames() << ".");
  }
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetKernelSize(vtkLight* light, int kernelSizeTexels)
{
  if (kernelSizeTexels > 0)
  {
    light->GetInformation()->Set(KERNEL_SIZE(), kernelSizeTexels);
  }
  else
  {
    light->GetInformation()->Remove(KERNEL_SIZE());
  }
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetBox(
  vtkLight* light, double width, double height, double depth, const double up[3])
{
  const auto isSize = [](double size) { return size > 0.0 && std::isfinite(size); };
  if (!isSize(width) || !isSize(height) || !isSize(depth))
  {
    vtkErrorWithObjectMacro(light,
      "A light's box of " << width << " x " << height << " x " << depth
                          << " was asked for; its sizes must be positive.");
    return;
  }
  if (!isSize(std::hypot(up[0], up[1], up[2])))
  {
    vtkErrorWithObjectMacro(light,
      "A light's box was asked for with the up direction " << up[0] << ", " << up[1] << ", "
                                                           << up[2] << ", which is none.");
    return;
  }
  const double numbers[6] = { width, height, depth, up[0], up[1], up[2] };
  light->GetInformation()->Set(BOX(), numbers, 6);
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::RemoveBox(vtkLight* light)
{
  light->GetInformation()->Remove(BOX());
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
