#pragma once

#include "lights/vtkGnomonVersions.h"
#include "plugin/plan/PictureSchedule.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkWeakPointer.h>

#include <memory>
#include <thread>

VTK_ABI_NAMESPACE_BEGIN
class vtkInteractorStyle;
class vtkObject;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A pass's event where no timer can draw the next picture. Its call data points to an int: the
/// milliseconds after which the program is to draw.
constexpr unsigned long pictureUnfinishedEvent = 1000 + 731; // vtkCommand::UserEvent and more

/// Asks for the pictures that a PictureSchedule finds due, by one-shot timers of the window's
/// interactor. VTK's interactors allow this (9.1 to 9.6):
///
/// - X of 9.1 walks its map of timers while one fires. A handler may start timers, but destroying
///   the one that fires leaves the walk in freed memory. X removes a one-shot after its event.
///   X of 9.2 and later walks a copy.
/// - Qt, Win32 and Cocoa remove a one-shot after its event, and allow anything in it.
/// - vtkGenericRenderWindowInteractor names the timer that was started last in the process,
///   whichever fires. Its clients: wx fires after 10 ms, whatever the duration, and cannot destroy
///   timers. PyQt has one timer, and fires a one-shot until it is destroyed.
///
/// So no timer is destroyed in its first event, any TimerEvent may draw, and a style that acts does
/// not see the events of this timer.
class PictureTimer
{
public:
  /// @param pass sends pictureUnfinishedEvent
  explicit PictureTimer(vtkObject* pass);
  ~PictureTimer();
  PictureTimer(const PictureTimer&) = delete;
  PictureTimer& operator=(const PictureTimer&) = delete;

  /// True if a window asks for fast frames, as interactor styles have it do while a user drags: its
  /// DesiredUpdateRate exceeds its interactor's StillUpdateRate.
  static bool asksForSpeed(vtkRenderWindow* window);

  /// True if a frame of such a window moves (PictureSchedule::moves()).
  bool moves(bool changed);

  /// True if a frame at rest may be unfinished, as more frames will follow. The window must be on
  /// screen, and a timer must have fired.
  bool mayRefine(vtkRenderWindow* window);

  /// Note a drawn frame of a window, and see to the next one if the picture is not finished.
  void drawn(vtkRenderWindow* window, const ShownPicture& picture);

private:
  void follow(vtkRenderWindow* window);
  vtkInteractorStyle* style() const;
  bool acts() const;
  bool usesTimers() const;
  void obey(const TimerOrder& order);
  void start(int milliseconds);
  void draw();
  void watchTimer(int id);
  static void onEvent(vtkObject*, unsigned long event, void* self, void* timerId);
  static void onTimer(vtkObject*, unsigned long event, void* self, void* timerId);

  vtkObject* pass_;
  std::thread::id thread_ = std::this_thread::get_id(); ///< of the pass, and of its interactor
  PictureSchedule schedule_;
  vtkNew<vtkCallbackCommand> watching_; ///< sees all events first, also while a style has the focus
  vtkNew<vtkCallbackCommand> drawing_;  ///< draws on TimerEvents
  vtkNew<vtkCallbackCommand> muting_;   ///< takes one TimerEvent from a style
  vtkWeakPointer<vtkRenderWindow> window_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_; ///< that is observed
  int own_ = 0;                   ///< the interactor's number of the timer started last; 0: none
  bool waits_ = false;            ///< true until that timer has fired
  bool timersFire_ = false;       ///< true once a timer of this interactor has fired
  bool drawsOnlyInPaint_ = false; ///< true if the interactor's Render() draws nothing
  std::shared_ptr<int> frames_ = std::make_shared<int>(0); ///< number of frames drawn
};

} // namespace gnomon
