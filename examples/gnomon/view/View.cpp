#include "view/View.h"

#include "Errors.h"
#include "Vec3.h"
#include "VtkMessages.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/base/Clock.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
View::View(vtkRenderWindow* window, Scene scene, const ViewState& state)
  : window_(window)
  , scene_(withoutShadowSettings(std::move(scene)))
  , renderer_(makeRenderer(this->scene_, state.size.aspect()))
  , text_(this->front_)
  , handle_(this->front_)
{
  vtkPropCollection* const props = this->renderer_->GetViewProps();
  std::vector<std::string> names;
  for (const SceneModel& model : this->scene_.models)
  {
    names.push_back(model.name);
  }
  for (const SceneProp& prop : this->scene_.props)
  {
    names.push_back(prop.name);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    this->propNames_[static_cast<vtkProp*>(props->GetItemAsObject(static_cast<int>(i)))] =
      names[i].empty() ? "model " + std::to_string(i) : names[i];
  }
  this->renderer_->SetPass(this->pass_);
  this->setUpLayers();
  this->apply(state);
}

//------------------------------------------------------------------------------
View::~View()
{
  for (vtkRenderer* const renderer :
    { this->renderer_.Get(), this->lines_.Get(), this->front_.Get() })
  {
    this->window_->RemoveRenderer(renderer);
    renderer->RemoveAllObservers();
  }
  this->window_->RemoveObservers(vtkCommand::StartEvent);
}

//------------------------------------------------------------------------------
void View::setUpLayers()
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->frusta_);
  vtkNew<vtkActor> lines;
  lines->SetMapper(mapper);
  lines->GetProperty()->LightingOff();
  lines->GetProperty()->SetLineWidth(1.5f);
  this->lines_->AddActor(lines);
  this->lines_->PreserveDepthBufferOn();

  this->window_->SetMultiSamples(0);
  this->window_->SetNumberOfLayers(3);
  this->window_->AddRenderer(this->renderer_);
  for (vtkRenderer* const layer : { this->lines_.Get(), this->front_.Get() })
  {
    layer->SetLayer(layer == this->lines_ ? 1 : 2);
    layer->InteractiveOff();
    this->window_->AddRenderer(layer);
  }
  this->lines_->SetActiveCamera(this->renderer_->GetActiveCamera());
  vtkNew<vtkCamera> camera;
  this->front_->SetActiveCamera(camera);
  this->window_->AddObserver(vtkCommand::StartEvent, this, &View::beginFrame);
  this->lines_->AddObserver(vtkCommand::StartEvent, this, &View::beforeLines);
  this->front_->AddObserver(vtkCommand::StartEvent, this, &View::beforeFront);
}

//------------------------------------------------------------------------------
void View::apply(const ViewState& state)
{
  this->state_ = state;
  const int* const size = this->window_->GetSize();
  if (size[0] != state.size.width || size[1] != state.size.height)
  {
    this->window_->SetSize(state.size.width, state.size.height);
  }
  this->window_->SetStereoRender(state.stereo);
  setCamera(this->renderer_->GetActiveCamera(), state.camera);
  this->lights_ = this->scene_.lights;
  for (std::size_t i = 0; i < this->lights_.size(); ++i)
  {
    place(this->lights_[i], state.lights[i]);
  }
  setLights(this->renderer_, this->lights_);
  if (!state.surfaces.empty())
  {
    vtkActorCollection* const actors = this->renderer_->GetActors();
    vtkCollectionSimpleIterator it;
    actors->InitTraversal(it);
    while (vtkActor* const actor = actors->GetNextActor(it))
    {
      actor->GetProperty()->SetRepresentation(
        state.surfaces == "wireframe" ? VTK_WIREFRAME : VTK_SURFACE);
    }
  }
  this->pass_->setUp(state, this->lights_, this->renderer_);
}

//------------------------------------------------------------------------------
ViewState View::state() const
{
  ViewState state = this->state_;
  const int* const size = this->window_->GetSize();
  state.size = { size[0], size[1] };
  state.stereo = this->window_->GetStereoRender();
  vtkCamera* const camera = this->renderer_->GetActiveCamera();
  camera->GetPosition(state.camera.position.data());
  camera->GetFocalPoint(state.camera.target.data());
  camera->GetViewUp(state.camera.up.data());
  state.camera.fovDegrees = camera->GetViewAngle();
  state.camera.parallelScale.reset();
  if (camera->GetParallelProjection())
  {
    state.camera.parallelScale = camera->GetParallelScale();
  }
  return state;
}

//------------------------------------------------------------------------------
const SceneLight* View::selectedLight() const
{
  return this->state_.light < this->lights_.size() ? &this->lights_[this->state_.light] : nullptr;
}

//------------------------------------------------------------------------------
Picture View::still()
{
  this->still_ = true;
  this->handle_.ball()->Highlight(0);
  this->pass_->setStill(true);
  this->pass_->setUp(this->state_, this->lights_, this->renderer_);
  do
  {
    this->window_->Render();
  } while (this->pass_->shown()->GetProgress() < 1.0);
  Picture picture = capture(this->window_);
  this->pass_->setStill(false);
  this->pass_->setUp(this->state_, this->lights_, this->renderer_);
  this->still_ = false;
  return picture;
}

//------------------------------------------------------------------------------
void View::beginFrame()
{
  this->frameStart_ = steadyMilliseconds();
  this->renderer_->ResetCameraClippingRange();
  const bool stereo = this->window_->GetStereoRender();
  if (stereo != this->stereoBefore_)
  {
    // VTK would draw the first left eye with cached matrices of a mono picture.
    this->renderer_->GetActiveCamera()->Modified();
    this->stereoBefore_ = stereo;
  }
}

//------------------------------------------------------------------------------
void View::beforeLines()
{
  this->frusta_->Initialize();
  const LightSights* const sights = this->pass_->sights();
  const LightSight* const sight =
    sights && this->state_.frusta ? sights->find(static_cast<int>(this->state_.light)) : nullptr;
  if (sight)
  {
    this->frusta_->ShallowCopy(frustumLines(sight->views, sights->snapshot().occluders().frame));
  }
}

//------------------------------------------------------------------------------
void View::beforeFront()
{
  // The scene is drawn; its time is the frame's.
  std::vector<std::string> lines = this->cornerLines();
  if (!this->still_)
  {
    this->window_->WaitForCompletion();
    char time[32];
    std::snprintf(time, sizeof time, "%.0f ms", steadyMilliseconds() - this->frameStart_);
    lines.insert(lines.begin() + 1, time);
  }
  ++this->framesDrawn_;
  this->text_.show(
    lines, captionOf(this->state_, this->pass_).legend, this->state_, this->window_->GetSize());
  vtkCamera* const camera = this->front_->GetActiveCamera();
  camera->DeepCopy(this->renderer_->GetActiveCamera());
  const SceneLight* const light = this->selectedLight();
  this->handle_.setVisible(light && this->state_.handle);
  if (light)
  {
    // Wide, and a function of the state alone, since the size of the ball follows from it.
    Vec3 eye;
    camera->GetPosition(eye.data());
    const double farthest = std::max(camera->GetDistance(), length(light->position - eye));
    camera->SetClippingRange(1e-3 * farthest, 10.0 * farthest);
    this->handle_.follow(*light);
  }
}

//------------------------------------------------------------------------------
std::vector<std::string> View::cornerLines()
{
  std::vector<std::string> lines = linesOf(this->state_, this->pass_);
  if (this->state_.probe && this->pass_->sights())
  {
    if (!this->probe_)
    {
      this->probe_ = std::make_unique<PixelProbe>();
    }
    const auto nameOf = [this](const vtkProp* prop)
    {
      const auto found = this->propNames_.find(prop);
      return found == this->propNames_.end() ? std::string("another prop") : found->second;
    };
    const std::vector<std::string> answer = this->probe_->ask(
      this->pass_->shown()->GetVisibility(), *this->pass_->sights(), nameOf, *this->state_.probe);
    lines.insert(lines.end(), answer.begin(), answer.end());
  }
  return lines;
}

//------------------------------------------------------------------------------
Picture drawWithoutScreen(const ViewState& state, Scene scene)
{
  VtkMessages messages;
  const auto window = makeOffScreenWindow();
  View view(window, std::move(scene), state);
  Picture picture = view.still();
  // The picture states what lights refuse.
  const std::vector<std::string>& misfits = view.pass()->shown()->GetReport().misfits;
  for (const std::string& error : messages.errors())
  {
    const bool isStated = std::any_of(misfits.begin(), misfits.end(),
      [&](const std::string& misfit) { return error.find(misfit) != std::string::npos; });
    if (!isStated)
    {
      throw Failure("rendering: " + error);
    }
  }
  return picture;
}

} // namespace gnomon::tool
