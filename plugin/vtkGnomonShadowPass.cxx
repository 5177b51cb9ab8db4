#include "vtkGnomonShadowPass.h"

#include "lights/SettingsTable.h"
#include "plugin/frame/Complaints.h"
#include "plugin/plan/FrameWishes.h"
#include "plugin/frame/OtherFrames.h"
#include "plugin/frame/PictureTimer.h"
#include "plugin/frame/Progress.h"
#include "plugin/frame/ReceiverDrawing.h"
#include "plugin/frame/RenderManager.h"
#include "plugin/frame/ReportText.h"
#include "plugin/frame/VisibilityData.h"
#include "plugin/ranks/Ranks.h"
#include "plugin/scene/DrawnLookup.h"
#include "plugin/scene/ShownView.h"
#include "plugin/vtkGnomonVisibilityImages.h"
#include "plugin/window/AroundOpaque.h"
#include "plugin/window/PassContext.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include "vtkGnomonShadowSettings.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <list>
#include <optional>
#include <string>
#include <utility>

static_assert(vtkGnomonShadowPass::PictureUnfinishedEvent == gnomon::pictureUnfinishedEvent);

vtkStandardNewMacro(vtkGnomonShadowPass);

namespace
{

/// Whether a picture has pixels at all; VTK draws nothing of others.
bool hasPixels(const vtkRenderState* s)
{
  int size[2];
  int origin[2];
  s->GetRenderer()->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  return s->GetFrameBuffer() || (size[0] > 0 && size[1] > 0);
}

/// Whether an outer pass has the scene drawn into a framebuffer of its own. Not all of them say so
/// in the render state.
bool drawsIntoOuterPass(const vtkRenderState* s)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(s->GetRenderer()->GetRenderWindow());
  if (!window)
  {
    return false;
  }
  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  return static_cast<GLuint>(framebuffer) != window->GetRenderFramebuffer()->GetFBOIndex();
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
struct vtkGnomonShadowPass::Internals
{
  explicit Internals(vtkGnomonShadowPass* pass)
    : pictureTimer(pass)
    , otherFrames([this](vtkRenderer* renderer) { this->tellOfOther(renderer); })
  {
  }

  /// A renderer's frames: each renderer has values of its own.
  struct RendererFrames
  {
    vtkWeakPointer<vtkRenderer> renderer;
    std::unique_ptr<gnomon::RenderManager> manager;
  };

  vtkSmartPointer<vtkGnomonShadowSettings> settings =
    vtkSmartPointer<vtkGnomonShadowSettings>::New(); ///< of lights that say nothing
  std::unique_ptr<gnomon::PassPrograms> programs = std::make_unique<gnomon::PassPrograms>();
  std::list<RendererFrames> renderers; ///< those drawn so far, the last one first
  gnomon::ViewCount viewCount;
  vtkNew<vtkRenderStepsPass> steps; ///< draws into the framebuffers of outer passes
  bool shadowed = false;            ///< whether the last frame was the manager's, which has it
  ///@{
  /// Of a frame that was drawn without the manager, or that the manager's resources outlived.
  gnomon::FrameReport report;
  gnomon::VisibilityImages visibility;
  ///@}
  double progress = 1.0; ///< of the last frame that was no selection's
  gnomon::Complaints complaints;

  std::optional<gnomon::CostFactors> factors; ///< none: the default ones
  gnomon::PictureTimer pictureTimer;
  gnomon::OtherFrames otherFrames;

  std::unique_ptr<gnomon::Ranks> ranks; ///< of the last controller with several processes, or null

  gnomon::PassContext context; ///< which holds the managers' GL objects

  gnomon::RenderManager& managerOf(vtkRenderer* renderer);
  gnomon::Ranks* updateRanks(vtkMultiProcessController* controller);
  void keepLastFrame();
  void tellOfOther(vtkRenderer* renderer);
  gnomon::RenderManager& manager() { return *this->renderers.front().manager; }
};

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
/// The processes of a controller; null if there is one at most. Collective where they change.
gnomon::Ranks* vtkGnomonShadowPass::Internals::updateRanks(vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return nullptr; // keeps those of before: the others need not know of this frame
  }
  if (!this->ranks || this->ranks->controller() != controller)
  {
    this->ranks = std::make_unique<gnomon::Ranks>(controller);
  }
  return this->ranks.get();
}

namespace
{

/// Has a renderer draw into the lower left part of its viewport, for as long as this lives.
class ReducedPicture
{
public:
  ReducedPicture(vtkRenderer* renderer, int factor)
    : renderer_(renderer)
  {
    renderer->GetViewport(this->before_);
    const int* const window = renderer->GetRenderWindow()->GetActualSize();
    if (factor == 1 || window[0] < 1 || window[1] < 1)
    {
      return;
    }
    int size[2];
    int origin[2];
    renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
    const double* const tile = renderer->GetRenderWindow()->GetTileViewport();
    double viewport[4];
    for (int axis = 0; axis < 2; ++axis)
    {
      const int last = origin[axis] + std::max(size[axis] / factor, 1);
      const double side = tile[axis + 2] - tile[axis];
      viewport[axis] = std::max(this->before_[axis], tile[axis]);
      viewport[axis + 2] = tile[axis] + side * last / window[axis];
    }
    renderer->SetViewport(viewport);
  }
  ~ReducedPicture()
  {
    this->renderer_->SetViewport(this->before_); // which tells observers of changes alone
  }
  ReducedPicture(const ReducedPicture&) = delete;
  ReducedPicture& operator=(const ReducedPicture&) = delete;

private:
  vtkRenderer* renderer_;
  double before_[4];
};

struct RendererAccess : vtkRenderer
{
  static vtkTypeBool& useShadows(vtkRenderer* renderer)
  {
    return renderer->*(&RendererAccess::UseShadows);
  }
};

/// Switches a renderer's UseShadows off for as long as this lives: vtkOpenGLRenderer's
/// UpdateGeometry would draw the props with vtkShadowMapPass, within our own frame. Naming the
/// member through a subclass gives access to it; the renderer's own function would tell all
/// observers that the renderer was modified.
class WithoutVtkShadows
{
public:
  explicit WithoutVtkShadows(vtkRenderer* renderer)
    : useShadows_(RendererAccess::useShadows(renderer))
    , before_(this->useShadows_)
  {
    this->useShadows_ = 0;
  }
  ~WithoutVtkShadows() { this->useShadows_ = this->before_; }
  WithoutVtkShadows(const WithoutVtkShadows&) = delete;
  WithoutVtkShadows& operator=(const WithoutVtkShadows&) = delete;

private:
  vtkTypeBool& useShadows_;
  vtkTypeBool before_;
};

/// Of the light that has the least of its points in the picture.
double leastProgress(const gnomon::FrameReport& report)
{
  double progress = 1.0;
  for (const gnomon::LightReport& light : report.lights)
  {
    progress = std::min(progress, light.progress);
  }
  return progress;
}

} // namespace

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
  const gnomon::ShownPicture picture = this->RenderPicture(s);
  this->Internal->pictureTimer.drawn(renderer->GetRenderWindow(),
    this->Interactive == INTERACTIVE_AUTO ? picture : gnomon::ShownPicture{});
}

//------------------------------------------------------------------------------
gnomon::ShownPicture vtkGnomonShadowPass::RenderPicture(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  gnomon::ShownPicture picture;
  const double progressBefore = this->Internal->progress;
  this->Internal->progress = 1.0;
  if (this->ObeyUseShadows && !renderer->GetUseShadows())
  {
    this->RenderPlain(s, "the renderer's UseShadows is off");
    return picture;
  }
  if (!hasPixels(s))
  {
    this->TellPlain("its viewport has no pixels");
    return picture;
  }
  std::string whyNot = this->Internal->context.enter(this, renderer, { 3, 2 });
  gnomon::Ranks* ranks = nullptr;
  try
  {
    ranks = this->Internal->updateRanks(this->Controller);
    whyNot = ranks ? ranks->beginFrame(whyNot) : whyNot;
  }
  catch (const std::exception& error)
  {
    whyNot = error.what();
  }
  this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Context, whyNot);
  if (!whyNot.empty())
  {
    this->RenderPlain(s, ranks ? "a process cannot draw shadows" : "OpenGL 3.2 is not available");
    return picture;
  }

  gnomon::RenderManager& manager = this->Internal->managerOf(renderer);
  bool marked = false;
  bool drawn = false;
  bool failed = false;
  bool again = false;
  bool outOfTextureMemory = false;
  bool measures = false; // on all processes
  std::optional<tbb::global_control> threads;
  try
  {
    gnomon::FrameWishes wishes = this->Wishes();
    if (ranks)
    {
      threads.emplace(tbb::global_control::max_allowed_parallelism, ranks->threads());
      measures = wishes.measureStages = ranks->isAny(wishes.measureStages);
      wishes.keepVisibility = ranks->isAny(wishes.keepVisibility);
    }
    manager.beginFrame(wishes, ranks);

    // lights
    std::optional<ReducedPicture> reduced(std::in_place, renderer, wishes.reductionFactor);
    this->BeginView(s);
    const bool goesOn = manager.collectLights(renderer, this->Internal->settings->GetValues(),
      this->Internal->viewCount.areSeveral(renderer));
    this->TellOfLights(renderer);
    if (goesOn)
    {
      // occluders
      manager.collectOccluders(s);
      this->TellWhatIsLeftOut(renderer);

      // choice
      picture.moves = this->Moves(s);
      picture.isApproximate = manager.chooseTechniques(picture.moves, this->MayRefine(s));

      // From here on, mappers call the hook.
      const vtkRenderPass* delegate = this->FindDelegate(s);
      const bool isTaken = manager.chooseRoute(s, !delegate || delegate == this->Internal->steps);
      this->TellOfRoute(renderer, isTaken);
      nameInKeys(s, this);
      marked = true;
    }
    if (goesOn && manager.route() == gnomon::Route::Deferred)
    {
      drawn = true;
      this->DrawDeferred(s);
    }
    else
    {
      if (goesOn)
      {
        this->ComputeShadows(s);
      }
      if (ranks)
      {
        ranks->endFrame();
      }
      reduced.reset();
      drawn = true;
      this->DrawScene(s);
    }
    if (goesOn)
    {
      this->TellOfResolution(s, manager.endShading());
    }
    manager.endFrame(s);
    this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Frame, "");
    this->Internal->shadowed = true;
    this->Internal->visibility = {};
    this->Internal->progress = leastProgress(manager.report());
    picture.progress = this->Internal->progress;
  }
  catch (const gnomon::FrameMustBeDrawnAgain&)
  {
    manager.abandonFrame();
    again = true;
  }
  catch (const std::exception& error)
  {
    if (ranks)
    {
      ranks->fail(error.what());
    }
    this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Frame,
      std::string("The scene is drawn without shadows: ") + error.what());
    manager.abandonFrame();
    failed = true;
    outOfTextureMemory = dynamic_cast<const gnomon::TextureMemoryError*>(&error) != nullptr;
  }
  if (marked)
  {
    this->PostRender(s);
  }
  if (again)
  {
    return this->RenderPicture(s);
  }
  if (failed)
  {
    picture = {};
    this->TellPlain("an error was met");
    this->Internal->report.outOfTextureMemory = outOfTextureMemory;
    if (!drawn)
    {
      this->DrawPlain(s);
    }
  }
  else
  {
    gnomon::tellProgress(this, progressBefore, this->Internal->progress);
  }
  if (measures)
  {
    this->CompareSurfaces(s, failed);
  }
  return picture;
}

//------------------------------------------------------------------------------
/// Has all processes compare what they have drawn with what they have traced.
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
void vtkGnomonShadowPass::ComputeShadows(const vtkRenderState* s)
{
  gnomon::RenderManager& manager = this->Internal->manager();
  const bool onImage = manager.route() == gnomon::Route::Image;

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

    // maps
    manager.bakeMaps();

    // visibility
    manager.computeVisibility();

    // shading
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
void vtkGnomonShadowPass::TellOfLights(vtkRenderer* renderer)
{
  gnomon::Complaints& complaints = this->Internal->complaints;
  const gnomon::FrameReport& report = this->Internal->manager().report();
  for (const std::string& misfit : complaints.news(renderer, gnomon::Topic::Lights, report.misfits))
  {
    gnomon::tell(this, vtkCommand::ErrorEvent, misfit + ".");
  }
  const std::string warning = complaints.news(renderer, gnomon::Topic::Headlight,
    report.headlightIsAlone
      ? "The only light is a headlight, which casts no shadow that could be seen. Add a "
        "light, as vtkGnomonLightPlacement::MakeKeyLight() makes it, or have the "
        "headlight cast by vtkGnomonLightKeys::SetCasts()."
      : "");
  gnomon::tell(this, vtkCommand::WarningEvent, warning);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::TellWhatIsLeftOut(vtkRenderer* renderer)
{
  const std::string kinds = gnomon::listOf(this->Internal->complaints.news(
    renderer, gnomon::Topic::LeftOut, this->Internal->manager().report().leftOut));
  if (!kinds.empty())
  {
    gnomon::tell(this, vtkCommand::WarningEvent,
      "Visible and lit, but without shadows: " + kinds +
        ". See docs/guide/what_casts.md for what casts and receives.");
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::TellOfRoute(vtkRenderer* renderer, bool isTaken)
{
  std::string error;
  if (!isTaken)
  {
    error = std::string("The ") + (this->Route == ROUTE_INLINE ? "inline" : "deferred") +
      " route was asked for, but " + this->Internal->manager().report().routeReason +
      "; this frame takes the image route.";
  }
  this->Internal->complaints.tellError(this, renderer, gnomon::Topic::Route, error);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::TellOfResolution(const vtkRenderState* s, bool isReceivers)
{
  std::string error;
  if (!isReceivers)
  {
    const vtkRenderPass* delegate = this->FindDelegate(s);
    error = std::string("Props were drawn without shadows: ") +
      (delegate ? delegate->GetClassName() : "the renderer") +
      " shades at another resolution than the receivers were drawn, and " +
      this->Internal->manager().report().routeReason +
      ". Let such a pass have this one as its delegate instead.";
  }
  this->Internal->complaints.tellError(this, s->GetRenderer(), gnomon::Topic::Resolution, error);
}

//------------------------------------------------------------------------------
vtkRenderPass* vtkGnomonShadowPass::FindDelegate(const vtkRenderState* s)
{
  if (s->GetRenderer()->GetSelector())
  {
    return nullptr;
  }
  if (!this->DelegatePass && drawsIntoOuterPass(s))
  {
    // What the renderer draws by itself copies depths between framebuffers of its own formats.
    return this->Internal->steps;
  }
  return this->DelegatePass;
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
/// What the pass is set to.
gnomon::FrameWishes vtkGnomonShadowPass::Wishes() const
{
  gnomon::FrameWishes wishes;
  wishes.route = static_cast<gnomon::RouteWish>(this->Route);
  wishes.casting = static_cast<gnomon::Casting>(this->Casting);
  wishes.keepVisibility = this->KeepVisibility;
  wishes.measureStages = this->MeasureStages;
  wishes.smoothTerminators = this->SmoothTerminators;
  wishes.maximumError = this->MaximumError;
  wishes.maximumSoftError = this->MaximumSoftError;
  wishes.timeBudget = this->TimeBudget;
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
  const WithoutVtkShadows withoutVtkShadows(renderer);
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
void vtkGnomonShadowPass::TellPlain(const char* reason)
{
  this->Internal->shadowed = false;
  this->Internal->visibility = {};
  this->Internal->report = gnomon::FrameReport{};
  this->Internal->report.route = "none";
  this->Internal->report.routeReason = reason;
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::DrawPlain(const vtkRenderState* s)
{
  this->BeginView(s);
  this->DrawScene(s);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::RenderPlain(const vtkRenderState* s, const char* reason)
{
  this->TellPlain(reason);
  this->DrawPlain(s);
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
void vtkGnomonShadowPass::SetMaximumError(double share)
{
  this->SetNumber("MaximumError", share, 1.0, this->MaximumError);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMaximumSoftError(double rootMeanSquare)
{
  this->SetNumber("MaximumSoftError", rootMeanSquare, 1.0, this->MaximumSoftError);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetTimeBudget(double milliseconds)
{
  this->SetNumber("TimeBudget", milliseconds, VTK_DOUBLE_MAX, this->TimeBudget);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMemoryBudget(double mebibytes)
{
  this->SetNumber("MemoryBudget", mebibytes, 1e9, this->MemoryBudget);
}

//------------------------------------------------------------------------------
/// Sets a number in [0, most]; anything else is an error and changes nothing.
void vtkGnomonShadowPass::SetNumber(const char* name, double value, double most, double& number)
{
  if (!(value >= 0.0 && value <= most))
  {
    vtkErrorMacro(<< name << " was to be " << value << ", expected a number in [0, " << most
                  << "].");
    return;
  }
  if (number != value)
  {
    number = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::ReadCostFactors(const char* path)
{
  try
  {
    this->Internal->factors =
      path && *path ? std::optional(gnomon::readFactors(path)) : std::nullopt;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Cost factors: " << error.what() << ".");
  }
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetSettings(vtkGnomonShadowSettings* settings)
{
  vtkSmartPointer<vtkGnomonShadowSettings>& held = this->Internal->settings;
  if (settings != held)
  {
    held = settings;
    if (!settings)
    {
      held = vtkSmartPointer<vtkGnomonShadowSettings>::New();
    }
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkGnomonShadowSettings* vtkGnomonShadowPass::GetSettings()
{
  return this->Internal->settings;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetSetting(const char* name, const char* value)
{
  const vtkMTimeType before = this->Internal->settings->GetMTime();
  const bool isSet = this->Internal->settings->TrySetting(name, value);
  if (!isSet)
  {
    vtkErrorMacro(<< this->GetSettingError() << ".");
  }
  else if (this->Internal->settings->GetMTime() != before)
  {
    this->Modified();
  }
  return isSet;
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetSettingError() const
{
  return this->Internal->settings->GetSettingError();
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetSetting(const char* name) const
{
  return this->Internal->settings->GetSetting(name);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::SetMapSize(int mapSizeTexels)
{
  const vtkMTimeType before = this->Internal->settings->GetMTime();
  this->Internal->settings->SetMapSize(mapSizeTexels);
  if (this->Internal->settings->GetMTime() != before)
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGnomonShadowPass::GetMapSize() const
{
  return this->Internal->settings->GetMapSize();
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::SetTechnique(const char* name)
{
  return this->SetSetting("technique", name);
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechnique() const
{
  const std::string& technique = this->Internal->settings->GetValues().technique;
  return technique.empty() ? gnomon::defaultTechnique : technique.c_str();
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetDefaultTechnique()
{
  return gnomon::defaultTechnique;
}

//------------------------------------------------------------------------------
int vtkGnomonShadowPass::GetNumberOfTechniques()
{
  return static_cast<int>(gnomon::registry().size());
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueName(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].name.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const char* vtkGnomonShadowPass::GetTechniqueSummary(int index)
{
  return index >= 0 && index < GetNumberOfTechniques()
    ? gnomon::registry()[static_cast<std::size_t>(index)].summary.c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
const gnomon::FrameReport& vtkGnomonShadowPass::GetReport() const
{
  return this->Internal->shadowed ? this->Internal->manager().report() : this->Internal->report;
}

//------------------------------------------------------------------------------
double vtkGnomonShadowPass::GetProgress() const
{
  return this->Internal->progress;
}

//------------------------------------------------------------------------------
const gnomon::VisibilityImages& vtkGnomonShadowPass::GetVisibility() const
{
  return this->Internal->shadowed ? this->Internal->manager().visibility()
                                  : this->Internal->visibility;
}

//------------------------------------------------------------------------------
std::string vtkGnomonShadowPass::GetReportText() const
{
  return gnomon::textOf(this->GetReport());
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::GetReportTable(vtkTable* lights) const
{
  if (!lights)
  {
    vtkErrorMacro("The report needs a table to fill.");
    return;
  }
  gnomon::fillTable(this->GetReport(), lights);
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::GetVisibilityImage(vtkImageData* image) const
{
  if (!image)
  {
    vtkErrorMacro("The visibility needs an image to fill.");
    return;
  }
  gnomon::fillImage(this->GetVisibility(), image);
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PreReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* vtkNotUsed(mapper),
  vtkProp* vtkNotUsed(prop))
{
  this->Internal->programs->shaders.markShader(vertexShader, geometryShader, fragmentShader);
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonShadowPass::PostReplaceShaderValues(std::string& vertexShader,
  std::string& geometryShader, std::string& fragmentShader, vtkAbstractMapper* mapper,
  vtkProp* prop)
{
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
vtkMTimeType vtkGnomonShadowPass::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internal->settings->GetMTime());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkGnomonShadowPass::GetShaderStageMTime()
{
  return this->Internal->programs->shaders.stageTime();
}

//------------------------------------------------------------------------------
void vtkGnomonShadowPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const routes[] = { "auto", "inline", "image", "deferred" };
  os << indent << "Settings:\n";
  this->Internal->settings->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Route: " << routes[this->Route] << "\n";
  os << indent << "SmoothTerminators: " << (this->SmoothTerminators ? "on" : "off") << "\n";
  const char* const castings[] = { "auto", "all", "brightest" };
  os << indent << "Casting: " << castings[this->Casting] << "\n";
  const char* const interactives[] = { "auto", "off", "on" };
  os << indent << "Interactive: " << interactives[this->Interactive] << "\n";
  os << indent << "MaximumError: " << this->MaximumError << "\n";
  os << indent << "MaximumSoftError: " << this->MaximumSoftError << "\n";
  os << indent << "TimeBudget: " << this->TimeBudget << " ms\n";
  os << indent << "MemoryBudget: " << this->MemoryBudget << " MiB\n";
  os << indent << "CostFactors: " << (this->Internal->factors ? "read" : "default") << "\n";
  os << indent << "MeasureStages: " << (this->MeasureStages ? "on" : "off") << "\n";
  os << indent << "KeepVisibility: " << (this->KeepVisibility ? "on" : "off") << "\n";
  os << indent
     << "DelegatePass: " << (this->DelegatePass ? this->DelegatePass->GetClassName() : "(none)")
     << "\n";
  os << indent << "Controller: " << (this->Controller ? this->Controller->GetClassName() : "(none)")
     << "\n";
  os << indent << "ImageReductionFactor: " << this->ImageReductionFactor << "\n";
  os << indent << "ObeyUseShadows: " << (this->ObeyUseShadows ? "on" : "off") << "\n";
  os << indent << "Progress: " << this->GetProgress() << "\n";
  os << indent << "Last frame's route: " << this->GetReport().route << "\n";
}
