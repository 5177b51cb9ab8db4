#include "vtkPVGnomonLightKeys.h"

#include "vtkGnomonLightKeys.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkPVGnomonLightKeys);

//----------------------------------------------------------------------------
void vtkPVGnomonLightKeys::SetRadius(double radius)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << radius;
  vtkNew<vtkLight> light; // keys are set by way of a light
  light->SetInformation(this);
  vtkGnomonLightKeys::SetSetting(light, "light_radius", radius > 0.0 ? text.str().c_str() : "");
}
