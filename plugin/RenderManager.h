#ifndef gnomon_plugin_RenderManager_h
#define gnomon_plugin_RenderManager_h

#include "lights/LightManager.h"
#include "plugin/FrameTracer.h"
#include "plugin/MapRasterizer.h"
#include "plugin/OccluderCollector.h"
#include "plugin/ShaderManager.h"
#include "plugin/ShownView.h"
#include "plugin/VisibilityImages.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/FrameReport.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

class vtkGnomonShadowPass;
class vtkRenderState;
class vtkRenderer;

namespace gnomon
{

/// A setting that cannot be served. The frame goes on without shadows, with this as its error.
class FrameError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The stages of a frame, what each of them keeps from frame to frame, and when that is stale. The
/// pass calls the stages in the order in which they stand here.
class RenderManager
{
public:
  /// Starts a frame's report and clock.
  void beginFrame(bool measureStages);

  /// lights: which of the renderer's lights cast, with which technique.
  /// @return false when none does
  /// @throws FrameError for techniques that do not exist or make no sense
  bool collectLights(vtkRenderer* renderer, const ShadowSettings& defaults);

  /// occluders: brings the snapshot up to date with the renderer's props.
  void collectOccluders(vtkRenderer* renderer);

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
  void bakeMaps(vtkRenderer* renderer, int wishedRasterizer);

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
  /// What a technique's maps were baked from.
  struct Bake
  {
    LightViews views;
    std::optional<CameraView> camera; ///< that the views were fitted to
    MapReach reach;
    ShadowSettings settings;
    int sizeTexels = 0;
    std::uint64_t topology = 0;
    std::uint64_t positions = 0;
    std::size_t receivers = 0; ///< a hash of what F of MapFit.h was found from on the GPU; else 0
    bool once = false;
    /// Who was to draw a conservative map; none for other maps.
    std::optional<RasterizerChoice> rasterizer;
    RasterizerChoice drawnBy; ///< and who did; before that the same
    int castersLeftOut = 0;
    ViewFitting fitting; ///< of this frame, by which the same views might be laid out again

    /// Whether maps that were baked from this serve where others are wanted.
    bool serves(const Bake& wanted) const;
  };
  /// A casting light and its technique.
  struct LightSlot
  {
    const EstimatorEntry* estimator = nullptr;
    std::unique_ptr<Technique> technique;
    Bake bake;
    Bake awaited; ///< what a map was last not baked from, to see whether it is still wanted
    /// Shades translucent surfaces where the technique works on the screen; null without such.
    std::unique_ptr<Technique> plain;
    Bake plainBake;
    ShadowLight light;
    int layer = 0;    ///< of the visibility layers, its first
    int channels = 1; ///< of its visibility, a layer each
    ReceiverFit receiverFit;
  };

  void endStageClock(const std::string& name);
  void chooseFits();
  std::string reasonAgainstReceivers(const LightSlot& slot) const;
  const Technique* pointwiseFor(LightSlot& slot) const;
  void bakeMaps(LightSlot& slot, const CameraView& camera, Technique& technique, Bake& bake);
  bool isWorthBaking(const LightSlot& slot, const Technique& technique, const Bake& wanted) const;
  std::optional<RasterizerChoice> rasterizerFor(
    const LightSlot& slot, const Technique& technique) const;
  static void takeReason(Bake& bake, const Bake& wanted);
  void reportBake(const ShadowLight& light, const Bake& bake);
  LightReport& reportOf(const ShadowLight& light);
  void updateTracer(int wished);
  void keepVisibility(const ReceiverPixels& receivers);
  void keepLayers(const LightSlot& slot);
  bool readsPoints() const;
  CameraView camera(vtkRenderer* renderer) const;
  ReceiverSpace receiverSpace(const vtkRenderState* s) const;
  glm::dmat4 centredFromView(vtkRenderer* renderer) const;

  FrameReport report_;
  bool measureStages_ = false;
  std::chrono::steady_clock::time_point frameStart_;
  std::chrono::steady_clock::time_point stageStart_;
  int compilesBefore_ = 0;

  LightManager lightManager_;
  std::map<int, LightSlot> slots_; ///< by the light's place in the scene
  std::vector<LightSlot*> casting_;
  ViewCount viewCount_;

  OccluderCollector collector_;
  OccluderBuffers buffers_;
  RasterizerChoice rasterizer_; ///< of conservative maps in this frame
  Route route_ = Route::Inline;
  CameraView camera_; ///< that the receivers were drawn by
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
