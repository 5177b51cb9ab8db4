#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace gnomon
{

/// Finds the casting triangles on a ray, front and back faces alike. Rays pass through holes that
/// textures cut, and through solids.
class CasterHits
{
public:
  virtual ~CasterHits() = default;

  struct Hit
  {
    std::uint32_t surface;   ///< Occluders::surfaces index
    std::uint32_t triangle;  ///< of the snapshot; of an instance, its source's
    float at;                ///< in lengths of the ray's direction
    glm::vec3 normalCentred; ///< of any length, on either side
  };

  /// The nearest one. Called from several threads at once.
  /// @param origin, direction centred; of any length
  /// @param after, until where hits count, in lengths of the direction
  virtual std::optional<Hit> nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const = 0;
};

} // namespace gnomon
