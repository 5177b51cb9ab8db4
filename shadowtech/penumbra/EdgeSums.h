#ifndef gnomon_shadowtech_penumbra_EdgeSums_h
#define gnomon_shadowtech_penumbra_EdgeSums_h

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// An edge as seen from where some rays start: a line of the plane z = 1, whose points are the rays' slopes (x, y).
struct SeenEdge
{
  glm::vec3 across;   ///< dot(across, (x, y, 1)) > 0 to the left of it, where x is less
  float uncertain;    ///< up to so much of that, rounding may say on which side a ray passes
  float lower, upper; ///< from this y on, up to that one
  float uncertainLower, uncertainUpper; ///< the same of where rounding counts
  /// How many triangles more are met to its left than to its right.
  float weight;
  ///@{
  /// How many more are met below this y than above, along the line of largest x.
  float weightBelow, below;
  ///@}
};

/// How many triangles each of a pixel's rays to an area light meets, up to a number that is the same for all of them.
class EdgeSums
{
public:
  /// Takes the rays.
  /// @param shaftFromCentred turns their directions; z > 0 then
  void setRays(const glm::mat3& shaftFromCentred, const glm::vec3* directions, std::size_t count);

  /// Sums the edges.
  void add(const std::vector<SeenEdge>& edges);

  std::size_t count() const { return this->count_; }
  float sum(std::size_t ray) const { return this->sums_[ray]; }
  /// Whether rounding may say on which side of an edge it passes.
  bool isUncertain(std::size_t ray) const { return this->uncertain_[ray] != 0; }

private:
  static constexpr std::size_t together = 8;

  std::size_t count_ = 0;
  std::vector<float> x_, y_; ///< slopes; NaN beyond the last one, up to a multiple of `together`
  std::vector<float> lowest_, highest_; ///< y of so many rays together
  std::vector<float> sums_;
  std::vector<std::int32_t> uncertain_;
};

} // namespace gnomon

#endif
