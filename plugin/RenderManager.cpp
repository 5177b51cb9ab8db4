#include "plugin/RenderManager.h"

#include "plugin/KeptVisibility.h"
#include "plugin/PictureTarget.h"
#include "plugin/ReceiverDrawing.h"
#include "plugin/ShownView.h"
#include "plugin/vtkGnomonShadowPass.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/conservative/CellTarget.h"
#include "shadowtech/tracing/GpuTracer.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderState.h>
#include <vtkRenderer.h>

#include <algorithm>

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
void RenderManager::beginFrame(bool measureStages)
{
  this->report_ = FrameReport{};
  this->visibility_ = VisibilityImages{};
  this->measureStages_ = measureStages;
  if (measureStages)
  {
    glFinish(); // what was pending before the frame is not the frame's
  }
  this->frameStart_ = this->stageStart_ = steadyMilliseconds();
  this->compilesBefore_ = this->library_.compiles() + this->shaders_.rebuilds();
}

//------------------------------------------------------------------------------
void RenderManager::endStageClock(const std::string& name)
{
  if (this->measureStages_)
  {
    glFinish();
    this->report_.stages.push_back({ name, steadyMilliseconds() - this->stageStart_ });
    this->stageStart_ = steadyMilliseconds();
  }
}

//------------------------------------------------------------------------------
bool RenderManager::collectLights(vtkRenderer* renderer, const ShadowSettings& defaults)
{
  this->lights_.collect(renderer, defaults, this->report_);
  this->endStageClock("lights");
  if (this->lights_.empty())
  {
    this->report_.route = "none";
    this->report_.routeReason = "no light casts a shadow";
  }
  return !this->lights_.empty();
}

//------------------------------------------------------------------------------
void RenderManager::collectOccluders(const vtkRenderState* s)
{
  const OccluderCollector::Change change = this->collector_.collect(s->GetRenderer());
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
  this->size_ = sizeOf(s);
  this->camera_ = cameraOf(s->GetRenderer(), occluders.centreWorld);
  this->stageValues_.space = { centredFromView(s->GetRenderer(), occluders.centreWorld),
    this->camera_.pixelSide(this->size_) };
  this->endStageClock("occluders");
}

//------------------------------------------------------------------------------
bool RenderManager::chooseRoute(int wished, bool keepVisibility)
{
  std::string screenTechnique;
  for (const CastingLight& casting : this->lights_)
  {
    if (!casting.own.info().isPointwise())
    {
      screenTechnique = casting.light.technique;
    }
  }
  const RouteChoice choice = gnomon::chooseRoute(wished, screenTechnique, keepVisibility);
  this->route_ = choice.route;
  this->report_.route = choice.route == Route::Image ? "image" : "inline";
  this->report_.routeReason = choice.reason;

  const bool translucentReceivers = this->collector_.translucentReceivers() > 0;
  if (!screenTechnique.empty() && translucentReceivers)
  {
    this->report_.notes.push_back("translucent surfaces show the plain shadow map ('" +
      std::string(plainTechnique) + "') of lights with '" + screenTechnique + "'");
  }
  const int samples = samplesOfBoundFramebuffer();
  if (this->route_ == Route::Image && samples > 1)
  {
    this->report_.notes.push_back("The window has " + std::to_string(samples) +
      " samples per pixel, and the image route one visibility, that of the surface at the pixel's "
      "centre: where another surface covers the rest of the pixel it is shaded with it, too.");
  }

  std::vector<ShadedLight> shaded;
  for (CastingLight& casting : this->lights_)
  {
    casting.own.chooseFit(
      casting.light, this->route_, translucentReceivers, reportOf(this->report_, casting.light));
    shaded.push_back({ casting.light, casting.layer, casting.channels,
      casting.pointwiseOn(this->route_, translucentReceivers) });
  }
  this->shaders_.configure({ this->route_, this->readsPoints(), samples > 1 }, shaded);
  return wished != vtkGnomonShadowPass::ROUTE_INLINE || screenTechnique.empty();
}

//------------------------------------------------------------------------------
/// Whether anything on the GPU asks for the receivers' points.
bool RenderManager::readsPoints() const
{
  return this->lights_.anyTechnique(
    [](const TechniqueInfo& info) { return info.evaluation != Evaluation::ScreenCpu; });
}

//------------------------------------------------------------------------------
void RenderManager::drawReceivers(const vtkRenderState* s, vtkGnomonShadowPass* pass)
{
  this->receiverImages_.rays = pixelRays(this->camera_.clipFromView,
    this->stageValues_.space.centredFromView, this->size_.x, this->size_.y);
  this->receiversShown_ = hashOfReceivers(s, this->camera_, this->size_);

  this->layers_.resize(this->size_.x, this->size_.y, this->lights_.layers());
  this->stageValues_.layers = { GL_TEXTURE_2D_ARRAY, this->layers_.texture() };
  this->stageValues_.layersSize = this->size_;
  this->stageValues_.receiversStage = true;
  this->shaders_.beginStage(windowOf(s), this->stageValues_);
  gnomon::drawReceivers(s, pass, this->size_, this->readsPoints(), this->receiverTarget_);
  this->shaders_.endStage();
  this->endStageClock("receivers");
}

//------------------------------------------------------------------------------
void RenderManager::bakeMaps(int wishedRasterizer)
{
  RasterizerChoice rasterizer;
  if (this->lights_.anyTechnique([](const TechniqueInfo& info) { return info.conservativeMap; }))
  {
    rasterizer = chooseRasterizer(wishedRasterizer, CellTarget::whyUnsupported());
  }
  const MapStage stage{ this->camera_, this->collector_.occluders(), this->buffers_, rasterizer,
    this->library_, this->receiverTarget_, this->stageValues_.space.centredFromView,
    this->receiversShown_, this->report_.mapBakes };
  for (CastingLight& casting : this->lights_)
  {
    LightReport& report = reportOf(this->report_, casting.light);
    casting.own.updateMaps(casting.light, stage, report);
    if (casting.plain)
    {
      casting.plain->updateMaps(casting.light, stage, report);
    }
  }
  this->endStageClock("maps");
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
  const bool onCpu = this->lights_.anyTechnique(
    [](const TechniqueInfo& info) { return info.evaluation == Evaluation::ScreenCpu; });
  if (onCpu || keep)
  {
    this->receiverTarget_.read(this->receiverImages_);
    this->endStageClock("visibility: read receivers");
  }
  if (onCpu)
  {
    this->updateTracer(wishedTracer);
  }

  const Occluders& occluders = this->collector_.occluders();
  Receivers receivers(
    this->receiverImages_, this->collector_.drawnSurfaces(), occluders, this->receivers_);
  const bool classify = keep || this->measureStages_;
  std::vector<std::vector<std::uint8_t>> classesOfLights;
  for (CastingLight& casting : this->lights_)
  {
    std::vector<std::uint8_t> classes;
    this->fillLayers(casting, receivers, classify ? &classes : nullptr);
    const std::vector<PixelClass>& named = casting.own.info().classes;
    if (classify && !named.empty())
    {
      reportOf(this->report_, casting.light).classes = countClasses(named, classes);
    }
    classesOfLights.push_back(std::move(classes));
  }
  if (keep)
  {
    this->visibility_ = keepVisibility(
      this->lights_, classesOfLights, this->layers_, receivers.all(), occluders.centreWorld);
  }
}

//------------------------------------------------------------------------------
/// Has a light's technique fill its layers.
/// @param classes where not null: each pixel's class, an index into TechniqueInfo::classes
void RenderManager::fillLayers(
  CastingLight& casting, Receivers& receivers, std::vector<std::uint8_t>* classes)
{
  const ShadowLight& light = casting.light;
  const Occluders& occluders = this->collector_.occluders();
  Technique& technique = casting.own.technique();
  LightReport& report = reportOf(this->report_, light);
  switch (casting.own.info().evaluation)
  {
    case Evaluation::Pointwise:
      this->layers_.estimate(casting.layer, technique, light, this->receiverTarget_,
        this->stageValues_.space, this->library_,
        casting.own.info().classes.empty() ? nullptr : classes);
      this->endStageClock("visibility: estimate");
      break;
    case Evaluation::ScreenGpu:
      this->buffers_.update(occluders);
      namingLight(light,
        [&]
        {
          technique.drawVisibility(
            { light, casting.own.fitting(), this->camera_, this->stageValues_.space, occluders,
              this->buffers_, this->receiverTarget_, this->receiversShown_,
              this->collector_.drawnSurfaces(), this->layers_, casting.layer, this->library_,
              classes != nullptr, classes, this->report_.notes, this->report_.mapBakes },
            report);
        });
      this->endStageClock("visibility: draw");
      break;
    case Evaluation::ScreenCpu:
    {
      std::vector<float> visibility;
      namingLight(light,
        [&]
        {
          technique.computeVisibility(
            { light, casting.own.fitting(), occluders, receivers, this->tracer_.tracer(),
              casting.own.usesMap(), classes, this->report_.mapBakes },
            visibility, report);
        });
      this->endStageClock("visibility: trace");
      this->layers_.upload(casting.layer, visibility);
      this->endStageClock("visibility: upload");
      break;
    }
  }
}

//------------------------------------------------------------------------------
void RenderManager::beginShading(const vtkRenderState* s)
{
  this->stageValues_.receiversStage = false;
  this->shaders_.beginStage(windowOf(s), this->stageValues_);
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
  for (const CastingLight& casting : this->lights_)
  {
    report.bytesMaps += casting.own.technique().bytesOfMaps() +
      (casting.plain ? casting.plain->technique().bytesOfMaps() : 0);
  }
  if (this->route_ == Route::Image)
  {
    report.bytesImages = this->receiverTarget_.bytes() + this->layers_.bytes() +
      bytesOf(this->receiverImages_.fragments) + this->receivers_.bytes() +
      this->tracer_.bytesOfRays();
  }
  report.wallMilliseconds = steadyMilliseconds() - this->frameStart_;
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
