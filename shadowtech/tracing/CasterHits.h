#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace gnomon
{

/// Who finds what may hide a light: triangles that cast, without those that a texture cuts out,
/// without instances and solids.
class CasterHits
{
public:
  virtual ~CasterHits() = default;

  struct Hit
  {
    std::uint32_t triangle; ///< of the snapshot
    float at;               ///< in lengths of the segment
  };

  /// The nearest triangle on a segment; on both of its sides, also of one-sided surfaces. Called
  /// from several threads at once.
  /// @param from, along the segment's start, centred, and the way to its end
  /// @param after nearer hits do not count, in lengths of the segment
  virtual std::optional<Hit> nearest(
    const glm::vec3& from, const glm::vec3& along, float after) const = 0;
};

} // namespace gnomon
