#include "vtkGnomonPropKeys.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProp.h"

vtkStandardNewMacro(vtkGnomonPropKeys);
vtkInformationKeyMacro(vtkGnomonPropKeys, CASTS, Integer);
vtkInformationKeyMacro(vtkGnomonPropKeys, TRANSMITS, Integer);
vtkInformationKeyMacro(vtkGnomonPropKeys, RECEIVES, Integer);
vtkInformationKeyMacro(vtkGnomonPropKeys, SHADOW_CATCHER, Integer);
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

void setKey(vtkProp* prop, vtkInformationIntegerKey* key, int value)
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
  prop->GetPropertyKeys()->Set(key, value);
}

int getKey(vtkProp* prop, vtkInformationIntegerKey* key, int defaultValue)
{
  vtkInformation* keys = isProp(prop) ? prop->GetPropertyKeys() : nullptr;
  return keys && keys->Has(key) ? keys->Get(key) : defaultValue;
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetCasts(vtkProp* prop, bool casts)
{
  setKey(prop, CASTS(), casts ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetTransmits(vtkProp* prop, int transmits)
{
  if (transmits < TRANSMITS_NOTHING || transmits > TRANSMITS_COLORED)
  {
    vtkErrorWithObjectMacro(
      prop, "TRANSMITS was to be " << transmits << ", expected a TransmitsType in [0, 2].");
    return;
  }
  setKey(prop, TRANSMITS(), transmits);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetReceives(vtkProp* prop, bool receives)
{
  setKey(prop, RECEIVES(), receives ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetShadowCatcher(vtkProp* prop, bool catches)
{
  setKey(prop, SHADOW_CATCHER(), catches ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkGnomonPropKeys::SetOneSided(vtkProp* prop, bool oneSided)
{
  setKey(prop, ONE_SIDED(), oneSided ? 1 : 0);
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetCasts(vtkProp* prop)
{
  return getKey(prop, CASTS(), 1) != 0;
}

//------------------------------------------------------------------------------
int vtkGnomonPropKeys::GetTransmits(vtkProp* prop)
{
  return getKey(prop, TRANSMITS(), TRANSMITS_GREY);
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetReceives(vtkProp* prop)
{
  return getKey(prop, RECEIVES(), 1) != 0;
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetShadowCatcher(vtkProp* prop)
{
  return getKey(prop, SHADOW_CATCHER(), 0) != 0;
}

//------------------------------------------------------------------------------
bool vtkGnomonPropKeys::GetOneSided(vtkProp* prop)
{
  return getKey(prop, ONE_SIDED(), 0) != 0;
}
