// Print what must stay while the frame is rebuilt, a line each, to be compared with `diff`:
// - `visibility SCENE TECHNIQUE VIEW`: hashes of visibility, classes and receivers, and of the
//   picture, of built-in scenes from two views,
// - `flight SCENE FRAME`: what `auto` takes in motion and at rest, by the default factors.

#include "BenchmarkMain.h"
#include "BuiltinScenes.h"
#include "Errors.h"
#include "FrameVariant.h"
#include "Scene.h"
#include "VtkMessages.h"

#include "shadowtech/Registry.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

struct Options
{
  std::vector<std::string> scenes;
  std::vector<std::string> flights = { "bunny", "atrium", "office", "cups", "soft-panels",
    "bench-side" };
  std::vector<std::string> techniques;
  int sidePixels = 128;
  int frames = 200;
};

/// FNV-1a (Fowler, Noll, Vo), of 64 bits.
class Fingerprint
{
public:
  template <typename Value>
  void add(const std::vector<Value>& values)
  {
    this->addBytes(values.data(), values.size() * sizeof(Value));
  }
  void addBytes(const void* data, std::size_t count)
  {
    const auto* const bytes = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < count; ++i)
    {
      this->value_ = (this->value_ ^ bytes[i]) * 1099511628211u;
    }
  }
  std::uint64_t value() const { return this->value_; }

private:
  std::uint64_t value_ = 14695981039346656037u;
};

std::uint64_t printOf(const VisibilityImages& images)
{
  Fingerprint print;
  for (const std::vector<float>& light : images.visibility)
  {
    print.add(light);
  }
  for (const ClassImage& classes : images.classes)
  {
    print.add(classes.ofPixels);
  }
  print.add(images.sceneIndices);
  print.addBytes(images.origin.data(), sizeof(images.origin));
  for (const std::vector<float>* values : { &images.positionX, &images.positionY, &images.positionZ,
         &images.normalX, &images.normalY, &images.normalZ, &images.coverage })
  {
    print.add(*values);
  }
  print.add(images.prop);
  print.add(images.cell);
  return print.value();
}

std::uint64_t printOfPicture(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window);
  filter->ShouldRerenderOff();
  filter->ReadFrontBufferOff();
  filter->Update();
  const auto* const bytes =
    vtkUnsignedCharArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars());
  Fingerprint print;
  print.addBytes(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0),
    std::size_t(bytes->GetNumberOfValues()));
  return print.value();
}

/// Print a technique's frames of a scene: without and with visibility, then from a second view.
void printVisibility(
  const Scene& scene, const std::string& name, const std::string& technique, int sidePixels)
{
  FrameVariant variant(parseTechnique(technique), scene, sidePixels, sidePixels);
  for (int view = 0; view < 2; ++view)
  {
    variant.pass()->KeepVisibilityOff();
    drawTimed(variant.window());
    const std::uint64_t picture = printOfPicture(variant.window());
    variant.pass()->KeepVisibilityOn();
    drawTimed(variant.window());
    std::cout << "visibility " << name << ' ' << technique << ' ' << view << ' ' << std::hex
              << picture << ' ' << printOf(variant.pass()->GetVisibility()) << ' '
              << printOfPicture(variant.window()) << std::dec << std::endl;
    vtkCamera* const camera = variant.renderer()->GetActiveCamera();
    camera->Azimuth(37.0);
    camera->Elevation(8.0);
    camera->OrthogonalizeViewUp();
    variant.renderer()->ResetCameraClippingRange();
  }
}

/// Print what `auto` takes while the camera circles, the first light turns, and both rest.
void printFlight(const Scene& scene, const std::string& name, const Options& options)
{
  FrameVariant variant({ automaticTechnique, 512 }, scene, options.sidePixels, options.sidePixels);
  variant.pass()->SetTimeBudget(0.0);
  for (int frame = 0; frame < options.frames; ++frame)
  {
    const int phase = frame % 50;
    const bool moves = phase < 44;
    variant.pass()->SetInteractive(
      moves ? vtkGnomonShadowPass::INTERACTIVE_ON : vtkGnomonShadowPass::INTERACTIVE_OFF);
    variant.drawFrame(!moves        ? Motion::Static
        : phase >= 30 && phase < 38 ? Motion::Light
                                    : Motion::Camera,
      20 * frame);
    const FrameReport& report = variant.pass()->GetReport();
    std::cout << "flight " << name << ' ' << frame << ' ' << report.route << " | "
              << report.routeReason << " | " << report.choice << " | probes " << report.probes;
    for (const LightReport& light : report.lights)
    {
      std::cout << " | " << light.technique << ' ' << light.mapSizeTexels << ' '
                << light.lightSamples << ' ' << light.fit << ' ' << light.tilesTraced << ' '
                << light.rays << ' ' << light.mapReason << ' ' << light.progress;
    }
    std::cout << " | " << std::hex << printOfPicture(variant.window()) << std::dec << std::endl;
  }
}

int run(int argc, char** argv)
{
  CLI::App app{ "Prints fingerprints of pictures and choices, to be compared between two states",
    "gnomon_guards" };
  Options options;
  addTexts(app, "--scenes", options.scenes, "Scenes of visibility; all but city if none is named");
  addTexts(app, "--techniques", options.techniques, "Their techniques; all if none is named");
  addTexts(app, "--flights", options.flights, "Scenes of flights");
  addNumber(app, "--size", options.sidePixels, 1, 4096, "Side of the windows in pixels");
  addNumber(app, "--frames", options.frames, 0, 10000, "Frames of a flight");
  CLI11_PARSE(app, argc, argv);

  if (options.scenes.empty())
  {
    for (const BuiltinScene& scene : builtinScenes())
    {
      if (std::string(scene.name) != "city") // 10 million triangles
      {
        options.scenes.push_back(scene.name);
      }
    }
  }
  if (options.techniques.empty())
  {
    for (const TechniqueEntry& technique : registry())
    {
      options.techniques.push_back(technique.name);
    }
    options.techniques.push_back(automaticTechnique);
  }
  const VtkMessages messages;
  for (const std::string& name : options.scenes)
  {
    const Scene scene = withoutShadowSettings(loadScene(name));
    for (const std::string& technique : options.techniques)
    {
      printVisibility(scene, name, technique, options.sidePixels);
    }
  }
  for (const std::string& name : options.frames > 0 ? options.flights : std::vector<std::string>{})
  {
    const Scene scene = withoutShadowSettings(loadScene(name));
    printFlight(scene, name, options);
  }
  return 0;
}

} // namespace
} // namespace gnomon::tool

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark("gnomon_guards", [&] { return gnomon::tool::run(argc, argv); });
}
