#include "shadowtech/penumbra/LightShaft.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gnomon
{
namespace
{

/// Slope by which a start's view is wider than the light, and a shaft wider than its views. Wider
/// strips where rounding matters around an edge are tested separately.
constexpr double moreSlope = 1.0 / 8192.0;

/// Bounds the relative error of where on its way a ray hits a triangle that is not seen edge-on
/// (docs/theory/exact_penumbrae.md).
constexpr double moreOfWay = 1.0 / 24.0;

/// The steepest slope of a shaft's rays.
constexpr double mostSlope = 2.0;

/// Return the rotation to axes with the given z. Its x is along one of the light's own axes, if
/// possible.
glm::dmat3 axesAlong(const glm::dvec3& z, const glm::dmat3& area)
{
  glm::dvec3 x(0.0);
  for (int i = 0; i < 2; ++i)
  {
    const glm::dvec3 across = area[i] - glm::dot(area[i], z) * z;
    if (glm::dot(across, across) > 0.25 * glm::dot(area[i], area[i]) && x == glm::dvec3(0.0))
    {
      x = glm::normalize(across);
    }
  }
  if (x == glm::dvec3(0.0))
  {
    x = axisAcross(z);
    x = glm::normalize(x - glm::dot(x, z) * z);
  }
  return glm::transpose(glm::dmat3(x, glm::cross(z, x), z));
}

} // namespace

std::optional<LightShaft> LightShaft::make(const ShaftLight& light, const RayStarts& starts)
{
  LightShaft shaft;
  shaft.starts_ = starts.bounds();
  shaft.origin_ = shaft.starts_.centre();
  shaft.directional_ = light.rays.kind == LightKind::Directional;
  const glm::dvec3 centre = light.rays.position;
  const glm::dvec3 axis =
    shaft.directional_ ? glm::dvec3(light.rays.toLight) : centre - shaft.origin_;
  const double distance = shaft.directional_ ? 1.0 : glm::length(axis);
  if (!(distance > 0.0))
  {
    return std::nullopt;
  }
  shaft.shaftFromCentred_ = axesAlong(glm::normalize(axis), light.area.worldFromUnit);
  const glm::dmat3 area = shaft.shaftFromCentred_ * light.area.worldFromUnit;
  shaft.lightHalf_ = glm::abs(area[0]) + glm::abs(area[1]) + glm::abs(area[2]);
  shaft.lightDistance_ = distance;
  Bounds startsShaft;
  for (const glm::vec3& start : starts)
  {
    startsShaft.add(shaft.toShaft(start));
  }
  if (!shaft.laySides(startsShaft) || !shaft.layEnds(light, area, startsShaft))
  {
    return std::nullopt;
  }
  shaft.startsRadius_ = shaft.starts_.radius();
  const auto toCentred = [&](const Plane& plane)
  {
    const glm::dvec3 outwards = plane.outwards * shaft.shaftFromCentred_;
    return Plane{ outwards, plane.distance + glm::dot(outwards, shaft.origin_) };
  };
  Planes& sides = shaft.sidesCentred_;
  sides.distance.fill(std::numeric_limits<double>::infinity());
  const auto put = [&](std::size_t i, const Plane& plane)
  {
    sides.x[i] = plane.outwards.x;
    sides.y[i] = plane.outwards.y;
    sides.z[i] = plane.outwards.z;
    sides.distance[i] = plane.distance;
  };
  for (std::size_t i = 0; i < shaft.sides_.size(); ++i)
  {
    put(i, toCentred(shaft.sides_[i]));
  }
  put(shaft.sides_.size(), toCentred({ shaft.end_, shaft.lastEnd_ }));
  shaft.firstEndCentred_ = toCentred({ shaft.end_, shaft.firstEnd_ });
  return shaft;
}

/// Set the sides around all that a start sees within slopes(), as edges are counted up to there.
/// @return false if there is no shaft
bool LightShaft::laySides(const Bounds& startsShaft)
{
  const glm::dvec3& lower = startsShaft.lower;
  const glm::dvec3& upper = startsShaft.upper;
  if (!(this->lightDistance_ - this->lightHalf_.z > (this->directional_ ? 0.5 : upper.z)))
  {
    return false;
  }
  this->allSlopes_ = this->slopes(startsShaft.lower);
  for (const glm::dvec3& corner : startsShaft.corners())
  {
    const Slopes of = this->slopes(corner);
    this->allSlopes_.least = glm::min(this->allSlopes_.least, of.least);
    this->allSlopes_.most = glm::max(this->allSlopes_.most, of.most);
  }
  const glm::dvec2 steepest =
    glm::max(glm::abs(this->allSlopes_.least), glm::abs(this->allSlopes_.most));
  this->longestSlope_ = 1.0 + steepest.x + steepest.y;
  this->firstStart_ = lower.z;
  for (int i = 0; i < 2; ++i)
  {
    const auto lay = [&](double sign, double start, double slopeOfAll)
    {
      const double slope = slopeOfAll + moreSlope;
      glm::dvec3 outwards(0.0, 0.0, -slope);
      outwards[i] = sign;
      return Plane{ outwards, start - slope * (slope > 0.0 ? lower.z : upper.z) };
    };
    const auto side = static_cast<std::size_t>(2 * i);
    this->sides_[side] = lay(1.0, upper[i], this->allSlopes_.most[i]);
    this->sides_[side + 1] = lay(-1.0, -lower[i], -this->allSlopes_.least[i]);
  }
  this->sides_[4] = { { 0.0, 0.0, -1.0 }, -lower.z };
  return steepest.x < mostSlope && steepest.y < mostSlope;
}

/// Set where rays end. That is the plane of a flat light, or of a box's near face; else the box
/// around the light.
/// @param area of the light, in the shaft's coordinates
/// @return false if there is no shaft
bool LightShaft::layEnds(const ShaftLight& light, const glm::dmat3& area, const Bounds& startsShaft)
{
  if (this->directional_ && !light.rays.hasBox)
  {
    return true;
  }
  const glm::dvec3 centre = light.rays.position;
  const glm::dvec3 centreShaft = this->toShaft(centre);
  const double distance = glm::length(centreShaft);
  // Add rounding of coordinates.
  const double rounding =
    std::ldexp(glm::length(centre) + glm::length(this->origin_) + distance, -18);
  glm::dvec3 normal = this->directional_ ? glm::dvec3(0.0, 0.0, 1.0) : glm::cross(area[0], area[1]);
  if (this->directional_ || (area[2] == glm::dvec3(0.0) && glm::length(normal) > 0.0))
  {
    normal = glm::normalize(normal);
    normal *= glm::dot(normal, centreShaft) < 0.0 ? -1.0 : 1.0;
    const double end = glm::dot(normal, centreShaft);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0.0;
    for (const glm::dvec3& corner : startsShaft.corners())
    {
      nearest = std::min(nearest, end - glm::dot(normal, corner));
      farthest = std::max(farthest, end - glm::dot(normal, corner));
    }
    if (nearest > 16.0 * rounding && nearest > (this->directional_ ? farthest : distance) / 16.0)
    {
      this->end_ = normal;
      this->firstEnd_ = end - moreOfWay * farthest - rounding;
      this->lastEnd_ = end + moreOfWay * farthest + rounding;
      return true;
    }
    if (this->directional_)
    {
      return false;
    }
  }
  this->end_ = { 0.0, 0.0, 1.0 };
  const double more = moreOfWay * (distance + this->lightHalf_.z - startsShaft.lower.z) + rounding;
  this->firstEnd_ = distance - this->lightHalf_.z - more;
  this->lastEnd_ = distance + this->lightHalf_.z + more;
  return this->firstEnd_ > startsShaft.upper.z;
}

LightShaft::Slopes LightShaft::slopes(const glm::dvec3& start) const
{
  Slopes slopes;
  for (int i = 0; i < 2; ++i)
  {
    const double from = this->directional_ ? 0.0 : start[i];
    const double nearest =
      this->lightDistance_ - this->lightHalf_.z - (this->directional_ ? 0.0 : start.z);
    const double farthest = nearest + 2.0 * this->lightHalf_.z;
    const double most = this->lightHalf_[i] - from;
    const double least = -this->lightHalf_[i] - from;
    slopes.most[i] = most / (most > 0.0 ? nearest : farthest) + moreSlope;
    slopes.least[i] = least / (least < 0.0 ? nearest : farthest) - moreSlope;
  }
  return slopes;
}

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
bool LightShaft::mayMeet(const Bounds& centred) const
{
  const glm::dvec3 centre = centred.centre();
  const glm::dvec3 half = centred.upper - centre;
  const Planes& planes = this->sidesCentred_;
  std::int64_t outside = 0;
  for (std::size_t i = 0; i < planes.x.size(); ++i)
  {
    const double nearest = planes.x[i] * centre.x - std::abs(planes.x[i]) * half.x +
      (planes.y[i] * centre.y - std::abs(planes.y[i]) * half.y) +
      (planes.z[i] * centre.z - std::abs(planes.z[i]) * half.z);
    outside |= nearest > planes.distance[i] ? 1 : 0;
  }
  return outside == 0;
}

bool LightShaft::mayReachEnds(const Bounds& centred) const
{
  const glm::dvec3 centre = centred.centre();
  const Plane& end = this->firstEndCentred_;
  return glm::dot(end.outwards, centre) +
    glm::dot(glm::abs(end.outwards), centred.upper - centre) >=
    end.distance;
}

glm::dvec2 LightShaft::extentAlong(const glm::dvec3& centred, const Slopes& slopes) const
{
  const glm::dvec3 along = this->shaftFromCentred_ * centred;
  const glm::dvec2 middle = 0.5 * (slopes.least + slopes.most);
  const glm::dvec2 half = slopes.most - middle;
  const double ofMiddle = glm::dot(along, glm::dvec3(middle, 1.0));
  const double more = std::abs(along.x) * half.x + std::abs(along.y) * half.y;
  return { ofMiddle - more, ofMiddle + more };
}

bool LightShaft::passes(
  const glm::dvec3& from, const glm::dvec3& to, double length, double uncertain) const
{
  // From a start s instead of the origin, from x to changes by s x (to - from).
  const glm::dvec3 across = glm::cross(from, to);
  const glm::dvec2 middle = 0.5 * (this->allSlopes_.least + this->allSlopes_.most);
  const glm::dvec2 half = this->allSlopes_.most - middle;
  return std::abs(glm::dot(across, glm::dvec3(middle, 1.0))) > std::abs(across.x) * half.x +
    std::abs(across.y) * half.y + this->startsRadius_ * length * this->longestSlope_ + uncertain;
}

} // namespace gnomon
