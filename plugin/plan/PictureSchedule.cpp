#include "plugin/plan/PictureSchedule.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

bool PictureSchedule::moves(bool changed, double now)
{
  this->changedAt_ = changed ? now : this->changedAt_;
  return now - this->changedAt_ < patience;
}

TimerOrder PictureSchedule::refine(double now)
{
  this->dueAt_ = now;
  return this->order(false, now);
}

/// A scene that changes in each frame makes no progress. It gets one frame with all points, if its
/// lights' technique is the pass's, and no timer after it.
TimerOrder PictureSchedule::drawn(const ShownPicture& picture, bool acts, double now)
{
  const bool stalls = this->isDrawing_ && picture.progress <= this->progress_;
  this->stalls_ = stalls ? this->stalls_ + 1 : 0;
  this->wasApproximate_ = picture.isApproximate;
  this->progress_ = picture.progress;
  this->isDrawing_ = false;
  this->dueAt_.reset();
  if (picture.isApproximate || (picture.progress < 1.0 && this->stalls_ < 2))
  {
    this->dueAt_ = picture.moves ? this->changedAt_ + patience : now;
  }
  return this->order(acts, now);
}

TimerOrder PictureSchedule::pressed()
{
  this->isHeld_ = true;
  return this->interacts();
}

/// Any button's release counts for all: programs may swallow releases, as of a menu's button.
TimerOrder PictureSchedule::released(double now)
{
  this->isHeld_ = false;
  return this->order(false, now); // the style, told later, stops acting
}

TimerOrder PictureSchedule::interacts()
{
  const bool waits = this->firesAt_.has_value();
  this->firesAt_.reset();
  return { waits ? TimerOrder::Kind::Stop : TimerOrder::Kind::None };
}

TimerOrder PictureSchedule::timerEvent(bool acts, double now)
{
  if (this->dueAt_ && *this->dueAt_ <= now && !acts && !this->isHeld_)
  {
    this->dueAt_.reset();
    this->isDrawing_ = true;
    return { TimerOrder::Kind::Draw };
  }
  return this->order(acts, now);
}

/// Order a timer if a picture is due and none waits. Interactors may lose a timer: those of wx and
/// PyQt name the last one that the process started, whichever fires.
TimerOrder PictureSchedule::order(bool acts, double now)
{
  constexpr double lostAfter = 1000.0;
  const bool waits = this->firesAt_ && now < *this->firesAt_ + lostAfter;
  if (!this->dueAt_ || waits || acts || this->isHeld_)
  {
    return {};
  }
  const int duration = std::max(static_cast<int>(std::ceil(*this->dueAt_ - now)), 1);
  this->firesAt_ = now + duration;
  return { TimerOrder::Kind::Start, duration };
}

} // namespace gnomon
