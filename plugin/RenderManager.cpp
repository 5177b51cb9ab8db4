#include "plugin/RenderManager.h"

#include "lights/KernelShape.h"
#include "plugin/DrawnProps.h"
#include "plugin/Hash.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/tracing/GpuTracer.h"

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseVectorKey.h>
#include <vtkOpenGLRenderPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkProp.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>

#include <algorithm>
#include <array>

namespace gnomon
{
namespace
{

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The name of the kernel that an estimator reads a light's map with; empty: it reads it with none.
std::string kernelOf(const TechniqueInfo& info, const ShadowLight& light)
{
  if (!info.filters)
  {
    return "";
  }
  return info.ownKernel.empty() ? findSetting("kernel")->get(light) : info.ownKernel;
}

/// What draws, by the name that OpenGL gives it.
std::string rendererName()
{
  const GLubyte* name = glGetString(GL_RENDERER);
  return name ? reinterpret_cast<const char*>(name) : "";
}

/// How many samples a pixel has where VTK draws now.
int samplesPerPixel()
{
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  return std::max(samples, 1);
}

/// Hides from a prop's shaders all render passes but one, for as long as it lives: other passes may
/// write outputs of their own.
class WithoutOtherPasses
{
public:
  WithoutOtherPasses(vtkProp* prop, vtkObjectBase* pass)
    : keys_(prop->GetPropertyKeys())
  {
    if (this->keys_ && this->keys_->Length(vtkOpenGLRenderPass::RenderPasses()) > 1)
    {
      this->hidden_ = vtkSmartPointer<vtkInformation>::New();
      this->hidden_->CopyEntry(this->keys_, vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Remove(vtkOpenGLRenderPass::RenderPasses());
      this->keys_->Append(vtkOpenGLRenderPass::RenderPasses(), pass);
    }
  }
  ~WithoutOtherPasses()
  {
    if (this->hidden_)
    {
      this->keys_->CopyEntry(this->hidden_, vtkOpenGLRenderPass::RenderPasses());
    }
  }
  WithoutOtherPasses(const WithoutOtherPasses&) = delete;
  WithoutOtherPasses& operator=(const WithoutOtherPasses&) = delete;

private:
  vtkInformation* keys_;
  vtkSmartPointer<vtkInformation> hidden_;
};

/// What a picture of props depends on, beside their places in the snapshot: the same numbers mean the
/// same picture.
std::size_t hashOfShown(const vtkRenderState* s, const CameraView& camera, const glm::ivec2& size)
{
  std::size_t seed = 0;
  hashView(seed, camera, size);
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = s->GetPropArray()[i];
    // Annotations and volumes receive nothing: a text that tells the frame's time is no other picture.
    if (!vtkActor2D::SafeDownCast(prop) && !vtkVolume::SafeDownCast(prop))
    {
      hashCombine(seed, prop);
      hashCombine(seed, prop->GetRedrawMTime());
    }
  }
  return seed;
}

template <typename Value>
std::vector<Value> topRowFirst(const std::vector<Value>& image, int width, int height)
{
  std::vector<Value> flipped(image.size());
  for (int y = 0; y < height; ++y)
  {
    const auto row = image.begin() + static_cast<std::ptrdiff_t>(y) * width;
    std::copy(
      row, row + width, flipped.begin() + static_cast<std::ptrdiff_t>(height - 1 - y) * width);
  }
  return flipped;
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

/// Does a light's work; what it says of memory that is not there then names the light.
template <typename Work>
void namingLight(const ShadowLight& light, const Work& work)
{
  try
  {
    work();
  }
  catch (const TextureMemoryError& error)
  {
    throw TextureMemoryError("light " + std::to_string(light.sceneIndex) + ": " + error.what());
  }
}

} // namespace

//------------------------------------------------------------------------------
void RenderManager::beginFrame(bool measureStages)
{
  this->report_ = FrameReport{};
  this->visibility_ = VisibilityImages{};
  this->measureStages_ = measureStages;
  if (measureStages)
  {
    glFinish(); // what was pending before the frame is not the frame's
  }
  this->frameStart_ = this->stageStart_ = Clock::now();
  this->compilesBefore_ = this->library_.compiles() + this->shaders_.rebuilds();
}

//------------------------------------------------------------------------------
void RenderManager::endStageClock(const std::string& name)
{
  if (this->measureStages_)
  {
    glFinish();
    this->report_.stages.push_back({ name, millisecondsSince(this->stageStart_) });
    this->stageStart_ = Clock::now();
  }
}

//------------------------------------------------------------------------------
bool RenderManager::collectLights(vtkRenderer* renderer, const ShadowSettings& defaults)
{
  const LightSet set = this->lightManager_.collect(renderer, defaults);
  for (const SkippedLight& skipped : set.skipped)
  {
    LightReport light;
    light.sceneIndex = skipped.sceneIndex;
    light.reason = skipped.reason;
    this->report_.lights.push_back(light);
  }

  const bool severalViews = this->viewCount_.areSeveral(renderer);
  this->casting_.clear();
  std::map<int, LightSlot> slots;
  for (ShadowLight light : set.casting)
  {
    const EstimatorEntry* estimator = nullptr;
    try
    {
      estimator = &compose(light);
    }
    catch (const CompositionError& error)
    {
      throw FrameError("light " + std::to_string(light.sceneIndex) + ": " + error.what());
    }
    const TechniqueInfo& info = estimator->info;
    const int mostSamples = info.averagesMap ? mostMapSamples() : light.mapSamples;
    if (light.mapSamples > mostSamples)
    {
      this->report_.notes.push_back("light " + std::to_string(light.sceneIndex) +
        ": OpenGL draws maps with at most " + std::to_string(mostSamples) +
        " samples of a texel, not " + std::to_string(light.mapSamples));
      light.mapSamples = mostSamples;
    }
    if (info.refines && light.progressiveSamples > 0 && severalViews)
    {
      this->report_.notes.push_back("light " + std::to_string(light.sceneIndex) +
        ": 'progressive' refines one view, and the pass draws several (stereo, tiles, renderers): "
        "all of the light's points are in every frame");
      light.progressiveSamples = 0;
    }
    LightSlot slot;
    const auto kept = this->slots_.find(light.sceneIndex);
    if (kept != this->slots_.end() && kept->second.estimator == estimator)
    {
      slot = std::move(kept->second);
    }
    else
    {
      slot.estimator = estimator;
      slot.technique = estimator->create();
    }
    slot.light = light;
    slot.channels = channelsOf(info, light);
    if (light.texture && !info.seesTextures)
    {
      this->report_.notes.push_back("light " + std::to_string(light.sceneIndex) + ": '" +
        light.technique + "' shows an even light of its texture's mean colour");
    }
    slots[light.sceneIndex] = std::move(slot);

    LightReport report;
    report.sceneIndex = light.sceneIndex;
    report.casts = true;
    report.technique = light.technique;
    report.estimator = light.estimator;
    report.projection = info.needsMap ? findSetting("projection")->get(light) : "";
    report.mapSizeTexels = info.needsMap ? light.mapSizeTexels : 0;
    report.kernel = kernelOf(info, light);
    report.kernelTexels = info.filters ? light.kernelTexels : 0;
    report.mapSamples = info.averagesMap ? light.mapSamples : 0;
    this->report_.lights.push_back(report);
  }
  this->slots_ = std::move(slots);
  int layer = 0;
  for (auto& [sceneIndex, slot] : this->slots_)
  {
    slot.layer = layer;
    layer += slot.channels;
    this->casting_.push_back(&slot);
  }
  std::sort(this->report_.lights.begin(), this->report_.lights.end(),
    [](const LightReport& a, const LightReport& b) { return a.sceneIndex < b.sceneIndex; });
  this->endStageClock("lights");
  if (this->casting_.empty())
  {
    this->report_.route = "none";
    this->report_.routeReason = "no light casts a shadow";
  }
  return !this->casting_.empty();
}

//------------------------------------------------------------------------------
void RenderManager::collectOccluders(vtkRenderer* renderer)
{
  const OccluderCollector::Change change = this->collector_.collect(renderer);
  const Occluders& occluders = this->collector_.occluders();
  this->report_.surfacesExtracted = change.extracted;
  this->report_.surfacesRetransformed = change.retransformed;
  this->report_.notes.insert(
    this->report_.notes.end(), this->collector_.notes().begin(), this->collector_.notes().end());
  for (const Surface& surface : occluders.surfaces)
  {
    const std::size_t instances = surface.centredFromSource.size();
    this->report_.instances += instances;
    this->report_.triangles += surface.triangleCount * std::max<std::size_t>(instances, 1);
  }
  this->report_.droppedNonFinite = occluders.droppedNonFinite;
  this->report_.droppedZeroArea = occluders.droppedZeroArea;
  this->endStageClock("occluders");
}

//------------------------------------------------------------------------------
bool RenderManager::chooseRoute(int wished, bool keepVisibility)
{
  std::string screenTechnique;
  for (const LightSlot* slot : this->casting_)
  {
    if (!slot->estimator->info.isPointwise())
    {
      screenTechnique = slot->light.technique;
    }
  }
  this->route_ = Route::Image;
  if (!screenTechnique.empty())
  {
    this->report_.routeReason = "'" + screenTechnique + "' works on the whole screen";
  }
  else if (wished == vtkGnomonShadowPass::ROUTE_IMAGE)
  {
    this->report_.routeReason = "asked for";
  }
  else if (keepVisibility)
  {
    this->report_.routeReason = "the visibility is kept";
  }
  else
  {
    this->route_ = Route::Inline;
    this->report_.routeReason = wished == vtkGnomonShadowPass::ROUTE_INLINE
      ? "asked for"
      : "all techniques are functions of the point, so that no prepass is needed";
  }
  this->report_.route = this->route_ == Route::Image ? "image" : "inline";
  if (!screenTechnique.empty() && this->collector_.translucentReceivers() > 0)
  {
    this->report_.notes.push_back("translucent surfaces show the plain shadow map ('" +
      std::string(plainTechnique) + "') of lights with '" + screenTechnique + "'");
  }

  const int samples = samplesPerPixel();
  if (this->route_ == Route::Image && samples > 1)
  {
    this->report_.notes.push_back("The window has " + std::to_string(samples) +
      " samples per pixel, and the image route one visibility, that of the surface at the pixel's "
      "centre: where another surface covers the rest of the pixel it is shaded with it, too.");
  }

  this->chooseFits();
  std::vector<ShadedLight> lights;
  for (LightSlot* slot : this->casting_)
  {
    lights.push_back({ slot->light, slot->layer, slot->channels, this->pointwiseFor(*slot) });
  }
  this->shaders_.configure({ this->route_, this->readsPoints(), samples > 1 }, lights);
  return wished != vtkGnomonShadowPass::ROUTE_INLINE || screenTechnique.empty();
}

//------------------------------------------------------------------------------
/// States what each light's views are fitted to: the receivers that are drawn, which are the tightest,
/// unless there is a reason not to.
void RenderManager::chooseFits()
{
  for (LightSlot* slot : this->casting_)
  {
    if (!slot->estimator->info.needsMap)
    {
      continue;
    }
    ShadowLight& light = slot->light;
    LightReport& report = this->reportOf(light);
    const bool fitted = isFittedToCamera(light);
    report.fitReason = fitted ? this->reasonAgainstReceivers(*slot) : "";
    light.fittedToReceivers = fitted && report.fitReason.empty();
    report.fit = light.fittedToReceivers ? "receivers" : fitted ? "frustum" : "off";
  }
}

//------------------------------------------------------------------------------
/// Why a light's views cannot be fitted to the receivers that are drawn; empty if they can.
std::string RenderManager::reasonAgainstReceivers(const LightSlot& slot) const
{
  if (this->route_ == Route::Inline)
  {
    return "the inline route does not draw the receivers first";
  }
  if (!slot.estimator->info.isPointwise())
  {
    return "the technique works on the screen, where the receivers are found after the maps";
  }
  if (slot.light.fit == ViewFit::Off)
  {
    return "that takes the setting fit=frame";
  }
  if (slot.light.projection == Projection::Splits && slot.light.splitBlend > 0.0)
  {
    return "splits that are blended overlap, and each receiver is counted to one";
  }
  if (slot.light.fit == ViewFit::Once)
  {
    return "a fit that is made once has to hold what will be seen later";
  }
  if (this->collector_.translucentReceivers() > 0)
  {
    return "translucent surfaces receive, which are not among the receivers that are drawn first";
  }
  if (slot.technique->mapReach(slot.light).dependsOnViews())
  {
    return "a kernel of a width in world units, or as wide as penumbrae are, needs a border that "
           "follows from the fit itself";
  }
  return {};
}

//------------------------------------------------------------------------------
LightReport& RenderManager::reportOf(const ShadowLight& light)
{
  return *std::find_if(this->report_.lights.begin(), this->report_.lights.end(),
    [&](const LightReport& report) { return report.sceneIndex == light.sceneIndex; });
}

//------------------------------------------------------------------------------
bool RenderManager::readsPoints() const
{
  return std::any_of(this->casting_.begin(), this->casting_.end(),
    [](const LightSlot* slot)
    { return slot->estimator->info.evaluation != Evaluation::ScreenCpu; });
}

//------------------------------------------------------------------------------
/// What the shader computes a light's visibility with on the route taken; null if it only fetches.
const Technique* RenderManager::pointwiseFor(LightSlot& slot) const
{
  const bool translucent = this->collector_.translucentReceivers() > 0;
  const bool pointwise = slot.estimator->info.isPointwise();
  if (pointwise || !translucent)
  {
    slot.plain.reset();
    return pointwise && (translucent || this->route_ == Route::Inline) ? slot.technique.get()
                                                                       : nullptr;
  }
  if (!slot.plain)
  {
    slot.plain = findTechnique(plainTechnique)->estimator->create();
    slot.plainBake = Bake();
  }
  return slot.plain.get();
}

//------------------------------------------------------------------------------
glm::dmat4 RenderManager::centredFromView(vtkRenderer* renderer) const
{
  // The camera's rigid inverse, moved by the centre before anything becomes float.
  glm::dmat4 matrix =
    glm::inverse(toGlm(renderer->GetActiveCamera()->GetModelViewTransformMatrix()));
  matrix[3] -= glm::dvec4(this->collector_.occluders().centreWorld, 0.0);
  return matrix;
}

//------------------------------------------------------------------------------
CameraView RenderManager::camera(vtkRenderer* renderer) const
{
  vtkCamera* camera = renderer->GetActiveCamera();
  CameraView view;
  view.viewFromCentred = glm::inverse(this->centredFromView(renderer));
  view.clipFromView =
    toGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  return view;
}

//------------------------------------------------------------------------------
ReceiverSpace RenderManager::receiverSpace(const vtkRenderState* s) const
{
  vtkRenderer* renderer = s->GetRenderer();
  return { this->centredFromView(renderer), this->camera(renderer).pixelSide(sizeOf(s)) };
}

//------------------------------------------------------------------------------
void RenderManager::drawReceivers(const vtkRenderState* s, vtkGnomonShadowPass* pass)
{
  vtkRenderer* renderer = s->GetRenderer();
  const glm::ivec2 size = sizeOf(s);
  const int width = size.x;
  const int height = size.y;

  this->stageValues_.space = this->receiverSpace(s);
  this->camera_ = this->camera(renderer);
  this->receiverImages_.rays =
    pixelRays(this->camera_.clipFromView, this->stageValues_.space.centredFromView, width, height);
  this->receiversShown_ = hashOfShown(s, this->camera_, size);

  const LightSlot& last = *this->casting_.back();
  this->layers_.resize(width, height, last.layer + last.channels);
  this->stageValues_.layers = { GL_TEXTURE_2D_ARRAY, this->layers_.texture() };
  this->stageValues_.layersSize = size;
  this->stageValues_.receiversStage = true;

  // VTK draws here and keeps its own record of the state, so the state is changed through that
  // record.
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglScissor(0, 0, width, height);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_DEPTH_TEST);

  this->shaders_.beginStage(window, this->stageValues_);
  this->receiverTarget_.begin(width, height, this->readsPoints());
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    const WithoutOtherPasses alone(s->GetPropArray()[i], pass);
    s->GetPropArray()[i]->RenderOpaqueGeometry(renderer);
  }
  this->receiverTarget_.end(state->GetEnumState(GL_BLEND));
  this->shaders_.endStage();
  this->endStageClock("receivers");
}

//------------------------------------------------------------------------------
void RenderManager::bakeMaps(vtkRenderer* renderer, int wishedRasterizer)
{
  if (std::any_of(this->casting_.begin(), this->casting_.end(),
        [](const LightSlot* slot) { return slot->estimator->info.conservativeMap; }))
  {
    this->rasterizer_ = chooseRasterizer(wishedRasterizer, whyUnsupported(CellPath::Compute),
      whyUnsupported(CellPath::Extension), rendererName());
  }
  const CameraView camera = this->camera(renderer);
  for (LightSlot* slot : this->casting_)
  {
    if (slot->estimator->info.needsMap)
    {
      this->bakeMaps(*slot, camera, *slot->technique, slot->bake);
    }
    if (slot->plain)
    {
      this->bakeMaps(*slot, camera, *slot->plain, slot->plainBake);
    }
  }
  this->endStageClock("maps");
}

//------------------------------------------------------------------------------
/// Bakes a light's maps if they are stale.
void RenderManager::bakeMaps(
  LightSlot& slot, const CameraView& camera, Technique& technique, Bake& bake)
{
  const ShadowLight& light = slot.light;
  const Occluders& occluders = this->collector_.occluders();
  const MapReach reach = technique.mapReach(light);
  ViewFitting fitting;
  fitting.centreWorld = occluders.centreWorld;
  fitting.castersCentred = occluders.castersCentred;
  fitting.receiversCentred = occluders.allCentred;
  fitting.texels = { light.mapSizeTexels, reach.borderTexels() };
  if (isFittedToCamera(light))
  {
    const std::optional<CameraView>& first = bake.camera ? bake.camera : slot.awaited.camera;
    fitting.camera = light.fit == ViewFit::Once && first ? first : camera;
  }
  const ShadowLight seen = technique.lightOfMap(light);
  LightViews views = fitLightViews(seen, fitting);
  if (reach.dependsOnViews())
  {
    // How many texels that is, only a view can tell. A wider border makes them fewer.
    fitting.texels.border = reach.borderTexels(mostTexelsAcross(views, light.mapSizeTexels),
      reachOfArea(reach.area, views, fitting.castersCentred, fitting.receiversCentred));
    views = fitLightViews(seen, fitting);
  }
  std::size_t receivers = 0;
  if (light.fittedToReceivers)
  {
    receivers = this->receiversShown_;
    hashCombine(receivers, light.snap);
    hashCombine(receivers, light.splitLambda);
  }
  const std::optional<RasterizerChoice> rasterizer = this->rasterizerFor(slot, technique);
  Bake wanted{ std::move(views), fitting.camera, reach, light, light.mapSizeTexels,
    occluders.topologyVersion, occluders.positionsVersion, receivers, true, rasterizer,
    rasterizer.value_or(RasterizerChoice()), 0, fitting };
  bake.fitting = fitting;
  if (bake.serves(wanted))
  {
    takeReason(bake, wanted);
    this->reportBake(light, bake);
    return;
  }
  bake.once = false; // in case that there is no memory
  if (!this->isWorthBaking(slot, technique, wanted))
  {
    slot.awaited = wanted;
    technique.dropMaps();
    this->reportOf(light).mapReason =
      "the light, the casters or what it is fitted to have changed: all is traced, and the map is "
      "drawn once nothing has changed for a frame";
    return;
  }
  this->buffers_.update(occluders);
  if (light.fittedToReceivers)
  {
    slot.receiverFit.compute(light, wanted.views,
      { this->receiverTarget_.fragments(), this->receiverTarget_.points(),
        this->receiverTarget_.width(), this->receiverTarget_.height() },
      this->stageValues_.space.centredFromView, this->library_);
  }
  namingLight(light,
    [&]
    {
      wanted.drawnBy = gnomon::bakeMaps(technique,
        { light, wanted.views, occluders, this->buffers_, this->library_,
          light.fittedToReceivers ? slot.receiverFit.fits() : TextureBinding() },
        wanted.drawnBy);
    });
  bake = wanted;
  bake.castersLeftOut = this->buffers_.countUnseen(wanted.views.views);
  ++this->report_.mapBakes;
  this->reportBake(light, bake);
}

//------------------------------------------------------------------------------
/// Who is to draw a technique's conservative maps; none where it has others.
std::optional<RasterizerChoice> RenderManager::rasterizerFor(
  const LightSlot& slot, const Technique& technique) const
{
  const TechniqueInfo& info = slot.estimator->info;
  if (&technique != slot.technique.get() || !info.conservativeMap)
  {
    return std::nullopt;
  }
  return info.onlyCpuDraws.empty() ? this->rasterizer_
                                   : RasterizerChoice{ std::nullopt, false, info.onlyCpuDraws };
}

//------------------------------------------------------------------------------
/// Who drew a map that serves may have been chosen anew, for another reason.
void RenderManager::takeReason(Bake& bake, const Bake& wanted)
{
  if (wanted.rasterizer && bake.drawnBy.gpu == wanted.rasterizer->gpu)
  {
    bake.rasterizer = wanted.rasterizer;
    bake.drawnBy = *wanted.rasterizer;
  }
}

//------------------------------------------------------------------------------
void RenderManager::reportBake(const ShadowLight& light, const Bake& bake)
{
  LightReport& report = this->reportOf(light);
  report.castersLeftOut = bake.castersLeftOut;
  if (bake.rasterizer)
  {
    report.rasterizer = bake.drawnBy.gpu ? std::string("gpu: ") + nameOf(*bake.drawnBy.gpu) : "cpu";
    report.rasterizerReason = bake.drawnBy.reason;
  }
}

//------------------------------------------------------------------------------
bool RenderManager::Bake::serves(const Bake& wanted) const
{
  return this->once && this->views == wanted.views && this->sizeTexels == wanted.sizeTexels &&
    this->reach == wanted.reach && this->settings.storesAs(wanted.settings) &&
    this->rasterizer.has_value() == wanted.rasterizer.has_value() &&
    (!this->rasterizer || servesChoice(*this->rasterizer, this->drawnBy, *wanted.rasterizer)) &&
    this->topology == wanted.topology && this->positions == wanted.positions &&
    this->receivers == wanted.receivers;
}

//------------------------------------------------------------------------------
/// Whether a stale map is to be drawn now: always, but for maps that only save time, and would not if
/// everything moved on.
bool RenderManager::isWorthBaking(
  const LightSlot& slot, const Technique& technique, const Bake& wanted) const
{
  const bool optional = &technique == slot.technique.get() && slot.estimator->info.mapIsOptional;
  return !optional || slot.light.bake == BakeTime::Always || slot.awaited.serves(wanted);
}

//------------------------------------------------------------------------------
/// Brings a tracer up to date, and states in the report which one and why.
void RenderManager::updateTracer(int wished)
{
  const TracerChoice choice = chooseTracer(wished, GpuTracer::whyUnsupported(), rendererName());
  const ShadowTracer::Update update = this->tracer_.update(choice, this->collector_.occluders());
  this->report_.bvhBuilds = update.builds;
  this->report_.bvhRefits = update.refits;
  this->report_.tracer = this->tracer_.taken().gpu ? "gpu" : "embree";
  this->report_.tracerReason = this->tracer_.taken().reason;
  if (!this->tracer_.gpuFailure().empty())
  {
    this->report_.notes.push_back(
      "Embree traces rays, as tracing on the GPU failed: " + this->tracer_.gpuFailure() + ".");
  }
  this->endStageClock("visibility: build");
}

//------------------------------------------------------------------------------
void RenderManager::computeVisibility(int wishedTracer, bool keep)
{
  const Occluders& occluders = this->collector_.occluders();
  const bool onCpu = std::any_of(this->casting_.begin(), this->casting_.end(),
    [](const LightSlot* slot)
    { return slot->estimator->info.evaluation == Evaluation::ScreenCpu; });
  if (onCpu || keep)
  {
    this->receiverTarget_.read(this->receiverImages_);
    this->endStageClock("visibility: read receivers");
  }
  if (onCpu)
  {
    this->updateTracer(wishedTracer);
  }

  Receivers receivers(
    this->receiverImages_, this->collector_.drawnSurfaces(), occluders, this->receivers_);
  const bool classify = keep || this->measureStages_;
  std::vector<float> visibility;
  std::vector<std::uint8_t> classes;
  for (LightSlot* const casting : this->casting_)
  {
    LightSlot& slot = *casting;
    LightReport& report = this->reportOf(slot.light);
    const TechniqueInfo& info = slot.estimator->info;
    switch (info.evaluation)
    {
      case Evaluation::Pointwise:
        this->layers_.estimate(slot.layer, *slot.technique, slot.light, this->receiverTarget_,
          this->stageValues_.space, this->library_);
        this->endStageClock("visibility: estimate");
        break;
      case Evaluation::ScreenGpu:
        this->buffers_.update(occluders);
        namingLight(slot.light,
          [&]
          {
            slot.technique->drawVisibility(
              { slot.light, slot.bake.fitting, this->camera_, this->stageValues_.space, occluders,
                this->buffers_, this->receiverTarget_, this->receiversShown_,
                this->collector_.drawnSurfaces(), this->layers_, slot.layer, this->library_,
                classify, classify ? &classes : nullptr, this->report_.notes,
                this->report_.mapBakes },
              report);
          });
        this->endStageClock("visibility: draw");
        break;
      case Evaluation::ScreenCpu:
        namingLight(slot.light,
          [&]
          {
            slot.technique->computeVisibility(
              { slot.light, slot.bake.fitting, occluders, receivers, this->tracer_.tracer(),
                classify ? &classes : nullptr, this->report_.mapBakes },
              visibility, report);
          });
        this->endStageClock("visibility: trace");
        this->layers_.upload(slot.layer, visibility);
        this->endStageClock("visibility: upload");
        break;
    }
    if (classify && !info.classes.empty())
    {
      report.classes = countClasses(info.classes, classes);
    }
    if (keep)
    {
      this->visibility_.classes.resize(
        this->visibility_.classes.size() + (slot.light.texture ? 3 : 1),
        { info.classes,
          info.classes.empty()
            ? std::vector<std::uint8_t>()
            : topRowFirst(classes, this->receiverImages_.width, this->receiverImages_.height) });
    }
  }
  if (keep)
  {
    this->keepVisibility(receivers.all());
  }
}

//------------------------------------------------------------------------------
void RenderManager::keepVisibility(const ReceiverPixels& receivers)
{
  VisibilityImages& kept = this->visibility_;
  kept.width = receivers.width;
  kept.height = receivers.height;
  const glm::dvec3 centre = this->collector_.occluders().centreWorld;
  kept.origin = { { centre.x, centre.y, centre.z } };
  for (const LightSlot* slot : this->casting_)
  {
    this->keepLayers(*slot);
  }
  const auto flip = [&](const std::vector<float>& plane)
  { return topRowFirst(plane, kept.width, kept.height); };
  kept.positionX = flip(receivers.positionX);
  kept.positionY = flip(receivers.positionY);
  kept.positionZ = flip(receivers.positionZ);
  kept.normalX = flip(receivers.normalX);
  kept.normalY = flip(receivers.normalY);
  kept.normalZ = flip(receivers.normalZ);
  std::vector<float> coverage(receivers.size());
  std::transform(receivers.surface.begin(), receivers.surface.end(), coverage.begin(),
    [](std::uint32_t surface) { return surface == ReceiverPixels::notCovered ? 0.0f : 1.0f; });
  kept.coverage = flip(coverage);
}

//------------------------------------------------------------------------------
/// Keeps a light's visibility: one image, or three of a light with a texture, whether or not its technique sees it.
void RenderManager::keepLayers(const LightSlot& slot)
{
  VisibilityImages& kept = this->visibility_;
  const auto keep = [&](const std::vector<float>& image, LightChannel channel)
  {
    kept.visibility.push_back(topRowFirst(image, kept.width, kept.height));
    kept.sceneIndices.push_back(slot.light.sceneIndex);
    kept.channels.push_back(channel);
  };
  std::vector<float> image;
  if (!slot.light.texture)
  {
    this->layers_.read(slot.layer, image);
    keep(image, LightChannel::All);
    return;
  }
  constexpr std::array<LightChannel, 3> channels = { LightChannel::Red, LightChannel::Green,
    LightChannel::Blue };
  for (int channel = 0; channel < 3; ++channel)
  {
    const bool seen = slot.channels == 3;
    this->layers_.read(slot.layer + (seen ? channel : 0), image);
    const float lit = seen ? 1.0f : slot.light.texture->mean[channel];
    std::transform(image.begin(), image.end(), image.begin(), [&](float v) { return lit * v; });
    keep(image, channels[static_cast<std::size_t>(channel)]);
  }
}

//------------------------------------------------------------------------------
void RenderManager::beginShading(const vtkRenderState* s)
{
  this->stageValues_.receiversStage = false;
  this->stageValues_.space = this->receiverSpace(s);
  this->shaders_.beginStage(
    vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow()), this->stageValues_);
}

//------------------------------------------------------------------------------
bool RenderManager::endShading()
{
  const bool fitted = this->shaders_.endStage();
  this->endStageClock("shading");
  return fitted;
}

//------------------------------------------------------------------------------
void RenderManager::endFrame()
{
  FrameReport& report = this->report_;
  report.programCompiles =
    this->library_.compiles() + this->shaders_.rebuilds() - this->compilesBefore_;
  report.bytesOccluders =
    this->collector_.bytes() + this->buffers_.bytes() + this->tracer_.bytesOfTable();
  report.bytesBvh = this->tracer_.bytes();
  for (const LightSlot* slot : this->casting_)
  {
    report.bytesMaps +=
      slot->technique->bytesOfMaps() + (slot->plain ? slot->plain->bytesOfMaps() : 0);
  }
  if (this->route_ == Route::Image)
  {
    report.bytesImages = this->receiverTarget_.bytes() + this->layers_.bytes() +
      bytesOf(this->receiverImages_.fragments) + this->receivers_.bytes() +
      this->tracer_.bytesOfRays();
  }
  report.wallMilliseconds = millisecondsSince(this->frameStart_);
}

//------------------------------------------------------------------------------
void RenderManager::abandonFrame()
{
  this->shaders_.endStage();
}

//------------------------------------------------------------------------------
void RenderManager::setShaderParameters(
  vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop)
{
  this->shaders_.setParameters(program, this->collector_.drawn(mapper, prop));
}

} // namespace gnomon
