// A figure for a paper, rendered on a machine without a display: a terrain in the evening, coloured
// by height, with a scale.
//
//   headless_figure figure.png

#include <vtkGnomonEGLRenderWindow.h>
#include <vtkGnomonLightKeys.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPerlinNoise.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

namespace
{

constexpr double sideMetres = 4000.0;
constexpr double highestMetres = 900.0;

/// Return a square of mountains around a valley: ridges of gradient noise in six octaves. x is
/// east, y north, z up, in metres.
vtkSmartPointer<vtkPolyData> makeTerrain()
{
  vtkNew<vtkPlaneSource> square;
  square->SetOrigin(0, 0, 0);
  square->SetPoint1(sideMetres, 0, 0);
  square->SetPoint2(0, sideMetres, 0);
  square->SetResolution(300, 300);
  square->Update();
  vtkSmartPointer<vtkPolyData> terrain = square->GetOutput();

  vtkNew<vtkFloatArray> elevation;
  elevation->SetName("elevation");
  elevation->SetNumberOfTuples(terrain->GetNumberOfPoints());
  vtkNew<vtkPerlinNoise> noise;
  for (vtkIdType i = 0; i < terrain->GetNumberOfPoints(); ++i)
  {
    double point[3];
    terrain->GetPoint(i, point);
    double height = 0.0;
    double amplitude = 0.5;
    double frequency = 1.0 / 1500.0;
    for (int octave = 0; octave < 6; ++octave)
    {
      noise->SetFrequency(frequency, frequency, 1.0);
      const double ridge = 1.0 - std::abs(noise->EvaluateFunction(point[0], point[1], 0.5));
      height += amplitude * ridge * ridge;
      amplitude *= 0.45;
      frequency *= 2.1;
    }
    point[2] = highestMetres * height;
    terrain->GetPoints()->SetPoint(i, point);
    elevation->SetValue(i, static_cast<float>(point[2]));
  }
  terrain->GetPointData()->SetScalars(elevation);
  return terrain;
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "usage: headless_figure figure.png\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkPolyDataNormals> terrain;
  terrain->SetInputData(makeTerrain());
  terrain->SplittingOff();
  terrain->Update();
  double range[2];
  terrain->GetOutput()->GetScalarRange(range);

  vtkNew<vtkColorTransferFunction> colours; // equal steps of lightness, readable in grey as well
  const double span = range[1] - range[0];
  colours->AddRGBPoint(range[0], 0.16, 0.36, 0.40);
  colours->AddRGBPoint(range[0] + 0.35 * span, 0.42, 0.58, 0.40);
  colours->AddRGBPoint(range[0] + 0.70 * span, 0.80, 0.72, 0.54);
  colours->AddRGBPoint(range[1], 0.98, 0.97, 0.95);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(terrain->GetOutputPort());
  mapper->SetLookupTable(colours);
  vtkNew<vtkActor> surface;
  surface->SetMapper(mapper);
  surface->GetProperty()->SetInterpolationToPhong();

  vtkNew<vtkScalarBarActor> scale;
  scale->SetLookupTable(colours);
  scale->SetTitle("Elevation (m)\n ");
  scale->SetNumberOfLabels(5);
  scale->SetLabelFormat("%.0f");
  scale->SetPosition(0.90, 0.15);
  scale->SetWidth(0.08);
  scale->SetHeight(0.7);
  scale->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : { scale->GetTitleTextProperty(), scale->GetLabelTextProperty() })
  {
    text->SetColor(0.1, 0.1, 0.1);
    text->SetFontSize(18);
    text->ItalicOff();
    text->BoldOff();
    text->ShadowOff();
  }

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(surface);
  renderer->AddViewProp(scale);

  vtkNew<vtkLight> sun; // in the west, 20 degrees above the horizon
  sun->SetFocalPoint(0, 0, 0);
  sun->SetPosition(-0.94, 0.10, 0.34);
  sun->SetIntensity(1.0);
  renderer->AddLight(sun);
  vtkNew<vtkLight> sky; // fills shadows, and casts none
  sky->SetFocalPoint(0, 0, 0);
  sky->SetPosition(0.2, -0.3, 1);
  sky->SetColor(0.85, 0.92, 1.0);
  sky->SetIntensity(0.5);
  vtkGnomonLightKeys::SetCasts(sky, false);
  renderer->AddLight(sky);

  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetMapSize(4096);
  renderer->SetPass(shadows);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0.53 * sideMetres, 0.42 * sideMetres, 300);
  camera->SetPosition(0.80 * sideMetres, -1.25 * sideMetres, 4000);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(28);
  renderer->ResetCameraClippingRange();

  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetSize(1200, 800);
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
