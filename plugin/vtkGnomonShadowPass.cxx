#include "vtkGnomonShadowPassInternals.h"

#include "plugin/frame/ReceiverDrawing.h"
#include "plugin/pass/FrameWords.h"
#include "plugin/pass/Progress.h"
#include "plugin/plan/FrameWishes.h"
#include "plugin/scene/DrawnLookup.h"
#include "plugin/scene/VolumeReceivers.h"
#include "plugin/window/AroundOpaque.h"
#include "plugin/window/RendererScopes.h"
#include "shadowtech/base/TextureMemory.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkVolume.h"

#include <glm/gtc/type_ptr.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>

static_assert(vtkGnomonShadowPass::PictureUnfinishedEvent == gnomon::pictureUnfinishedEvent);

vtkStandardNewMacro(vtkGnomonShadowPass);

namespace
{

/// True if a picture has any pixels; VTK draws nothing of others.
bool hasPixels(const vtkRenderState* s)
{
  int size[2];
  int origin[2];
  s->GetRenderer()->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  return s->GetFrameBuffer() || (size[0] > 0 && size[1] > 0);
}

/// Does what PreRender() does, but names a pass once in property keys that props share, so that it
/// fills their shaders once. A part of an assembly has the assembly's keys, and may be in the
/// renderer by itself, too.
void nameInKeys(const vtkRenderState* s, vtkObjectBase* pass)
{
  const auto passes = vtkOpenGLRenderPass::RenderPasses();
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    vtkProp* prop = s->GetPropArray()[i];
    if (!prop->GetPropertyKeys())
    {
      prop->SetPropertyKeys(vtkNew<vtkInformation>());
    }
    vtkInformation* keys = prop->GetPropertyKeys();
    bool isNamed = false;
    for (int k = 0; k < keys->Length(passes); ++k)
    {
      isNamed = isNamed || keys->Get(passes, k) == pass;
    }
    if (!isNamed)
    {
      keys->Append(passes, pass);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
/// The manager of a renderer's frames, which becomes manager(). Those of renderers that are gone
/// go, too; the context is current.
gnomon::RenderManager& vtkGnomonShadowPass::Internals::managerOf(vtkRenderer* renderer)
{
  this->renderers.remove_if([](const RendererFrames& frames) { return !frames.renderer; });
  const auto found = std::find_if(this->renderers.begin(), this->renderers.end(),
    [renderer](const RendererFrames& frames) { return frames.renderer == renderer; });
  if (found != this->renderers.end())
  {
    this->renderers.splice(this->renderers.begin(), this->renderers, found);
  }
  else
  {
    this->renderers.push_front(
      { renderer, std::make_unique<gnomon::RenderManager>(*this->programs) });
  }
  return this->manager();
}

//------------------------------------------------------------------------------
/// Take the last frame's report and visibility from the manager.
void vtkGnomonShadowPass::Internals::keepLastFrame()
{
  if (this->shadowed)
  {
    this->report = this->manager().report();
    this->visibility = this->manager().visibility();
  }
  this->shadowed = false;
}

//------------------------------------------------------------------------------
/// Note in the report that the renderer has drawn a frame without this pass.
void vtkGnomonShadowPass::Internals::tellOfOther(vtkRenderer* renderer)
{
  const vtkRenderPass* const other = renderer->GetPass();
  this->keepLastFrame();
  this->report.notes.push_back(
    std::string("this frame is not the last one: the renderer has since been drawn by ") +
    (other ? other->GetClassName() : "no pass"));
}

//------------------------------------------------------------------------------
/// Take the processes of a controller as the ranks. Collective where they change.
void vtkGnomonShadowPass::Internals::updateRanks(vtkMultiProcessController* controller)
{
  this->ranks = &gnomon::alone(); // keeps those of before: the others need not know of this frame
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    if (!this->many || this->many->controller() != controller)
    {
      this->many = std::make_unique<gnomon::ManyRanks>(controller);
    }
    this->ranks = this->many.get();
  }
}

//------------------------------------------------------------------------------
vtkGnomonShadowPass::vtkGnomonShadowPass()
  : Internal(new Internals(this))
{
  if (const char* const path = std::getenv("GNOMON_FACTORS"))
  {
    this->vtkGnomonShadowPass::ReadCostFactors(path);
  }
}

//------------------------------------------------------------------------------
vtkGnomonShadowPass::~vtkGnomonShadowPass()
{
  this->ReleaseGraphicsResources(this->Internal->context.window());
  this->SetDelegatePass(nullptr);
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkGnomonShadowPass, DelegatePass, vtkRenderPass);
vtkCxxSetObjectMacro(vtkGnomonShadowPass, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
/// Names a pass in the props' keys, so that their mappers call the hook, for as long as this lives.
class vtkGnomonShadowPass::HookMarks
{
public:
  HookMarks(vtkGnomonShadowPass* pass, const vtkRenderState* s)
    : pass_(pass)
    , state_(s)
  {
    nameInKeys(s, pass);
  }
  ~HookMarks() { this->pass_->PostRender(this->state_); }
  HookMarks(const HookMarks&) = delete;
  HookMarks& operator=(const HookMarks&) = delete;

private:
  vtkGnomonShadowPass* pass_;
  const vtkRenderState* state_;
};

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::Render(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  this->NumberOfRenderedProps = 0;
  this->Internal->otherFrames.drawn(renderer);
  if (renderer->GetSelector())
  {
    this->DrawPlain(s); // and what refines goes on after it
    return;
  }
  const double progressBefore = std::exchange(this->Internal->progress, 1.0);
  gnomon::FrameEnd end;
  do
  {
    end = this->DrawFrame(s);
  } while (end.isToBeDrawnAgain); // at most once: the shaders that it asks for stay
  if (end.whyPlain)
  {
    this->EndPlain(s, end);
  }
  else
  {
    gnomon::tellProgress(this, progressBefore, this->Internal->progress);
  }
  if (end.measuresProcesses)
  {
    this->CompareSurfaces(s, end.whyPlain.has_value());
  }
  this->Internal->pictureTimer.drawn(renderer->GetRenderWindow(),
    this->Interactive == INTERACTIVE_AUTO ? end.picture : gnomon::ShownPicture{});
}

//------------------------------------------------------------------------------
/// Draw a frame with shadows, if it can have them.
gnomon::FrameEnd vtkGnomonShadowPass::DrawFrame(const vtkRenderState* s)
{
  gnomon::FrameEnd end;
  vtkRenderer* renderer = s->GetRenderer();
  if (this->ObeyUseShadows && !renderer->GetUseShadows())
  {
    end.whyPlain = "the renderer's UseShadows is off";
    return end;
  }
  if (!hasPixels(s))
  {
    end.whyPlain = "its viewport has no pixels";
    end.isDrawn = true;
    return end;
  }
  end.whyPlain = this->EnterContext(renderer);
  if (end.whyPlain)
  {
    return end;
  }
  gnomon::RenderManager& manager = this->Internal->managerOf(renderer);
  try
  {
    this->DrawShadows(s, end);
  }
  catch (const gnomon::FrameMustBeDrawnAgain&)
  {
    manager.abandonFrame();
    end.isToBeDrawnAgain = true;
  }
  catch (const std::exception& error)
  {
    this->Internal->ranks->fail(error.what());
    this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Frame,
      std::string("The scene is drawn without shadows: ") + error.what());
    manager.abandonFrame();
    end.whyPlain = "an error was met";
    end.outOfTextureMemory = dynamic_cast<const gnomon::TextureMemoryError*>(&error) != nullptr;
  }
  return end;
}

//------------------------------------------------------------------------------
/// Make the renderer's context this pass's, and find the processes that draw the picture.
/// @return why there can be no shadows, as a clause; nothing if there can
std::optional<std::string> vtkGnomonShadowPass::EnterContext(vtkRenderer* renderer)
{
  std::string whyNot = this->Internal->context.enter(this, renderer, { 3, 2 });
  try
  {
    this->Internal->updateRanks(this->Controller);
    whyNot = this->Internal->ranks->beginFrame(whyNot);
  }
  catch (const std::exception& error)
  {
    whyNot = error.what();
  }
  this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Context, whyNot);
  return whyNot.empty()                  ? std::optional<std::string>()
    : this->Internal->ranks->count() > 1 ? "a process cannot draw shadows"
                                         : "OpenGL 3.2 is not available";
}

//------------------------------------------------------------------------------
/// The frame's stages, from top to bottom.
/// @throws std::exception for a frame without shadows
void vtkGnomonShadowPass::DrawShadows(const vtkRenderState* s, gnomon::FrameEnd& end)
{
  vtkRenderer* renderer = s->GetRenderer();
  gnomon::RenderManager& manager = this->Internal->manager();
  gnomon::Complaints& complaints = this->Internal->complaints;
  gnomon::Ranks& ranks = *this->Internal->ranks;
  std::optional<tbb::global_control> threads;
  if (ranks.threads() > 0)
  {
    threads.emplace(tbb::global_control::max_allowed_parallelism, ranks.threads());
  }
  gnomon::FrameWishes wishes = this->Wishes(renderer);
  end.measuresProcesses = wishes.measureStages = ranks.isAny(wishes.measureStages);
  wishes.keepVisibility = ranks.isAny(wishes.keepVisibility);
  manager.beginFrame(wishes, ranks);

  // lights
  std::optional<gnomon::ReducedPicture> reduced(std::in_place, renderer, wishes.reductionFactor);
  this->BeginView(s);
  if (manager.readLights(renderer, this->Internal->settings->GetValues(),
        this->Internal->viewCount.areSeveral(renderer)))
  {
    // occluders
    gnomon::tellWhatIsLeftOut(this, renderer, complaints, manager.readProps(s));
    end.picture.moves = ranks.isAny(this->Moves(s));
  }

  // plan
  const vtkRenderPass* delegate = this->FindDelegate(s);
  const gnomon::FramePlan& plan = manager.plan(
    s, end.picture.moves, this->MayRefine(s), !delegate || delegate == this->Internal->steps);
  end.picture.isApproximate = plan.isApproximate;
  gnomon::tellOfPlan(this, renderer, complaints, plan, wishes.route);
  std::optional<HookMarks> marks;
  if (plan.hasShadows)
  {
    marks.emplace(this, s); // from here on, mappers call the hook
  }
  const gnomon::RouteChoice& route = plan.picture.route;
  if (plan.hasShadows && route.route == gnomon::Route::Deferred)
  {
    end.isDrawn = true;
    this->DrawDeferred(s);
  }
  else
  {
    if (plan.hasShadows)
    {
      this->ComputeShadows(s, route.route == gnomon::Route::Image);
    }
    ranks.endFrame();
    reduced.reset();
    end.isDrawn = true;
    this->DrawScene(s);
  }
  if (plan.hasShadows)
  {
    gnomon::tellOfMisfit(this, renderer, complaints,
      delegate ? delegate->GetClassName() : "the renderer", manager.endShading());
  }
  manager.endFrame(s);
  complaints.tellError(this, renderer, gnomon::Topic::Frame, "");
  this->Internal->shadowed = true;
  this->Internal->visibility = {};
  end.picture.progress = this->Internal->progress = manager.progress();
}

//------------------------------------------------------------------------------
/// End a frame that has no shadows: report why, and draw it unless it is drawn.
void vtkGnomonShadowPass::EndPlain(const vtkRenderState* s, const gnomon::FrameEnd& end)
{
  this->Internal->shadowed = false;
  this->Internal->visibility = {};
  this->Internal->report = gnomon::FrameReport{};
  this->Internal->report.route = "none";
  this->Internal->report.routeReason = *end.whyPlain;
  this->Internal->report.outOfTextureMemory = end.outOfTextureMemory;
  if (!end.isDrawn)
  {
    this->DrawPlain(s);
  }
}

//------------------------------------------------------------------------------
/// Let all processes compare their pictures with their receivers.
void vtkGnomonShadowPass::CompareSurfaces(const vtkRenderState* s, bool failed)
{
  gnomon::Ranks& ranks = *this->Internal->ranks;
  try
  {
    if (ranks.beginFrame(failed ? "it has no shadows" : "").empty())
    {
      this->Internal->manager().compareSurfaces(s);
      ranks.endFrame();
    }
  }
  catch (const std::exception& error)
  {
    ranks.fail(error.what()); // the count stays 0
  }
}

//------------------------------------------------------------------------------
/// @param onImage true on the image route
void vtkGnomonShadowPass::ComputeShadows(const vtkRenderState* s, bool onImage)
{
  gnomon::RenderManager& manager = this->Internal->manager();

  // receivers
  if (onImage)
  {
    manager.updateReceivers(s, this);
  }

  // maps
  manager.bakeMaps();

  // visibility
  if (onImage)
  {
    manager.computeVisibility();
  }

  // shading
  manager.beginShading(s);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::DrawDeferred(const vtkRenderState* s)
{
  gnomon::RenderManager& manager = this->Internal->manager();

  // shading and receivers
  const auto before = [&] { manager.beginOpaque(s); };
  const auto afterwards = [&]
  {
    manager.endOpaque(s);
    manager.bakeMaps();
    manager.computeVisibility();
    manager.drawShadows();
    manager.beginShading(s); // of the props that are left
  };
  const auto isAmong = [](vtkProp* prop)
  { return gnomon::drawnByPasses(prop) == gnomon::ByPasses::All; };
  const gnomon::AroundOpaque around(s, isAmong, before, afterwards);
  this->DrawScene(around.state());
  around.end();
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::BeginView(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  if (!this->FindDelegate(s))
  {
    this->UpdateCamera(renderer); // sets the viewport and clears
  }
  this->UpdateLightGeometry(renderer); // head lights follow the camera
  this->UpdateLights(renderer);
}

//------------------------------------------------------------------------------
/// Return the pass's settings for a frame.
gnomon::FrameWishes vtkGnomonShadowPass::Wishes(vtkRenderer* renderer) const
{
  gnomon::FrameWishes wishes;
  wishes.route = static_cast<gnomon::RouteWish>(this->Route);
  wishes.casting = static_cast<gnomon::Casting>(this->Casting);
  wishes.keepVisibility = this->KeepVisibility;
  wishes.measureStages = this->MeasureStages;
  wishes.smoothTerminators = this->SmoothTerminators;
  wishes.translucentCasters = this->TranslucentCasters;
  wishes.volumesReceive = this->VolumesReceive;
  wishes.volumeCasters = this->VolumeCasters;
  wishes.volumeResolution = this->VolumeResolution;
  wishes.maximumError = this->MaximumError;
  wishes.maximumSoftError = this->MaximumSoftError;
  wishes.timeBudget = std::max(this->TimeBudget, 0.0);
  const bool isOfWindow = this->TimeBudget == GNOMON_TIME_BUDGET_OF_WINDOW &&
    gnomon::PictureTimer::asksForSpeed(renderer->GetRenderWindow());
  wishes.windowTime = isOfWindow ? 1000.0 * renderer->GetAllocatedRenderTime() : 0.0;
  wishes.sky.intensity = this->SkyIntensity;
  wishes.sky.colour = glm::make_vec3(this->SkyColor);
  wishes.sky.model = static_cast<gnomon::SkyModel>(this->SkyModel);
  wishes.sky.upWorld = glm::make_vec3(this->SkyUp);
  wishes.sky.distanceWorld = this->SkyDistance;
  wishes.sky.directions = this->SkyDirections;
  wishes.memoryBudget = this->MemoryBudget * 1024.0 * 1024.0;
  wishes.reductionFactor = this->DelegatePass ? this->ImageReductionFactor : 1;
  wishes.factors = this->Internal->factors;
  return wishes;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::Moves(const vtkRenderState* s)
{
  return this->Interactive == INTERACTIVE_AUTO
    ? gnomon::PictureTimer::asksForSpeed(s->GetRenderer()->GetRenderWindow()) &&
      this->Internal->pictureTimer.moves(this->Internal->manager().changes(s))
    : this->Interactive == INTERACTIVE_ON;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::MayRefine(const vtkRenderState* s)
{
  return this->Interactive == INTERACTIVE_AUTO &&
    this->Internal->pictureTimer.mayRefine(s->GetRenderer()->GetRenderWindow());
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::DrawScene(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  const gnomon::WithoutVtkShadows withoutVtkShadows(renderer);
  if (vtkRenderPass* delegate = this->FindDelegate(s))
  {
    delegate->Render(s);
    this->NumberOfRenderedProps = delegate->GetNumberOfRenderedProps();
  }
  else
  {
    this->UpdateGeometry(renderer, s->GetFrameBuffer());
    this->NumberOfRenderedProps = renderer->GetNumberOfPropsRendered();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::DrawPlain(const vtkRenderState* s)
{
  this->BeginView(s);
  this->DrawScene(s);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window) // null where nothing was drawn or the context is gone; VTK asserts that it is not
  {
    this->Superclass::ReleaseGraphicsResources(window);
  }
  this->Internal->context.leave(
    [this](vtkWindow* drawnIn)
    {
      if (drawnIn)
      {
        if (this->DelegatePass)
        {
          this->DelegatePass->ReleaseGraphicsResources(drawnIn);
        }
        this->Internal->steps->ReleaseGraphicsResources(drawnIn);
      }
      this->Internal->keepLastFrame();
      this->Internal->renderers.clear();
      this->Internal->programs = std::make_unique<gnomon::PassPrograms>();
    });
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* vtkNotUsed(mapper),
  vtkProp* prop)
{
  if (!vtkVolume::SafeDownCast(prop))
  {
    this->Internal->programs->shaders.glsl().mark(vertexShader, geometryShader, fragmentShader);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PostReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper,
  vtkProp* prop)
{
  if (auto* const volume = vtkVolume::SafeDownCast(prop))
  {
    if (!gnomon::reasonAgainst(volume))
    {
      this->Internal->programs->shaders.fillVolume(fragmentShader);
    }
    return true;
  }
  // Where other passes write outputs of their own, this is not the receivers stage.
  vtkInformation* const keys = prop->GetPropertyKeys(); // null outside a frame
  const bool alone = keys && keys->Length(vtkOpenGLRenderPass::RenderPasses()) == 1;
  this->Internal->programs->shaders.fillShader(
    vertexShader, geometryShader, fragmentShader, alone, gnomon::cornersOfPrimitives(mapper, prop));
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper,
  vtkProp* prop, vtkOpenGLVertexArrayObject* vtkNotUsed(vao))
{
  if (!this->Internal->renderers.empty())
  {
    this->Internal->manager().setShaderParameters(program, mapper, prop);
  }
  return true;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkGnomonShadowPass::GetShaderStageMTime()
{
  return this->Internal->programs->shaders.stageTime();
}
