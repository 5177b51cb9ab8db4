#pragma once

#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct SurfaceEdges;

/// Where a surface goes on as another one.
struct Seam
{
  std::uint32_t edge;         ///< of the surface
  std::uint32_t otherSurface; ///< index into the snapshot's surfaces
  std::uint32_t otherTriangle;
  ///@{
  /// As of CasterEdge.
  bool sameDirection;
  bool sharp;
  ///@}
};

/// Seams of the casting surfaces: edges of two of them, both ends of which are at exactly the same
/// places, and of no third.
///
/// Surfaces that are instances, one-sided or cut out have none: what is true of one side need not
/// be of the other.
class CasterSeams
{
public:
  /// Finds the seams anew.
  /// @param edges of the snapshot's surfaces; null for those that do not cast
  void update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges);

  /// Of an edge of a surface; null where there is none.
  const Seam* at(std::size_t surface, std::uint32_t edge) const;

  /// All of a surface, by their edges.
  const std::vector<Seam>& of(std::size_t surface) const { return this->bySurface_[surface]; }

  std::size_t bytes() const;

private:
  std::vector<std::vector<Seam>> bySurface_;
};

} // namespace gnomon
