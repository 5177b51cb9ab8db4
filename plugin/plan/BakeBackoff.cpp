#include "plugin/plan/BakeBackoff.h"

#include <algorithm>

namespace gnomon
{

bool BakeBackoff::usesMap(bool rested, bool baked, bool mayBake)
{
  if (this->served_ > 0 && !baked)
  {
    this->patience_ = this->served_ < this->patience_
      ? std::min(2 * this->patience_, mostPatience)
      : std::max(this->patience_ / 2, leastPatience);
    this->served_ = 0;
  }
  if (!baked && (!rested || !mayBake || this->rested_ < this->patience_))
  {
    this->rested_ = rested ? std::min(this->rested_ + 1, mostPatience) : 0;
    return false;
  }
  this->rested_ = 0;
  this->served_ = std::min(this->served_ + 1, mostPatience); // a larger count has no effect
  return true;
}

std::string BakeBackoff::reason() const
{
  return this->served_ > 0
    ? ""
    : "the light, the casters or what the map is fitted to changed: all is traced, and the map is "
      "baked after " +
      std::to_string(this->patience_) + " frames without a change (so far " +
      std::to_string(this->rested_) + ")";
}

} // namespace gnomon
