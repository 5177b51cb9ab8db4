#include "plugin/frame/Motion.h"

#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSmartPointer.h>

namespace gnomon
{

//------------------------------------------------------------------------------
bool isDragged(vtkRenderWindow* window)
{
  // VTK's default rate (0.0001) is below this.
  constexpr double slowest = 0.01; // frames a second
  vtkRenderWindowInteractor* const interactor = window ? window->GetInteractor() : nullptr;
  return interactor && window->GetDesiredUpdateRate() > slowest &&
    window->GetDesiredUpdateRate() > interactor->GetStillUpdateRate();
}

//------------------------------------------------------------------------------
RestingFrame::RestingFrame()
{
  this->command_->SetCallback(onTimer);
  this->command_->SetClientData(this);
}

//------------------------------------------------------------------------------
RestingFrame::~RestingFrame()
{
  this->stop();
}

//------------------------------------------------------------------------------
bool RestingFrame::mayRefine(vtkRenderWindow* window) const
{
  return window && window == this->window_ && this->follows_ && (this->moved_ || this->draws_) &&
    !window->GetOffScreenRendering();
}

//------------------------------------------------------------------------------
void RestingFrame::drawn(vtkRenderWindow* window, bool moves, double shown)
{
  if (!moves && window != this->window_)
  {
    return; // the timer belongs to another window
  }
  this->stop();
  const bool isMissing = moves || (this->follows_ && shown < 1.0);
  this->follows_ = false;
  this->moved_ = moves;
  this->draws_ = false;
  vtkRenderWindowInteractor* const interactor = window ? window->GetInteractor() : nullptr;
  if (!isMissing || !interactor || !interactor->GetInitialized())
  {
    return; // timers need an initialized interactor
  }
  const unsigned long patience = moves ? 500 : 1; // milliseconds
  this->timer_ = interactor->CreateOneShotTimer(patience);
  if (this->timer_ != 0)
  {
    this->follows_ = true;
    this->window_ = window;
    this->interactor_ = interactor;
    interactor->AddObserver(vtkCommand::TimerEvent, this->command_);
  }
}

//------------------------------------------------------------------------------
void RestingFrame::stop()
{
  if (this->timer_ != 0 && this->interactor_)
  {
    this->interactor_->RemoveObserver(this->command_);
    this->interactor_->DestroyTimer(this->timer_);
  }
  this->timer_ = 0;
}

//------------------------------------------------------------------------------
void RestingFrame::onTimer(vtkObject*, unsigned long, void* self, void* timerId)
{
  auto& of = *static_cast<RestingFrame*>(self);
  // Replayed events have no number.
  if (of.timer_ == 0 || !timerId || *static_cast<int*>(timerId) != of.timer_)
  {
    return;
  }
  of.stop();
  const vtkSmartPointer<vtkRenderWindow> window = of.window_.GetPointer();
  const vtkSmartPointer<vtkRenderWindowInteractor> interactor = of.interactor_.GetPointer();
  if (window && interactor)
  {
    // Observers of this frame may delete the pass, and `of` with it. drawn() resets the flag.
    of.draws_ = true;
    const double rate = window->GetDesiredUpdateRate();
    window->SetDesiredUpdateRate(interactor->GetStillUpdateRate());
    interactor->Render();
    window->SetDesiredUpdateRate(rate);
  }
}

} // namespace gnomon
