#pragma once

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::test
{

/// Return the share of a disk, or of an outline that looks like one, on one side of a line. The
/// line is at this distance from its middle, in radii.
inline double diskShare(double distance)
{
  const double t = std::clamp(distance, -1.0, 1.0);
  return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / glm::pi<double>();
}

/// Return the same share of a square, for a line along two of its sides, in half sides.
inline double squareShare(double distance)
{
  return std::clamp(0.5 + 0.5 * distance, 0.0, 1.0);
}

/// The visible share of a level lamp around (0, 0, lampHeight) from (x, 0, 0), past the edge x = 0,
/// z = edgeHeight of a half plane at x < 0. All lengths are in world units.
struct LampPastEdge
{
  double edgeHeight;
  double lampHeight;
  double halfSize; ///< half a side, or the radius

  double square(double x) const { return squareShare(this->distance(x) / this->edgeHeight); }
  double disk(double x) const { return diskShare(this->distance(x) / this->edgeHeight); }
  /// A ball's outline lies across the direction to it, so the plane through the receiver and the
  /// edge cuts it.
  double ball(double x) const
  {
    return diskShare(this->distance(x) / std::hypot(x, this->edgeHeight));
  }

private:
  double distance(double x) const
  {
    return x * (this->lampHeight - this->edgeHeight) / this->halfSize;
  }
};

/// The same for a sun in the zenith.
struct SunPastEdge
{
  double edgeHeight;
  double tangent; ///< of half the sun's angle

  double square(double x) const { return squareShare(x / (this->tangent * this->edgeHeight)); }
  double disk(double x) const { return diskShare(x / (this->tangent * this->edgeHeight)); }
};

} // namespace gnomon::test
