#include "vtkGnomonLightKeys.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"
#include "vtkLight.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkGnomonLightKeys);
vtkInformationKeyMacro(vtkGnomonLightKeys, CASTS, Integer);
vtkInformationKeyMacro(vtkGnomonLightKeys, TECHNIQUE, String);
vtkInformationKeyMacro(vtkGnomonLightKeys, MAP_SIZE, Integer);

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
void vtkGnomonLightKeys::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
