#include "plugin/frame/RenderManager.h"

#include "lights/Hash.h"
#include "plugin/scene/PropRecords.h"
#include "plugin/scene/ShownView.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "plugin/window/PictureTarget.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"

#include <vtkMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

namespace gnomon
{
namespace
{

vtkOpenGLRenderWindow* windowOf(const vtkRenderState* s)
{
  return vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
}

/// Return a number that differs where lights differ in what decides their rays.
/// @param withSettings true if it also differs with the settings of raytraced
std::uint64_t hashOf(const SceneLights& lights, bool withSettings)
{
  std::size_t seed = lights.identities.size();
  auto identity = lights.identities.begin();
  for (const ShadowLight& light : lights.set.lights)
  {
    hashCombine(seed, light.sceneIndex);
    hashCombine(seed, identity->centre);
    hashCombine(seed, identity->area);
    ++identity;
    if (withSettings)
    {
      for (const SettingsTable* table : findTechnique("raytraced")->estimator->info.settings)
      {
        for (const Setting& setting : table->settings)
        {
          hashCombine(seed, setting.read(light));
        }
      }
    }
  }
  return seed;
}

bool drawsInSoftware()
{
  const GLubyte* const name = glGetString(GL_RENDERER);
  return isSoftwareRenderer(name ? reinterpret_cast<const char*>(name) : "");
}

/// Return the colour to which a renderer clears its picture; none if it leaves or draws more there
/// before its props.
std::optional<glm::vec4> clearedColour(vtkRenderer* renderer)
{
  const bool isCleared = std::strcmp(renderer->GetClassName(), "vtkOpenGLRenderer") == 0 &&
    renderer->GetErase() && renderer->GetRenderWindow()->GetErase() && !renderer->Transparent();
  if (!isCleared || renderer->GetGradientBackground() || renderer->GetTexturedBackground())
  {
    return std::nullopt;
  }
  const double* const colour = renderer->GetBackground();
  return glm::vec4(colour[0], colour[1], colour[2], renderer->GetBackgroundAlpha());
}

} // namespace

RenderManager::RenderManager(PassPrograms& programs)
  : programs_(programs)
{
}

void RenderManager::beginFrame(const FrameWishes& wishes, Ranks& ranks)
{
  Frame& frame = this->frame_;
  frame.counts = FrameCounts{};
  frame.counts.numbersChecked = std::exchange(this->checkedBefore_, 0);
  frame.scene = Scene{};
  this->receivers_.beginFrame();
  frame.wishes = wishes;
  frame.ranks = &ranks;
  frame.wishes.isShared = ranks.count() > 1;
  frame.onCpu = &this->ownReceivers_;
  if (frame.wishes.isShared)
  {
    frame.onCpu = &this->receiversOfRanks_;
  }
  if (!wishes.keepVisibility)
  {
    this->visibility_.dropImages();
  }
  if (wishes.measureStages)
  {
    glFinish(); // what was pending before the frame is not the frame's
  }
  frame.start = frame.stageStart = steadyMilliseconds();
  const PassPrograms& programs = this->programs_;
  this->compilesBefore_ = programs.library.compiles() + programs.shaders.rebuilds();
  this->newProgramsBefore_ = programs.library.compiles() + programs.shaders.newPrograms();
}

bool RenderManager::readLights(
  vtkRenderer* renderer, const ShadowSettings& defaults, bool severalViews)
{
  Frame& frame = this->frame_;
  frame.view = &this->views_.of(renderer);
  frame.scene.picture.severalViews = severalViews;
  frame.scene.picture.drawsMaps = canDrawMaps();
  frame.scene.lights = this->lights_.read(renderer, defaults, frame.wishes);
  const SceneLights& lights = frame.scene.lights;
  frame.ranks->requireSame([&] { return hashOf(lights, true); }, "lights");
  frame.endStage("lights");
  return !lights.set.lights.empty() || frame.wishes.showsSky() || frame.wishes.keepVisibility;
}

const std::vector<std::string>& RenderManager::readProps(const vtkRenderState* s)
{
  Frame& frame = this->frame_;
  const SnapshotChange change = this->collector_.collect(s->GetRenderer(),
    { frame.wishes.smoothTerminators, haveInputsRun(s->GetRenderer()),
      { frame.wishes.translucentCasters && !frame.wishes.isShared, !frame.wishes.isShared,
        frame.wishes.volumeCasters, frame.wishes.volumesReceive } },
    *frame.ranks);
  frame.counts.surfacesExtracted = change.extracted;
  frame.counts.surfacesRetransformed = change.retransformed;
  const Occluders& occluders = this->collector_.occluders();
  frame.scene.props = gnomon::readProps(occluders);
  frame.scene.props.seenThrough = this->collector_.anySeenThrough();
  frame.scene.props.catcher = this->collector_.anyCatcher();
  frame.scene.props.translucent = this->collector_.translucentReceivers() > 0;
  frame.scene.props.volumes = this->collector_.volumeReceivers() > 0 && occluders.hasCasters();
  frame.size = sizeOf(s, frame.wishes.reductionFactor);
  const ShownView shown = shownView(s->GetRenderer(), occluders.frame);
  frame.camera = shown.camera;
  frame.space = { shown.centredFromView, shown.camera.pixelSide(frame.size) };
  this->stageValues_.space = frame.space;
  this->stageValues_.viewFromVtkView = shown.viewFromVtkView;
  this->stageValues_.eyeView = shown.camera.eyeView();
  this->stageValues_.reductionFactor = frame.wishes.reductionFactor;
  hashView(frame.scene.picture.view, frame.camera, frame.size);
  frame.ranks->requireSame(
    [&] { return frame.scene.picture.view; }, "cameras or sizes of the picture");
  frame.endStage("occluders");
  return this->collector_.leftOut();
}

bool RenderManager::changes(const vtkRenderState* s)
{
  std::size_t shown = hashOf(this->frame_.scene.lights, false);
  hashCombine(shown, this->frame_.scene.picture.view);
  hashCombine(shown, this->receivers_.shownProps(s).hash);
  hashCombine(shown, this->frame_.scene.props.casters.first);
  hashCombine(shown, this->frame_.scene.props.casters.second);
  return std::exchange(this->frame_.view->shown, shown) != shown;
}

/// Read what a plan must know of the picture.
void RenderManager::readPicture(
  const vtkRenderState* s, bool moves, bool mayRefine, bool drawnPlainly)
{
  vtkRenderer* const renderer = s->GetRenderer();
  ScenePicture& picture = this->frame_.scene.picture;
  picture.pixels =
    static_cast<std::size_t>(this->frame_.size.x) * static_cast<std::size_t>(this->frame_.size.y);
  picture.samples = samplesOfBoundFramebuffer();
  picture.moves = moves;
  picture.mayRefine = mayRefine;
  picture.drawnPlainly =
    drawnPlainly && !renderer->GetUseSSAO() && !renderer->GetUseHiddenLineRemoval();
  picture.inSoftware = drawsInSoftware();
  picture.factors =
    this->frame_.wishes.factors ? *this->frame_.wishes.factors : defaultFactors(picture.inSoftware);
}

const FramePlan& RenderManager::plan(
  const vtkRenderState* s, bool moves, bool mayRefine, bool drawnPlainly)
{
  this->readPicture(s, moves, mayRefine, drawnPlainly);
  const FramePlan& plan = this->frame_.plan;
  this->planner_.plan(
    [this](const ShadowLight& map, LightTechnique& technique)
    {
      LightCounts ofMap; // the light's own are those of the technique that is chosen
      technique.updateMaps(map, this->mapStage(true), ofMap);
    },
    [this, s]
    {
      const ShownProps& shown = this->receivers_.shownProps(s);
      return DeferredFacts{ shown.ownShaders, shown.partsOfBothKinds, shown.physicallyBased,
        DeferredPicture::whyUnsupported() };
    });
  if (plan.lights.empty())
  {
    this->visibility_.dropImages(); // that of an earlier frame
  }
  if (plan.hasShadows)
  {
    this->names_ = plan.namesSurfaces ? surfaceNames(s->GetRenderer(), this->collector_.records())
                                      : std::vector<SurfaceName>{};
    this->configureShaders(s);
  }
  this->frame_.endStage("plan");
  return plan;
}

/// Give the hook its tasks in this frame.
void RenderManager::configureShaders(const vtkRenderState* s)
{
  Frame& frame = this->frame_;
  this->transmittance_.attach();
  Numbering numbering = Numbering::None;
  if (frame.route() != Route::Inline)
  {
    this->receivers_.findStale(s);
    numbering = numberingOf({ frame.route(), frame.scene.picture.inSoftware,
      this->receivers_.countRest(), frame.scene.picture.severalViews, frame.scene.props.triangles,
      this->collector_.occluders().surfaces.size() });
  }
  this->programs_.shaders.configure(
    { frame.route(), this->receivers_.readsPoints(), frame.scene.picture.samples > 1, numbering,
      this->stageValues_.viewFromVtkView == glm::dmat4(1.0), frame.scene.props.seenThrough,
      frame.scene.props.catcher, frame.plan.layers, frame.plan.bits,
      frame.plan.sky ? frame.plan.sky->layer : noSkyLayer, frame.plan.edgeBit,
      frame.plan.picture.shadesVolumes },
    frame.lights);
  this->stageValues_.skyLight = frame.plan.sky ? frame.plan.sky->light : glm::vec3(0.0f);
}

void RenderManager::makeRoomForLayers()
{
  VisibilityLayers& layers = this->frame_.view->layers;
  const glm::ivec2& size = this->frame_.size;
  const int count = this->frame_.plan.layers;
  const int bits = this->frame_.plan.bits;
  if (count + bits > 0 && !layers.have(size.x, size.y, count, bits))
  {
    this->frame_.view->visibility.clear();
    this->frame_.view->sky.layer.reset();
    layers.resize(size.x, size.y, count, bits);
  }
  this->stageValues_.layers = { GL_TEXTURE_2D_ARRAY, layers.texture() };
  this->stageValues_.bits = { GL_TEXTURE_2D, layers.textureOfBits() };
  this->stageValues_.layersSize = size;
}

void RenderManager::updateReceivers(const vtkRenderState* s, vtkObjectBase* pass)
{
  this->makeRoomForLayers();
  this->receivers_.update(s, pass);
  this->visibility_.findStale();
}

/// Return the inputs of maps.
/// @param bakesOptional false: bakes of optional maps wait for a later frame
MapStage RenderManager::mapStage(bool bakesOptional)
{
  return { this->frame_.camera, this->collector_.occluders(), this->buffers_,
    this->programs_.library, this->frame_.view->receivers.target,
    this->frame_.space.centredFromView, this->frame_.view->receivers.number, bakesOptional,
    this->frame_.counts, this->collector_.pointsCentred() };
}

void RenderManager::bakeMaps()
{
  for (CastingLight& casting : this->frame_.lights)
  {
    const LightPlan& plan = casting.plan;
    // A moving picture that leaves the technique to the pass would stand still meanwhile.
    const MapStage stage = this->mapStage(!(plan.asked && this->frame_.plan.moves));
    const bool isInline = this->frame_.route() == Route::Inline;
    if (isInline || casting.isStale || plan.shadedBy == ShadedBy::Own)
    {
      casting.own->updateMaps(plan.light, stage, casting.counts);
    }
    if (casting.atPoints)
    {
      MapStage ofPoints = stage;
      ofPoints.servesPointsAlone = !stage.pointsCentred.empty();
      casting.atPoints->updateMaps(casting.lightInShaders(), ofPoints, casting.counts);
    }
  }
  this->frame_.endStage("maps");
}

void RenderManager::computeVisibility()
{
  this->sky_.compute(); // may store the receivers, which the lights read then
  this->visibility_.compute();
}

void RenderManager::beginOpaque(const vtkRenderState* s)
{
  this->makeRoomForLayers();
  this->receivers_.begin(s);
  this->frame_.view->receivers.deferred.attach(
    this->receivers_.areDue(), clearedColour(s->GetRenderer()));
}

void RenderManager::endOpaque(const vtkRenderState* s)
{
  this->programs_.shaders.endStage();
  this->frame_.view->receivers.deferred.detach();
  if (this->frame_.view->receivers.deferred.size() != this->frame_.size)
  {
    throw std::runtime_error("it is drawn at another size than its viewport has");
  }
  this->frame_.endStage("shading: lit and in shadow");
  if (this->receivers_.areDue() && !this->receivers_.ensureRightNumbers(s))
  {
    this->checkedBefore_ = this->frame_.counts.numbersChecked;
    throw FrameMustBeDrawnAgain();
  }
  this->receivers_.take();
  this->visibility_.findStale();
}

void RenderManager::drawShadows()
{
  this->frame_.view->receivers.deferred.darken(
    this->frame_.plan.bits > 0 ? this->stageValues_.bits : this->stageValues_.layers,
    this->programs_.library);
  this->frame_.endStage("shading: shadows");
}

void RenderManager::beginShading(const vtkRenderState* s)
{
  this->stageValues_.receiversStage = false;
  this->stageValues_.edges = this->frame_.view->edges.texture();
  this->shadedView_.emplace(s->GetRenderer());
  this->hadOtherView_ = false;
  this->programs_.shaders.beginStage(windowOf(s), this->stageValues_);
}

std::string RenderManager::endShading()
{
  const bool fitted = this->programs_.shaders.endStage();
  this->frame_.endStage(this->frame_.route() == Route::Deferred ? "shading: the rest" : "shading");
  return this->hadOtherView_ ? "by another camera"
    : fitted                 ? ""
                             : "at another resolution than the receivers were drawn, and " +
      this->frame_.plan.picture.route.reason;
}

void RenderManager::compareSurfaces(const vtkRenderState* s)
{
  const SharedReceivers& shared = this->frame_.view->receivers.shared;
  const bool canCompare = shared.areShared() && samplesOfBoundFramebuffer() <= 1;
  if (this->frame_.ranks->isAny(!canCompare))
  {
    return;
  }
  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  std::vector<float> drawn;
  readDepths(static_cast<GLuint>(framebuffer), originOf(s), this->frame_.size, drawn);
  std::vector<float> nearest = drawn;
  this->frame_.ranks->reduceToLeast(nearest);
  std::int64_t others = 0;
  for (std::size_t pixel = 0; pixel < drawn.size(); ++pixel)
  {
    const bool isReceiver = shared.pixels().surface[pixel] != ReceiverPixels::notCovered;
    const bool isShown = drawn[pixel] == nearest[pixel] && drawn[pixel] < 1.0f;
    others += isReceiver && isShown && !shared.isOwn(pixel) ? 1 : 0;
  }
  this->report_.otherSurfaces = this->frame_.ranks->sum(others);
}

void RenderManager::endFrame(const vtkRenderState* s)
{
  Frame& frame = this->frame_;
  const PassPrograms& programs = this->programs_;
  this->collector_.props().endFrame(s->GetRenderer());
  frame.lights.endFrame();
  frame.counts.programCompiles =
    programs.library.compiles() + programs.shaders.rebuilds() - this->compilesBefore_;
  frame.counts.newPrograms =
    programs.library.compiles() + programs.shaders.newPrograms() - this->newProgramsBefore_;
  FrameTotals totals;
  totals.numbersByGeometryShaders = programs.shaders.numbersByGeometryShaders();
  totals.bytesOccluders = this->collector_.bytes() + this->patches_.bytes() +
    this->buffers_.bytes() + this->tracer_.bytesOfTable();
  totals.bytesBvh = this->tracer_.bytes() + this->transmittance_.bytesOfSheets();
  totals.bytesMaps =
    frame.lights.bytesOfMaps() + this->views_.bytesOfMaps() + this->transmittance_.bytes();
  totals.bytesImages = this->planner_.bytes();
  if (frame.route() != Route::Inline)
  {
    totals.bytesImages +=
      this->views_.bytesOfImages() + this->visibility_.bytesOfRays() + this->tracer_.bytesOfRays();
  }
  const bool isTimed = frame.wishes.timeBudget > 0.0 ||
    (frame.wishes.windowTime > 0.0 && frame.scene.picture.inSoftware);
  if (frame.plan.moves && isTimed)
  {
    glFinish(); // so that the frame's time is known
  }
  totals.wallMilliseconds = steadyMilliseconds() - frame.start;
  this->planner_.remember(
    totals.wallMilliseconds, frame.counts.newPrograms == 0 && frame.counts.bvhBuilds == 0);
  this->report_ = reportOf(frame, this->collector_, totals);
}

double RenderManager::progress() const
{
  double progress = this->frame_.counts.skyProgress;
  for (const CastingLight& casting : this->frame_.lights)
  {
    progress = std::min(progress, casting.counts.progress);
  }
  return progress;
}

void RenderManager::abandonFrame()
{
  this->programs_.shaders.endStage();
}

void RenderManager::setShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop)
{
  HookedSurface drawn;
  if (prop->IsA("vtkVolume"))
  {
    drawn.receives = vtkGnomonPropKeys::GetReceives(prop);
    drawn.translucent = true;
  }
  else
  {
    drawn = this->collector_.drawn(mapper, prop);
  }
  if (this->stageValues_.receiversStage && drawn.index >= 0)
  {
    TriangleNumbers& numbers = this->programs_.numbers;
    const DrawnSurface::Block& last =
      this->collector_.drawnSurfaces()[static_cast<std::size_t>(drawn.index)].blocks.back();
    const std::uint32_t primitives = last.firstPrimitive + last.primitiveCount;
    // The snapshot need not hold what shaders of a user's own draw. Of triangles that clipping
    // planes cut it holds pieces.
    const bool isCut = mapper->GetClippingPlanes() && mapper->GetNumberOfClippingPlanes() > 0;
    if (numbers.isNew(program, primitives) && !isCut && !hasOwnShaders(prop))
    {
      numbers.add(program, primitives, drawn.index);
    }
  }
  drawn.catches = this->frame_.scene.props.catcher && vtkGnomonPropKeys::GetShadowCatcher(prop);
  // The layers of the image route hold what is behind.
  drawn.translucent |= this->frame_.route() == Route::Image && this->collector_.isSeenThrough(prop);
  drawn.receives =
    drawn.receives && (!drawn.translucent || this->frame_.plan.picture.shadesPoints());
  if (!this->stageValues_.receiversStage &&
    !this->shadedView_->isShown(this->frame_.route() != Route::Inline))
  {
    this->hadOtherView_ = true;
    drawn.receives = false;
  }
  this->programs_.shaders.setParameters(program, drawn);
}

} // namespace gnomon
