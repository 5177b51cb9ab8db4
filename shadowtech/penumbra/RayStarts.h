#pragma once

#include "lights/Bounds.h"
#include "shadowtech/penumbra/EdgeTree.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon
{

/// Where the rays of some pixels start, centred.
class RayStarts
{
public:
  void clear();
  void add(const glm::vec3& start);
  /// To be called once all are added.
  void finish();

  std::size_t size() const { return this->starts_.size(); }
  const glm::vec3& operator[](std::size_t number) const { return this->starts_[number]; }
  auto begin() const { return this->starts_.begin(); }
  auto end() const { return this->starts_.end(); }
  const Bounds& bounds() const { return this->bounds_; }

  /// The least and the most of how far they lie behind a triangle's plane, as
  /// EdgeTriangle::behind() has it.
  glm::dvec2 behind(const EdgeTriangle& triangle) const;

private:
  static constexpr std::size_t together = 8;

  std::vector<glm::vec3> starts_;
  /// x, y, z; the last one again up to a multiple of `together`.
  std::array<std::vector<float>, 3> axes_;
  Bounds bounds_;
};

} // namespace gnomon
