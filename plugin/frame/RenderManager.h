#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/Frame.h"
#include "plugin/frame/FramePlanner.h"
#include "plugin/frame/FrameReporting.h"
#include "plugin/frame/PassPrograms.h"
#include "plugin/frame/ReceiversOnCpu.h"
#include "plugin/frame/ReceiversStage.h"
#include "plugin/frame/SceneReading.h"
#include "plugin/frame/SkyStage.h"
#include "plugin/frame/SnapshotTracer.h"
#include "plugin/frame/VisibilityStage.h"
#include "plugin/ranks/SharedPatches.h"
#include "plugin/scene/OccluderCollector.h"
#include "plugin/scene/ShadedView.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "shadowtech/base/OccluderBuffers.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractMapper;
class vtkObjectBase;
class vtkRenderState;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Thrown where a frame has begun that other shaders must draw.
struct FrameMustBeDrawnAgain
{
};

/// One renderer's frames. A frame reads what there is (Scene), plans (FramePlan), executes the plan
/// in stages, and reports. The pass calls what follows from top to bottom. Each stage takes values
/// of the stages above it, and reuses its own last value while what that was made from is the same.
class RenderManager
{
public:
  /// @param programs of the pass, which serve all of its renderers
  explicit RenderManager(PassPrograms& programs);

  /// Start a frame's counts and clock.
  /// @param ranks the processes that draw the picture
  void beginFrame(const FrameWishes& wishes, Ranks& ranks);

  /// lights: reads which of the renderer's lights may cast.
  /// @param severalViews whether the pass draws others beside this one
  /// @return whether the frame goes on: to shadows, or to receivers that are kept
  bool readLights(vtkRenderer* renderer, const ShadowSettings& defaults, bool severalViews);

  /// snapshot: brings it up to date with the renderer's props. From here on it is known where the
  /// camera is in it.
  /// @return the kinds of visible props that are left out of it
  const std::vector<std::string>& readProps(const vtkRenderState* s);

  /// Note lights, camera and props.
  /// @return true if they differ from what this noted last for the same view
  bool changes(const vtkRenderState* s);

  /// Plan the frame. Maps that the plan must look at first are baked.
  /// @param moves true if the frame is one of a moving picture
  /// @param mayRefine true if more frames at rest follow an unfinished one
  /// @param drawnPlainly true if no render pass of the user's draws the props
  /// @throws std::runtime_error as bakeMaps() and computeVisibility()
  const FramePlan& plan(const vtkRenderState* s, bool moves, bool mayRefine, bool drawnPlainly);

  /// receivers (image route): draws which triangle each pixel shows, and points for techniques that
  /// read them on the GPU. Then it is known which lights' visibility is another one than the view
  /// has.
  /// @param pass whose hook the props' shaders have
  void updateReceivers(const vtkRenderState* s, vtkObjectBase* pass);

  /// maps: bakes what is stale, for lights whose visibility is computed in this frame.
  /// @throws TextureMemoryError for maps without room
  void bakeMaps();

  /// visibility (image route): fills the layers of the sky and of the lights whose visibility is
  /// another one than the view has, and keeps a copy of the lights' if asked to.
  /// @throws std::runtime_error if there is no tracer
  void computeVisibility();

  /// shading and receivers (deferred route): between the two calls VTK draws its opaque props, lit
  /// and in shadow. Afterwards it is known which lights' visibility is another one than the view
  /// has.
  void beginOpaque(const vtkRenderState* s);
  /// @throws FrameMustBeDrawnAgain
  void endOpaque(const vtkRenderState* s);

  /// shading (deferred route): gives what is in shadow its colour.
  void drawShadows();

  /// shading: between the two calls VTK draws its props with the hook in place; on the deferred
  /// route those that are left.
  void beginShading(const vtkRenderState* s);
  /// @return how a pass inside this one drew props that its shaders do not fit, as the end of a
  /// clause; they show no shadows then. Empty if all fitted
  std::string endShading();

  /// Count where the picture shows another process's surface than its receivers. This is a
  /// collective frame of its own (Ranks), after the picture was drawn and the report completed.
  void compareSurfaces(const vtkRenderState* s);

  /// Remember the frame, and report it, after VTK has drawn the props.
  void endFrame(const vtkRenderState* s);

  /// End a stage that an error has ended early.
  void abandonFrame();

  /// For the hook: sets a program's parameters for the prop that is about to be drawn.
  void setShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop);
  /// Return the share of its points that the light with the fewest shows (LightCounts::progress).
  double progress() const;
  const FrameReport& report() const { return this->report_; }
  const VisibilityImages& visibility() const { return this->visibility_.images(); }

private:
  void readPicture(const vtkRenderState* s, bool moves, bool mayRefine, bool drawnPlainly);
  void configureShaders(const vtkRenderState* s);
  MapStage mapStage(bool bakesOptional);
  void makeRoomForLayers();

  Frame frame_;
  LightReading lights_;
  OccluderCollector collector_;
  std::vector<SurfaceName> names_; ///< of the snapshot's surfaces, if the plan names them
  SharedPatches patches_;          ///< of the snapshot, if several processes draw the picture
  OccluderBuffers buffers_;
  PassPrograms& programs_;
  ShaderManager::StageValues stageValues_;
  TransmittanceStage transmittance_{ frame_, collector_.occluders() };
  SnapshotTracer tracer_{ frame_, collector_.occluders(), patches_.names(), transmittance_ };
  ReceiversStage receivers_{ frame_, collector_, programs_, stageValues_ };
  OwnReceivers ownReceivers_{ frame_, collector_, names_ };
  ReceiversOfRanks receiversOfRanks_{ frame_, collector_, names_, patches_ };
  VisibilityStage visibility_{ frame_, collector_.occluders(), buffers_, tracer_,
    programs_.library };
  SkyStage sky_{ frame_, tracer_ };
  FramePlanner planner_{ frame_, collector_.occluders(), tracer_, programs_.library };
  RendererViews views_;
  std::optional<ShadedView> shadedView_; ///< once a frame's shaders shade
  bool hadOtherView_ = false;            ///< true if a pass drew props by another camera
  FrameReport report_;                   ///< of the last frame
  std::int64_t checkedBefore_ = 0;       ///< triangle numbers, in a frame that is drawn again
  ///@{
  /// Before the frame.
  int compilesBefore_ = 0;
  int newProgramsBefore_ = 0;
  ///@}
};

} // namespace gnomon
