#pragma once

#include "Comparison.h"
#include "Scene.h"

#include "lights/SettingsTable.h"
#include "plugin/vtkGnomonEGLRenderWindow.h"
#include "plugin/vtkGnomonShadowPass.h"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderPass.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <map>
#include <string>

namespace gnomon::tool
{

/// One way to draw a scene.
struct VariantSpec
{
  std::string technique; ///< of the registry, or one of the peers' names
  int mapSizeTexels = 0; ///< 0: no map
  int route = vtkGnomonShadowPass::ROUTE_AUTO;
  bool pointwise = false; ///< whether the technique has two routes
  /// What else is asked of the lights' shadows, by name (lights/ShadowSettings.h).
  std::map<std::string, std::string> settings = {};
  int tracer = vtkGnomonShadowPass::TRACER_AUTO;
  int rasterizer = vtkGnomonShadowPass::RASTERIZER_AUTO;

  bool isGnomon() const
  {
    return this->technique != plainTechnique && this->technique != shadowMapPassTechnique;
  }
  /// "inline", "image", or "" where routes mean nothing.
  std::string routeName() const;
  /// For people: "nsm fit=frame 1024 inline".
  std::string name() const;
};

/// What it asks of lights' shadows.
ShadowSettings settingsOf(const VariantSpec& spec);

/// "pcf:kernel=box:projection=lispsm" as a variant without map size and route.
/// @throws BadInput that names the technique or setting which there is not, or that is not a
/// technique's
VariantSpec parseTechnique(const std::string& text);

/// Has a pass draw a variant that isGnomon(), and forget what it was set to.
void setUp(vtkGnomonShadowPass* pass, const VariantSpec& spec);

/// What draws this variant, for vtkRenderer::SetPass; null for plain VTK.
vtkSmartPointer<vtkRenderPass> makePass(const VariantSpec& spec);

/// The scene with lights that say how large they are, and leave to the pass, hence to the variant,
/// how their shadows are made: technique, map size, kernel.
Scene withoutShadowSettings(Scene scene);

/// Turns a renderer's camera or lights a little, from the places that they had when this was made.
class Mover
{
public:
  /// How far camera and lights turn per step.
  static constexpr double stepDegrees = 0.05;

  /// @param renderer made from the scene, which must outlive this
  Mover(vtkRenderer* renderer, const Scene& scene);
  void apply(Motion motion, int step);

private:
  void turnCamera(double degrees);
  void turnLights(double degrees);

  vtkRenderer* renderer_;
  const Scene& scene_;
  vtkNew<vtkCamera> camera_;
  double cameraDegrees_ = 0.0;
  double lightDegrees_ = 0.0;
};

/// Draws a frame to its end and returns its wall clock time in milliseconds.
double drawTimed(vtkRenderWindow* window);

/// A variant with a window, a renderer and a pass of its own.
class FrameVariant
{
public:
  /// @param scene must outlive this
  FrameVariant(const VariantSpec& spec, const Scene& scene, int width, int height);

  const VariantSpec& spec() const { return this->spec_; }
  /// Null for the peers.
  vtkGnomonShadowPass* pass() const
  {
    return vtkGnomonShadowPass::SafeDownCast(this->renderer_->GetPass());
  }
  vtkRenderer* renderer() const { return this->renderer_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// Whether a light's map is still to be baked, once nothing has changed for some frames.
  bool awaitsMap() const;

  /// Draws one frame to its end and returns its wall clock time in milliseconds.
  double drawFrame(Motion motion, int step);

private:
  VariantSpec spec_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkNew<vtkGnomonEGLRenderWindow> window_;
  Mover mover_;
};

} // namespace gnomon::tool
