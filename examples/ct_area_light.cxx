// Trabecular bone in a micro-CT volume: plain VTK on the left, under an area light on the right.
//
// The surface is the contour of a volume, which this program makes up instead of reading a scan.
// Without shadows the near struts and the far ones look alike. The area light's shadows are sharp
// at contacts and soften with the distance, and so they show the depth of the pores.
//
//   ct_area_light [picture.png [width height]]

#include <vtkGnomonAreaLight.h>
#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>

// The density of a network of struts, irregular as bone is: above 0 in bone. In millimetres.
double density(double x, double y, double z)
{
  const double u = 3.4 * x + 0.9 * std::sin(1.7 * y + 1.0) + 0.5 * std::sin(2.9 * z);
  const double v = 3.4 * y + 0.9 * std::sin(1.9 * z) + 0.5 * std::sin(3.1 * x + 2.0);
  const double w = 2.6 * z + 0.9 * std::sin(1.6 * x) + 0.5 * std::sin(2.7 * y + 0.5);
  return std::sin(u) * std::cos(v) + std::sin(v) * std::cos(w) + std::sin(w) * std::cos(u) - 0.55;
}

// A drilled core: a cylinder along z, with nothing around it.
void makeScan(vtkImageData* scan)
{
  constexpr int side = 110;
  constexpr double spacing = 0.05;
  scan->SetDimensions(side, side, side);
  scan->SetSpacing(spacing, spacing, spacing);
  scan->SetOrigin(-0.5 * side * spacing, -0.5 * side * spacing, -0.5 * side * spacing);
  scan->AllocateScalars(VTK_FLOAT, 1);
  auto* voxel = static_cast<float*>(scan->GetScalarPointer());
  for (vtkIdType i = 0; i < scan->GetNumberOfPoints(); ++i)
  {
    double point[3];
    scan->GetPoint(i, point);
    const double outside =
      std::fmax(std::hypot(point[0], point[1]) - 2.4, std::fabs(point[2]) - 2.6);
    voxel[i] = static_cast<float>(std::fmin(density(point[0], point[1], point[2]), -6.0 * outside));
  }
}

int main(int argc, char* argv[])
{
  vtkNew<vtkImageData> scan;
  makeScan(scan);
  vtkNew<vtkFlyingEdges3D> bone;
  bone->SetInputData(scan);
  bone->SetValue(0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(bone->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> surface;
  surface->SetMapper(mapper);
  surface->GetProperty()->SetColor(0.97, 0.91, 0.79);

  vtkNew<vtkGnomonAreaLight> lamp;
  lamp->SetPosition(-7.0, -8.0, 9.0);
  lamp->SetFocalPoint(0.0, 0.0, 0.0);
  lamp->SetRadius(1.2);

  const auto window = gnomon::makeOffScreenWindow(); // or any vtkRenderWindow
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 800, argc > 3 ? std::atoi(argv[3]) : 600);
  for (const bool shadowed : { false, true })
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(shadowed ? 0.5 : 0.0, 0.0, shadowed ? 1.0 : 0.5, 1.0);
    renderer->SetBackground(0.10, 0.11, 0.13);
    renderer->AddActor(surface);
    renderer->AddLight(lamp);
    renderer->GetActiveCamera()->SetPosition(2.5, -14.0, 8.4);
    renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, -0.1);
    renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
    renderer->ResetCameraClippingRange();
    if (shadowed)
    {
      vtkNew<vtkGnomonShadowPass> shadows;
      shadows->SetSkyIntensity(0.15);
      renderer->SetPass(shadows);
    }
    window->AddRenderer(renderer);
  }
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argc > 1 ? argv[1] : "ct_area_light.png");
  writer->Write();
}
