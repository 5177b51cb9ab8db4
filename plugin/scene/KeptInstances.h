#pragma once

#include "lights/SceneFrame.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

struct Surface;

/// @file
/// Decides which glyphs the snapshot holds as instances (Surface::centredFromSource), and places
/// them. It holds the other glyphs as the triangles of all their instances.

/// The most triangles that all instances of a glyph may have, as instances or as triangles: a
/// 32-bit float must hold their numbers.
inline constexpr std::size_t mostGlyphTriangles = 1u << 24;

/// True if instances are cheaper than their triangles (figures: docs/dev/decisions.md).
///
/// Instances need little memory and hardly any time to build, but every ray takes longer, by half
/// for small sources. So a source needs 64 triangles, and all of its instances 2^18. Fewer
/// triangles build in a tenth of a second and need 36 MB. With more, rays soon take equally long
/// either way.
bool areInstancesCheaper(std::size_t trianglesOfSource, std::size_t instances);

/// The places of a surface's instances.
struct PlacedInstances
{
  std::vector<glm::mat4x3> centredFromSource; ///< as in Surface
  bool mirrored = false;
  std::size_t leftOutNonFinite = 0; ///< not finite, or too large for a float
  std::size_t leftOutVanished = 0;  ///< too small for floats to distinguish their vertices

  /// True if a surface only has to be moved to have these instances: their number, the instances
  /// left out and the front side are the same.
  bool areMoved(const Surface& before) const;
};

/// Compute the instances' matrices in double precision, rounded once to float.
///
/// @return nothing if rays and maps cannot use them. They must be affine and regular (Instances.h),
/// and all or none must mirror. Instances that are left out do not count.
/// @param source the frame of source coordinates in the polydata's
/// @param boundsSource box around the drawn cells, in source coordinates
std::optional<PlacedInstances> placeKeptInstances(const glm::dmat4& worldFromModel,
  const std::vector<glm::mat4>& modelFromInstance, const SceneFrame& source,
  const Bounds& boundsSource, const SceneFrame& frame);

} // namespace gnomon
