#pragma once

#include "lights/Bounds.h"
#include "lights/LightRays.h"
#include "lights/MapFit.h"

#include <glm/glm.hpp>

#include <limits>
#include <vector>

namespace gnomon
{

/// One projection of a light's view onto one layer of its map, in double precision.
///
/// It has three spaces. The first is relative to a *centre* that the caller chooses: positions less
/// the centre are small, so floats hold them.
/// - View space: x and y lie across the view. z is the distance along its axis and grows away from
///   the light, which is at z = 0. For a directional light, it lies at the nearest bound, or at the
///   near face of its box.
/// - Across coordinates: the light's rays as points of a plane (LightRays.h).
/// - The map: [-1, 1]^2, a homography of that plane. It is a scale and an offset for uniform
///   projections, and a perspective for warped ones.
///
/// The map stores linear depth, scaled to [0, 1]: depth = z * depthScale + depthOffset. Casters lie
/// well below 1, the depth of empty texels.
struct LightView
{
  LightRays rays;
  glm::dmat3 mapFromAcross{ 1.0 }; ///< w > 0 over everything visible; positive determinant
  double depthScale = 1.0;
  double depthOffset = 0.0;
  /// The z from which casters count: where the light begins, or just before a positional light's
  /// first caster.
  double beginsAt = -std::numeric_limits<double>::infinity();
  /// The part of the map that may be read. It is smaller than the map only if the last fit is
  /// pending (LightViews::awaitFit).
  Rectangle readable = wholeMap;
  /// If the last fit also chooses a warp, its candidates for mapFromAcross. The first is
  /// mapFromAcross itself, which is uniform.
  std::vector<glm::dmat3> warps;

  /// True if texels have, or may get, different sizes across the light. Then linear functions
  /// across the light are not linear on the map.
  bool warped() const
  {
    return this->mapFromAcross[0].z != 0.0 || this->mapFromAcross[1].z != 0.0 ||
      !this->warps.empty();
  }
  /// True if a plane's depth is affine on the map.
  bool depthIsAffine() const { return !this->rays.positional && !this->warped(); }

  /// Return the transformation to OpenGL's clip space, with the map's x and y. If depth is affine
  /// on the map, z/w is that depth scaled to [-1, 1]. Else z is 0 and the fragment shader computes
  /// depth.
  glm::dmat4 clipFromCentred() const;

  /// True if the readable part may show part of the box; false only if it shows nothing of it.
  /// @param centred box in centred coordinates
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

/// Return the homography from across coordinates to texels of a square map, in [0, size]^2.
glm::dmat3 texelFromAcross(const glm::dmat3& mapFromAcross, int sizeTexels);
glm::dmat3 texelFromAcross(const LightView& view, int sizeTexels);

} // namespace gnomon
