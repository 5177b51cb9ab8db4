#pragma once

#include "view/View.h"
#include "view/ViewKeys.h"

#include <vtkCallbackCommand.h>
#include <vtkHandleWidget.h>
#include <vtkInteractorStyleSwitch.h>
#include <vtkRenderWindowInteractor.h>

#include <functional>
#include <string>

namespace gnomon::tool
{

/// A window with a view. Keys, mouse and handle change its state. It draws only on events.
class Viewer
{
public:
  /// @param saveTo the prefix of saved files: "PREFIX-1.png", "PREFIX-1.json"
  Viewer(Scene scene, const ViewState& state, ViewChoices choices, std::string saveTo);

  /// Open the window.
  void open();
  /// Run the event loop until the user ends it.
  void run() { this->interactor_->Start(); }
  /// Press keys in turn, by the events that a window sends.
  void press(const std::string& keys);

  View& view() { return this->view_; }
  vtkRenderWindowInteractor* interactor() const { return this->interactor_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// Save the picture and the state under the first free number.
  /// @return their path without the ending
  /// @throws Failure
  std::string save();

private:
  void change(const std::function<void(ViewState&)>& change);
  void enableHandle();
  void onChar();
  void onMove();
  bool onWheel(vtkObject*, unsigned long event, void*);
  void onDrag();

  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleSwitch> style_;
  View view_;
  ViewChoices choices_;
  std::string saveTo_;
  vtkNew<vtkHandleWidget> widget_;
};

} // namespace gnomon::tool
