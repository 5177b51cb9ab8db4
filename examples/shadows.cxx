// A sphere over a plane, with shadows, as a PNG: README.md's two lines in a program.
//
//   shadows picture.png

#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>
#include <iostream>

namespace
{

void addSurface(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.2); // ambient light is never shadowed
  actor->GetProperty()->SetDiffuse(0.8);
  renderer->AddActor(actor);
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: shadows picture.png\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(32);
  addSurface(renderer, sphere);
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-2, -2, -0.5);
  ground->SetPoint1(2, -2, -0.5);
  ground->SetPoint2(-2, 2, -0.5);
  addSurface(renderer, ground);
  renderer->GetActiveCamera()->SetPosition(0, -5, 3);
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, -0.3);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);

  vtkNew<vtkLight> sun; // any vtkLight: directional unless made positional
  sun->SetPosition(2, -1, 3);
  renderer->AddLight(sun);

  vtkNew<vtkGnomonShadowPass> shadows;
  renderer->SetPass(shadows);

  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(800, 600);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argv[1]);
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
