#pragma once

#include "plugin/Picture.h"
#include "plugin/Shapes.h"

#include "vtkGnomonShadowPass.h"

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace gnomon::test
{

/// A sphere over a plane under one directional light, drawn by vtkGnomonShadowPass.
inline vtkSmartPointer<vtkRenderer> makeSphereScene()
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  const auto add = [&](vtkAlgorithm* source, double red, double green, double blue)
  {
    const auto actor = actorOf(mapperOf(source));
    actor->GetProperty()->SetColor(red, green, blue);
    renderer->AddActor(actor);
  };
  add(ballOf(glm::dvec3(0.0), 0.5, 48, 24), 0.9, 0.4, 0.2);
  add(squareOf(2.0, -0.6), 0.8, 0.8, 0.8);

  vtkNew<vtkLight> light;
  light->SetPosition(1, -1, 3);
  light->SetFocalPoint(0, 0, 0);
  renderer->AddLight(light);
  renderer->SetBackground(0.2, 0.4, 0.6);
  renderer->GetActiveCamera()->SetPosition(0, -5, 3);
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkGnomonShadowPass> shadows;
  renderer->SetPass(shadows);
  return renderer;
}

/// Draw a frame and return its picture.
inline Picture drawn(vtkRenderWindow* window)
{
  window->Render();
  return readPicture(window);
}

} // namespace gnomon::test
