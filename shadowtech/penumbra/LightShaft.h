#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/penumbra/RayStarts.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace gnomon
{

/// An area light in centred coordinates, with bounds of its samples.
struct ShaftLight
{
  ShadowRayLight rays;
  LightArea area;

  ShaftLight(const ShadowLight& light, const glm::dvec3& centreWorld)
    : rays(light, centreWorld)
    , area(*light.area)
  {
  }
};

/// A space that holds all shadow rays from some starts to an area light. Its coordinates are
/// centred coordinates, rotated and moved. z grows towards the light's centre; x and y are across.
class LightShaft
{
public:
  /// A range of rays with direction (x, y, 1).
  struct Slopes
  {
    glm::dvec2 least, most;
  };

  /// Return the shaft of some starts.
  /// @param starts centred; at least one
  /// @return nothing if the light is too close, too large, or seen edge-on
  static std::optional<LightShaft> make(const ShaftLight& light, const RayStarts& starts);

  glm::dvec3 toShaft(const glm::dvec3& centred) const
  {
    return this->shaftFromCentred_ * (centred - this->origin_);
  }
  /// The rotation from centred directions to the shaft's.
  const glm::dmat3& rotation() const { return this->shaftFromCentred_; }

  const Bounds& starts() const { return this->starts_; }
  /// Return the slopes of the rays from one of the starts, with a small border.
  /// @param start in the shaft's coordinates
  Slopes slopes(const glm::dvec3& start) const;

  /// Return true if a box may meet the shaft. The test allows for rounding between rays and what
  /// they hit.
  bool mayMeet(const Bounds& centred) const;
  /// As above, for a triangle or an edge in the shaft's coordinates.
  /// @param more slope by which the shaft is widened
  template <std::size_t count>
  bool mayMeet(const std::array<glm::dvec3, count>& corners, double more = 0.0) const
  {
    for (const Plane& plane : this->sides_)
    {
      bool outside = true;
      for (const glm::dvec3& corner : corners)
      {
        outside &=
          glm::dot(plane.outwards, corner) - plane.distance > more * (corner.z - this->firstStart_);
      }
      if (outside)
      {
        return false;
      }
    }
    return true;
  }

  /// Return true if all rays pass an edge's line on one side.
  /// @param uncertain rays with at most this |dot(cross(from, to), (x, y, 1))| pass on no certain
  /// side
  bool passes(const glm::dvec3& from, const glm::dvec3& to, double length, double uncertain) const;
  /// Return the least and the most of a vector's product with any ray's (x, y, 1).
  /// @param centred the vector
  ///@{
  glm::dvec2 extentAlong(const glm::dvec3& centred) const
  {
    return this->extentAlong(centred, this->allSlopes_);
  }
  glm::dvec2 extentAlong(const glm::dvec3& centred, const Slopes& slopes) const;
  ///@}
  /// Return a bound of the length of (x, y, 1) over all rays.
  double longestSlope() const { return this->longestSlope_; }

  /// The depths, as endDepth(), before which no ray ends, and beyond which none does. Infinite if
  /// rays have no end.
  double firstEnd() const { return this->firstEnd_; }
  double lastEnd() const { return this->lastEnd_; }
  double endDepth(const glm::dvec3& point) const { return glm::dot(this->end_, point); }
  /// Return true if a box may reach the depth where rays end.
  bool mayReachEnds(const Bounds& centred) const;

private:
  /// A half space, inside if dot(outwards, point) <= distance.
  struct Plane
  {
    glm::dvec3 outwards;
    double distance;
  };

  LightShaft() = default;
  bool laySides(const Bounds& startsShaft);
  bool layEnds(const ShaftLight& light, const glm::dmat3& area, const Bounds& startsShaft);

  glm::dmat3 shaftFromCentred_;
  glm::dvec3 origin_;         ///< centred
  Bounds starts_;             ///< centred
  double startsRadius_ = 0.0; ///< around the origin
  bool directional_ = false;
  double lightDistance_ = 1.0;  ///< from the origin to its centre, which is at x = y = 0
  glm::dvec3 lightHalf_{ 0.0 }; ///< half the extent of its box, or of the box around its directions
  Slopes allSlopes_;            ///< of all rays
  double longestSlope_ = 1.0;
  double firstStart_ = 0.0; ///< the least z of the starts, in the shaft's coordinates
  std::array<Plane, 5> sides_;
  glm::dvec3 end_{ 0.0 };
  double firstEnd_ = std::numeric_limits<double>::infinity();
  double lastEnd_ = std::numeric_limits<double>::infinity();
  /// The sides and the last end in centred coordinates. Planes at infinity pad them to the width of
  /// a vector.
  struct Planes
  {
    std::array<double, 8> x{}, y{}, z{}, distance{};
  };
  Planes sidesCentred_;
  Plane firstEndCentred_; ///< centred
};

} // namespace gnomon
