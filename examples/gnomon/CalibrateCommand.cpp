#include "Commands.h"
#include "Files.h"
#include "FrameVariant.h"
#include "MeshBuilder.h"
#include "Progress.h"

#include "plugin/plan/CostModel.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkPlaneSource.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::tool
{
namespace
{

/// The object that moves from frame to frame.
enum class Moved
{
  Nothing,
  Camera,
  Light,
  Caster
};

/// The settings of a measured window.
struct Setup
{
  int sphereColumns; ///< the sphere has about twice their square of triangles
  int sidePixels;
  const char* technique;
  int mapSizeTexels = 0; ///< 0: the technique has no map
};

/// Return a ball over a floor under the sun, of which the camera sees only the floor.
Scene sceneOf(const Setup& setup)
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-4.0, -4.0, 0.0);
  floor->SetPoint1(4.0, -4.0, 0.0);
  floor->SetPoint2(-4.0, 4.0, 0.0);
  floor->Update();
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0.0, 0.0, 1.2);
  ball->SetThetaResolution(setup.sphereColumns);
  ball->SetPhiResolution(setup.sphereColumns);
  ball->Update();
  Scene scene;
  scene.models = { makeModel("floor", floor->GetOutput(), planeColor),
    makeModel("ball", ball->GetOutput(), planeColor) };
  scene.lights.resize(1);
  return scene;
}

struct MeasuredWindow
{
  explicit MeasuredWindow(const Setup& setup)
    : scene(sceneOf(setup))
    , variant({ setup.technique, setup.mapSizeTexels }, scene, setup.sidePixels, setup.sidePixels)
  {
    if (this->variant.pass())
    {
      this->variant.pass()->SmoothTerminatorsOn(); // as by default
    }
  }

  double triangles() const
  {
    return static_cast<double>(this->scene.models[1].surface->GetNumberOfCells());
  }

  /// Render a frame and wait for its end.
  /// @return the frame's milliseconds
  double draw(Moved moved, int step)
  {
    const auto turned = [&](Moved by) { return moved == by ? 0.001 * step : 0.0; };
    vtkRenderer* const renderer = this->variant.renderer();
    const Vec3 eye{ 0.5 + turned(Moved::Camera), -3.0, 3.0 };
    setCamera(renderer->GetActiveCamera(), { eye, { 0.0, 0.0, 0.6 }, { 0.0, 0.0, 1.0 }, 30.0, {} });
    renderer->ResetCameraClippingRange();
    vtkLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0))
      ->SetPosition(1.0 + turned(Moved::Light), -0.5, 2.0);
    renderer->GetActors()->GetLastActor()->SetPosition(turned(Moved::Caster), 0.0, 0.0);
    return drawTimed(this->variant.window());
  }

  Scene scene;
  FrameVariant variant;
};

/// The windows, by their purpose.
enum Window : std::size_t
{
  PlainSmall,
  PlainLarge,
  PlainFine,
  MapLarge,
  MapLargeFiner,
  MapFine,
  RaysLarge,
  RaysFine,
  windowCount
};

constexpr int smallSide = 512;
constexpr int largeSide = 1024;
constexpr int coarseMap = 512;
constexpr int fineMap = 2048;

/// Measure this machine.
/// @param frames timed frames of each kind
CostFactors measuredFactors(int frames, Progress& progress)
{
  constexpr int few = 100;
  constexpr int many = 700;
  std::vector<std::unique_ptr<MeasuredWindow>> windows;
  for (const Setup& setup :
    { Setup{ few, smallSide, plainTechnique }, { few, largeSide, plainTechnique },
      { many, smallSide, plainTechnique }, { few, largeSide, "nsm", coarseMap },
      { few, largeSide, "nsm", fineMap }, { many, smallSide, "nsm", coarseMap },
      { few, largeSide, "raytraced" }, { many, smallSide, "raytraced" } })
  {
    windows.push_back(std::make_unique<MeasuredWindow>(setup));
  }
  std::vector<std::vector<double>> medians; // milliseconds, by moving object and by window
  for (const Moved moved : { Moved::Nothing, Moved::Camera, Moved::Light, Moved::Caster })
  {
    progress.begin("timing frames", static_cast<double>(medians.size()) / 4.0);
    medians.push_back(timeFrames(windows.size(), frames,
      [&](std::size_t window, int step) { return windows[window]->draw(moved, step); }));
  }
  const double pixelsSmall = double(smallSide) * smallSide;
  const double pixelsLarge = double(largeSide) * largeSide;
  const double triangles = windows[PlainFine]->triangles() - windows[PlainSmall]->triangles();
  const double texelsCoarse = double(coarseMap) * coarseMap;
  const double texelsFine = double(fineMap) * fineMap;
  const auto over = [&](double milliseconds, double count)
  { return std::max(1e6 * milliseconds / count, 0.0); };
  const auto at = [&](Window window, Moved moved)
  { return medians[static_cast<std::size_t>(moved)][window]; };
  const double plainLarge = at(PlainLarge, Moved::Nothing);
  CostFactors factors{};
  factors.drawPixel = over(plainLarge - at(PlainSmall, Moved::Nothing), pixelsLarge - pixelsSmall);
  factors.drawTriangle =
    over(at(PlainFine, Moved::Nothing) - at(PlainSmall, Moved::Nothing), triangles);
  factors.askPixel = over(at(MapLarge, Moved::Nothing) - plainLarge, pixelsLarge);
  factors.bakeTexel =
    over(at(MapLargeFiner, Moved::Light) - at(MapLarge, Moved::Light), texelsFine - texelsCoarse);
  const double bakeFine = at(MapFine, Moved::Light) - at(MapFine, Moved::Nothing);
  factors.bakeTriangle = over(bakeFine - 1e-6 * factors.bakeTexel * texelsCoarse, triangles);
  factors.fetchPixel = over(at(RaysLarge, Moved::Nothing) - plainLarge, pixelsLarge);
  factors.tracePixel =
    over(at(RaysLarge, Moved::Light) - at(RaysLarge, Moved::Nothing), pixelsLarge);
  factors.receiverPixel =
    over(at(RaysLarge, Moved::Camera) - at(RaysLarge, Moved::Light), pixelsLarge);
  const double receiversFine = at(RaysFine, Moved::Camera) - at(RaysFine, Moved::Light);
  factors.receiverTriangle =
    over(receiversFine - 1e-6 * factors.receiverPixel * pixelsSmall, triangles);
  factors.refitTriangle =
    over(at(RaysFine, Moved::Caster) - at(RaysFine, Moved::Camera), triangles);
  return factors;
}

struct CalibrateOptions
{
  std::string output;
  int frames = 21;
};

void calibrate(const CalibrateOptions& options)
{
  if (!options.output.empty())
  {
    requireWritableFile(options.output, "--output", { ".txt" });
  }
  Progress progress("setting up");
  const CostFactors factors = measuredFactors(options.frames, progress);
  const std::string text =
    "# Costs of frames on this machine, in nanoseconds per triangle, pixel or texel.\n" +
    textOf(factors);
  if (options.output.empty())
  {
    progress.print(text, std::cout);
    return;
  }
  writeWholeFile(options.output, text);
}

} // namespace

void addCalibrateCommand(CLI::App& app)
{
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand("calibrate",
    "Measure the costs of frames on this machine, for the technique auto; the environment variable "
    "GNOMON_FACTORS names the file for programs");
  command->add_option(
    "-o,--output", options->output, "Output file; without it, print to standard output");
  addOption(*command, "--frames", options->frames, "Timed frames of each kind")
    ->check(CLI::Range(1, 1000));
  command->callback([options] { calibrate(*options); });
}

} // namespace gnomon::tool
