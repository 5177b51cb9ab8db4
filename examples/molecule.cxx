// A molecule as balls and sticks on a table: glyphs that cast shadows on each other.
//
// The molecule is a cage of 60 carbon atoms around one of potassium; vtkGlyph3DMapper draws its
// balls. The light is a disc: shadows are sharp near what casts them and soft on the table.
//
//   molecule [picture.png [width height]]

#include <vtkGnomonAreaLight.h>
#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkGlyph3DMapper.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

// The corners of a truncated icosahedron with edges of length 2, and its edges.
void makeCage(vtkPolyData* cage)
{
  constexpr double golden = 1.618033988749895;
  const double corners[][3] = { { 0, 1, 3 * golden }, { 1, 2 + golden, 2 * golden },
    { golden, 2, 2 * golden + 1 } };
  vtkNew<vtkPoints> atoms;
  for (const auto& corner : corners)
    for (int turn = 0; turn < 3; ++turn)
      for (int signs = corner[0] == 0 ? 1 : 0; signs < 8; signs += corner[0] == 0 ? 2 : 1)
      {
        double atom[3];
        for (int axis = 0; axis < 3; ++axis)
          atom[(axis + turn) % 3] = (signs >> axis & 1) ? corner[axis] : -corner[axis];
        atoms->InsertNextPoint(atom);
      }
  vtkNew<vtkCellArray> bonds;
  for (vtkIdType i = 0; i < atoms->GetNumberOfPoints(); ++i)
    for (vtkIdType j = 0; j < i; ++j)
    {
      double from[3];
      atoms->GetPoint(i, from);
      if (vtkMath::Distance2BetweenPoints(from, atoms->GetPoint(j)) < 4.1)
        bonds->InsertNextCell({ i, j });
    }
  cage->SetPoints(atoms);
  cage->SetLines(bonds);
}

void add(vtkRenderer* renderer, vtkMapper* mapper, double red, double green, double blue)
{
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  renderer->AddActor(actor);
}

void addSurface(vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  add(renderer, mapper, red, green, blue);
}

int main(int argc, char* argv[])
{
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyData> cage;
  makeCage(cage);
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.6);
  ball->SetThetaResolution(24);
  vtkNew<vtkGlyph3DMapper> balls;
  balls->SetInputData(cage);
  balls->SetSourceConnection(ball->GetOutputPort());
  balls->ScalingOff();
  add(renderer, balls, 0.42, 0.44, 0.50);
  vtkNew<vtkTubeFilter> sticks;
  sticks->SetInputData(cage);
  sticks->SetRadius(0.2);
  sticks->SetNumberOfSides(16);
  addSurface(renderer, sticks, 0.85, 0.86, 0.88);
  vtkNew<vtkSphereSource> potassium;
  potassium->SetRadius(1.6);
  potassium->SetThetaResolution(24);
  addSurface(renderer, potassium, 0.62, 0.35, 0.78);
  vtkNew<vtkPlaneSource> table;
  table->SetOrigin(-60, -60, -5.5);
  table->SetPoint1(60, -60, -5.5);
  table->SetPoint2(-60, 60, -5.5);
  addSurface(renderer, table, 0.90, 0.89, 0.87);
  vtkNew<vtkGnomonAreaLight> lamp;
  lamp->SetPosition(-14, -8, 22);
  lamp->SetRadius(1.5);
  renderer->AddLight(lamp);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetSkyIntensity(0.25);
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(6, -27, 13);
  renderer->GetActiveCamera()->SetFocalPoint(2.0, 0, -1.5);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCameraClippingRange();

  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 600);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "molecule.png");
  writer->Write();
}
