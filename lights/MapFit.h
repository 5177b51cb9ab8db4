#pragma once

#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace gnomon
{

/// An axis-aligned rectangle. It is empty until a point is added; then lower <= upper.
struct Rectangle
{
  glm::dvec2 lower{ std::numeric_limits<double>::infinity() };
  glm::dvec2 upper{ -std::numeric_limits<double>::infinity() };

  bool empty() const { return !(this->lower.x <= this->upper.x && this->lower.y <= this->upper.y); }
  void add(const glm::dvec2& point)
  {
    this->lower = glm::min(this->lower, point);
    this->upper = glm::max(this->upper, point);
  }

  bool operator==(const Rectangle& other) const
  {
    return this->lower == other.lower && this->upper == other.upper;
  }
};

/// A map's whole range in its normalised device coordinates.
constexpr Rectangle wholeMap{ glm::dvec2(-1.0), glm::dvec2(1.0) };

/// Return the range of points' images under a homography. All images must have w > 0.
Rectangle rangeOf(const glm::dmat3& mapFromAcross, const std::vector<glm::dvec2>& across);

/// Return the scale and offset that take a rectangle to [-1, 1]^2. An extent of 0 is widened
/// relative to the coordinates. For an empty rectangle, return the identity.
glm::dmat3 uniformFromRange(const Rectangle& range);

/// Return the uniform projection of points, by scale and offset, which takes their rectangle to
/// [-1, 1]^2.
glm::dmat3 uniformFromAcross(const std::vector<glm::dvec2>& across);

/// F: a scale and an offset per axis of a map's normalised device coordinates.
struct MapFit
{
  glm::dvec2 scale{ 1.0 };
  glm::dvec2 offset{ 0.0 };

  /// Return F as a matrix, to be multiplied from the left: F mapFromAcross.
  glm::dmat3 matrix() const
  {
    return { this->scale.x, 0.0, 0.0, 0.0, this->scale.y, 0.0, this->offset.x, this->offset.y,
      1.0 };
  }
};

/// The sizes of a map's side and border in texels. The border surrounds the visible range and takes
/// at most a quarter of the side at each end (fitLightViews).
struct MapTexels
{
  int side = 1024; ///< at least 4
  int border = 0;

  /// Return the share of [-1, 1] inside the border, at least 0.5.
  double inside() const;
  /// Return the range of a map whose casters fill [-1, 1]^2, border included.
  Rectangle covered() const;
};

/// The least share of the covered range that a map is fitted to. With a side of 1024, a smaller
/// share would make texels narrower than the spacing of floats.
constexpr double leastVisibleShare = 1e-4;

/// Fit the visible range into the map: take [min, max] to [-1, 1] less the border, by s = 2 / (max
/// - min), o = -s (max + min) / 2 (Selected Real-Time Shadow Techniques, equations 3.9 and 3.10).
///
/// The visible range is clipped to the covered range. If its extent is below leastVisibleShare of
/// the covered range, or 0, it is widened to that share.
///
/// @param visible visible range, in device coordinates before the fit
/// @param covered range that the map may show, in the same coordinates
/// @return nothing if nothing is visible; then no map is needed, and everything is lit
std::optional<MapFit> fitTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered = wholeMap);

/// Fit as fitTo() does, but steadily while the camera moves. The scale is one of a fixed series and
/// the offset a whole number of texels, so texels stay in place in the projection before the fit.
/// That projection must not depend on the camera (uniformFromAcross() of the whole scene does not).
///
/// The series is the scale that fits `covered`, times 2^(k/4), k = 0, 1, 2 and so on. Its steps
/// cost 8 % of the resolution on average and 16 % at most. The visible range must change by 19 % to
/// reach the next step. Half a texel at each end is reserved for the offset's rounding.
std::optional<MapFit> fitSnappedTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered = wholeMap);

} // namespace gnomon
