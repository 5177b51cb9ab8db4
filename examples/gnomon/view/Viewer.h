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

/// A window with a view, whose keys, mouse and handle change its state. It draws only on
/// events.
class Viewer
{
public:
  /// @param saveTo where pictures and settings are saved: "PREFIX-1.png", "PREFIX-1.json"
  Viewer(Scene scene, const ViewState& state, ViewChoices choices, std::string saveTo);

  /// Opens the window.
  void open();
  /// Lets the user act until the end.
  void run() { this->interactor_->Start(); }
  /// Presses keys one after the other, as the window would tell of them.
  void press(const std::string& keys);

  View& view() { return this->view_; }
  vtkRenderWindowInteractor* interactor() const { return this->interactor_; }
  vtkRenderWindow* window() const { return this->window_; }

  /// Writes the picture and the state under the first free number.
  /// @return their path without the ending
  /// @throws Failure
  std::string save();

private:
  void change(const std::function<void(ViewState&)>& change);
  void onChar();
  void onMove();
  bool onWheelForward(vtkObject*, unsigned long, void*);
  bool onWheelBackward(vtkObject*, unsigned long, void*);
  bool resize(int steps);
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
