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

/// An area light as shafts see it: centred, what its samples are within.
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

/// The shaft of some shadow rays' starts: a space that holds all of their rays to an area light.
/// Its own coordinates are turned and moved only: z grows towards the light's centre, x and y
/// across.
class LightShaft
{
public:
  /// Rays whose direction is (x, y, 1) with these.
  struct Slopes
  {
    glm::dvec2 least, most;
  };

  /// @param starts centred; at least one
  /// @return nothing where the light is too close, or too large, or seen from its side
  static std::optional<LightShaft> make(const ShaftLight& light, const RayStarts& starts);

  glm::dvec3 toShaft(const glm::dvec3& centred) const
  {
    return this->shaftFromCentred_ * (centred - this->origin_);
  }
  /// Turns directions.
  const glm::dmat3& rotation() const { return this->shaftFromCentred_; }

  const Bounds& starts() const { return this->starts_; }
  /// Slopes of the rays from one of the starts, with some more around them.
  /// @param start in the shaft's coordinates
  Slopes slopes(const glm::dvec3& start) const;

  /// Whether a box may meet it. Larger than it is by as much as rays may be from what they meet by
  /// rounding.
  bool mayMeet(const Bounds& centred) const;
  /// The same of a triangle, and of an edge, in its coordinates.
  /// @param more by how much the shaft's slopes are larger than that
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

  /// Whether the line of an edge passes all rays by.
  /// @param uncertain how little of cross(from, to) times a ray's (x, y, 1) says nothing
  bool passes(const glm::dvec3& from, const glm::dvec3& to, double length, double uncertain) const;
  /// The least and the most of the product of a vector and any ray's (x, y, 1).
  /// @param centred the vector
  ///@{
  glm::dvec2 extentAlong(const glm::dvec3& centred) const
  {
    return this->extentAlong(centred, this->allSlopes_);
  }
  glm::dvec2 extentAlong(const glm::dvec3& centred, const Slopes& slopes) const;
  ///@}
  /// Not less than the length of (x, y, 1) for any ray's slopes.
  double longestSlope() const { return this->longestSlope_; }

  /// Where rays end: none of them beyond `last`, none before `first`, as endDepth() has it.
  /// Infinite where they go on for ever.
  double firstEnd() const { return this->firstEnd_; }
  double lastEnd() const { return this->lastEnd_; }
  double endDepth(const glm::dvec3& point) const { return glm::dot(this->end_, point); }
  /// Whether a box may reach as far as the rays' ends.
  bool mayReachEnds(const Bounds& centred) const;

private:
  /// dot(outwards, point) <= distance inside.
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
  double lightDistance_ = 1.0;  ///< of its centre, which is at x = y = 0, from the origin
  glm::dvec3 lightHalf_{ 0.0 }; ///< half the box around it, or around its directions
  Slopes allSlopes_;            ///< of all rays
  double longestSlope_ = 1.0;
  double firstStart_ = 0.0; ///< the least z of the starts, in the shaft's coordinates
  std::array<Plane, 5> sides_;
  glm::dvec3 end_{ 0.0 };
  double firstEnd_ = std::numeric_limits<double>::infinity();
  double lastEnd_ = std::numeric_limits<double>::infinity();
  /// Centred: the sides and the last end, with planes beyond which nothing is up to as many as are
  /// compared at once.
  struct Planes
  {
    std::array<double, 8> x{}, y{}, z{}, distance{};
  };
  Planes sidesCentred_;
  Plane firstEndCentred_; ///< centred
};

} // namespace gnomon
