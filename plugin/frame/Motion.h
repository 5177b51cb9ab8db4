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

/// Sees to it that a picture at rest follows frames that move: interactor styles draw one when
/// their user lets go, but a program that draws by itself while something moves may not.
class RestingFrame
{
public:
  RestingFrame();
  ~RestingFrame();
  RestingFrame(const RestingFrame&) = delete;
  RestingFrame& operator=(const RestingFrame&) = delete;

  /// A frame of a window was drawn. After one that moves, and half a second without another frame,
  /// the window's interactor is asked for one more.
  void drawn(vtkRenderWindow* window, bool moves);

  /// Whether the frame that is drawn now is that one. It is at rest whatever the window asks for.
  bool isDue() const { return this->isDue_; }

private:
  static void onTimer(vtkObject*, unsigned long, void* self, void* timerId);
  void stop();

  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  vtkWeakPointer<vtkRenderWindow> window_;
  int timer_ = 0; ///< by the interactor's numbers; 0: none runs
  bool isDue_ = false;
};

} // namespace gnomon
