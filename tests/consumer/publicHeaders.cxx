// Every public header stands on its own and on what is installed with it.
#include <vtkGnomonAreaLight.h>
#include <vtkGnomonEGLRenderWindow.h>
#include <vtkGnomonFrameReport.h>
#include <vtkGnomonLightKeys.h>
#include <vtkGnomonLightPlacement.h>
#include <vtkGnomonLightSamplingPass.h>
#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonPixelClass.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>
#include <vtkGnomonShadowSettings.h>
#include <vtkGnomonSun.h>
#include <vtkGnomonVisibilityFilter.h>
#include <vtkGnomonVisibilityImages.h>
