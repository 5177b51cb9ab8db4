// A figure for a paper, drawn on a machine without a display: hills under a low sun, coloured by
// height, with a scale. The PNG is for the page. The EXR is for measurements: the figure's colours,
// and for each pixel the sun's visibility and the height, as floats.
//
//   headless_figure [figure.png [width height]]

#include <vtkGnomonOffScreenWindow.h>
#include <vtkGnomonShadowPass.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkParametricFunctionSource.h>
#include <vtkParametricRandomHills.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <cstdlib>
#include <string>

// Writes red, green and blue, V: the sun's visibility, A: 1 on the hills, Z: the height on them.
void writeExr(const std::string& path, vtkRenderWindow* window, vtkGnomonShadowPass* shadows)
{
  vtkNew<vtkImageData> image;
  shadows->GetVisibilityImage(image);
  const int width = image->GetDimensions()[0];
  const int height = image->GetDimensions()[1];
  vtkNew<vtkFloatArray> colours;
  window->GetRGBAPixelData(0, 0, width - 1, height - 1, 1, colours);
  Imf::Header header(width, height);
  Imf::FrameBuffer frame;
  const auto add = [&](const char* name, vtkDataArray* array, int component)
  {
    auto* values = static_cast<char*>(array->GetVoidPointer(0)) + component * sizeof(float);
    const auto pixel = static_cast<std::ptrdiff_t>(array->GetNumberOfComponents() * sizeof(float));
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, // VTK's first row is the lowest
      Imf::Slice(Imf::FLOAT, values + (height - 1) * width * pixel, pixel, -width * pixel));
  };
  add("R", colours, 0);
  add("G", colours, 1);
  add("B", colours, 2);
  add("V", image->GetPointData()->GetArray("light 0"), 0);
  add("A", image->GetPointData()->GetArray("coverage"), 0);
  add("Z", image->GetPointData()->GetArray("position"), 2);
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(height);
}

int main(int argc, char* argv[])
{
  const std::string path = argc > 1 ? argv[1] : "headless_figure.png";
  vtkNew<vtkParametricRandomHills> hills;
  hills->SetHillAmplitude(1.4);
  vtkNew<vtkParametricFunctionSource> terrain;
  terrain->SetParametricFunction(hills);
  terrain->SetUResolution(200);
  terrain->SetVResolution(200);
  terrain->SetScalarModeToZ();
  vtkNew<vtkColorTransferFunction> colours; // equal steps of lightness, readable in grey as well
  colours->AddRGBPoint(0.0, 0.28, 0.52, 0.60);
  colours->AddRGBPoint(2.0, 0.55, 0.74, 0.52);
  colours->AddRGBPoint(4.0, 0.90, 0.82, 0.62);
  colours->AddRGBPoint(6.0, 0.98, 0.97, 0.95);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(terrain->GetOutputPort());
  mapper->SetLookupTable(colours);
  vtkNew<vtkActor> surface;
  surface->SetMapper(mapper);
  const auto window = gnomon::makeOffScreenWindow();
  window->SetSize(argc > 3 ? std::atoi(argv[2]) : 1200, argc > 3 ? std::atoi(argv[3]) : 900);
  vtkNew<vtkScalarBarActor> scale;
  scale->SetLookupTable(colours);
  scale->SetTitle("Height\n ");
  scale->SetLabelFormat("%.0f");
  scale->SetPosition(0.84, 0.15);
  scale->UnconstrainedFontSizeOn();
  scale->GetTitleTextProperty()->SetColor(0, 0, 0);
  scale->GetLabelTextProperty()->SetColor(0, 0, 0);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(surface);
  renderer->AddViewProp(scale);
  vtkNew<vtkLight> sun; // directional: it shines towards the origin
  sun->SetPosition(-0.85, -0.1, 0.45);
  renderer->AddLight(sun);
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SetSkyIntensity(0.4);
  shadows->KeepVisibilityOn(); // for the EXR
  renderer->SetPass(shadows);
  renderer->GetActiveCamera()->SetPosition(5, -24, 28);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.2);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
  writeExr(path.substr(0, path.rfind('.')) + ".exr", window, shadows);
}
