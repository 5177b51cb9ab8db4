#pragma once

#include "lights/LightSamples.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// An edge as seen from where some rays start. It is a line on the plane z = 1, whose points are
/// the rays' slopes (x, y).
struct SeenEdge
{
  glm::vec3 across; ///< dot(across, (x, y, 1)) > 0 on its left, where x is less
  /// Rays with at most this |dot(across, (x, y, 1))| pass on a side that rounding decides.
  float uncertain;
  float lower, upper;                   ///< its range of y; rays in [lower, upper) cross it
  float uncertainLower, uncertainUpper; ///< the range of y in which `uncertain` applies
  /// How many more triangles rays on its left meet than rays on its right.
  std::int32_t weight;
  ///@{
  /// How many more triangles rays below this y meet than rays above it, along the line of largest
  /// x.
  std::int32_t weightBelow;
  float below;
  ///@}
};

/// Counts the triangles on each of a pixel's rays to an area light, up to a constant that all of
/// them share.
class EdgeSums
{
public:
  /// Set the rays.
  /// @param shaftFromCentred rotates their directions, after which z > 0
  void setRays(const glm::mat3& shaftFromCentred, const LightSamples::Coordinates& directions,
    std::size_t count);

  void add(const std::vector<SeenEdge>& edges);

  /// The rays with the least sum, among rays that pass all edges on a certain side.
  struct Fewest
  {
    std::uint32_t first; ///< number of the first of them
    std::uint32_t count; ///< 0 if there are none
  };
  Fewest fewest() const;

  /// Append the numbers of all rays that pass an edge on a side that rounding decides.
  void appendUncertain(std::vector<std::uint32_t>& rays) const;

private:
  static constexpr std::size_t together = 16;

  std::size_t count_ = 0;
  /// Slopes, padded to a multiple of `together`. Padding counts as uncertain.
  std::vector<float> x_, y_;
  std::vector<std::int32_t> sums_;
  std::vector<std::int32_t> uncertain_; ///< 1 if uncertain, else 0
};

} // namespace gnomon
