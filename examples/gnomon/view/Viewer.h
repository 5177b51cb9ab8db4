#pragma once

#include "Errors.h"
#include "Files.h"
#include "view/View.h"
#include "view/ViewKeys.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkHandleWidget.h>
#include <vtkInteractorStyle.h>
#include <vtkInteractorStyleSwitch.h>
#include <vtkRenderWindowInteractor.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>

namespace gnomon::tool
{

/// A window with a view. Keys, mouse and handle change its state. It draws only on events.
class Viewer
{
public:
  /// @param saveTo the prefix of saved files: "PREFIX-1.png", "PREFIX-1.json"
  Viewer(Scene scene, const ViewState& state, ViewChoices choices, std::string saveTo)
    : view_(window_, std::move(scene), state)
    , choices_(std::move(choices))
    , saveTo_(std::move(saveTo))
  {
    this->window_->SetWindowName(("gnomon view " + state.scene).c_str());
    this->interactor_->SetRenderWindow(this->window_);
    this->style_->SetCurrentStyleToTrackballCamera();
    this->interactor_->SetInteractorStyle(this->style_);
    this->interactor_->AddObserver(vtkCommand::CharEvent, this, &Viewer::onChar, beforeAll);
    this->interactor_->AddObserver(vtkCommand::MouseMoveEvent, this, &Viewer::onMove, beforeAll);
    for (const auto wheel :
      { vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent })
    {
      this->interactor_->AddObserver(wheel, this, &Viewer::onWheel, beforeAll);
    }

    this->widget_->SetInteractor(this->interactor_);
    this->widget_->SetDefaultRenderer(this->view_.front());
    this->widget_->SetRepresentation(this->view_.handle().ball());
    this->widget_->AllowHandleResizeOff();
    this->widget_->KeyPressActivationOff(); // by `i`, which is the probe's
    this->widget_->AddObserver(vtkCommand::InteractionEvent, this, &Viewer::onDrag);
  }

  void open()
  {
    this->window_->Render();
    this->interactor_->Initialize();
    this->enableHandle();
  }

  /// Run the event loop until the user ends it.
  void run() { this->interactor_->Start(); }
  /// Press keys in turn, by the events that a window sends.
  void press(const std::string& keys)
  {
    for (const char key : keys)
    {
      this->interactor_->SetKeyEventInformation(0, 0, key, 1, nullptr);
      this->interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
      this->interactor_->InvokeEvent(vtkCommand::CharEvent);
      this->interactor_->InvokeEvent(vtkCommand::KeyReleaseEvent);
    }
  }

  View& view() { return this->view_; }
  vtkRenderWindowInteractor* interactor() const { return this->interactor_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// Save the picture and the state under the first free number.
  /// @return their path without the ending
  /// @throws Failure
  std::string save()
  {
    std::string path;
    for (int number = 1; path.empty() || std::filesystem::exists(path + ".png") ||
         std::filesystem::exists(path + ".json");
         ++number)
    {
      path = this->saveTo_ + "-" + std::to_string(number);
    }
    if (auto* const style = vtkInteractorStyle::SafeDownCast(this->style_->GetCurrentStyle()))
    {
      style->HighlightProp(nullptr); // no state knows of it
    }
    // Draw the state of the file, to the last bit.
    const std::string text = textOf(this->view_.state());
    this->view_.apply(parseState(text, path + ".json", this->view_.scene()));
    writePicture(this->view_.still(), path + ".png");
    writeWholeFile(path + ".json", text);
    this->window_->Render();
    return path;
  }

private:
  /// Before VTK's interactor styles, whose priority is 0, and its widgets, whose is 0.5.
  static constexpr float beforeAll = 1.0f;

  void change(const std::function<void(ViewState&)>& change)
  {
    ViewState state = this->view_.state();
    change(state);
    this->view_.apply(state);
    this->enableHandle(); // before the frame: the widget adds and removes the ball
    this->window_->Render();
  }

  void enableHandle()
  {
    this->widget_->SetEnabled(this->view_.selectedLight() && this->view_.state().handle);
  }

  void onChar()
  {
    const char code = this->interactor_->GetKeyCode();
    if (code == saveKey)
    {
      try
      {
        std::cout << this->save() << ".png" << std::endl;
      }
      catch (const std::exception& error) // VTK's events do not let it through
      {
        std::cerr << "gnomon: error: " << error.what() << std::endl;
      }
      return;
    }
    const ViewKey* const key = findKey(code);
    if (!key || !key->change)
    {
      return;
    }
    this->change(
      [&](ViewState& state) { key->change(state, this->view_.scene(), this->choices_); });
  }

  void onMove()
  {
    auto* const style = vtkInteractorStyle::SafeDownCast(this->style_->GetCurrentStyle());
    if (this->view_.state().probe && style && style->GetState() == VTKIS_NONE)
    {
      const int* const position = this->interactor_->GetEventPosition();
      this->change(
        [position](ViewState& state) {
          state.probe = { { position[0], position[1] } };
        });
    }
  }

  /// Resize the light by the wheel over the handle; elsewhere the wheel is VTK's.
  bool onWheel(vtkObject*, unsigned long event, void*)
  {
    const int* const position = this->interactor_->GetEventPosition();
    vtkSphereHandleRepresentation* const ball = this->view_.handle().ball();
    const bool over = this->widget_->GetEnabled() &&
      ball->ComputeInteractionState(position[0], position[1]) != vtkHandleRepresentation::Outside;
    if (over)
    {
      this->change(
        [&](ViewState& state) {
          resizeLight(
            state, this->view_.scene(), event == vtkCommand::MouseWheelForwardEvent ? 1 : -1);
        });
    }
    return over;
  }

  /// The widget draws the frame that follows.
  void onDrag()
  {
    ViewState state = this->view_.state();
    state.lights[state.light] = this->view_.handle().placeOfBall(*this->view_.selectedLight());
    if (sunOf(this->view_.scene()) == state.light)
    {
      state.sun.reset();
    }
    this->view_.apply(state);
  }

  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleSwitch> style_;
  View view_;
  ViewChoices choices_;
  std::string saveTo_;
  vtkNew<vtkHandleWidget> widget_;
};

} // namespace gnomon::tool
