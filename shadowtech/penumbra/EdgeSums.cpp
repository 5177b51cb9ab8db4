#include "shadowtech/penumbra/EdgeSums.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// Adds an edge to `count` rays side by side.
template <std::size_t count>
inline void addTo(
  const SeenEdge& edge, const float* x, const float* y, float* sums, std::int32_t* uncertain)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const float side = edge.across.x * x[i] + edge.across.y * y[i] + edge.across.z;
    const bool within = (y[i] >= edge.lower) & (y[i] < edge.upper) & (side > 0.0f);
    sums[i] += within ? edge.weight : 0.0f;
    sums[i] += y[i] < edge.below ? edge.weightBelow : 0.0f;
    const bool unclear = (std::abs(side) <= edge.uncertain) & (y[i] >= edge.uncertainLower) &
      (y[i] <= edge.uncertainUpper);
    uncertain[i] |= unclear ? 1 : 0;
  }
}

} // namespace

//------------------------------------------------------------------------------
void EdgeSums::setRays(
  const glm::mat3& shaftFromCentred, const glm::vec3* directions, std::size_t count)
{
  const std::size_t groups = (count + together - 1) / together;
  this->count_ = count;
  this->x_.assign(groups * together, std::numeric_limits<float>::quiet_NaN());
  this->y_.assign(groups * together, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec3 direction = shaftFromCentred * directions[i];
    this->x_[i] = direction.x / direction.z;
    this->y_[i] = direction.y / direction.z;
  }
  this->lowest_.resize(groups);
  this->highest_.resize(groups);
  for (std::size_t group = 0; group < groups; ++group)
  {
    const auto first = this->y_.begin() + static_cast<std::ptrdiff_t>(group * together);
    const auto last =
      first + static_cast<std::ptrdiff_t>(std::min(together, count - group * together));
    const auto [lowest, highest] = std::minmax_element(first, last);
    this->lowest_[group] = *lowest;
    this->highest_[group] = *highest;
  }
  this->sums_.assign(groups * together, 0.0f);
  this->uncertain_.assign(groups * together, 0);
}

//------------------------------------------------------------------------------
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void EdgeSums::add(const std::vector<SeenEdge>& edges)
{
  for (const SeenEdge& edge : edges)
  {
    const float lowest = std::min(edge.lower, edge.uncertainLower);
    const float highest = edge.weightBelow != 0.0f ? std::numeric_limits<float>::infinity()
                                                   : std::max(edge.upper, edge.uncertainUpper);
    const float least = edge.weightBelow != 0.0f ? -highest : lowest;
    for (std::size_t group = 0; group < this->lowest_.size(); ++group)
    {
      if (this->highest_[group] < least || this->lowest_[group] > highest)
      {
        continue;
      }
      const std::size_t first = group * together;
      addTo<together>(
        edge, &this->x_[first], &this->y_[first], &this->sums_[first], &this->uncertain_[first]);
    }
  }
}

} // namespace gnomon
