#include "plugin/data/CoarsePicture.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PixelRays.h"
#include "shadowtech/tracing/SeenReceiver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace gnomon
{
namespace
{

/// Where photographers put a key light first: half way to the side and half way up.
constexpr double classic = 45.0;

/// Return how well a light suits a picture, in [0, 1].
///
/// Three quarters of the subject lit model its form, as a sphere's under the classic light. Shadow
/// on 8 % of the ground is seen at once. More of either is no gain, as it costs the other. Ground
/// that is mostly dark is as poor as ground without shadow. Squared, the cosine of the angle to the
/// classic light is how much of its light is left: far from it, surfaces turn dull and shadows
/// long. A light from the right must be better by 10 %, as photographers start from the left.
double balance(const LightShares& shares, const KeyDirection& direction)
{
  const KeyDirection side{ std::copysign(classic, direction.left), classic };
  const double cosine = glm::dot(direction.towardsView(), side.towardsView());
  return std::min(1.0, shares.lit / 0.75) *
    std::min({ 1.0, shares.inShadow / 0.08, shares.litGround / 0.5 }) * cosine * cosine *
    (direction.left > 0.0 ? 1.0 : 0.9);
}

/// Return the directions to try. On equal terms the first is chosen: the classic light, then higher
/// ones.
std::vector<KeyDirection> directions()
{
  std::vector<KeyDirection> all{ { classic, classic }, { -classic, classic } };
  for (const double above : { 55.0, 45.0, 35.0, 65.0, 25.0 })
  {
    for (const double aside : { 40.0, 50.0, 30.0, 60.0, 20.0, 70.0 })
    {
      all.push_back({ aside, above });
      all.push_back({ -aside, above });
    }
  }
  return all;
}

float heightAbove(const CoarsePicture::Point& plane, const CoarsePicture::Point& point)
{
  return glm::dot(plane.normal, point.position - plane.position);
}

/// True if a point lies on the plane through another, to within half the rays' spacing there.
bool isOn(const CoarsePicture::Point& plane, const CoarsePicture::Point& point)
{
  return std::abs(heightAbove(plane, point)) <= 0.5f * point.spacing &&
    glm::dot(plane.normal, point.normal) > 0.98f;
}

/// True if a good part of the picture lies on the plane through a point, and nearly all the rest in
/// front of it.
bool isGroundPlane(
  const CoarsePicture::Point& plane, const std::vector<CoarsePicture::Point>& points)
{
  std::size_t on = 0;
  std::size_t behind = 0;
  for (const CoarsePicture::Point& point : points)
  {
    const bool isOnPlane = isOn(plane, point);
    on += isOnPlane ? 1 : 0;
    behind += !isOnPlane && heightAbove(plane, point) < -0.5f * point.spacing ? 1 : 0;
  }
  return 32 * on > points.size() && 20 * behind <= points.size() - on;
}

double share(std::size_t part, std::size_t all)
{
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

} // namespace

glm::dvec3 KeyDirection::towardsView() const
{
  const double yaw = glm::radians(this->left);
  const double pitch = glm::radians(this->above);
  return { -std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw) };
}

CoarsePicture::CoarsePicture(const Occluders& occluders, const CameraView& camera)
  : worldFromView_(glm::transpose(glm::dmat3(camera.viewFromCentred)))
{
  this->tracer_.update(occluders);
  const auto casts = [](const Surface& surface) { return surface.casts; };
  if (std::all_of(occluders.surfaces.begin(), occluders.surfaces.end(), casts))
  {
    this->look(occluders, camera, this->tracer_);
  }
  else // the camera sees surfaces that do not cast, too
  {
    Occluders seen = occluders;
    seen.positionsCentred.reserve(seen.positionsCentred.size() + 1); // see Occluders
    for (Surface& surface : seen.surfaces)
    {
      surface.casts = true;
    }
    EmbreeTracer eye;
    eye.update(seen);
    this->look(seen, camera, eye);
  }
  this->findGround();
}

/// Find the points that the camera's rays meet.
void CoarsePicture::look(
  const Occluders& occluders, const CameraView& camera, const EmbreeTracer& eye)
{
  const PixelRays rays =
    pixelRays(camera.clipFromView, glm::inverse(camera.viewFromCentred), across, across);
  const glm::dvec2 side = camera.pixelSide({ across, across });
  // In lengths of the direction, which are distances across the view (PixelRays).
  const auto nearest = static_cast<float>(camera.nearDistance());
  std::vector<std::optional<Point>> met(std::size_t(across) * across);
  const auto lookAt = [&](std::size_t i)
  {
    const glm::dvec3 origin = rays.origin(i % across, i / across);
    const glm::dvec3 direction = rays.direction(i % across, i / across);
    const std::optional<CasterHits::Hit> hit = eye.nearest(
      glm::vec3(origin), glm::vec3(direction), nearest, std::numeric_limits<float>::infinity());
    if (hit && occluders.surfaces[hit->surface].receives)
    {
      const SeenReceiver seen = seenReceiver(*hit, origin, direction, camera.eyeCentred());
      const auto spacing = static_cast<float>(side.x + side.y * hit->at);
      const float offset = shadowRayOffset(seen.noise, spacing);
      if (std::isfinite(offset)) // not of a triangle too small for a normal
      {
        met[i] = { seen.position, seen.normal, spacing, offset };
      }
    }
  };
  tbb::parallel_for(std::size_t(0), met.size(), lookAt);
  for (const std::optional<Point>& point : met)
  {
    if (point)
    {
      this->points_.push_back(*point);
    }
  }
}

/// Mark the ground, and forget what lies on it far from the subject.
void CoarsePicture::findGround()
{
  constexpr int planes = 256; // tried at points spread evenly over the picture (Roberts 2018)
  for (int i = 0; i < planes && !this->points_.empty(); ++i)
  {
    const double at =
      glm::fract(0.6180339887498949 * i) * static_cast<double>(this->points_.size());
    const Point plane = this->points_[static_cast<std::size_t>(at)];
    if (!plane.isGround && isGroundPlane(plane, this->points_))
    {
      for (Point& point : this->points_)
      {
        point.isGround |= isOn(plane, point);
      }
    }
  }
  Bounds subject;
  for (const Point& point : this->points_)
  {
    if (!point.isGround)
    {
      subject.add(glm::dvec3(point.position));
    }
  }
  const auto isFarGround = [&](const Point& point)
  {
    return point.isGround &&
      glm::distance(glm::dvec3(point.position), subject.centre()) >= 1.5 * subject.radius();
  };
  if (subject.empty()) // planes alone are the subject
  {
    for (Point& point : this->points_)
    {
      point.isGround = false;
    }
  }
  this->points_.erase(
    std::remove_if(this->points_.begin(), this->points_.end(), isFarGround), this->points_.end());
  this->groundCount_ = static_cast<std::size_t>(std::count_if(
    this->points_.begin(), this->points_.end(), [](const Point& point) { return point.isGround; }));
}

LightShares CoarsePicture::sharesOf(const KeyDirection& direction) const
{
  const glm::vec3 towards(this->towards(direction));
  std::array<std::vector<float>, 6> rays; // origins and directions, by axis
  std::vector<std::size_t> onGround;      // 1 or 0
  for (const Point& point : this->points_)
  {
    if (facesLight(point.normal, towards))
    {
      const glm::vec3 origin = point.position + point.offset * point.normal;
      for (int axis = 0; axis < 3; ++axis)
      {
        rays[static_cast<std::size_t>(axis)].push_back(origin[axis]);
        rays[static_cast<std::size_t>(axis + 3)].push_back(towards[axis]);
      }
      onGround.push_back(point.isGround ? 1 : 0);
    }
  }
  std::vector<std::uint8_t> blocked(onGround.size());
  this->tracer_.areBlocked(blocked.size(), { rays[0].data(), rays[1].data(), rays[2].data() },
    { rays[3].data(), rays[4].data(), rays[5].data() }, shadowRayFarDirectional, blocked.data());
  std::array<std::array<std::size_t, 2>, 2> counts{}; // by blocked and ground
  for (std::size_t i = 0; i < blocked.size(); ++i)
  {
    ++counts[blocked[i]][onGround[i]];
  }
  const double lit = share(counts[0][0], this->points_.size() - this->groundCount_);
  return !this->hasGround() ? LightShares{ lit, 1.0 - lit, lit }
                            : LightShares{ lit, share(counts[1][1], this->groundCount_),
                                share(counts[0][1], this->groundCount_) };
}

CoarsePicture::Choice CoarsePicture::chooseKey() const
{
  const std::vector<KeyDirection> all = directions();
  std::vector<LightShares> shares(all.size());
  tbb::parallel_for(
    std::size_t(0), all.size(), [&](std::size_t i) { shares[i] = this->sharesOf(all[i]); });
  // A light that shows form and shadow beats all that do not.
  const auto rank = [&](std::size_t i)
  { return std::pair(shares[i].suffice(), balance(shares[i], all[i])); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    best = rank(best) < rank(i) ? i : best;
  }
  return { all[best], shares[best] };
}

} // namespace gnomon
