#pragma once

#include "shadowtech/base/Occluders.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct SurfaceEdges;

/// An edge where a surface continues as another surface.
struct Seam
{
  std::uint32_t edge;         ///< number in the surface
  std::uint32_t otherSurface; ///< index into the snapshot's surfaces
  std::uint32_t otherTriangle;
  ///@{
  /// As in CasterEdge.
  bool sameDirection;
  bool sharp;
  ///@}
};

/// Seams of the casting surfaces. A seam is a pair of border edges of two surfaces between exactly
/// the same two places, where no third border edge lies.
///
/// Instances, one-sided surfaces and cut-outs have no seams: facts about one side need not hold for
/// the other.
class CasterSeams
{
public:
  /// Find the seams of a snapshot.
  /// @param edges of the snapshot's surfaces; null for surfaces that do not cast
  void update(const Occluders& occluders, const std::vector<const SurfaceEdges*>& edges);

  /// Return the seam at an edge of a surface; null if there is none.
  const Seam* at(std::size_t surface, std::uint32_t edge) const;

  /// Return all seams of a surface, sorted by edge.
  const std::vector<Seam>& of(std::size_t surface) const { return this->bySurface_[surface]; }

  std::size_t bytes() const;

private:
  std::vector<std::vector<Seam>> bySurface_;
};

} // namespace gnomon
