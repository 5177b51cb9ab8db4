// Every public header stands on its own and on what is installed with it.
#include <FrameReport.h>
#include <PixelClass.h>
#include <VisibilityImages.h>
#include <vtkGnomonAreaLight.h>
#include <vtkGnomonEGLRenderWindow.h>
#include <vtkGnomonLightKeys.h>
#include <vtkGnomonLightPlacement.h>
#include <vtkGnomonLightSamplingPass.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>
#include <vtkGnomonSun.h>
#include <vtkGnomonVisibilityFilter.h>
