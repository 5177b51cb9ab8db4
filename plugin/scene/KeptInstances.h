#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon
{

struct Surface;

/// @file
/// Which glyphs the snapshot keeps as instances (Surface::centredFromSource), and where they are.
/// The others are kept as the triangles of all of them.

/// The most triangles that all instances of a glyph may have, kept either way: their numbers have
/// to fit a 32-bit float.
inline constexpr std::size_t mostGlyphTriangles = 1u << 24;

/// Whether instances are cheaper than their triangles (docs/dev/decisions.md has the figures). They
/// take little memory and hardly any time to build. But every ray takes longer, for small sources
/// by half: so sources have to have 64 triangles, and all of their instances 2^18. Fewer are built
/// in a tenth of a second and take 36 MB; of more, rays soon take as long either way.
bool areInstancesCheaper(std::size_t trianglesOfSource, std::size_t instances);

/// Where a surface's instances are.
struct PlacedInstances
{
  std::vector<glm::mat4x3> centredFromSource; ///< as Surface has them
  bool mirrored = false;
  std::size_t leftOutNonFinite = 0; ///< not finite, or too large for a float
  std::size_t leftOutVanished = 0;  ///< too small for floats to tell their vertices apart there

  /// Whether a surface only has to be moved to have these: they are as many, the same ones are left
  /// out, and the same side is the front.
  bool areMoved(const Surface& before) const;
};

/// Computes the instances' matrices in double precision, rounded once to float. Nothing where rays
/// and maps cannot do with them: they have to be affine and regular (Instances.h), and all have to
/// mirror or none. Those that are left out do not count.
///
/// @param sourceCentre the origin of source coordinates, in those of the polydata
/// @param boundsSource box around what is drawn, in source coordinates
std::optional<PlacedInstances> placeKeptInstances(const glm::dmat4& worldFromModel,
  const std::vector<glm::mat4>& modelFromInstance, const glm::dvec3& sourceCentre,
  const Bounds& boundsSource, const glm::dvec3& centreWorld);

} // namespace gnomon
