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

/// True while a user drags: the window's desired update rate exceeds the StillUpdateRate of its
/// interactor. Windows without an interactor are always at rest.
bool isDragged(vtkRenderWindow* window);

/// Draws pictures at rest after moving frames. Interactor styles draw one when the user lets go,
/// but programs that animate by themselves may not. If area lights first show some of their
/// samples, further pictures follow until all are shown.
class RestingFrame
{
public:
  RestingFrame();
  ~RestingFrame();
  RestingFrame(const RestingFrame&) = delete;
  RestingFrame& operator=(const RestingFrame&) = delete;

  /// True if a picture at rest may refine. The window must be on screen, and the timer must be able
  /// to draw the missing samples. Also, the last frame moved or the interactor's timer draws this
  /// one. Later pictures that a program draws by itself are complete.
  bool mayRefine(vtkRenderWindow* window) const;

  /// Restart the timer after each frame of a window. The window's interactor renders at its
  /// StillUpdateRate half a second after a moving frame, and at once after an incomplete one.
  /// @param shown the share of the samples that a frame at rest shows, in [0, 1]
  void drawn(vtkRenderWindow* window, bool moves, double shown);

private:
  static void onTimer(vtkObject*, unsigned long, void* self, void* timerId);
  void stop();

  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  vtkWeakPointer<vtkRenderWindow> window_; ///< the window of the timer
  int timer_ = 0;                          ///< the interactor's number; 0: none runs
  bool follows_ = false;                   ///< true if pictures at rest follow the last frame
  bool moved_ = false;                     ///< true if the last frame moved
  bool draws_ = false;                     ///< true while the timer draws a frame
};

} // namespace gnomon
