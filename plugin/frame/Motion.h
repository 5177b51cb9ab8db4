#pragma once

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkWeakPointer.h>

class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace gnomon
{

/// Whether a user drags something: the window has an interactor and is asked to be faster than this
/// asks it to be at rest. Windows without one are always at rest.
bool isDragged(vtkRenderWindow* window);

/// Draws a picture at rest after frames that move. Interactor styles draw one when their user lets
/// go, but a program that draws by itself while something moves may not.
class RestingFrame
{
public:
  RestingFrame();
  ~RestingFrame();
  RestingFrame(const RestingFrame&) = delete;
  RestingFrame& operator=(const RestingFrame&) = delete;

  /// To be called in each frame of a window. After one that moves, and half a second without
  /// another frame, the window's interactor draws one, at its update rate at rest.
  void drawn(vtkRenderWindow* window, bool moves);

private:
  static void onTimer(vtkObject*, unsigned long, void* self, void* timerId);
  void stop();

  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  vtkWeakPointer<vtkRenderWindow> window_; ///< whose frame the timer follows
  int timer_ = 0;                          ///< by the interactor's numbers; 0: none runs
};

} // namespace gnomon
