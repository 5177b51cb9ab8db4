#pragma once

#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace gnomon
{

/// An axis-aligned rectangle; empty until a point is added, then lower <= upper.
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

/// The images of points under a homography, all of which it must see with w > 0.
Rectangle rangeOf(const glm::dmat3& mapFromAcross, const std::vector<glm::dvec2>& across);

/// Takes a rectangle to [-1, 1]^2. An extent of 0 is widened, relative to its coordinates. The
/// identity of an empty one.
glm::dmat3 uniformFromRange(const Rectangle& range);

/// The uniform projection of points: that of their rectangle, by scale and offset alone.
glm::dmat3 uniformFromAcross(const std::vector<glm::dvec2>& across);

/// F: a scale and an offset per axis of a map's normalised device coordinates.
struct MapFit
{
  glm::dvec2 scale{ 1.0 };
  glm::dvec2 offset{ 0.0 };

  /// To be multiplied from the left: F mapFromAcross.
  glm::dmat3 matrix() const
  {
    return { this->scale.x, 0.0, 0.0, 0.0, this->scale.y, 0.0, this->offset.x, this->offset.y,
      1.0 };
  }
};

/// The texels of a map's side and of the border that is kept free around what is visible. No more
/// than a quarter of the side is kept on either side (fitLightViews).
struct MapTexels
{
  int side = 1024; ///< at least 4
  int border = 0;

  /// The share of [-1, 1] that lies inside of the border.
  double inside() const;
  /// What a map covers whose casters fill [-1, 1]^2 and that keeps its border outside of them.
  Rectangle covered() const;
};

/// The least part of what is to be covered that a map is fitted to. At a side of 1024, the texels
/// of a smaller one would be narrower than the spacing of floats there.
constexpr double leastVisibleShare = 1e-4;

/// Fits what is visible into the map: [lower, upper] to [-1, 1] less the border, s = 2 / (max -
/// min), o = -s (max + min) / 2. (Selected Real-Time Shadow Techniques, eqs 3.9 and 3.10.)
///
/// What is visible is cut to what is to be covered: the fit never looks beyond it. Less than
/// leastVisibleShare of what is to be covered, or none at all, is widened to that.
///
/// @param visible in the device coordinates of the projection before the fit
/// @param covered the same: of all that can be there
/// @return nothing where nothing is visible: the map can be left out, and everything is lit
std::optional<MapFit> fitTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered = wholeMap);

/// As fitTo(), but steady while the camera moves: the scale is one of a fixed series, and the
/// offset a whole number of texels, so that the texels stay where they are in the projection before
/// the fit. This must not depend on the camera (uniformFromAcross() of the whole scene does not).
///
/// The series: the scale that fits `covered`, times 2^(k/4), k = 0, 1, 2, ... Steps of 2^(1/4) cost
/// 8 % of the resolution on average and 16 % at most, and lie so far apart that what the camera
/// sees has to change by 19 % from one to the next. Half a texel is kept free on either side for
/// the offset's rounding.
std::optional<MapFit> fitSnappedTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered = wholeMap);

} // namespace gnomon
