#include "plugin/pass/PictureTimer.h"

#include "shadowtech/base/Clock.h"

#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkInteractorStyle.h>
#include <vtkInteractorStyleSwitch.h> // inline and virtual functions alone: not linked
#include <vtkRenderWindowInteractor.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace gnomon
{
namespace
{

constexpr float beforeAll = 100.0f; // priority; styles have 0, widgets 0.5

constexpr unsigned long presses[] = { vtkCommand::LeftButtonPressEvent,
  vtkCommand::MiddleButtonPressEvent, vtkCommand::RightButtonPressEvent,
  vtkCommand::FourthButtonPressEvent, vtkCommand::FifthButtonPressEvent };
constexpr unsigned long releases[] = { vtkCommand::LeftButtonReleaseEvent,
  vtkCommand::MiddleButtonReleaseEvent, vtkCommand::RightButtonReleaseEvent,
  vtkCommand::FourthButtonReleaseEvent, vtkCommand::FifthButtonReleaseEvent };

template <std::size_t count>
bool isOneOf(const unsigned long (&events)[count], unsigned long event)
{
  return std::find(std::begin(events), std::end(events), event) != std::end(events);
}

/// Return the number of a TimerEvent's timer; 0 for replayed events, which have none.
int idOf(const void* timerId)
{
  return timerId ? *static_cast<const int*>(timerId) : 0;
}

struct InteractorAccess : vtkRenderWindowInteractor
{
  static int lastTimer(vtkRenderWindowInteractor* interactor)
  {
    return (interactor->*(&InteractorAccess::GetCurrentTimerId))();
  }
};

/// True if another timer would stop a repeating one: generic interactors reset the last one alone.
bool wouldStopRepeatingTimer(vtkRenderWindowInteractor* interactor)
{
  constexpr int recent = 1000; // timers
  const bool isGeneric = interactor->IsA("vtkGenericRenderWindowInteractor");
  const int last = isGeneric ? InteractorAccess::lastTimer(interactor) : 0;
  for (int id = std::max(last - recent, 0) + 1; id <= last; ++id)
  {
    if (interactor->GetTimerDuration(id) > 0 && !interactor->IsOneShotTimer(id))
    {
      return true;
    }
  }
  return false;
}

} // namespace

PictureTimer::PictureTimer(vtkObject* pass)
  : pass_(pass)
{
  this->watching_->SetCallback(onEvent);
  this->watching_->SetClientData(this);
  this->watching_->SetPassiveObserver(1);
  this->drawing_->SetCallback(onTimer);
  this->drawing_->SetClientData(this);
  this->muting_->SetClientData(this->muting_);
  this->muting_->SetCallback([](vtkObject* style, unsigned long, void* muting, void*)
    { style->RemoveObserver(static_cast<vtkCommand*>(muting)); });
}

PictureTimer::~PictureTimer()
{
  this->follow(nullptr);
}

bool PictureTimer::asksForSpeed(vtkRenderWindow* window)
{
  // VTK's default rate (0.0001) is below this.
  constexpr double slowest = 0.01; // frames a second
  vtkRenderWindowInteractor* const interactor = window ? window->GetInteractor() : nullptr;
  return interactor && window->GetDesiredUpdateRate() > slowest &&
    window->GetDesiredUpdateRate() > interactor->GetStillUpdateRate();
}

bool PictureTimer::moves(bool changed)
{
  return this->schedule_.moves(changed, steadyMilliseconds());
}

bool PictureTimer::mayRefine(vtkRenderWindow* window)
{
  if (!window || window != this->window_ || window->GetOffScreenRendering() ||
    !this->schedule_.mayRefine() || this->acts())
  {
    return false;
  }
  if (!this->usesTimers())
  {
    return this->pass_->HasObserver(pictureUnfinishedEvent);
  }
  if (!this->timersFire_)
  {
    // Not all interactors have timers, nor fire them in all event loops (X of 9.1).
    this->obey(this->schedule_.refine(steadyMilliseconds()));
  }
  return this->timersFire_;
}

void PictureTimer::drawn(vtkRenderWindow* window, const ShownPicture& picture)
{
  ++*this->frames_;
  if (this->window_ && window != this->window_ && !picture.isApproximate && picture.progress == 1.0)
  {
    return; // the picture that may be due is another window's
  }
  this->follow(window);
  this->obey(this->schedule_.drawn(picture, this->acts(), steadyMilliseconds()));
}

/// Observe a window's interactor in place of the last one.
void PictureTimer::follow(vtkRenderWindow* window)
{
  vtkRenderWindowInteractor* const interactor = window ? window->GetInteractor() : nullptr;
  if (window == this->window_ && interactor == this->interactor_)
  {
    return;
  }
  if (this->interactor_)
  {
    this->obey(this->schedule_.interacts());
    this->interactor_->RemoveObserver(this->watching_);
    this->interactor_->RemoveObserver(this->drawing_);
  }
  this->schedule_.failed();
  this->waits_ = false;
  this->timersFire_ = false;
  this->drawsOnlyInPaint_ = false;
  this->window_ = window;
  this->interactor_ = interactor;
  if (interactor)
  {
    for (int button = 0; button < 5; ++button)
    {
      interactor->AddObserver(presses[button], this->watching_);
      interactor->AddObserver(releases[button], this->watching_);
    }
    interactor->AddObserver(vtkCommand::StartInteractionEvent, this->watching_);
    interactor->AddObserver(vtkCommand::TimerEvent, this->watching_);
    interactor->AddObserver(vtkCommand::TimerEvent, this->drawing_, beforeAll);
  }
}

/// Return the style that has the interactor's events; null if it is none of VTK's.
vtkInteractorStyle* PictureTimer::style() const
{
  vtkInteractorObserver* style =
    this->interactor_ ? this->interactor_->GetInteractorStyle() : nullptr;
  if (auto* const several = vtkInteractorStyleSwitch::SafeDownCast(style))
  {
    style = several->GetCurrentStyle();
  }
  return vtkInteractorStyle::SafeDownCast(style);
}

bool PictureTimer::acts() const
{
  vtkInteractorStyle* const style = this->style();
  return style && style->GetState() != VTKIS_NONE;
}

bool PictureTimer::usesTimers() const
{
  return this->interactor_ && this->interactor_->GetInitialized() && !this->drawsOnlyInPaint_ &&
    std::this_thread::get_id() == this->thread_;
}

/// Draw, start or stop a timer. Drawing may delete this.
void PictureTimer::obey(const TimerOrder& order)
{
  switch (order.kind)
  {
    case TimerOrder::Kind::None:
      break;
    case TimerOrder::Kind::Start:
      this->start(order.milliseconds);
      break;
    case TimerOrder::Kind::Stop:
      this->interactor_->DestroyTimer(this->own_);
      this->waits_ = false;
      break;
    case TimerOrder::Kind::Draw:
      this->draw();
      break;
  }
}

void PictureTimer::start(int milliseconds)
{
  this->waits_ = false;
  if (!this->usesTimers())
  {
    this->schedule_.failed();
    this->pass_->InvokeEvent(pictureUnfinishedEvent, &milliseconds);
    return;
  }
  if (!wouldStopRepeatingTimer(this->interactor_))
  {
    this->own_ = this->interactor_->CreateOneShotTimer(milliseconds);
    this->waits_ = this->own_ != 0;
  }
  if (!this->waits_)
  {
    this->schedule_.failed();
  }
}

void PictureTimer::draw()
{
  // Observers of the frame may delete the pass, and this with it.
  const std::weak_ptr<int> frames = this->frames_;
  const int before = *this->frames_;
  const vtkSmartPointer<vtkRenderWindow> window = this->window_.GetPointer();
  const vtkSmartPointer<vtkRenderWindowInteractor> interactor = this->interactor_.GetPointer();
  if (!window || !interactor)
  {
    return;
  }
  const double rate = window->GetDesiredUpdateRate();
  window->SetDesiredUpdateRate(interactor->GetStillUpdateRate());
  interactor->Render();
  window->SetDesiredUpdateRate(rate);

  const std::shared_ptr<int> after = frames.lock();
  auto* const painted = vtkGenericOpenGLRenderWindow::SafeDownCast(window);
  if (after && *after == before)
  {
    this->schedule_.notDrawn();
    this->drawsOnlyInPaint_ = painted && !painted->GetReadyForRendering();
    if (this->drawsOnlyInPaint_)
    {
      this->start(1);
    }
  }
}

/// Watches as a passive observer: it changes nothing that other observers see.
void PictureTimer::onEvent(vtkObject*, unsigned long event, void* self, void* timerId)
{
  auto& of = *static_cast<PictureTimer*>(self);
  if (event == vtkCommand::TimerEvent)
  {
    of.watchTimer(idOf(timerId));
    return;
  }
  of.obey(isOneOf(presses, event) ? of.schedule_.pressed()
      : isOneOf(releases, event)  ? of.schedule_.released(steadyMilliseconds())
                                  : of.schedule_.interacts());
}

void PictureTimer::watchTimer(int id)
{
  vtkInteractorStyle* const style = this->style();
  if (style)
  {
    style->RemoveObserver(this->muting_);
  }
  if (id == 0 || id != this->own_)
  {
    return;
  }
  if (this->acts())
  {
    // A focus holder's events cannot be aborted. Styles pass TimerEvents to their observers, if
    // they have some, and else act.
    style->AddObserver(vtkCommand::TimerEvent, this->muting_);
  }
  if (!this->waits_)
  {
    this->interactor_->DestroyTimer(id); // it fires again: the interactor keeps one-shots
  }
  this->waits_ = false;
  this->timersFire_ = true;
  this->schedule_.fired();
}

/// Draws a picture that is due. Other observers do not see the events of this timer.
void PictureTimer::onTimer(vtkObject*, unsigned long, void* self, void* timerId)
{
  auto& of = *static_cast<PictureTimer*>(self);
  const int id = idOf(timerId);
  of.drawing_->SetAbortFlag(id != 0 && id == of.own_ ? 1 : 0);
  of.obey(of.schedule_.timerEvent(of.acts(), steadyMilliseconds()));
}

} // namespace gnomon
