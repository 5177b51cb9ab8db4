#pragma once

#include "Comparison.h"
#include "Scene.h"

#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonOffScreenWindow.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// One way to render a scene.
struct VariantSpec
{
  std::string technique; ///< a name of the registry or of a peer
  int mapSizeTexels = 0; ///< 0: no map
  int route = vtkGnomonShadowPass::ROUTE_AUTO;
  bool pointwise = false; ///< true if the technique has two routes
  /// Other settings of the lights' shadows, by name (lights/ShadowSettings.h).
  std::map<std::string, std::string> settings = {};

  bool isGnomon() const
  {
    return this->technique != plainTechnique && this->technique != shadowMapPassTechnique;
  }
  /// Return "inline", "image", or "" for variants without routes.
  std::string routeName() const;
  /// Return a name for users: "nsm fit=frame 1024 inline".
  std::string name() const;
};

ShadowSettings settingsOf(const VariantSpec& spec);

/// Parse a text such as "pcf:kernel=box:projection=lispsm" as a variant without map size and route.
/// @throws BadInput with the name of an unknown technique or setting, or of a setting that the
/// technique lacks
VariantSpec parseTechnique(const std::string& text);

/// Set a pass up to draw a variant that isGnomon(). Its other settings return to their defaults.
void setUp(vtkGnomonShadowPass* pass, const VariantSpec& spec);

/// Return a variant's pass, for vtkRenderer::SetPass(); null for plain VTK.
vtkSmartPointer<vtkRenderPass> makePass(const VariantSpec& spec);

/// Return the scene with lights that keep their size only. Technique, map size and kernel come from
/// the pass, hence from the variant.
Scene withoutShadowSettings(Scene scene);

/// Render a frame, wait for its end, and return its wall clock time in milliseconds.
double drawTimed(vtkRenderWindow* window);

/// A variant with its own window, renderer and pass.
class FrameVariant
{
public:
  /// The turn of camera and lights per step, in degrees.
  static constexpr double stepDegrees = 0.05;

  /// @param scene must outlive this object
  FrameVariant(const VariantSpec& spec, const Scene& scene, int width, int height);

  const VariantSpec& spec() const { return this->spec_; }
  /// Return the pass; null for the peers.
  vtkGnomonShadowPass* pass() const
  {
    return vtkGnomonShadowPass::SafeDownCast(this->renderer_->GetPass());
  }
  vtkRenderer* renderer() const { return this->renderer_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// True if a light's map will be baked after some more frames at rest.
  bool awaitsMap() const;

  /// Render one frame, wait for its end, and return its wall clock time in milliseconds. Camera and
  /// lights are those of the scene; the moving one is turned by `step` steps.
  double drawFrame(Motion motion, int step);

private:
  void turnCamera(double degrees);
  void turnLights(double degrees);

  VariantSpec spec_;
  const Scene& scene_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkOpenGLRenderWindow> window_ = makeOffScreenWindow();
  vtkNew<vtkCamera> camera_; ///< the scene's
  double cameraDegrees_ = 0.0;
  double lightDegrees_ = 0.0;
};

/// The number of frames that are rendered but not counted after a change of motion.
inline constexpr int warmUpFrames = 3;

/// Return the median: the upper of two middle values, or 0 without values.
double median(std::vector<double> values);

/// Return the median wall clock time per frame of each of several ways to draw, in milliseconds.
/// Their frames are interleaved, so other load of the machine affects all alike.
/// @param frames number of counted frames, after warmUpFrames others
/// @param draw renders a frame of a way, at a step from 1, and returns its milliseconds
/// @param roundDone called after each round of one frame per way; may be empty
std::vector<double> timeFrames(std::size_t ways, int frames,
  const std::function<double(std::size_t way, int step)>& draw,
  const std::function<void()>& roundDone = {});

/// Return this process' resident memory in bytes; 0 if it is unknown.
std::int64_t residentBytes();

/// Return the processor's model and its number of hardware threads.
std::string processorName();

std::string openGlName(vtkRenderWindow* window);

} // namespace gnomon::tool
