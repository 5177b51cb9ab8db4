#pragma once

#include "lights/Bounds.h"
#include "shadowtech/penumbra/EdgeTree.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// Centred starts of the rays of some pixels.
class RayStarts
{
public:
  void clear();
  void add(const glm::vec3& start);
  /// Must be called after the last start is added.
  void finish();

  auto begin() const { return this->starts_.begin(); }
  auto end() const { return this->starts_.end(); }
  const Bounds& bounds() const { return this->bounds_; }

  glm::dvec2 behind(const EdgeTriangle& triangle) const;

private:
  static constexpr std::size_t together = 8;

  std::vector<glm::vec3> starts_;
  /// x, y, z of the starts. The last one is repeated up to a multiple of `together`.
  std::array<std::vector<float>, 3> axes_;
  Bounds bounds_;
};

} // namespace gnomon
