#include "Commands.h"
#include "Files.h"
#include "FrameVariant.h"
#include "Progress.h"

#include "plugin/plan/CostModel.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
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
  const char* technique; ///< null: plain VTK
  int mapSizeTexels = 0; ///< 0: the technique has no map
};

/// A ball over a floor under the sun, in its own window.
class MeasuredWindow
{
public:
  explicit MeasuredWindow(const Setup& setup)
  {
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-4.0, -4.0, 0.0);
    floor->SetPoint1(4.0, -4.0, 0.0);
    floor->SetPoint2(-4.0, 4.0, 0.0);
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(0.0, 0.0, 1.2);
    ball->SetThetaResolution(setup.sphereColumns);
    ball->SetPhiResolution(setup.sphereColumns);
    ball->Update();
    this->triangles_ = static_cast<double>(ball->GetOutput()->GetNumberOfCells());
    this->add(floor);
    this->ball_ = this->add(ball);
    this->light_->SetLightTypeToSceneLight();
    this->renderer_->AutomaticLightCreationOff();
    this->renderer_->AddLight(this->light_);
    if (setup.technique)
    {
      vtkNew<vtkGnomonShadowPass> pass;
      pass->SetSetting("edge_samples", "1");
      pass->SetTechnique(setup.technique);
      if (setup.mapSizeTexels > 0)
      {
        pass->SetMapSize(setup.mapSizeTexels);
      }
      this->renderer_->SetPass(pass);
    }
    this->window_->SetSize(setup.sidePixels, setup.sidePixels);
    this->window_->AddRenderer(this->renderer_);
  }

  double triangles() const { return this->triangles_; }

  /// Render a frame and wait for its end.
  /// @return the frame's milliseconds
  double draw(Moved moved, int step)
  {
    const auto turned = [&](Moved by) { return moved == by ? 0.001 * step : 0.0; };
    vtkCamera* const camera = this->renderer_->GetActiveCamera();
    camera->SetPosition(0.5 + turned(Moved::Camera), -3.0, 3.0); // sees only the floor
    camera->SetFocalPoint(0.0, 0.0, 0.6);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->renderer_->ResetCameraClippingRange();
    this->light_->SetPosition(1.0 + turned(Moved::Light), -0.5, 2.0);
    this->ball_->SetPosition(turned(Moved::Caster), 0.0, 0.0);
    return drawTimed(this->window_);
  }

private:
  vtkActor* add(vtkAlgorithm* source)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->renderer_->AddActor(actor);
    return actor;
  }

  vtkNew<vtkRenderer> renderer_;
  vtkSmartPointer<vtkOpenGLRenderWindow> window_ = makeOffScreenWindow();
  vtkNew<vtkLight> light_;
  vtkActor* ball_ = nullptr;
  double triangles_ = 0.0;
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

class Calibration
{
public:
  Calibration(int frames, Progress& progress)
  {
    constexpr int few = 100;
    constexpr int many = 700;
    const std::vector<Setup> setups = { { few, smallSide, nullptr }, { few, largeSide, nullptr },
      { many, smallSide, nullptr }, { few, largeSide, "nsm", coarseMap },
      { few, largeSide, "nsm", fineMap }, { many, smallSide, "nsm", coarseMap },
      { few, largeSide, "raytraced" }, { many, smallSide, "raytraced" } };
    for (const Setup& setup : setups)
    {
      this->windows_.push_back(std::make_unique<MeasuredWindow>(setup));
    }
    constexpr int motions = 4;
    for (int motion = 0; motion < motions; ++motion)
    {
      progress.begin("timing frames", static_cast<double>(motion) / motions);
      this->measure(static_cast<Moved>(motion), frames);
    }
  }

  CostFactors factors() const
  {
    const double pixelsSmall = double(smallSide) * smallSide;
    const double pixelsLarge = double(largeSide) * largeSide;
    const double triangles =
      this->windows_[PlainFine]->triangles() - this->windows_[PlainSmall]->triangles();
    const double texelsCoarse = double(coarseMap) * coarseMap;
    const double texelsFine = double(fineMap) * fineMap;
    const auto over = [&](double milliseconds, double count)
    { return std::max(1e6 * milliseconds / count, 0.0); };
    const auto at = [&](Window window, Moved moved)
    { return this->medians_[static_cast<std::size_t>(moved)][window]; };
    const double plainLarge = at(PlainLarge, Moved::Nothing);
    CostFactors factors{};
    factors.drawPixel =
      over(plainLarge - at(PlainSmall, Moved::Nothing), pixelsLarge - pixelsSmall);
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

private:
  /// Measure frames of all windows, interleaved.
  void measure(Moved moved, int frames)
  {
    this->medians_.push_back(timeFrames(this->windows_.size(), frames,
      [&](std::size_t window, int step) { return this->windows_[window]->draw(moved, step); }));
  }

  std::vector<std::unique_ptr<MeasuredWindow>> windows_;
  std::vector<std::vector<double>> medians_; ///< milliseconds, by moving object and by window
};

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
  const CostFactors factors = Calibration(options.frames, progress).factors();
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

//------------------------------------------------------------------------------
void addCalibrateCommand(CLI::App& app)
{
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command = app.add_subcommand("calibrate",
    "Measure the costs of frames on this machine, for the technique auto; the environment variable "
    "GNOMON_FACTORS names the file for programs");
  command->add_option(
    "-o,--output", options->output, "Output file; without it, print to standard output");
  command->add_option("--frames", options->frames, "Timed frames of each kind")
    ->check(CLI::Range(1, 1000))
    ->capture_default_str();
  command->callback([options] { calibrate(*options); });
}

} // namespace gnomon::tool
