#include "shadowtech/penumbra/EdgeSums.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Compiles loops over rays for several widths of vectors. All widths give the same certain results.
#ifdef __x86_64__
#define GNOMON_SIDE_BY_SIDE [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define GNOMON_SIDE_BY_SIDE
#endif

namespace gnomon
{
namespace
{

GNOMON_SIDE_BY_SIDE
void slopesOf(const glm::mat3& turn, const LightSamples::Coordinates& directions, std::size_t count,
  float* x, float* y)
{
  const float *const fromX = directions.x, *const fromY = directions.y, *const fromZ = directions.z;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i)
  {
    const float z = turn[0].z * fromX[i] + turn[1].z * fromY[i] + turn[2].z * fromZ[i];
    x[i] = (turn[0].x * fromX[i] + turn[1].x * fromY[i] + turn[2].x * fromZ[i]) / z;
    y[i] = (turn[0].y * fromX[i] + turn[1].y * fromY[i] + turn[2].y * fromZ[i]) / z;
  }
}

/// Add edges to the sums of all rays.
GNOMON_SIDE_BY_SIDE
void addEdges(const SeenEdge* edges, std::size_t edgeCount, const float* x, const float* y,
  std::size_t count, std::int32_t* sums, std::int32_t* uncertain)
{
  for (std::size_t number = 0; number < edgeCount; ++number)
  {
    const SeenEdge edge = edges[number];
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i)
    {
      const float side = edge.across.x * x[i] + edge.across.y * y[i] + edge.across.z;
      const bool within = (y[i] >= edge.lower) & (y[i] < edge.upper) & (side > 0.0f);
      const bool below = y[i] < edge.below;
      sums[i] += (within ? edge.weight : 0) + (below ? edge.weightBelow : 0);
      const bool unclear = (std::abs(side) <= edge.uncertain) & (y[i] >= edge.uncertainLower) &
        (y[i] <= edge.uncertainUpper);
      uncertain[i] |= unclear ? 1 : 0;
    }
  }
}

constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

GNOMON_SIDE_BY_SIDE
std::int32_t leastOf(const std::int32_t* sums, const std::int32_t* uncertain, std::size_t count)
{
  std::int32_t least = none;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::int32_t of = uncertain[i] != 0 ? none : sums[i];
    least = std::min(least, of);
  }
  return least;
}

GNOMON_SIDE_BY_SIDE
std::uint32_t countOf(
  std::int32_t sum, const std::int32_t* sums, const std::int32_t* uncertain, std::size_t count)
{
  std::int32_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    found += (sums[i] == sum) & (uncertain[i] == 0) ? 1 : 0;
  }
  return static_cast<std::uint32_t>(found);
}

} // namespace

void EdgeSums::setRays(
  const glm::mat3& shaftFromCentred, const LightSamples::Coordinates& directions, std::size_t count)
{
  const std::size_t padded = (count + together - 1) / together * together;
  this->count_ = count;
  this->x_.resize(padded, 0.0f);
  this->y_.resize(padded, 0.0f);
  slopesOf(shaftFromCentred, directions, count, this->x_.data(), this->y_.data());
  this->sums_.assign(padded, 0);
  this->uncertain_.assign(padded, 0);
  std::fill(
    this->uncertain_.begin() + static_cast<std::ptrdiff_t>(count), this->uncertain_.end(), 1);
}

void EdgeSums::add(const std::vector<SeenEdge>& edges)
{
  addEdges(edges.data(), edges.size(), this->x_.data(), this->y_.data(), this->x_.size(),
    this->sums_.data(), this->uncertain_.data());
}

EdgeSums::Fewest EdgeSums::fewest() const
{
  const std::int32_t least =
    leastOf(this->sums_.data(), this->uncertain_.data(), this->sums_.size());
  if (least == none)
  {
    return { 0, 0 };
  }
  std::uint32_t first = 0;
  while (this->uncertain_[first] != 0 || this->sums_[first] != least)
  {
    ++first;
  }
  return { first, countOf(least, this->sums_.data(), this->uncertain_.data(), this->sums_.size()) };
}

void EdgeSums::appendUncertain(std::vector<std::uint32_t>& rays) const
{
  const std::size_t before = rays.size();
  rays.resize(before + this->count_);
  std::uint32_t* next = rays.data() + before;
  for (std::size_t i = 0; i < this->count_; ++i)
  {
    *next = static_cast<std::uint32_t>(i);
    next += this->uncertain_[i];
  }
  rays.resize(static_cast<std::size_t>(next - rays.data()));
}

} // namespace gnomon
