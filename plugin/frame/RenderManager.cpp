#include "plugin/frame/RenderManager.h"

#include "plugin/frame/KeptVisibility.h"
#include "plugin/frame/ReceiverDrawing.h"
#include "plugin/scene/ShownView.h"
#include "plugin/window/PictureTarget.h"
#include "shadowtech/exact/CellTarget.h"
#include "shadowtech/tracing/GpuTracer.h"
#include "shadowtech/tracing/RefinementSettings.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace gnomon
{
namespace
{

/// What draws, by the name that OpenGL gives it.
std::string rendererName()
{
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "";
}

vtkOpenGLRenderWindow* windowOf(const vtkRenderState* s)
{
  return vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
}

///@{
/// Parts of a visibility's key.
constexpr const char* propsPart = "the props in view";
constexpr const char* snapshotPart = "the snapshot";
///@}

/// Where a light is, and what it is.
auto placeOf(const ShadowLight& light)
{
  const auto box = [](const LightBox& of)
  { return std::tuple(of.width, of.height, of.depth, of.upWorld); };
  const auto texture = [](const PlacedTexture& of)
  { return std::tuple(of.texture, of.pictureFromWorld); };
  return std::tuple(light.kind, light.positionWorld, light.directionWorld, light.coneAngleDegrees,
    light.area, light.box ? std::optional(box(*light.box)) : std::nullopt,
    light.texture ? std::optional(texture(*light.texture)) : std::nullopt);
}

/// How many samples an area light has in this frame.
/// @param before in the frame before; 0 where that showed something else
int samplesOf(const CastingLight& casting, int before)
{
  const bool refines = casting.own.info().has(refinementSettings()) && casting.light.area;
  return refines ? samplesOfStep(casting.light, before) : casting.light.lightSamples;
}

/// Whether parts of a key whose change leaves some tiles as they are, of all that changed.
bool leavesTiles(const std::set<std::string>& changedParts)
{
  return std::all_of(changedParts.begin(), changedParts.end(),
    [](const std::string& name) { return name == propsPart || name == snapshotPart; });
}

/// How many pixels are of each class.
std::vector<ClassCount> countClasses(
  const std::vector<PixelClass>& classes, const std::vector<std::uint8_t>& ofPixels)
{
  std::vector<ClassCount> counts;
  for (const PixelClass& pixelClass : classes)
  {
    counts.push_back({ pixelClass.name, 0 });
  }
  for (const std::uint8_t pixelClass : ofPixels)
  {
    ++counts[pixelClass].pixels;
  }
  return counts;
}

} // namespace

//------------------------------------------------------------------------------
RenderManager::RenderManager(PassPrograms& programs)
  : programs_(programs)
{
}

//------------------------------------------------------------------------------
void RenderManager::beginFrame(const FrameWishes& wishes)
{
  this->report_ = FrameReport{};
  this->wishes_ = wishes;
  if (!wishes.keepVisibility)
  {
    this->dropVisibility();
  }
  if (wishes.measureStages)
  {
    glFinish(); // what was pending before the frame is not the frame's
  }
  this->frameStart_ = this->stageStart_ = steadyMilliseconds();
  this->compilesBefore_ = this->programs_.library.compiles() + this->programs_.shaders.rebuilds();
}

//------------------------------------------------------------------------------
void RenderManager::endStageClock(const std::string& name)
{
  if (this->wishes_.measureStages)
  {
    glFinish();
    this->report_.stages.push_back({ name, steadyMilliseconds() - this->stageStart_ });
    this->stageStart_ = steadyMilliseconds();
  }
}

//------------------------------------------------------------------------------
/// Says in the report whether a value was reused.
void RenderManager::tellReuse(const std::string& value, const std::string& changes)
{
  this->report_.values.push_back({ value, changes.empty(), changes });
}

//------------------------------------------------------------------------------
bool RenderManager::collectLights(
  vtkRenderer* renderer, const ShadowSettings& defaults, bool severalViews)
{
  this->view_ = &this->views_.of(renderer);
  this->severalViews_ = severalViews;
  this->lights_.collect(renderer, defaults, this->view_->techniques, this->report_);
  this->endStageClock("lights");
  if (this->lights_.empty())
  {
    this->report_.route = "none";
    this->report_.routeReason = "no light casts a shadow";
    this->dropVisibility(); // that of an earlier frame
  }
  return !this->lights_.empty() || this->wishes_.keepVisibility;
}

//------------------------------------------------------------------------------
void RenderManager::collectOccluders(const vtkRenderState* s)
{
  const SnapshotChange change =
    this->collector_.collect(s->GetRenderer(), this->wishes_.smoothTerminators);
  const Occluders& occluders = this->collector_.occluders();
  this->report_.surfacesExtracted = change.extracted;
  this->report_.surfacesRetransformed = change.retransformed;
  this->report_.notes.insert(
    this->report_.notes.end(), this->collector_.notes().begin(), this->collector_.notes().end());
  this->report_.leftOut = this->collector_.leftOut();
  for (const Surface& surface : occluders.surfaces)
  {
    const std::size_t instances = surface.centredFromSource.size();
    this->report_.instances += instances;
    this->report_.triangles += surface.triangleCount * std::max<std::size_t>(instances, 1);
  }
  this->report_.droppedNonFinite = occluders.droppedNonFinite;
  this->report_.droppedZeroArea = occluders.droppedZeroArea;
  this->size_ = sizeOf(s);
  this->camera_ = cameraOf(s->GetRenderer(), occluders.centreWorld);
  this->stageValues_.space = { centredFromView(s->GetRenderer(), occluders.centreWorld),
    this->camera_.pixelSide(this->size_) };
  this->endStageClock("occluders");
}

//------------------------------------------------------------------------------
/// Why a frame cannot be drawn before its visibility is known, as a clause; empty if it can.
std::string RenderManager::whyNotDeferred(const vtkRenderState* s, bool drawnPlainly) const
{
  if (this->lights_.size() != 1)
  {
    return "the picture is drawn without one light's shadows, and " +
      std::to_string(this->lights_.size()) + " lights cast";
  }
  const CastingLight& casting = *this->lights_.begin();
  if (!isOnCpu(casting) || !casting.own.info().exact || casting.light.area)
  {
    return "'" + casting.light.technique + "' may leave pixels between light and shadow";
  }
  if (samplesOfBoundFramebuffer() > 1)
  {
    return "pixels have several samples";
  }
  vtkRenderer* renderer = s->GetRenderer();
  if (!drawnPlainly || renderer->GetUseSSAO() || renderer->GetUseHiddenLineRemoval())
  {
    return "a render pass draws the props in its own way";
  }
  if (anyPropHasOwnShaders(s))
  {
    return "a prop may have shaders of its own, which need not light twice";
  }
  if (std::any_of(s->GetPropArray(), s->GetPropArray() + s->GetPropArrayCount(),
        [](vtkProp* prop) { return drawnByPasses(prop) == ByPasses::Some; }))
  {
    return "an assembly has parts that passes cannot reach";
  }
  return DeferredPicture::whyUnsupported();
}

//------------------------------------------------------------------------------
bool RenderManager::chooseRoute(const vtkRenderState* s, bool drawnPlainly)
{
  const int samples = samplesOfBoundFramebuffer();
  RouteNeeds needs;
  needs.keepVisibility = this->wishes_.keepVisibility;
  needs.lights = this->lights_.size();
  for (const CastingLight& casting : this->lights_)
  {
    if (!casting.own.info().isPointwise())
    {
      needs.screenTechnique = casting.light.technique;
    }
    needs.headlightOnSamples |= casting.light.isHeadlight && samples > 1;
    if (casting.own.info().isSlow && samples <= 1)
    {
      needs.slowTechnique = casting.light.technique;
    }
  }
  needs.whyNotDeferred = this->whyNotDeferred(s, drawnPlainly);
  const std::string& screenTechnique = needs.screenTechnique;
  const RouteChoice choice = gnomon::chooseRoute(this->wishes_.route, needs);
  this->route_ = choice.route;
  this->report_.route = nameOf(choice.route);
  this->report_.routeReason = choice.reason;

  const bool askTranslucent = this->collector_.translucentReceivers() > 0;
  const bool fewLights = this->route_ == Route::Inline || this->lights_.size() <= mostInlineLights;
  const bool translucentReceivers = askTranslucent && fewLights && canDrawMaps();
  this->shadesTranslucent_ = translucentReceivers;
  if (askTranslucent && !translucentReceivers)
  {
    this->report_.notes.push_back(!fewLights
        ? "translucent surfaces show no shadows of " + std::to_string(this->lights_.size()) +
          " lights; " + std::to_string(mostInlineLights) + " are the most"
        : "translucent surfaces show no shadows: their maps take OpenGL 4.3");
  }
  if (!screenTechnique.empty() && translucentReceivers)
  {
    this->report_.notes.push_back("translucent surfaces show the plain shadow map ('" +
      std::string(plainTechnique) + "') of lights with '" + screenTechnique + "'");
  }
  if (this->route_ == Route::Image && samples > 1)
  {
    this->report_.notes.push_back("The window has " + std::to_string(samples) +
      " samples per pixel, and the image route one visibility, that of the surface at the pixel's "
      "centre: what covers other samples has that of the nearest surface at a centre around.");
  }

  std::vector<ShadedLight> shaded;
  for (CastingLight& casting : this->lights_)
  {
    casting.own.chooseFit(
      casting.light, this->route_, translucentReceivers, reportOf(this->report_, casting.light));
    const PointwiseTechnique* pointwise = casting.pointwiseOn(this->route_, translucentReceivers);
    casting.shadesAtPoints = pointwise != nullptr;
    shaded.push_back({ casting.light, casting.channels, casting.layer, casting.bit, pointwise });
  }
  bool namesTriangles = true;
  if (this->route_ == Route::Deferred)
  {
    this->findStaleReceivers(s);
    namesTriangles = this->namesTriangles();
  }
  this->programs_.shaders.configure(
    { this->route_, this->readsPoints(), samples > 1, namesTriangles }, shaded);
  return (this->wishes_.route != RouteWish::Inline || screenTechnique.empty()) &&
    (this->wishes_.route != RouteWish::Deferred || needs.whyNotDeferred.empty());
}

//------------------------------------------------------------------------------
/// True if shaders of the deferred route write triangle numbers. On llvmpipe these cost 25 ns a
/// triangle or more, even where no image takes them. Switching them off makes VTK rebuild shaders,
/// which costs some 0.2 ms a surface. So it waits until receivers rest, and for scenes where eight
/// frames pay for it.
bool RenderManager::namesTriangles()
{
  constexpr int patience = 3; // frames
  constexpr std::size_t leastTriangles = 1000;
  this->restingFrames_ = this->receiversDue_ ? 0 : this->restingFrames_ + 1;
  return this->restingFrames_ < patience || this->severalViews_ ||
    this->report_.triangles < leastTriangles * this->collector_.occluders().surfaces.size();
}

//------------------------------------------------------------------------------
/// Whether anything on the GPU asks for the receivers' points.
bool RenderManager::readsPoints() const
{
  return this->lights_.anyTechnique(
    [](const TechniqueInfo& info) { return info.evaluation != Evaluation::ScreenCpu; });
}

//------------------------------------------------------------------------------
/// The key of the picture of the receivers.
ValueKey RenderManager::receiversKey(const vtkRenderState* s) const
{
  std::size_t view = 0;
  hashView(view, this->camera_, this->size_);
  const Occluders& occluders = this->collector_.occluders();
  ValueKey key;
  key.add("the camera", view);
  key.add(propsPart, hashOfShownProps(s));
  key.add(snapshotPart, std::pair(occluders.topologyVersion, occluders.positionsVersion));
  key.add("what is read of receivers", this->readsPoints());
  key.add("where they are drawn", std::tuple(this->route_, originOf(s)));
  return key;
}

//------------------------------------------------------------------------------
/// The key of a light's visibility; its maps follow from the same parts.
ValueKey RenderManager::visibilityKey(const CastingLight& casting) const
{
  const TechniqueInfo& info = casting.own.info();
  ValueKey key = *this->view_->receivers.key;
  key.add("the light", placeOf(casting.light));
  key.add("its technique", std::pair(&casting.own.estimator(), casting.light.fittedToReceivers));
  key.add("its settings", valuesOf(info, SettingsOf::Estimator, casting.light));
  key.add("its layer", std::pair(casting.layer, casting.bit));
  if (info.evaluation == Evaluation::ScreenCpu)
  {
    key.add("the tracer", this->wishes_.tracer);
  }
  if (info.conservativeMap)
  {
    key.add("the rasterizer", this->wishes_.rasterizer); // which the report names
  }
  return key;
}

//------------------------------------------------------------------------------
void RenderManager::makeRoomForLayers()
{
  VisibilityLayers& layers = this->view_->layers;
  const int count = this->lights_.layers();
  const int bits = this->lights_.bits();
  if (count + bits > 0 && !layers.have(this->size_.x, this->size_.y, count, bits))
  {
    this->view_->visibility.clear();
    layers.resize(this->size_.x, this->size_.y, count, bits);
  }
  this->stageValues_.layers = { GL_TEXTURE_2D_ARRAY, layers.texture() };
  this->stageValues_.bits = { GL_TEXTURE_2D, layers.bits() };
  this->stageValues_.layersSize = this->size_;
}

//------------------------------------------------------------------------------
/// Compares the receivers' key with the cached one. If it differs, the cached receivers are dropped
/// and new ones are due.
void RenderManager::findStaleReceivers(const vtkRenderState* s)
{
  ReceiversValue& value = this->view_->receivers;
  ValueKey key = this->receiversKey(s);
  const std::string changes = value.key ? key.changesFrom(*value.key) : "there were none";
  this->tellReuse("receivers", changes);
  this->receiversDue_.reset();
  if (!changes.empty())
  {
    this->receiversDue_ = std::move(key);
    value.key.reset(); // in case of an error
    value.onCpu.reset();
    value.framesTraced = 0;
  }
}

//------------------------------------------------------------------------------
/// Caches the receivers that were drawn, if they were due.
void RenderManager::takeReceivers()
{
  if (this->receiversDue_)
  {
    ReceiversValue& value = this->view_->receivers;
    if (value.drawnSurfaces != this->collector_.drawnSurfaces())
    {
      value.drawnSurfaces = this->collector_.drawnSurfaces();
      value.numberOfImages = 0; // the fragments that were read have other names
    }
    value.key = std::move(this->receiversDue_);
    value.number = ++this->receiversNumbered_;
    ++this->report_.receiversDrawn;
  }
  this->findStaleVisibility();
}

//------------------------------------------------------------------------------
void RenderManager::updateReceivers(const vtkRenderState* s, vtkObjectBase* pass)
{
  this->makeRoomForLayers();
  this->findStaleReceivers(s);
  if (this->receiversDue_)
  {
    this->stageValues_.receiversStage = true;
    this->programs_.shaders.beginStage(windowOf(s), this->stageValues_);
    drawReceivers(s, pass, this->size_, this->readsPoints(), this->view_->receivers.target);
    this->programs_.shaders.endStage();
  }
  this->takeReceivers();
  this->stageValues_.depths = { GL_TEXTURE_2D, this->view_->receivers.target.depths() };
  this->endStageClock("receivers");
}

//------------------------------------------------------------------------------
/// Says of each light whether its visibility is computed in this frame, or reused as it is.
void RenderManager::findStaleVisibility()
{
  std::vector<VisibilityValue>& values = this->view_->visibility;
  values.resize(this->lights_.size());
  auto value = values.begin();
  for (CastingLight& casting : this->lights_)
  {
    const ValueKey key = this->visibilityKey(casting);
    std::string changes = value->key ? key.changesFrom(*value->key) : "there was none";
    casting.mayKeepTiles = value->key && leavesTiles(key.changedParts(*value->key));
    value->samples = changes.empty() ? value->samples : 0;
    if (changes.empty() && value->report.progress < 1.0)
    {
      changes = "more of the light's points";
    }
    if (changes.empty() && this->classifies() && !value->classified)
    {
      changes = "how pixels were decided is asked for";
    }
    this->tellReuse("visibility of " + nameOf(casting.light), changes);
    casting.isStale = !changes.empty();
    if (!casting.isStale)
    {
      LightReport& report = reportOf(this->report_, casting.light);
      report = value->report;
      report.sceneIndex = casting.light.sceneIndex;
    }
    else
    {
      value->key.reset(); // in case of an error
    }
    ++value;
  }
}

//------------------------------------------------------------------------------
void RenderManager::bakeMaps()
{
  RasterizerChoice rasterizer;
  if (this->lights_.anyTechnique([](const TechniqueInfo& info) { return info.conservativeMap; }))
  {
    rasterizer = chooseRasterizer(this->wishes_.rasterizer, CellTarget::whyUnsupported());
  }
  const MapStage stage{ this->camera_, this->collector_.occluders(), this->buffers_, rasterizer,
    this->programs_.library, this->view_->receivers.target,
    this->stageValues_.space.centredFromView, this->view_->receivers.number, this->report_ };
  for (CastingLight& casting : this->lights_)
  {
    LightReport& report = reportOf(this->report_, casting.light);
    const bool shadesByOwn = casting.shadesAtPoints && !casting.plain;
    if (this->route_ == Route::Inline || casting.isStale || shadesByOwn)
    {
      casting.own.updateMaps(casting.light, stage, report);
    }
    if (casting.plain)
    {
      casting.plain->updateMaps(casting.light, stage, report);
    }
  }
  this->endStageClock("maps");
}

//------------------------------------------------------------------------------
/// Brings a tracer up to date with the snapshot.
void RenderManager::updateTracer()
{
  const TracerChoice choice =
    chooseTracer(this->wishes_.tracer, GpuTracer::whyUnsupported(), rendererName());
  const ShadowTracer::Update update = this->tracer_.update(choice, this->collector_.occluders());
  this->report_.bvhBuilds = update.builds;
  this->report_.bvhRefits = update.refits;
  this->endStageClock("visibility: build");
}

//------------------------------------------------------------------------------
/// States in the report which tracer the frame's visibility is from, and why.
void RenderManager::tellTracer()
{
  this->report_.tracer = this->tracer_.taken().gpu ? "gpu" : "embree";
  this->report_.tracerReason = this->tracer_.taken().reason;
  if (!this->tracer_.gpuFailure().empty())
  {
    this->report_.notes.push_back(
      "Embree traces rays, as tracing on the GPU failed: " + this->tracer_.gpuFailure() + ".");
  }
}

//------------------------------------------------------------------------------
/// The view's receivers on the CPU, read back once.
Receivers& RenderManager::receiversOnCpu()
{
  ReceiversValue& value = this->view_->receivers;
  // Where no technique traces, the tracer is not updated, and may hold an older snapshot.
  const FreeSegments* const freeSegments =
    this->tracesOnCpu() ? this->tracer_.freeSegments() : nullptr;
  if (!value.onCpu || value.onCpu->freeSegments() != freeSegments)
  {
    if (value.numberOfImages != value.number)
    {
      value.fragmentsBefore.swap(value.images.fragments);
      value.numberBefore = std::exchange(value.numberOfImages, value.number);
    }
    value.images.rays = pixelRays(this->camera_.clipFromView,
      this->stageValues_.space.centredFromView, this->size_.x, this->size_.y);
    if (this->route_ == Route::Deferred)
    {
      value.deferred.read(value.images);
    }
    else
    {
      value.target.read(value.images);
    }
    value.onCpu.emplace(
      value.images, value.drawnSurfaces, this->collector_.occluders(), value.pixels, freeSegments);
    this->endStageClock("visibility: read receivers");
  }
  return *value.onCpu;
}

//------------------------------------------------------------------------------
/// Stores receivers that lights move over, which takes half as long as tracing from them. From then
/// on a light's image takes a fifth less.
void RenderManager::storeResting()
{
  constexpr int patience = 2; // frames
  if (++this->view_->receivers.framesTraced > patience)
  {
    this->receiversOnCpu().all();
  }
}

//------------------------------------------------------------------------------
/// Whether any light's technique does.
bool RenderManager::tracesOnCpu() const
{
  return std::any_of(this->lights_.begin(), this->lights_.end(), isOnCpu);
}

//------------------------------------------------------------------------------
void RenderManager::computeVisibility()
{
  if (std::any_of(this->lights_.begin(), this->lights_.end(),
        [](const CastingLight& casting) { return casting.isStale && isOnCpu(casting); }))
  {
    this->updateTracer();
    this->storeResting();
  }
  if (this->tracesOnCpu())
  {
    this->tellTracer();
  }
  auto value = this->view_->visibility.begin();
  for (CastingLight& casting : this->lights_)
  {
    if (casting.isStale)
    {
      LightReport& report = reportOf(this->report_, casting.light);
      value->classified = this->classifies();
      this->fillLayers(casting, *value, report);
      const std::vector<PixelClass>& named = casting.own.info().classes;
      if (value->classified && !named.empty())
      {
        report.classes = countClasses(named, value->classes);
      }
      value->key = this->visibilityKey(casting);
      value->report = report;
      ++this->report_.visibilityComputed;
      this->report_.raysTraced += report.rays;
    }
    this->report_.notes.insert(this->report_.notes.end(), value->notes.begin(), value->notes.end());
    ++value;
  }
  this->view_->layers.uploadBits();
  const bool isKept = this->report_.visibilityComputed == 0 && this->keptOf_ == this->view_ &&
    !this->visibility_.visibility.empty();
  if (this->wishes_.keepVisibility && !isKept)
  {
    this->visibility_ = keepVisibility(this->lights_, this->view_->visibility, this->view_->layers,
      this->receiversOnCpu().all(), this->collector_.occluders().centreWorld);
    this->keptOf_ = this->view_;
  }
}

//------------------------------------------------------------------------------
void RenderManager::dropVisibility()
{
  this->visibility_ = VisibilityImages{};
  this->keptOf_ = nullptr;
}

//------------------------------------------------------------------------------
/// Begins a light's image where tiles of the one before may stay.
/// @param traced the light, with as many samples as the image has
/// @return null where all tiles are computed
TracedTiles* RenderManager::beginTiles(
  const CastingLight& casting, const ShadowLight& traced, VisibilityValue& value)
{
  const Occluders& occluders = this->collector_.occluders();
  const ReceiversValue& receivers = this->view_->receivers;
  const TechniqueInfo& info = casting.own.info();
  const bool isDecidedByMap = info.conservativeMap && casting.own.usesMap();
  if (!info.exact || isDecidedByMap || edgeSamplesOf(casting) > 1 || this->tracer_.taken().gpu ||
    occluders.surfaces.size() < 2)
  {
    value.classes.clear();
    value.tiles.forget();
    value.onCpu = {};
    return nullptr;
  }
  const bool isFollowed = casting.mayKeepTiles && value.receivers == receivers.numberBefore &&
    (!value.classified || !value.classes.empty());
  if (!isFollowed || !value.classified)
  {
    value.classes.clear();
  }
  value.tiles.begin(
    occluders, traced, receivers.images, isFollowed ? &receivers.fragmentsBefore : nullptr);
  value.receivers = receivers.number;
  return &value.tiles;
}

//------------------------------------------------------------------------------
/// Has a light's technique fill its layers.
/// @param value whose classes, if they are asked for, and notes are filled
void RenderManager::fillLayers(CastingLight& casting, VisibilityValue& value, LightReport& report)
{
  value.notes.clear();
  if (!isOnCpu(casting))
  {
    value.classes.clear();
  }
  std::vector<std::uint8_t>* const classes = value.classified ? &value.classes : nullptr;
  const ShadowLight& light = casting.light;
  const Occluders& occluders = this->collector_.occluders();
  const ReceiversValue& receivers = this->view_->receivers;
  VisibilityLayers& layers = this->view_->layers;
  if (auto* pointwise = casting.own.as<PointwiseTechnique>())
  {
    layers.estimate(casting.layer, *pointwise, light, receivers.target, this->stageValues_.space,
      this->programs_.library, casting.own.info().classes.empty() ? nullptr : classes);
    this->endStageClock("visibility: estimate");
  }
  else if (auto* onGpu = casting.own.as<GpuScreenTechnique>())
  {
    this->buffers_.update(occluders);
    namingLight(light,
      [&]
      {
        onGpu->drawVisibility(
          { light, casting.own.fitting(), this->camera_, this->stageValues_.space, occluders,
            this->buffers_, receivers.target, this->view_->receivers.number,
            receivers.drawnSurfaces, layers, casting.layer, this->severalViews_,
            this->programs_.library, classes != nullptr, classes, value.notes,
            this->report_.mapBakes },
          report);
      });
    this->endStageClock("visibility: draw");
  }
  else
  {
    auto& technique = *casting.own.as<CpuScreenTechnique>();
    const std::size_t edgeSamples = edgeSamplesOf(casting);
    std::vector<std::uint8_t> classesForEdges;
    ShadowLight traced = light;
    traced.lightSamples = samplesOf(casting, value.samples);
    Receivers& onCpu = this->receiversOnCpu();
    TracedTiles* const tiles = this->beginTiles(casting, traced, value);
    std::vector<float>& visibility = tiles ? value.onCpu : this->visibilityOnCpu_;
    const ScreenInput input{ traced, casting.own.fitting(), occluders, onCpu,
      this->tracer_.tracer(), casting.own.usesMap(),
      classes || edgeSamples == 1 ? classes : &classesForEdges, tiles, this->report_.mapBakes };
    namingLight(light, [&] { technique.computeVisibility(input, visibility, report); });
    value.samples = traced.lightSamples;
    report.progress = static_cast<double>(traced.lightSamples) / light.lightSamples;
    this->endStageClock("visibility: trace");
    if (edgeSamples > 1)
    {
      namingLight(light,
        [&] {
          this->edges_.smooth(technique, input, *input.classes, edgeSamples, visibility, report);
        });
      this->endStageClock("visibility: edges");
    }
    casting.bit == noBit ? layers.upload(casting.layer, visibility)
                         : layers.fillBit(casting.bit, visibility);
    if (this->route_ == Route::Deferred)
    {
      this->view_->receivers.deferred.keepShadows(visibility);
    }
    this->endStageClock("visibility: upload");
  }
}

//------------------------------------------------------------------------------
void RenderManager::beginOpaque(const vtkRenderState* s)
{
  this->makeRoomForLayers();
  this->stageValues_.receiversStage = true;
  this->programs_.shaders.beginStage(windowOf(s), this->stageValues_);
  this->view_->receivers.deferred.attach(this->receiversDue_.has_value());
}

//------------------------------------------------------------------------------
void RenderManager::endOpaque()
{
  this->programs_.shaders.endStage();
  this->view_->receivers.deferred.detach();
  if (this->view_->receivers.deferred.size() != this->size_)
  {
    throw std::runtime_error("it is drawn at another size than its viewport has");
  }
  this->endStageClock("shading: lit and in shadow");
  this->takeReceivers();
}

//------------------------------------------------------------------------------
void RenderManager::drawShadows()
{
  this->view_->receivers.deferred.darken(this->stageValues_.layers, this->programs_.library);
  this->endStageClock("shading: shadows");
}

//------------------------------------------------------------------------------
void RenderManager::beginShading(const vtkRenderState* s)
{
  this->stageValues_.receiversStage = false;
  this->programs_.shaders.beginStage(windowOf(s), this->stageValues_);
}

//------------------------------------------------------------------------------
bool RenderManager::endShading()
{
  const bool fitted = this->programs_.shaders.endStage();
  this->endStageClock(this->route_ == Route::Deferred ? "shading: the rest" : "shading");
  return fitted;
}

//------------------------------------------------------------------------------
void RenderManager::endFrame()
{
  FrameReport& report = this->report_;
  report.programCompiles =
    this->programs_.library.compiles() + this->programs_.shaders.rebuilds() - this->compilesBefore_;
  report.bytesOccluders =
    this->collector_.bytes() + this->buffers_.bytes() + this->tracer_.bytesOfTable();
  report.bytesBvh = this->tracer_.bytes();
  this->lights_.giveBack(this->view_->techniques);
  report.bytesMaps = this->lights_.bytesOfMaps() + this->views_.bytesOfMaps();
  if (this->route_ != Route::Inline)
  {
    report.bytesImages =
      this->views_.bytesOfImages() + this->tracer_.bytesOfRays() + this->edges_.bytes();
  }
  report.wallMilliseconds = steadyMilliseconds() - this->frameStart_;
}

//------------------------------------------------------------------------------
void RenderManager::abandonFrame()
{
  this->lights_.giveBack(this->view_->techniques);
  this->programs_.shaders.endStage();
}

//------------------------------------------------------------------------------
void RenderManager::setShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop)
{
  Drawn drawn = this->collector_.drawn(mapper, prop);
  drawn.receives = drawn.receives && (!drawn.translucent || this->shadesTranslucent_);
  this->programs_.shaders.setParameters(program, drawn);
}

} // namespace gnomon
