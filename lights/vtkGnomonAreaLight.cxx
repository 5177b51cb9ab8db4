#include "vtkGnomonAreaLight.h"

#include "lights/NumberSetters.h"
#include "lights/OSPRayRadius.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkGnomonAreaLight);

//------------------------------------------------------------------------------
vtkGnomonAreaLight::vtkGnomonAreaLight()
{
  this->Positional = 1;
  this->ConeAngle = 90.0;
  this->TellOSPRay();
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::SetShape(int shape)
{
  const int clamped = std::clamp<int>(shape, RECTANGLE, DISK);
  const bool changes = this->Shape != clamped;
  this->Shape = clamped;
  this->TellOSPRay(); // its module may have been loaded since the last call
  if (changes)
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::SetRadius(double radius)
{
  gnomon::setClamped(this, "Radius", radius, 0.0, VTK_DOUBLE_MAX, this->Radius);
  this->TellOSPRay(); // its module may have been loaded since the last call
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::SetWidth(double width)
{
  gnomon::setClamped(this, "Width", width, 0.0, VTK_DOUBLE_MAX, this->Width);
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::SetHeight(double height)
{
  gnomon::setClamped(this, "Height", height, 0.0, VTK_DOUBLE_MAX, this->Height);
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::SetUp(double x, double y, double z)
{
  gnomon::setFinite(this, "Up", x, y, z, this->Up);
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::TellOSPRay()
{
  vtkInformationDoubleKey* const key = gnomon::ospRayRadiusKey();
  if (!key)
  {
    return;
  }
  if (this->Shape == DISK && this->Radius < VTK_DOUBLE_MAX)
  {
    this->GetInformation()->Set(key, this->Radius);
  }
  else
  {
    this->GetInformation()->Remove(key);
  }
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::CopyArea(vtkGnomonAreaLight* light)
{
  this->SetShape(light->Shape);
  this->SetRadius(light->Radius);
  this->SetWidth(light->Width);
  this->SetHeight(light->Height);
  this->SetUp(light->Up);
  this->SetTexture(light->Texture);
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::DeepCopy(vtkLight* light)
{
  if (!light)
  {
    vtkErrorMacro("There is no light to copy.");
    return;
  }
  auto* const area = vtkGnomonAreaLight::SafeDownCast(light);
  if (area)
  {
    this->CopyArea(area);
  }
  this->Superclass::DeepCopy(light); // copies the information, OSPRay's key included
  if (!area)
  {
    this->TellOSPRay();
  }
}

//------------------------------------------------------------------------------
vtkLight* vtkGnomonAreaLight::ShallowClone()
{
  vtkGnomonAreaLight* clone = vtkGnomonAreaLight::New();
  clone->DeepCopy(this);
  clone->SetTransformMatrix(this->TransformMatrix);
  return clone;
}

//------------------------------------------------------------------------------
void vtkGnomonAreaLight::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shape: " << (this->Shape == RECTANGLE ? "Rectangle" : "Disk") << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Up: (" << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << ")\n";
  os << indent << "Texture: " << this->Texture.Get() << "\n";
}
