#include "vtkGnomonShadowSettings.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkGnomonShadowSettings);
