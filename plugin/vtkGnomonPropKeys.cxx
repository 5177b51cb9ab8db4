#include "vtkGnomonPropKeys.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProp.h"

vtkStandardNewMacro(vtkGnomonPropKeys);
vtkInformationKeyMacro(vtkGnomonPropKeys, CASTS, Integer);
vtkInformationKeyMacro(vtkGnomonPropKeys, RECEIVES, Integer);
vtkInformationKeyMacro(vtkGnomonPropKeys, ONE_SIDED, Integer);

namespace
{

bool isProp(vtkProp* prop)
{
  if (!prop)
  {
    vtkErrorWithObjectMacro(prop, "vtkGnomonPropKeys needs a prop, not null.");
  }
  return prop != nullptr;
}

void setKey(vtkProp* prop, vtkInformationIntegerKey* key, bool value)
{
  if (!isProp(prop))
  {
    return;
  }
  if (!prop->GetPropertyKeys())
  {
    vtkNew<vtkInformation> keys;
    prop->SetPropertyKeys(keys);
  }
  prop->GetPropertyKeys()->Set(key, value ? 1 : 0);
}

bool getKey(vtkProp* prop, vtkInformationIntegerKey* key, bool defaultValue)
{
  vtkInformation* keys = isProp(prop) ? prop->GetPropertyKeys() : nullptr;
  return keys && keys->Has(key) ? keys->Get(key) != 0 : defaultValue;
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetCasts(vtkProp* prop, bool casts)
{
  setKey(prop, CASTS(), casts);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetReceives(vtkProp* prop, bool receives)
{
  setKey(prop, RECEIVES(), receives);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetOneSided(vtkProp* prop, bool oneSided)
{
  setKey(prop, ONE_SIDED(), oneSided);
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetCasts(vtkProp* prop)
{
  return getKey(prop, CASTS(), true);
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetReceives(vtkProp* prop)
{
  return getKey(prop, RECEIVES(), true);
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetOneSided(vtkProp* prop)
{
  return getKey(prop, ONE_SIDED(), false);
}
