#pragma once

#include "Errors.h"
#include "ImageFile.h"
#include "Scene.h"
#include "Vec3.h"
#include "VtkMessages.h"
#include "view/LightHandle.h"
#include "view/PixelProbe.h"
#include "view/ViewPass.h"
#include "view/ViewState.h"
#include "view/ViewText.h"

#include "plugin/vtkGnomonOffScreenWindow.h"
#include "shadowtech/base/Clock.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A state's picture in a window, with or without an interactor. A ViewPass draws the scene. Layers
/// in front of it hold the frusta, then the handle and the text.
class View
{
public:
  /// @param window gets the renderers; must outlive this
  View(vtkRenderWindow* window, Scene scene, const ViewState& state)
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

  ~View()
  {
    for (vtkRenderer* const renderer :
      { this->renderer_.Get(), this->lines_.Get(), this->front_.Get() })
    {
      this->window_->RemoveRenderer(renderer);
      renderer->RemoveAllObservers();
    }
    this->window_->RemoveObservers(vtkCommand::StartEvent);
  }

  View& operator=(View&&) = delete; ///< nor copied

  /// Show a state from the next frame on.
  void apply(const ViewState& state)
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

  /// Return the state of the window: the last one applied, with the changes of VTK's interaction.
  ViewState state() const
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

  /// Draw the state with all samples, and without the frame's time, which differs between frames.
  Picture still()
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

  const Scene& scene() const { return this->scene_; }
  vtkRenderWindow* window() const { return this->window_; }
  vtkRenderer* front() const { return this->front_; }
  ViewPass* pass() const { return this->pass_; }
  LightHandle& handle() { return this->handle_; }
  /// Return the selected light at its place in the state; null in a scene without lights.
  const SceneLight* selectedLight() const
  {
    return this->state_.light < this->lights_.size() ? &this->lights_[this->state_.light] : nullptr;
  }

  ///@{
  /// Of the last frame.
  std::string cornerText() const { return this->text_.corner(); }
  int framesDrawn() const { return this->framesDrawn_; } ///< since the start
  ///@}

private:
  void setUpLayers()
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

  void beginFrame()
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

  void beforeLines()
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

  void beforeFront()
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
    this->text_.show(lines, ViewText::captionOf(this->state_, this->pass_).legend, this->state_,
      this->window_->GetSize());
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

  std::vector<std::string> cornerLines()
  {
    std::vector<std::string> lines = ViewText::linesOf(this->state_, this->pass_);
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

  vtkRenderWindow* window_;
  const Scene scene_; ///< as loaded, without its lights' shadow settings
  ViewState state_;
  std::vector<SceneLight> lights_; ///< as the state places them
  vtkSmartPointer<vtkRenderer> renderer_;
  std::map<const vtkProp*, std::string> propNames_;
  vtkNew<vtkRenderer> lines_; ///< shares the scene's depths
  vtkNew<vtkRenderer> front_; ///< its camera has clipping planes of its own
  vtkNew<ViewPass> pass_;
  vtkNew<vtkPolyData> frusta_;
  ViewText text_;
  LightHandle handle_;
  std::unique_ptr<PixelProbe> probe_; ///< once asked for
  bool still_ = false;
  bool stereoBefore_ = false; ///< of the last frame
  double frameStart_ = 0.0;   ///< by steadyMilliseconds()
  int framesDrawn_ = 0;
};

/// Draw a state's picture without a screen.
/// @throws BadInput, Failure
inline Picture drawWithoutScreen(const ViewState& state, Scene scene)
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
