#pragma once

#include "lights/VtkVersions.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkWeakPointer.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
class vtkRenderWindowInteractor;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// Return true while a user drags: the window's desired update rate exceeds the StillUpdateRate of
/// its interactor. Windows without an interactor are always at rest.
bool isDragged(vtkRenderWindow* window);

/// Draws a picture at rest after frames that move. Interactor styles draw one when the user lets go;
/// programs that animate by themselves may not.
class RestingFrame
{
public:
  RestingFrame();
  ~RestingFrame();
  RestingFrame(const RestingFrame&) = delete;
  RestingFrame& operator=(const RestingFrame&) = delete;

  /// Restart the timer in each frame of a window. Half a second after a moving frame, the window's
  /// interactor renders once at its StillUpdateRate.
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
