#pragma once

#include "lights/Bounds.h"
#include "lights/LightRays.h"
#include "lights/MapFit.h"

#include <glm/glm.hpp>

#include <limits>
#include <vector>

namespace gnomon
{

/// One projection of what a light sees, for one layer of its map, as plain double-precision
/// mathematics.
///
/// Three spaces, of which the first is relative to a *centre* that the caller chooses (positions
/// less the centre stay small, so that they survive as floats):
/// - the view's space: x and y across the view, z the distance along its axis, growing away from
///   the light. z = 0 lies at the light; for a directional light at the nearest bound, or at the
///   near face of its box.
/// - across coordinates: the light's rays as points of a plane (LightRays.h).
/// - the map: [-1, 1]^2, a homography of that plane. It is a scale and an offset of uniform
///   projections, and a perspective of warped ones.
///
/// The map stores linear depth z, scaled to [0, 1] by depthScale and depthOffset:
/// depth = z * depthScale + depthOffset. Casters end well before 1, the depth of empty texels.
struct LightView
{
  LightRays rays;
  glm::dmat3 mapFromAcross{ 1.0 }; ///< positive w over all that is visible, positive determinant
  double depthScale = 1.0;
  double depthOffset = 0.0;
  /// The z from which on casters count: where the light begins, or just before the first caster of
  /// a positional one.
  double beginsAt = -std::numeric_limits<double>::infinity();
  /// The part of the map that can be read. It is smaller than the map only where the last fit is
  /// still to come (LightViews::awaitFit).
  Rectangle readable = wholeMap;
  /// Where the last fit chooses a warp, too: the maps in place of mapFromAcross that it chooses
  /// from. The first one is mapFromAcross itself, which is uniform.
  std::vector<glm::dmat3> warps;

  /// Whether texels are, or may yet be, of different sizes, so that what is linear across the light
  /// is not linear on the map.
  bool warped() const
  {
    return this->mapFromAcross[0].z != 0.0 || this->mapFromAcross[1].z != 0.0 ||
      !this->warps.empty();
  }
  /// Whether depth is linear on the map.
  bool depthIsAffine() const { return !this->rays.positional && !this->warped(); }

  /// To OpenGL's clip space, as far as the map's x and y go. Where depth is affine on the map, z/w
  /// is that depth, scaled to [-1, 1]; else z is 0, and depth is the fragment's business.
  glm::dmat4 clipFromCentred() const;

  /// False only if nothing in the box can be seen in the readable part.
  bool maySee(const Bounds& centred) const;

  bool operator==(const LightView& other) const
  {
    return this->rays == other.rays && this->mapFromAcross == other.mapFromAcross &&
      this->depthScale == other.depthScale && this->depthOffset == other.depthOffset &&
      this->beginsAt == other.beginsAt && this->readable == other.readable &&
      this->warps == other.warps;
  }
  bool operator!=(const LightView& other) const { return !(*this == other); }
};

/// From across coordinates to texels of a square map, [0, size]^2 in place of [-1, 1]^2.
glm::dmat3 texelFromAcross(const glm::dmat3& mapFromAcross, int sizeTexels);
glm::dmat3 texelFromAcross(const LightView& view, int sizeTexels);

} // namespace gnomon
