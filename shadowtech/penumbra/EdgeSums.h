#pragma once

#include "lights/LightSamples.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// An edge as seen from where some rays start: a line of the plane z = 1, whose points are the
/// rays' slopes (x, y).
struct SeenEdge
{
  glm::vec3 across;   ///< dot(across, (x, y, 1)) > 0 to the left of it, where x is less
  float uncertain;    ///< up to so much of that, rounding may say on which side a ray passes
  float lower, upper; ///< from this y on, up to that one
  float uncertainLower, uncertainUpper; ///< the same of where rounding counts
  /// How many triangles more are met to its left than to its right.
  std::int32_t weight;
  ///@{
  /// How many more are met below this y than above, along the line of largest x.
  std::int32_t weightBelow;
  float below;
  ///@}
};

/// How many triangles each of a pixel's rays to an area light meets, up to a number that is the
/// same for all of them.
class EdgeSums
{
public:
  /// Takes the rays.
  /// @param shaftFromCentred turns their directions; z > 0 then
  void setRays(const glm::mat3& shaftFromCentred, const LightSamples::Coordinates& directions,
    std::size_t count);

  /// Sums the edges.
  void add(const std::vector<SeenEdge>& edges);

  /// Of those rays of which no rounding says on which side of an edge they pass, those that meet
  /// the fewest triangles.
  struct Fewest
  {
    std::uint32_t first; ///< one of them
    std::uint32_t count; ///< 0 where there is none
  };
  Fewest fewest() const;

  /// Appends the numbers of all other rays: where rounding may say on which side of an edge they
  /// pass.
  void appendUncertain(std::vector<std::uint32_t>& rays) const;

private:
  static constexpr std::size_t together = 16;

  std::size_t count_ = 0;
  /// Slopes; up to a multiple of `together` those of no ray, which are uncertain.
  std::vector<float> x_, y_;
  std::vector<std::int32_t> sums_;
  std::vector<std::int32_t> uncertain_; ///< 1 or 0
};

} // namespace gnomon
