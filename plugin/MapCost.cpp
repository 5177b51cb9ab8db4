#include "plugin/MapCost.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace gnomon
{
namespace
{

std::string inMilliseconds(double milliseconds)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(milliseconds < 10.0 ? 2 : 0) << milliseconds << " ms";
  return text.str();
}

} // namespace

//------------------------------------------------------------------------------
MapCost::Plan MapCost::plan(Situation situation, glm::ivec2 picturePixels)
{
  this->situation_ = situation;
  this->completesPair_ = situation == Situation::Mapped && this->plan_ == Plan::Compare;
  if (this->picturePixels_ != picturePixels)
  {
    this->picturePixels_ = picturePixels;
    this->dropped_.reset(); // it may pay now
  }
  switch (situation)
  {
    case Situation::Changed:
      this->rent_ = 0.0;
      this->dropped_.reset();
      this->plan_ = Plan::Trace;
      break;
    case Situation::Still:
      this->plan_ = this->rent_ >= this->asked() ? Plan::Draw : Plan::Trace;
      break;
    case Situation::Mapped:
      if (this->judged() && !this->typicalPair().pays())
      {
        this->dropped_ = this->typicalPair();
        this->plan_ = Plan::Drop;
      }
      else
      {
        this->plan_ = this->isToBeCompared() ? Plan::Compare : Plan::Use;
      }
      break;
  }
  return this->plan_;
}

//------------------------------------------------------------------------------
void MapCost::mapTook(double milliseconds)
{
  this->cost_ = milliseconds;
  this->payIn(-milliseconds);
  this->rent_ = 0.0;
  this->dropped_.reset();
  this->framesInUse_ = 0;
  this->pairs_.clear();
}

//------------------------------------------------------------------------------
void MapCost::visibilityTook(double milliseconds)
{
  switch (this->plan_)
  {
    case Plan::Trace:
    case Plan::Drop:
      this->traced_ = milliseconds;
      if (this->situation_ != Situation::Changed)
      {
        this->rent_ += this->dropped_
          ? std::max(0.0, milliseconds - lapseOfVerdict * this->dropped_->mapped)
          : milliseconds;
      }
      break;
    case Plan::Compare:
      this->traced_ = milliseconds;
      break;
    case Plan::Draw:
      this->known_ = { this->traced_, milliseconds };
      this->useMap(milliseconds);
      break;
    case Plan::Use:
      if (this->completesPair_)
      {
        this->pairs_.push_back({ this->traced_, milliseconds });
        this->known_ = this->typicalPair();
      }
      this->useMap(milliseconds);
      break;
  }
}

//------------------------------------------------------------------------------
/// A frame with the map is over.
void MapCost::useMap(double milliseconds)
{
  ++this->framesInUse_;
  if (this->known_.mapped > 0.0)
  {
    // In proportion, as what the camera sees may take more by now, or less.
    this->payIn(milliseconds * (this->known_.traced / this->known_.mapped - 1.0));
  }
}

//------------------------------------------------------------------------------
void MapCost::payIn(double milliseconds)
{
  this->account_ =
    std::clamp(this->account_ + milliseconds, -mostDebtMaps * *this->cost_, *this->cost_);
}

//------------------------------------------------------------------------------
/// What tracing is to take until a map is drawn. Nobody knows what the first one costs.
double MapCost::asked() const
{
  return this->cost_ ? std::max(0.0, *this->cost_ - this->account_) : 0.0;
}

//------------------------------------------------------------------------------
/// Whether it is time to trace a frame that the next one, with the map, is compared with.
bool MapCost::isToBeCompared() const
{
  return this->framesInUse_ >= framesUnquestioned && !this->judged() && !this->completesPair_;
}

//------------------------------------------------------------------------------
/// Whether it is known what the map saves. Where it is more than half, two pairs tell.
bool MapCost::judged() const
{
  return this->pairs_.size() == comparedPairs ||
    (this->pairs_.size() >= 2 &&
      std::all_of(this->pairs_.begin(), this->pairs_.end(),
        [](const Pair& pair) { return pair.mapped < 0.5 * pair.traced; }));
}

//------------------------------------------------------------------------------
/// The median by what the map saves: neighbouring frames see the same, and other programs' work disturbs few.
MapCost::Pair MapCost::typicalPair() const
{
  std::vector<Pair> sorted = this->pairs_;
  std::sort(sorted.begin(), sorted.end(),
    [](const Pair& a, const Pair& b) { return a.mapped * b.traced < b.mapped * a.traced; });
  return sorted[sorted.size() / 2];
}

//------------------------------------------------------------------------------
std::string MapCost::reason() const
{
  if (this->plan_ == Plan::Draw || this->plan_ == Plan::Use)
  {
    return "";
  }
  if (this->plan_ == Plan::Compare)
  {
    return "all is traced in this frame, to see what the map saves";
  }
  if (this->dropped_)
  {
    return "the map does not pay: with it visibility took " +
      inMilliseconds(this->dropped_->mapped) + ", and without it " +
      inMilliseconds(this->dropped_->traced) + ", so that all is traced";
  }
  const std::string changed =
    "the light, the casters or what it is fitted to have changed: all is traced, and the map is "
    "drawn once ";
  return this->asked() > 0.0 ? changed + "that has taken " + inMilliseconds(this->asked()) +
      " in frames in which nothing changes (so far " + inMilliseconds(this->rent_) + ")"
                             : changed + "nothing has changed for a frame";
}

} // namespace gnomon
