#include "vtkGnomonLightSamplingPass.h"

#include "lights/Hash.h"
#include "lights/LightManager.h"
#include "lights/LightSamples.h"
#include "lights/NumberSetters.h"
#include "plugin/pass/Complaints.h"
#include "plugin/pass/PictureTimer.h"
#include "plugin/pass/PointLights.h"
#include "plugin/pass/Progress.h"
#include "plugin/scene/ShownScene.h"
#include "plugin/scene/ShownView.h"
#include "plugin/window/PassContext.h"
#include "plugin/window/PictureTarget.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/PictureMean.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"

#include <optional>
#include <stdexcept>
#include <string>

static_assert(vtkGnomonLightSamplingPass::PictureUnfinishedEvent == gnomon::pictureUnfinishedEvent);

vtkStandardNewMacro(vtkGnomonLightSamplingPass);

namespace
{

/// That VTK's physically based shading ends in.
constexpr double gammaOfPbr = 2.2;

/// The renderer's area lights with the points that stand for them.
std::vector<gnomon::PointedLight> pointedLights(gnomon::LightSet areas, int samples)
{
  if (!areas.skipped.empty())
  {
    const gnomon::SkippedLight& first = areas.skipped.front();
    throw std::runtime_error("light " + std::to_string(first.sceneIndex) + ": " + first.reason);
  }
  std::vector<gnomon::PointedLight> pointed;
  for (gnomon::ShadowLight& light : areas.lights)
  {
    if (light.lightSampling == gnomon::LightSampling::Jittered)
    {
      throw std::runtime_error(gnomon::nameOf(light) +
        ": its points are to come in opposite pairs, which a grid of cells does not; its "
        "'light_sampling' is sobol or random");
    }
    light.lightSamples = samples;
    pointed.push_back(gnomon::pointedLight(std::move(light)));
  }
  return pointed;
}

/// Refuses what the mean of pictures cannot be shown in.
void requireToBeInPlace(vtkRenderer* renderer)
{
  GLint second = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER1, &second);
  if (second != GL_NONE)
  {
    throw std::runtime_error("the pass around this one has it draw into several images, of which "
                             "it knows one; let that pass be the delegate");
  }
  if (renderer->GetPreserveDepthBuffer() || !renderer->GetErase() ||
    !renderer->GetRenderWindow()->GetErase())
  {
    throw std::runtime_error(
      "the depths of what is drawn already are to be kept (PreserveDepthBuffer, or Erase off)");
  }
}

} // namespace

//------------------------------------------------------------------------------
struct vtkGnomonLightSamplingPass::Internals
{
  explicit Internals(vtkGnomonLightSamplingPass* pass)
    : pictureTimer(pass)
  {
  }

  vtkNew<vtkRenderStepsPass> steps; ///< where there is no delegate
  gnomon::PassContext context;      ///< which holds the following two's OpenGL objects
  std::unique_ptr<gnomon::PictureTarget> target = std::make_unique<gnomon::PictureTarget>();
  std::unique_ptr<gnomon::PictureMean> mean = std::make_unique<gnomon::PictureMean>();
  gnomon::LightManager lightManager;
  std::vector<gnomon::PointedLight> lights; ///< of this frame
  std::optional<std::size_t> shown;         ///< a hash of what the mean was begun for
  gnomon::ViewCount viewCount;
  double progress = 1.0; ///< of the last frame that was no selection's
  gnomon::Complaints complaints;
  gnomon::PictureTimer pictureTimer;
};

//------------------------------------------------------------------------------
vtkGnomonLightSamplingPass::vtkGnomonLightSamplingPass()
  : Internal(new Internals(this))
{
}

//------------------------------------------------------------------------------
vtkGnomonLightSamplingPass::~vtkGnomonLightSamplingPass()
{
  this->ReleaseGraphicsResources(this->Internal->context.window());
  this->SetDelegatePass(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkGnomonLightSamplingPass, DelegatePass, vtkRenderPass);

//------------------------------------------------------------------------------
vtkRenderPass* vtkGnomonLightSamplingPass::Delegate() const
{
  return this->DelegatePass ? this->DelegatePass : this->Internal->steps;
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::DrawByDelegate(const vtkRenderState* s)
{
  this->Delegate()->Render(s);
  this->NumberOfRenderedProps = this->Delegate()->GetNumberOfRenderedProps();
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::DrawFromCentres(const vtkRenderState* s)
{
  const gnomon::PointLights atCentres(s->GetRenderer(), this->Internal->lights);
  this->DrawByDelegate(s);
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::Render(const vtkRenderState* s)
{
  Internals& internal = *this->Internal;
  vtkRenderer* renderer = s->GetRenderer();
  if (renderer->GetSelector())
  {
    this->DrawByDelegate(s);
    return;
  }
  const double progressBefore = internal.progress;
  internal.progress = this->DrawMeanOrAlone(s);
  gnomon::tellProgress(this, progressBefore, internal.progress);
  internal.pictureTimer.drawn(renderer->GetRenderWindow(), { false, false, internal.progress });
}

//------------------------------------------------------------------------------
/// Let the delegate draw alone where the mean cannot be shown.
/// @return how much of the mean this frame shows, or all of what there is
double vtkGnomonLightSamplingPass::DrawMeanOrAlone(const vtkRenderState* s)
{
  Internals& internal = *this->Internal;
  vtkRenderer* renderer = s->GetRenderer();
  try
  {
    const std::string whyNot = internal.context.enter(this, renderer, { 4, 3 });
    internal.complaints.tellError(this, renderer, gnomon::Topic::Context, whyNot);
    if (whyNot.empty())
    {
      this->UpdateLightGeometry(renderer); // head lights follow the camera
      internal.lights =
        pointedLights(internal.lightManager.collectAreas(renderer, {}), this->Samples);
      const double shown = this->DrawMean(s);
      internal.complaints.tellError(this, renderer, gnomon::Topic::Frame, "");
      return shown;
    }
  }
  catch (const std::exception& error)
  {
    internal.complaints.tellError(this, renderer, gnomon::Topic::Frame,
      std::string("The delegate draws alone: ") + error.what() + ".");
  }
  internal.shown.reset();
  this->DrawByDelegate(s);
  return 1.0;
}

//------------------------------------------------------------------------------
/// @return how much of the mean this frame shows
double vtkGnomonLightSamplingPass::DrawMean(const vtkRenderState* s)
{
  Internals& internal = *this->Internal;
  vtkRenderer* renderer = s->GetRenderer();
  if (internal.lights.empty() || this->Samples == 1)
  {
    internal.shown.reset();
    internal.lights.empty() ? this->DrawByDelegate(s) : this->DrawFromCentres(s);
    return 1.0;
  }
  requireToBeInPlace(renderer);
  const bool refines = !internal.viewCount.areSeveral(renderer) && !renderer->Transparent() &&
    this->SamplesPerFrame > 0;
  const bool begins = !refines || internal.shown != this->HashOfShown(s);
  internal.shown.reset(); // in case of an error
  if (begins)
  {
    internal.mean->begin(gnomon::sizeOf(s), this->GammaOf(s));
  }
  if (begins && refines)
  {
    this->DrawFromCentres(s);
    internal.shown = this->HashOfShown(s);
    return 0.0;
  }
  const auto all = static_cast<std::size_t>(this->Samples);
  this->AddPictures(s,
    gnomon::pairedPointsWanted(all, internal.mean->pictures(),
      refines ? static_cast<std::size_t>(this->SamplesPerFrame) : 0));
  const glm::ivec2 origin = gnomon::originOf(s);
  const glm::ivec2 size = gnomon::sizeOf(s);
  internal.mean->show(internal.target->picture(), origin);
  // As the renderer leaves them that draws for itself.
  vtkOpenGLState* state = internal.context.window()->GetState();
  state->vtkglViewport(origin.x, origin.y, size.x, size.y);
  state->vtkglScissor(origin.x, origin.y, size.x, size.y);
  if (refines)
  {
    internal.shown = this->HashOfShown(s); // which drawing may change: of a text, the texture
  }
  return static_cast<double>(internal.mean->pictures()) / static_cast<double>(all);
}

//------------------------------------------------------------------------------
/// Draw pictures from the lights' next points until there are as many as wanted.
void vtkGnomonLightSamplingPass::AddPictures(const vtkRenderState* s, std::size_t wanted)
{
  Internals& internal = *this->Internal;
  internal.target->resize(internal.context.window(), gnomon::sizeOf(s));
  gnomon::PointLights lights(s->GetRenderer(), internal.lights);
  while (internal.mean->pictures() < wanted)
  {
    lights.moveTo(internal.mean->pictures());
    internal.target->draw(this->Delegate(), s, gnomon::originOf(s));
    internal.mean->add(internal.target->picture());
  }
  this->NumberOfRenderedProps = this->Delegate()->GetNumberOfRenderedProps();
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::SetGamma(double gamma)
{
  gnomon::setClamped(this, "Gamma", gamma, 0.0, 10.0, this->Gamma);
}

//------------------------------------------------------------------------------
double vtkGnomonLightSamplingPass::GammaOf(const vtkRenderState* s) const
{
  if (this->Gamma > 0.0)
  {
    return this->Gamma;
  }
  vtkNew<vtkPropCollection> parts;
  for (int i = 0; i < s->GetPropArrayCount(); ++i)
  {
    s->GetPropArray()[i]->GetActors(parts);
  }
  vtkCollectionSimpleIterator iterator;
  parts->InitTraversal(iterator);
  while (vtkProp* part = parts->GetNextProp(iterator))
  {
    auto* actor = vtkActor::SafeDownCast(part);
    if (actor && actor->GetProperty()->GetInterpolation() == VTK_PBR)
    {
      return gammaOfPbr;
    }
  }
  return 1.0;
}

//------------------------------------------------------------------------------
/// Return a hash of all that a picture from given points of the lights depends on.
std::size_t vtkGnomonLightSamplingPass::HashOfShown(const vtkRenderState* s)
{
  vtkRenderer* renderer = s->GetRenderer();
  std::size_t seed = gnomon::hashOfShownScene(renderer);
  gnomon::hashView(seed, gnomon::shownView(renderer, {}).camera, gnomon::sizeOf(s));
  gnomon::hashCombine(seed, gnomon::samplesOfBoundFramebuffer());
  gnomon::hashCombine(seed, this->GetMTime());
  gnomon::hashCombine(seed, this->Delegate()->GetMTime());
  return seed;
}

//------------------------------------------------------------------------------
double vtkGnomonLightSamplingPass::GetProgress() const
{
  return this->Internal->progress;
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::ReleaseGraphicsResources(vtkWindow* window)
{
  if (window) // null where nothing was drawn or the context is gone; VTK asserts that it is not
  {
    this->Superclass::ReleaseGraphicsResources(window);
  }
  this->Internal->context.leave(
    [this](vtkOpenGLRenderWindow* drawnIn)
    {
      Internals& internal = *this->Internal;
      if (drawnIn)
      {
        this->Delegate()->ReleaseGraphicsResources(drawnIn);
      }
      internal.target = std::make_unique<gnomon::PictureTarget>();
      internal.mean = std::make_unique<gnomon::PictureMean>();
      internal.shown.reset();
    });
}

//------------------------------------------------------------------------------
void vtkGnomonLightSamplingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "DelegatePass: " << (this->DelegatePass ? this->DelegatePass->GetClassName() : "(none)")
     << "\n";
  os << indent << "Samples: " << this->Samples << "\n";
  os << indent << "SamplesPerFrame: " << this->SamplesPerFrame << "\n";
  os << indent << "Gamma: " << this->Gamma << "\n";
  os << indent << "Progress: " << this->GetProgress() << "\n";
}
