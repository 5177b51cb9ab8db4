#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/RayFilter.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace gnomon
{

struct SheetCrossing
{
  double at;       ///< in lengths of the direction
  glm::dvec3 left; ///< the share of light that it leaves, by channel
};

/// The surfaces of a snapshot that let light through (Surface::sheet), in a structure of their own.
///
/// Each crossing of a ray counts once. Embree finds the triangles whose boxes the ray passes, and
/// crossingOf() decides in double, so that triangles with a common edge share no ray and lose none.
class Sheets : public RayFilter
{
public:
  /// @throws std::runtime_error if Embree cannot be started
  Sheets();
  ~Sheets() override;
  Sheets& operator=(Sheets&&) = delete; ///< nor copied

  /// Bring the structure up to date with the snapshot. Does nothing if neither topologyVersion nor
  /// positionsVersion changed. The snapshot must stay in place until the next update.
  /// @return true if rays may find others than before
  /// @throws std::runtime_error if there is no structure, or for casters beyond Embree's range
  bool update(const Occluders& occluders);

  bool isColoured() const override;
  /// Return the product over the ray's crossings (Sheet).
  glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const override;
  /// Find the ray's crossings, from its origin on. The arguments are those of transmittanceOf().
  void findCrossings(const glm::vec3& origin, const glm::vec3& direction, float rayFar,
    std::vector<SheetCrossing>& crossings) const;

  std::size_t bytes() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
