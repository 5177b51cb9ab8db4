#include "plugin/frame/RenderManager.h"

#include "lights/Hash.h"
#include "plugin/frame/ReceiverDrawing.h"
#include "plugin/scene/ShownView.h"
#include "plugin/window/PictureTarget.h"
#include "shadowtech/base/GlState.h"

#include <vtkCamera.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon
{
namespace
{

vtkOpenGLRenderWindow* windowOf(const vtkRenderState* s)
{
  return vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
}

void hashLight(std::size_t& seed, const CastingLight& casting)
{
  hashCombine(seed, casting.light.sceneIndex);
  hashCombine(seed, casting.identity.hash);
}

/// Return a camera's view transformation and its angle.
std::array<double, 17> viewOf(vtkRenderer* renderer)
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  std::array<double, 17> view;
  std::copy_n(camera->GetModelViewTransformMatrix()->GetData(), 16, view.begin());
  view.back() = camera->GetViewAngle();
  return view;
}

/// True if shaders for one view are right in another. Visibility of the picture's pixels needs the
/// same angle, which passes compute again.
bool isSameView(const std::array<double, 17>& a, const std::array<double, 17>& b, Route route)
{
  return std::equal(a.begin(), a.end() - 1, b.begin()) &&
    (route == Route::Inline || std::abs(a.back() - b.back()) < 1e-6 * b.back());
}

/// Return a number that differs where lights differ in what decides their rays.
std::uint64_t hashOf(const CastingLights& lights)
{
  std::size_t seed = lights.size();
  for (const CastingLight& casting : lights)
  {
    hashLight(seed, casting);
    for (const std::string& value :
      valuesOf(casting.own->info(), SettingsOf::Estimator, casting.light))
    {
      hashCombine(seed, value);
    }
  }
  return seed;
}

} // namespace

//------------------------------------------------------------------------------
RenderManager::RenderManager(PassPrograms& programs)
  : programs_(programs)
{
}

//------------------------------------------------------------------------------
void RenderManager::beginFrame(const FrameWishes& wishes, Ranks* ranks)
{
  this->frame_.report = FrameReport{};
  this->receivers_.beginFrame();
  this->frame_.report.numbersChecked = std::exchange(this->checkedBefore_, 0);
  this->frame_.wishes = wishes;
  this->frame_.ranks = ranks;
  this->frame_.moves = false;
  this->frame_.mayRefine = false;
  this->frame_.wishes.isShared = ranks != nullptr;
  if (!wishes.keepVisibility)
  {
    this->visibility_.dropImages();
  }
  if (wishes.measureStages)
  {
    glFinish(); // what was pending before the frame is not the frame's
  }
  this->frame_.start = this->frame_.stageStart = steadyMilliseconds();
  const PassPrograms& programs = this->programs_;
  this->compilesBefore_ = programs.library.compiles() + programs.shaders.rebuilds();
  this->newProgramsBefore_ = programs.library.compiles() + programs.shaders.newPrograms();
}

//------------------------------------------------------------------------------
bool RenderManager::collectLights(
  vtkRenderer* renderer, const ShadowSettings& defaults, bool severalViews)
{
  Ranks* const ranks = this->frame_.ranks;
  this->frame_.view = &this->views_.of(renderer);
  this->frame_.severalViews = severalViews;
  this->frame_.lights.collect(
    renderer, defaults, this->frame_.wishes, this->frame_.view->techniques, this->frame_.report);
  if (ranks)
  {
    ranks->requireSame(hashOf(this->frame_.lights), "lights");
  }
  this->frame_.endStage("lights");
  if (this->frame_.lights.empty())
  {
    this->frame_.report.route = "none";
    this->frame_.report.routeReason = "no light casts a shadow";
    this->visibility_.dropImages(); // that of an earlier frame
  }
  return !this->frame_.lights.empty() || this->frame_.wishes.keepVisibility;
}

//------------------------------------------------------------------------------
void RenderManager::collectOccluders(const vtkRenderState* s)
{
  OtherProcesses others;
  if (Ranks* const ranks = this->frame_.ranks)
  {
    others.unite = [ranks](const Bounds& own) { return ranks->united(own); };
    others.gather = [ranks](const std::vector<GlyphCount>& own)
    {
      Ranks::Gathered<GlyphCount> all;
      ranks->gather(own, all);
      return all.elements;
    };
  }
  const SnapshotChange change =
    this->collector_.collect(s->GetRenderer(), this->frame_.wishes.smoothTerminators, others);
  const Occluders& occluders = this->collector_.occluders();
  FrameReport& report = this->frame_.report;
  this->frame_.lights.enter(occluders.frame, report);
  report.surfacesExtracted = change.extracted;
  report.surfacesRetransformed = change.retransformed;
  report.notes.insert(
    report.notes.end(), this->collector_.notes().begin(), this->collector_.notes().end());
  report.leftOut = this->collector_.leftOut();
  this->names_.clear();
  if (this->frame_.ranks || this->frame_.wishes.keepVisibility)
  {
    this->names_ = surfaceNames(s->GetRenderer(), this->collector_.records());
  }
  this->frame_.triangles = 0;
  for (const Surface& surface : occluders.surfaces)
  {
    const std::size_t instances = surface.centredFromSource.size();
    report.instances += instances;
    this->frame_.triangles += surface.triangleCount * std::max<std::size_t>(instances, 1);
  }
  report.triangles = this->frame_.triangles;
  report.droppedNonFinite = occluders.droppedNonFinite;
  report.droppedZeroArea = occluders.droppedZeroArea;
  this->frame_.size = sizeOf(s, this->frame_.wishes.reductionFactor);
  const ShownView shown = shownView(s->GetRenderer(), occluders.frame);
  this->frame_.camera = shown.camera;
  this->frame_.space = { shown.centredFromView, shown.camera.pixelSide(this->frame_.size) };
  this->stageValues_.space = this->frame_.space;
  this->stageValues_.viewFromVtkView = shown.viewFromVtkView;
  this->stageValues_.eyeView = shown.camera.eyeView();
  this->stageValues_.reductionFactor = this->frame_.wishes.reductionFactor;
  if (this->frame_.ranks)
  {
    std::size_t hash = 0;
    hashView(hash, this->frame_.camera, this->frame_.size);
    this->frame_.ranks->requireSame(hash, "cameras or sizes of the picture");
  }
  this->frame_.endStage("occluders");
}

//------------------------------------------------------------------------------
bool RenderManager::changes(const vtkRenderState* s)
{
  std::size_t shown = this->frame_.lights.size();
  for (const CastingLight& casting : this->frame_.lights)
  {
    hashLight(shown, casting);
  }
  hashView(shown, this->frame_.camera, this->frame_.size);
  hashCombine(shown, this->receivers_.shownProps(s));
  const Occluders& occluders = this->collector_.occluders();
  hashCombine(shown, occluders.topologyVersion);
  hashCombine(shown, occluders.positionsVersion);
  return std::exchange(this->frame_.view->shown, shown) != shown;
}

//------------------------------------------------------------------------------
bool RenderManager::chooseTechniques(bool moves, bool mayRefine)
{
  if (this->frame_.ranks)
  {
    return false; // all lights have rays
  }
  this->frame_.moves = moves;
  this->frame_.mayRefine = mayRefine;
  this->choice_.choose(
    [this](const CastingLight& casting, const ShadowLight& map, LightTechnique& technique)
    {
      LightReport ofMap; // the light's own is that of the technique that is chosen
      technique.updateMaps(map, this->mapStage(casting), ofMap);
    });
  this->frame_.endStage("choice");
  return moves &&
    std::any_of(this->frame_.lights.begin(), this->frame_.lights.end(),
      [](const CastingLight& casting) { return casting.asked; });
}

//------------------------------------------------------------------------------
/// Plan how visibility reaches the picture, from what there is.
PicturePlan RenderManager::planOfPicture(const vtkRenderState* s, bool drawnPlainly) const
{
  vtkRenderer* const renderer = s->GetRenderer();
  std::vector<PictureLight> lights;
  for (const CastingLight& casting : this->frame_.lights)
  {
    lights.push_back({ casting.light, casting.own->info() });
  }
  PictureFacts facts;
  facts.samples = samplesOfBoundFramebuffer();
  facts.drawsMaps = canDrawMaps();
  facts.drawnPlainly =
    drawnPlainly && !renderer->GetUseSSAO() && !renderer->GetUseHiddenLineRemoval();
  facts.seenThrough = this->collector_.anySeenThrough();
  facts.translucent = this->collector_.translucentReceivers() > 0;
  PropFacts props;
  if (whyNotDeferred(lights, this->frame_.wishes, facts).empty())
  {
    facts.whyNoDeferred = DeferredPicture::whyUnsupported();
    props = { anyPropHasOwnShaders(s), hasPartsOfBothKinds(s) };
  }
  return planPicture(lights, this->frame_.wishes, facts, props);
}

//------------------------------------------------------------------------------
bool RenderManager::chooseRoute(const vtkRenderState* s, bool drawnPlainly)
{
  FrameReport& report = this->frame_.report;
  const PicturePlan plan = this->planOfPicture(s, drawnPlainly);
  this->frame_.route = plan.route.route;
  this->shadesTranslucent_ = plan.shadesTranslucent;
  report.route = nameOf(plan.route.route);
  report.routeReason = plan.route.reason;
  report.notes.insert(report.notes.end(), plan.notes.begin(), plan.notes.end());

  std::vector<ShadedLight> shaded;
  for (CastingLight& casting : this->frame_.lights)
  {
    casting.own->chooseFit(
      casting.light, plan.route.route, plan.shadesTranslucent, reportOf(report, casting.light));
    const PointwiseTechnique* pointwise =
      this->frame_.lights.pointwiseOn(casting, plan.route.route, plan.shadesTranslucent);
    casting.shadesAtPoints = pointwise != nullptr;
    shaded.push_back({ casting.light, casting.channels, casting.layer, casting.bit, pointwise });
  }
  bool namesTriangles = true;
  if (this->frame_.route == Route::Deferred)
  {
    this->receivers_.findStale(s);
    this->receivers_.countRest();
    namesTriangles = this->receivers_.namesTriangles();
  }
  this->programs_.shaders.configure(
    { this->frame_.route, this->receivers_.readsPoints(), samplesOfBoundFramebuffer() > 1,
      namesTriangles, this->stageValues_.viewFromVtkView == glm::dmat4(1.0),
      this->collector_.anySeenThrough() },
    shaded);
  return plan.isAsTold;
}

//------------------------------------------------------------------------------
void RenderManager::makeRoomForLayers()
{
  VisibilityLayers& layers = this->frame_.view->layers;
  const glm::ivec2& size = this->frame_.size;
  const int count = this->frame_.lights.layers();
  const int bits = this->frame_.lights.bits();
  if (count + bits > 0 && !layers.have(size.x, size.y, count, bits))
  {
    this->frame_.view->visibility.clear();
    layers.resize(size.x, size.y, count, bits);
  }
  this->stageValues_.layers = { GL_TEXTURE_2D_ARRAY, layers.texture() };
  this->stageValues_.bits = { GL_TEXTURE_2D, layers.textureOfBits() };
  this->stageValues_.layersSize = size;
}

//------------------------------------------------------------------------------
void RenderManager::updateReceivers(const vtkRenderState* s, vtkObjectBase* pass)
{
  this->makeRoomForLayers();
  this->receivers_.update(s, pass);
  this->visibility_.findStale();
}

//------------------------------------------------------------------------------
/// Return the inputs of a light's maps. A moving picture that leaves the technique to the pass
/// would stand still while an optional map is baked.
MapStage RenderManager::mapStage(const CastingLight& casting)
{
  const bool bakesOptional = !(casting.asked && this->frame_.moves);
  return { this->frame_.camera, this->collector_.occluders(), this->buffers_,
    this->programs_.library, this->frame_.view->receivers.target,
    this->frame_.space.centredFromView, this->frame_.view->receivers.number, bakesOptional,
    this->frame_.report };
}

//------------------------------------------------------------------------------
void RenderManager::bakeMaps()
{
  for (CastingLight& casting : this->frame_.lights)
  {
    const MapStage stage = this->mapStage(casting);
    LightReport& report = reportOf(this->frame_.report, casting.light);
    const bool shadesByOwn = casting.shadesAtPoints && casting.own->info().isPointwise();
    if (this->frame_.route == Route::Inline || casting.isStale || shadesByOwn)
    {
      casting.own->updateMaps(casting.light, stage, report);
    }
    if (casting.plain && casting.shadesAtPoints)
    {
      casting.plain->updateMaps(casting.light, stage, report);
    }
  }
  this->frame_.endStage("maps");
}

//------------------------------------------------------------------------------
void RenderManager::beginOpaque(const vtkRenderState* s)
{
  this->makeRoomForLayers();
  this->receivers_.begin(s);
  this->frame_.view->receivers.deferred.attach(this->receivers_.areDue());
}

//------------------------------------------------------------------------------
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
    this->checkedBefore_ = this->frame_.report.numbersChecked;
    throw FrameMustBeDrawnAgain();
  }
  this->receivers_.take();
  this->visibility_.findStale();
}

//------------------------------------------------------------------------------
void RenderManager::drawShadows()
{
  this->frame_.view->receivers.deferred.darken(
    this->frame_.lights.bits() > 0 ? this->stageValues_.bits : this->stageValues_.layers,
    this->programs_.library);
  this->frame_.endStage("shading: shadows");
}

//------------------------------------------------------------------------------
void RenderManager::beginShading(const vtkRenderState* s)
{
  this->stageValues_.receiversStage = false;
  this->shading_ = s->GetRenderer();
  this->shadingView_ = viewOf(this->shading_);
  this->hadOtherView_ = false;
  this->programs_.shaders.beginStage(windowOf(s), this->stageValues_);
}

//------------------------------------------------------------------------------
std::string RenderManager::endShading()
{
  const bool fitted = this->programs_.shaders.endStage();
  this->frame_.endStage(this->frame_.route == Route::Deferred ? "shading: the rest" : "shading");
  return this->hadOtherView_ ? "by another camera"
    : fitted
    ? ""
    : "at another resolution than the receivers were drawn, and " + this->frame_.report.routeReason;
}

//------------------------------------------------------------------------------
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
  this->frame_.report.otherSurfaces = this->frame_.ranks->sum(others);
}

//------------------------------------------------------------------------------
void RenderManager::endFrame(const vtkRenderState* s)
{
  this->receivers_.endFrame(s->GetRenderer());
  FrameReport& report = this->frame_.report;
  const PassPrograms& programs = this->programs_;
  report.numbersByGeometryShaders = programs.shaders.numbersByGeometryShaders();
  report.programCompiles =
    programs.library.compiles() + programs.shaders.rebuilds() - this->compilesBefore_;
  report.newPrograms =
    programs.library.compiles() + programs.shaders.newPrograms() - this->newProgramsBefore_;
  report.bytesOccluders = this->collector_.bytes() + this->patches_.bytes() +
    this->buffers_.bytes() + this->tracer_.bytesOfTable();
  report.bytesBvh = this->tracer_.bytes();
  this->frame_.lights.endFrame();
  report.bytesMaps = this->frame_.lights.bytesOfMaps() + this->views_.bytesOfMaps();
  if (this->frame_.route != Route::Inline)
  {
    report.bytesImages =
      this->views_.bytesOfImages() + this->visibility_.bytesOfRays() + this->tracer_.bytesOfRays();
  }
  report.bytesImages += this->choice_.bytes();
  if (this->frame_.moves && this->frame_.wishes.timeBudget > 0.0)
  {
    glFinish(); // so that the frame's time is known
  }
  if (const Ranks* const ranks = this->frame_.ranks)
  {
    report.processes = ranks->count();
    report.bytesShared = static_cast<std::int64_t>(ranks->bytesShared());
    if (const SharedReceivers& shared = this->frame_.view->receivers.shared; shared.areShared())
    {
      report.ownReceivers = static_cast<std::int64_t>(shared.ownCount());
      report.depthTies = static_cast<std::int64_t>(shared.ties());
    }
  }
  report.wallMilliseconds = steadyMilliseconds() - this->frame_.start;
  this->choice_.endFrame(report.wallMilliseconds, report.newPrograms == 0 && report.bvhBuilds == 0);
}

//------------------------------------------------------------------------------
double RenderManager::progress() const
{
  double progress = 1.0;
  for (const LightReport& light : this->frame_.report.lights)
  {
    progress = std::min(progress, light.progress);
  }
  return progress;
}

//------------------------------------------------------------------------------
void RenderManager::abandonFrame()
{
  this->programs_.shaders.endStage();
}

//------------------------------------------------------------------------------
void RenderManager::setShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop)
{
  HookedSurface drawn = this->collector_.drawn(mapper, prop);
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
  // The layers of the image route hold what is behind.
  drawn.translucent |= this->frame_.route == Route::Image && this->collector_.isSeenThrough(prop);
  drawn.receives = drawn.receives && (!drawn.translucent || this->shadesTranslucent_);
  if (!this->stageValues_.receiversStage &&
    !isSameView(viewOf(this->shading_), this->shadingView_, this->frame_.route))
  {
    this->hadOtherView_ = true;
    drawn.receives = false;
  }
  this->programs_.shaders.setParameters(program, drawn);
}

} // namespace gnomon
