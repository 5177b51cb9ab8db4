// Preloaded, it has a program draw as VTK does without shadows: it stands in for the pass's frame.

#include "plugin/vtkGnomonShadowPass.h"

#include <vtkNew.h>
#include <vtkRenderState.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderer.h>

void vtkGnomonShadowPass::Render(const vtkRenderState* s)
{
  vtkNew<vtkRenderStepsPass> steps;
  steps->Render(s);
  steps->ReleaseGraphicsResources(s->GetRenderer()->GetVTKWindow());
}
