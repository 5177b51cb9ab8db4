#include "plugin/plan/Slowness.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{
namespace
{

constexpr std::size_t mostFrames = 30;
/// Of the last frames that show a load at once, a majority must be slow.
constexpr std::size_t lastFrames = 5;

double medianOf(std::deque<double> numbers)
{
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// Return the slowness of frames from old to new: a load counts at once, its end later.
double slownessOf(const std::deque<double>& frames, double ofNone)
{
  if (frames.empty())
  {
    return ofNone;
  }
  const auto last = static_cast<std::ptrdiff_t>(std::min(frames.size(), lastFrames));
  return std::max(medianOf(frames), medianOf({ frames.end() - last, frames.end() }));
}

} // namespace

//------------------------------------------------------------------------------
void Slowness::begin(bool byMaps, double modelledMilliseconds)
{
  this->byMaps_ = byMaps;
  this->modelledMilliseconds_ = modelledMilliseconds;
}

//------------------------------------------------------------------------------
void Slowness::end(double milliseconds)
{
  if (!this->awaitsTime())
  {
    return;
  }
  std::deque<double>& taken = this->byMaps_ ? this->maps_ : this->rays_;
  std::deque<double>& other = this->byMaps_ ? this->rays_ : this->maps_;
  taken.push_back(milliseconds / this->modelledMilliseconds_);
  if (taken.size() > mostFrames)
  {
    taken.pop_front();
  }
  if (!other.empty())
  {
    other.pop_front();
  }
  this->modelledMilliseconds_ = 0.0;
}

//------------------------------------------------------------------------------
double Slowness::ofMaps() const
{
  return slownessOf(this->maps_, slownessOf(this->rays_, 1.0));
}

//------------------------------------------------------------------------------
double Slowness::ofRays() const
{
  return slownessOf(this->rays_, slownessOf(this->maps_, 1.0));
}

} // namespace gnomon
