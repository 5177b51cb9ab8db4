#include "plugin/data/CoarsePicture.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PixelRays.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/Solid.h"

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
/// that is mostly in shadow is as poor as ground without. Squared, the cosine of the angle to the
/// classic light is how much of its light is left: far from it, surfaces turn dull and shadows
/// long. A light from the right must be better by 5 %, as photographers start from the left.
double balance(const LightShares& shares, const KeyDirection& direction)
{
  const KeyDirection side{ std::copysign(classic, direction.left), classic };
  const double cosine = glm::dot(direction.towardsView(), side.towardsView());
  return std::min(1.0, shares.lit / 0.75) *
    std::min({ 1.0, shares.inShadow / 0.08, (1.0 - shares.inShadow) / 0.5 }) * cosine * cosine *
    (direction.left > 0.0 ? 1.0 : 0.95);
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

} // namespace

//------------------------------------------------------------------------------
glm::dvec3 KeyDirection::towardsView() const
{
  const double yaw = glm::radians(this->left);
  const double pitch = glm::radians(this->above);
  return { -std::cos(pitch) * std::sin(yaw), std::sin(pitch), std::cos(pitch) * std::cos(yaw) };
}

//------------------------------------------------------------------------------
CoarsePicture::CoarsePicture(const Occluders& occluders, const CameraView& camera)
  : centredFromView_(glm::transpose(glm::dmat3(camera.viewFromCentred)))
{
  this->tracer_.update(occluders);
  const bool allCast = std::all_of(occluders.surfaces.begin(), occluders.surfaces.end(),
    [](const Surface& surface) { return surface.casts; });
  if (allCast)
  {
    this->look(occluders, camera, this->tracer_);
  }
  else // the camera sees surfaces that do not cast, too
  {
    Occluders seen;
    seen.positionsCentred.reserve(occluders.positionsCentred.size() + 1); // for Embree
    seen.positionsCentred = occluders.positionsCentred;
    seen.triangles = occluders.triangles;
    seen.surfaces = occluders.surfaces;
    seen.topologyVersion = occluders.topologyVersion;
    seen.positionsVersion = occluders.positionsVersion;
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

//------------------------------------------------------------------------------
/// Find the point that each ray of the camera meets.
void CoarsePicture::look(
  const Occluders& occluders, const CameraView& camera, const EmbreeTracer& eye)
{
  const PixelRays rays =
    pixelRays(camera.clipFromView, glm::inverse(camera.viewFromCentred), across, across);
  const glm::dvec2 side = camera.pixelSide({ across, across });
  const glm::dvec3 eyeCentred = camera.eyeCentred();
  // Lengths of the directions are distances across the view (PixelRays).
  const auto nearest = static_cast<float>(camera.nearDistance());
  std::vector<std::optional<Point>> met(std::size_t(across) * across);
  tbb::parallel_for(std::size_t(0), met.size(),
    [&](std::size_t i)
    {
      const glm::dvec3 origin = rays.origin(i % across, i / across);
      const glm::dvec3 direction = rays.direction(i % across, i / across);
      const std::optional<CasterHits::Hit> hit = eye.nearest(
        glm::vec3(origin), glm::vec3(direction), nearest, std::numeric_limits<float>::infinity());
      if (!hit || !occluders.surfaces[hit->surface].receives)
      {
        return;
      }
      Point point;
      float noise = 0.0f;
      if (hit->solid)
      {
        const SolidPoint seen = seenPoint(*hit->solid, origin, direction);
        point.position = seen.position;
        point.normal = seen.normal;
        noise = noiseOf(*hit->solid, seen);
      }
      else
      {
        point.position = origin + static_cast<double>(hit->at) * direction;
        point.normal = glm::normalize(hit->normalCentred);
        point.normal *= glm::dot(point.normal, glm::vec3(direction)) > 0.0f ? -1.0f : 1.0f;
        // Rounding of the ray and of its length is of the size of the storage noise.
        noise = 4.0f *
          storageNoise(point.normal, glm::abs(point.position) + glm::abs(glm::vec3(eyeCentred)));
      }
      point.footprint = static_cast<float>(side.x + side.y * hit->at);
      point.offset = shadowRayOffset(noise, point.footprint);
      if (std::isfinite(point.offset) && glm::dot(point.normal, point.normal) > 0.5f)
      {
        met[i] = point; // not of a triangle too small for a normal
      }
    });
  for (const std::optional<Point>& point : met)
  {
    if (point)
    {
      this->points_.push_back(*point);
    }
  }
}

//------------------------------------------------------------------------------
/// True if a point lies on the plane through another, to within half the rays' spacing there.
bool CoarsePicture::isOn(const Point& plane, const Point& point) const
{
  return std::abs(glm::dot(plane.normal, point.position - plane.position)) <=
    0.5f * point.footprint &&
    glm::dot(plane.normal, point.normal) > 0.98f;
}

//------------------------------------------------------------------------------
/// True if a good part of the picture lies on the plane through a point, and nearly all the rest in
/// front of it.
bool CoarsePicture::isGroundPlane(const Point& plane) const
{
  std::size_t on = 0;
  std::size_t behind = 0;
  for (const Point& point : this->points_)
  {
    const bool isOn = this->isOn(plane, point);
    on += isOn ? 1 : 0;
    behind +=
      !isOn && glm::dot(plane.normal, point.position - plane.position) < -0.5f * point.footprint
      ? 1
      : 0;
  }
  const std::size_t others = this->points_.size() - on;
  return 12 * on > this->points_.size() && 20 * behind <= others;
}

//------------------------------------------------------------------------------
/// Mark the ground, and forget what lies on it far from the subject.
void CoarsePicture::findGround()
{
  constexpr std::size_t planes = 64;
  const std::size_t step = std::max<std::size_t>(1, this->points_.size() / planes);
  for (std::size_t i = step / 2; i < this->points_.size(); i += step)
  {
    const Point plane = this->points_[i];
    if (!plane.isGround && this->isGroundPlane(plane))
    {
      for (Point& point : this->points_)
      {
        point.isGround |= this->isOn(plane, point);
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
  const auto isNear = [&](const Point& point)
  { return glm::distance(glm::dvec3(point.position), subject.centre()) < 1.5 * subject.radius(); };
  const auto isNearGround = [&](const Point& point) { return point.isGround && isNear(point); };
  this->groundCount_ = static_cast<std::size_t>(
    std::count_if(this->points_.begin(), this->points_.end(), isNearGround));
  if (subject.empty()) // planes alone are the subject
  {
    this->groundCount_ = 0;
    for (Point& point : this->points_)
    {
      point.isGround = false;
    }
  }
  this->points_.erase(std::remove_if(this->points_.begin(), this->points_.end(),
                        [&](const Point& point) { return point.isGround && !isNear(point); }),
    this->points_.end());
}

//------------------------------------------------------------------------------
LightShares CoarsePicture::sharesOf(const KeyDirection& direction) const
{
  const glm::vec3 towards(this->centredFromView_ * direction.towardsView());
  std::array<std::vector<float>, 6> rays; // origins and directions, by axis
  std::vector<bool> areGround;
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
      areGround.push_back(point.isGround);
    }
  }
  std::vector<std::uint8_t> blocked(areGround.size());
  this->tracer_.areBlocked(blocked.size(), { rays[0].data(), rays[1].data(), rays[2].data() },
    { rays[3].data(), rays[4].data(), rays[5].data() }, shadowRayFarDirectional, blocked.data());
  std::size_t lit = 0;
  std::size_t inShadow = 0;
  for (std::size_t i = 0; i < blocked.size(); ++i)
  {
    lit += !areGround[i] && blocked[i] == 0 ? 1 : 0;
    inShadow += areGround[i] && blocked[i] != 0 ? 1 : 0;
  }
  const std::size_t subject = this->points_.size() - this->groundCount_;
  LightShares shares;
  shares.lit = subject > 0 ? static_cast<double>(lit) / static_cast<double>(subject) : 0.0;
  shares.inShadow = this->groundCount_ > 0
    ? static_cast<double>(inShadow) / static_cast<double>(this->groundCount_)
    : 1.0 - shares.lit;
  return shares;
}

//------------------------------------------------------------------------------
CoarsePicture::Choice CoarsePicture::chooseKey() const
{
  const std::vector<KeyDirection> all = directions();
  std::vector<LightShares> shares(all.size());
  tbb::parallel_for(
    std::size_t(0), all.size(), [&](std::size_t i) { shares[i] = this->sharesOf(all[i]); });
  // A light that shows shadow beats all that do not.
  const auto rank = [&](std::size_t i)
  { return std::pair(showsShadow(shares[i]), balance(shares[i], all[i])); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    best = rank(best) < rank(i) ? i : best;
  }
  return { all[best], shares[best] };
}

} // namespace gnomon
