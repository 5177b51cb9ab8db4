#pragma once

#include "shadowtech/base/Occluders.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>

namespace gnomon
{

/// The surfaces of a snapshot that let light through (Surface::sheet), in a structure of their own.
///
/// Each crossing of a ray counts once. Embree finds the triangles whose boxes the ray passes, and
/// crossingOf() decides in double, so that triangles with a common edge share no ray and lose none.
class Sheets
{
public:
  /// @throws std::runtime_error if Embree cannot be started
  Sheets();
  ~Sheets();
  Sheets(const Sheets&) = delete;
  Sheets& operator=(const Sheets&) = delete;

  /// Bring the structure up to date with the snapshot. Does nothing if neither topologyVersion nor
  /// positionsVersion changed. The snapshot must stay in place until the next update.
  /// @throws std::runtime_error if there is no structure, or for casters beyond Embree's range
  void update(const Occluders& occluders);

  /// True if no surface lets light through.
  bool empty() const;

  /// Return the share of light, by channel, that passes all sheets which a ray crosses: the product
  /// over its crossings (Sheet). All channels are equal without coloured sheets. Called from
  /// several threads at once.
  /// @param origin, direction centred; the origin in the box around the snapshot
  /// (Occluders::allCentred), the direction of any length but 0
  /// @param rayFar far end of the ray, in lengths of its direction (ShadowRay.h)
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const;

  /// Return the bytes of the structure and of its tables.
  std::size_t bytes() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
