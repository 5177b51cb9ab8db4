#pragma once

#include "vtkGnomonShadowPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

namespace gnomon::test
{

/// A sphere over a plane under one directional light, drawn by vtkGnomonShadowPass.
inline vtkSmartPointer<vtkRenderer> makeSphereScene()
{
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  const auto add = [&](vtkAlgorithm* source, double red, double green, double blue)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(red, green, blue);
    renderer->AddActor(actor);
  };
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(24);
  add(sphere, 0.9, 0.4, 0.2);
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2, -2, -0.6);
  plane->SetPoint1(2, -2, -0.6);
  plane->SetPoint2(-2, 2, -0.6);
  add(plane, 0.8, 0.8, 0.8);

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

/// The window's picture, three bytes per pixel, bottom row first.
inline std::vector<unsigned char> readPicture(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int* size = window->GetSize();
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 1, pixels);
  const unsigned char* first = pixels->GetPointer(0);
  return { first, first + pixels->GetNumberOfValues() };
}

/// Draw a frame and return its picture.
inline std::vector<unsigned char> drawn(vtkRenderWindow* window)
{
  window->Render();
  return readPicture(window);
}

} // namespace gnomon::test
