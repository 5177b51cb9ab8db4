// A gear box whose housing is transparent: the gears cast shadows on each other and on the table.
//
// Translucent surfaces cast if asked: the housing takes a part of the light. They receive shadows;
// this one is told not to, and stays clear. A key of an assembly goes before those of its parts, so
// the housing is a prop of its own.
//
//   assembly [picture.png [width height]]

#include <vtkGnomonLightKeys.h>
#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonPropKeys.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkAssembly.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkCylinderSource.h>
#include <vtkLight.h>
#include <vtkLinearExtrusionFilter.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTriangleFilter.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>

vtkSmartPointer<vtkActor> makePart(vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> part;
  part->SetMapper(mapper);
  part->GetProperty()->SetColor(red, green, blue);
  return part;
}

// A gear on its shaft, about the z axis.
void addGear(vtkAssembly* box, double x, double y, double z, int teeth, double phase)
{
  const double radius = teeth * 0.1;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> rim;
  rim->InsertNextCell(4 * teeth);
  for (int i = 0; i < 4 * teeth; ++i)
  {
    const double angle = (i + phase) * 2.0 * vtkMath::Pi() / (4.0 * teeth);
    const double r = radius + (i % 4 < 2 ? 0.13 : -0.13);
    points->InsertNextPoint(r * std::cos(angle), r * std::sin(angle), 0.0);
    rim->InsertCellPoint(i);
  }
  vtkNew<vtkPolyData> outline;
  outline->SetPoints(points);
  outline->SetPolys(rim);
  vtkNew<vtkTriangleFilter> triangles; // the outline is not convex
  triangles->SetInputData(outline);
  vtkNew<vtkLinearExtrusionFilter> gear;
  gear->SetInputConnection(triangles->GetOutputPort());
  gear->SetScaleFactor(0.5);
  auto wheel = makePart(gear, 0.85, 0.66, 0.30);
  wheel->SetPosition(x, y, z);
  box->AddPart(wheel);

  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetHeight(2.4);
  cylinder->SetRadius(0.28);
  cylinder->SetResolution(32);
  auto shaft = makePart(cylinder, 0.62, 0.66, 0.72);
  shaft->RotateX(90.0);
  shaft->SetPosition(x, y, 1.2);
  box->AddPart(shaft);
}

int main(int argc, char* argv[])
{
  vtkNew<vtkAssembly> box;
  addGear(box, 0.0, 0.0, 1.6, 20, 0.0);
  addGear(box, 3.2, 0.0, 1.6, 12, 2.0);
  addGear(box, 3.2, 0.0, 0.5, 22, 0.0);
  addGear(box, 3.2, 3.4, 0.5, 12, 2.0);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(box);
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(-2.5, 5.8, -2.6, 5.0, 0.0, 2.8);
  auto housing = makePart(cube, 0.55, 0.75, 0.90);
  housing->GetProperty()->SetOpacity(0.22);
  vtkGnomonPropKeys::SetReceives(housing, false); // clear glass shows no shadow
  renderer->AddActor(housing);
  vtkNew<vtkCubeSource> table;
  table->SetBounds(-80, 80, -80, 80, -0.7, -0.4);
  renderer->AddActor(makePart(table, 0.86, 0.85, 0.83));

  vtkNew<vtkLight> lamp; // directional: it shines towards the origin
  lamp->SetPosition(-0.6, -0.25, 1.0);
  vtkGnomonLightKeys::SetSetting(lamp, "light_radius", "2"); // its disc, in degrees
  renderer->AddLight(lamp);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetSkyIntensity(0.25);
  shadows->SetTranslucentCasters(true);
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(5, -12.4, 12.4);
  renderer->GetActiveCamera()->SetFocalPoint(1.9, 0.9, 0.6);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCameraClippingRange();

  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 600);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "assembly.png");
  writer->Write();
}
