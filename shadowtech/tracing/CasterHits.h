#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>

namespace gnomon
{

struct PlacedSolid;

/// Finds the casters on a ray, front and back faces alike. Rays pass through holes that textures
/// cut.
class CasterHits
{
public:
  virtual ~CasterHits() = default;

  struct Hit
  {
    std::uint32_t surface;   ///< Occluders::surfaces index
    std::uint32_t triangle;  ///< of the snapshot; for an instance, of its source
    float at;                ///< in lengths of the ray's direction
    glm::vec3 normalCentred; ///< of any length, on either side
    /// The solid that is hit instead of a triangle, until the casters change. If set, the triangle
    /// and the normal are invalid.
    const PlacedSolid* solid = nullptr;
  };

  /// Return the nearest hit; none if the ray meets no caster. Called from several threads at once.
  /// @param origin, direction centred; direction of any length
  /// @param after, until the interval in which hits count, in lengths of the direction
  virtual std::optional<Hit> nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const = 0;
};

} // namespace gnomon
