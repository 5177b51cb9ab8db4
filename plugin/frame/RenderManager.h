#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/Frame.h"
#include "plugin/frame/PassPrograms.h"
#include "plugin/frame/ReceiversStage.h"
#include "plugin/frame/SnapshotTracer.h"
#include "plugin/frame/TechniqueChoice.h"
#include "plugin/frame/VisibilityStage.h"
#include "plugin/plan/PicturePlan.h"
#include "plugin/ranks/SharedPatches.h"
#include "plugin/scene/OccluderCollector.h"
#include "plugin/vtkGnomonVisibilityImages.h"

#include "shadowtech/base/OccluderBuffers.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
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

/// The stages of one renderer's frame, in the order in which the pass calls them. Each takes values
/// of the stages above it, and reuses its own last value while what that was made from is the same.
class RenderManager
{
public:
  /// @param programs of the pass, which serve all of its renderers
  explicit RenderManager(PassPrograms& programs);

  /// Start a frame's report and clock.
  /// @param ranks the processes that draw the picture; null: this one alone
  void beginFrame(const FrameWishes& wishes, Ranks* ranks);

  /// lights: which of the renderer's lights cast, with which technique.
  /// @param severalViews whether the pass draws others beside this one
  /// @return whether the frame goes on: to shadows, or to receivers that are kept
  bool collectLights(vtkRenderer* renderer, const ShadowSettings& defaults, bool severalViews);

  /// snapshot: brings it up to date with the renderer's props. From here on it is known where the
  /// camera is in it.
  void collectOccluders(const vtkRenderState* s);

  /// Note lights, camera and props.
  /// @return true if they differ from what this noted last for the same view
  bool changes(const vtkRenderState* s);

  /// Choose for lights that leave their technique to the pass. Maps that they take are baked.
  /// @param moves true if the frame is one of a moving picture
  /// @param mayRefine true if more frames at rest follow an unfinished one
  /// @return true if a picture at rest may differ from this choice's
  /// @throws std::runtime_error as bakeMaps() and computeVisibility()
  bool chooseTechniques(bool moves, bool mayRefine);

  /// Plan how visibility reaches the picture, and state it in the report.
  /// @param drawnPlainly true if no render pass of the user's draws the props
  /// @return false when a route is asked for that cannot be taken; it is the image route then, for
  /// the reason in the report
  bool chooseRoute(const vtkRenderState* s, bool drawnPlainly);
  Route route() const { return this->frame_.route; }

  /// receivers (image route): draws which triangle each pixel shows, and points for techniques that
  /// read them on the GPU. Then it is known which lights' visibility is another one than the view
  /// has.
  /// @param pass whose hook the props' shaders have
  void updateReceivers(const vtkRenderState* s, vtkObjectBase* pass);

  /// maps: bakes what is stale, for lights whose visibility is computed in this frame.
  /// @throws TextureMemoryError for maps without room
  void bakeMaps();

  /// visibility (image route): fills the layers of the lights whose visibility is another one than
  /// the view has, and keeps a copy if asked to.
  /// @throws std::runtime_error if there is no tracer
  void computeVisibility() { this->visibility_.compute(this->names_); }

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

  /// Complete the report, after VTK has drawn the props.
  void endFrame(const vtkRenderState* s);

  /// End a stage that an error has ended early.
  void abandonFrame();

  /// For the hook: sets a program's parameters for the prop that is about to be drawn.
  void setShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop);
  /// Return the share of its points that the light with the fewest shows (LightReport::progress).
  double progress() const;
  const FrameReport& report() const { return this->frame_.report; }
  const VisibilityImages& visibility() const { return this->visibility_.images(); }

private:
  MapStage mapStage(const CastingLight& casting);
  PicturePlan planOfPicture(const vtkRenderState* s, bool drawnPlainly) const;
  void makeRoomForLayers();

  Frame frame_;
  OccluderCollector collector_;
  std::vector<SurfaceName> names_; ///< of the snapshot's surfaces, if they are needed
  SharedPatches patches_;          ///< of the snapshot, if several processes draw the picture
  OccluderBuffers buffers_;
  PassPrograms& programs_;
  ShaderManager::StageValues stageValues_;
  SnapshotTracer tracer_{ frame_, collector_.occluders(), patches_.names() };
  ReceiversStage receivers_{ frame_, collector_, names_, patches_, programs_, stageValues_ };
  VisibilityStage visibility_{ frame_, collector_.occluders(), buffers_, tracer_, receivers_,
    programs_.library };
  TechniqueChoice choice_{ frame_, collector_.occluders(), tracer_, programs_.library };
  RendererViews views_;
  ///@{
  /// The renderer that shades, and its camera as the shaders know it.
  vtkRenderer* shading_ = nullptr;
  std::array<double, 17> shadingView_{};
  bool hadOtherView_ = false; ///< true if a pass drew props by another camera
  ///@}
  bool shadesTranslucent_ = false; ///< whether translucent surfaces show shadows in this frame
  std::int64_t checkedBefore_ = 0; ///< triangle numbers, in a frame that is drawn again
  ///@{
  /// Before the frame.
  int compilesBefore_ = 0;
  int newProgramsBefore_ = 0;
  ///@}
};

} // namespace gnomon
