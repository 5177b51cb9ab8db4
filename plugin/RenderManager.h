#ifndef gnomon_plugin_RenderManager_h
#define gnomon_plugin_RenderManager_h

#include "lights/CameraView.h"
#include "plugin/CastingLights.h"
#include "plugin/Clock.h"
#include "plugin/FrameTracer.h"
#include "plugin/MapRasterizer.h"
#include "plugin/OccluderCollector.h"
#include "plugin/Route.h"
#include "plugin/ShaderManager.h"
#include "plugin/VisibilityImages.h"
#include "shadowtech/base/FrameReport.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

class vtkAbstractMapper;
class vtkGnomonShadowPass;
class vtkRenderState;
class vtkRenderer;

namespace gnomon
{

/// The stages of a frame, in the order in which the pass calls them and they stand here: what each takes from those before
/// it, keeps from frame to frame, and says in the report.
class RenderManager
{
public:
  /// Starts a frame's report and clock.
  void beginFrame(bool measureStages);

  /// lights: which of the renderer's lights cast, with which technique.
  /// @return false when none does
  /// @throws FrameError for techniques that do not exist or make no sense
  bool collectLights(vtkRenderer* renderer, const ShadowSettings& defaults);

  /// occluders: brings the snapshot up to date with the renderer's props. From here on it is known where the camera is in it.
  void collectOccluders(const vtkRenderState* s);

  /// Chooses how visibility reaches the shader, and states it in the report.
  /// @param wished a vtkGnomonShadowPass::RouteType
  /// @return false when the inline route is asked of a technique that works on the screen; it is
  /// the image route then, for the reason in the report
  bool chooseRoute(int wished, bool keepVisibility);
  Route route() const { return this->route_; }

  /// receivers (image route): has VTK draw the opaque props' triangle numbers, and points for
  /// techniques that read them on the GPU.
  /// @param pass whose hook the props' shaders have
  void drawReceivers(const vtkRenderState* s, vtkGnomonShadowPass* pass);

  /// maps: bakes what is stale.
  /// @param wishedRasterizer a vtkGnomonShadowPass::RasterizerType; nobody asks for it where no map is conservative
  /// @throws std::runtime_error for a rasterizer that there is not
  void bakeMaps(int wishedRasterizer);

  /// visibility (image route): fills one layer per light, and keeps a copy if asked to.
  /// @param wishedTracer a vtkGnomonShadowPass::TracerType; nobody asks for it where nothing is traced
  /// @throws std::runtime_error for a tracer that there is not, or has no room
  void computeVisibility(int wishedTracer, bool keep);

  /// shading: between the two calls VTK draws its props with the hook in place.
  void beginShading(const vtkRenderState* s);
  /// @return false if props were drawn at another resolution than the visibility layers have; they
  /// show no shadows then
  bool endShading();

  /// Completes the report.
  void endFrame();

  /// Gives back what a stage holds that an error has ended early.
  void abandonFrame();

  /// For the hook: sets a program's parameters for the prop that is about to be drawn.
  void setShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop);
  ShaderManager& shaders() { return this->shaders_; }

  const FrameReport& report() const { return this->report_; }
  const VisibilityImages& visibility() const { return this->visibility_; }

private:
  void endStageClock(const std::string& name);
  void updateTracer(int wished);
  void fillLayers(CastingLight& casting, Receivers& receivers, std::vector<std::uint8_t>* classes);
  bool readsPoints() const;

  FrameReport report_;
  bool measureStages_ = false;
  double frameStart_ = 0.0; ///< by steadyMilliseconds()
  double stageStart_ = 0.0; ///< likewise
  int compilesBefore_ = 0;

  glm::ivec2 size_{ 0 }; ///< of this frame's picture, in pixels
  CameraView camera_;    ///< that it is drawn by

  CastingLights lights_;
  OccluderCollector collector_;
  OccluderBuffers buffers_;
  Route route_ = Route::Inline;
  ReceiverTarget receiverTarget_;
  std::size_t receiversShown_ = 0; ///< a hash of what the receivers' images depend on
  ReceiverImages receiverImages_;
  ReceiverPixels receivers_; ///< where somebody asked for all of them
  VisibilityLayers layers_;
  ShaderLibrary library_;
  FrameTracer tracer_{ buffers_, library_ };
  ShaderManager shaders_;
  ShaderManager::StageValues stageValues_;
  VisibilityImages visibility_;
};

} // namespace gnomon

#endif
