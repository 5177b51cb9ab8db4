// An atrium at night, lit by 64 spot lights, all of which cast shadows.
//
// Lamps hang in rows under the gallery and under the roof, which is left out. Lights whose
// technique is exact trace no rays outside their cones, so that many small lamps stay affordable.
//
//   atrium [picture.png [width height]]

#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkLight.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

// A box between two corners, in metres; y is up.
void addBox(
  vtkAppendPolyData* all, double x0, double y0, double z0, double x1, double y1, double z1)
{
  vtkNew<vtkCubeSource> box;
  box->SetBounds(x0, x1, y0, y1, z0, z1);
  all->AddInputConnection(box->GetOutputPort());
}

void addColumn(vtkAppendPolyData* parts, double x, double z, double radius, double y0, double y1)
{
  vtkNew<vtkCylinderSource> column;
  column->SetCenter(x, 0.5 * (y0 + y1), z);
  column->SetHeight(y1 - y0);
  column->SetRadius(radius);
  column->SetResolution(24);
  parts->AddInputConnection(column->GetOutputPort());
}

void addTree(vtkAppendPolyData* parts, double x)
{
  addColumn(parts, x, 0.0, 0.09, 0.5, 2.4);
  vtkNew<vtkSphereSource> crown;
  crown->SetCenter(x, 2.7, 0.0);
  crown->SetRadius(0.8);
  crown->SetThetaResolution(16);
  parts->AddInputConnection(crown->GetOutputPort());
}

void addLamp(vtkRenderer* renderer, double x, double y, double z, double coneAngle)
{
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(x, y, z);
  lamp->SetFocalPoint(x, 0.0, z);
  lamp->SetConeAngle(coneAngle); // half of the cone
  lamp->SetExponent(7.0);        // dimmer towards its rim
  lamp->SetColor(1.0, 0.84, 0.62);
  lamp->SetIntensity(0.30);
  renderer->AddLight(lamp);
}

void add(vtkRenderer* renderer, vtkAlgorithm* parts, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(parts->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  renderer->AddActor(actor);
}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkAppendPolyData> stone;
  vtkNew<vtkAppendPolyData> green;
  addBox(stone, -18, -0.3, -10, 18, 0, 9);
  addBox(stone, -18, 0, -10.3, 18, 9, -10);
  addBox(stone, 18, 0, -10.3, 18.3, 9, 9);
  addBox(stone, -18, 4.6, -10, 18, 5.2, -5); // the gallery
  for (double x = -16.0; x < 18.0; x += 4.0)
  {
    addColumn(stone, x, -5.4, 0.3, 0.0, 4.6);
    addColumn(stone, x, 5.0, 0.3, 0.0, 6.0);
    addBox(stone, x - 0.8, 0.0, -0.8, x + 0.8, 0.5, 0.8);
    addTree(green, x);
  }
  for (double x = -16.5; x < 17.0; x += 2.2) // four rows of 16 lamps
  {
    addLamp(renderer, x, 4.5, -7.8, 50.0);
    addLamp(renderer, x, 8.5, -7.8, 40.0);
    addLamp(renderer, x, 8.0, -2.6, 26.0);
    addLamp(renderer, x, 8.0, 2.8, 26.0);
  }
  add(renderer, stone, 0.90, 0.87, 0.83);
  add(renderer, green, 0.45, 0.70, 0.36);
  renderer->SetBackground(0.16, 0.19, 0.25);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetSkyIntensity(0.32);
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(-24.0, 16.0, 25.0);
  renderer->GetActiveCamera()->SetFocalPoint(-1.5, 1.5, -2.0);
  renderer->GetActiveCamera()->SetViewAngle(36);
  renderer->ResetCameraClippingRange();
  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 600);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "atrium.png");
  writer->Write();
}
