#include "vtkGnomonAreaLight.h"

#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkGnomonAreaLight);

//------------------------------------------------------------------------------
vtkGnomonAreaLight::vtkGnomonAreaLight()
{
  this->Positional = 1;
  this->ConeAngle = 90.0;
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
  this->Superclass::DeepCopy(light);
  if (auto* area = vtkGnomonAreaLight::SafeDownCast(light))
  {
    this->CopyArea(area);
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
