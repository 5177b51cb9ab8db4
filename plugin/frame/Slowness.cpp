#include "plugin/frame/Slowness.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{
namespace
{

constexpr std::size_t mostFrames = 30;

double medianOf(std::deque<double> numbers, double ofNone)
{
  if (numbers.empty())
  {
    return ofNone;
  }
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
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
  return medianOf(this->maps_, medianOf(this->rays_, 1.0));
}

//------------------------------------------------------------------------------
double Slowness::ofRays() const
{
  return medianOf(this->rays_, medianOf(this->maps_, 1.0));
}

} // namespace gnomon
