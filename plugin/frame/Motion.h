#pragma once

#include "lights/vtkGnomonVersions.h"

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

/// Draws pictures at rest after frames that move. Interactor styles draw one when the user lets go;
/// programs that animate by themselves may not. If area lights show some of their samples at first,
/// further pictures follow until all are shown.
class RestingFrame
{
public:
  RestingFrame();
  ~RestingFrame();
  RestingFrame(const RestingFrame&) = delete;
  RestingFrame& operator=(const RestingFrame&) = delete;

  /// Return true if a picture at rest may refine: the window is on screen, the frame before moved or
  /// the interactor's timer draws this one, and it will draw what is missing. Pictures that a program
  /// draws by itself later are complete.
  bool mayRefine(vtkRenderWindow* window) const;

  /// Restart the timer after each frame of a window. The window's interactor renders at its
  /// StillUpdateRate half a second after a moving frame, and at once after one that is incomplete.
  /// @param shown the share of the samples that a frame at rest shows, in [0, 1]
  void drawn(vtkRenderWindow* window, bool moves, double shown);

private:
  static void onTimer(vtkObject*, unsigned long, void* self, void* timerId);
  void stop();

  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  vtkWeakPointer<vtkRenderWindow> window_; ///< whose frame the timer follows
  int timer_ = 0;                          ///< by the interactor's numbers; 0: none runs
  bool follows_ = false; ///< whether pictures at rest are to follow the last frame
  bool moved_ = false;   ///< whether that moved
  bool draws_ = false;   ///< whether the timer draws a frame now
};

} // namespace gnomon
