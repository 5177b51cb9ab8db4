#include "lights/MapWarp.h"

#include "lights/MapAliasing.h"
#include "lights/MapFit.h"
#include "lights/VisibleBody.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon
{
namespace
{

/// Smaller sines count as 0: light along the view, or a light on the camera's axis.
constexpr double leastSine = 1e-6;
/// Smaller ratios of lengths count as 0: no depth, or infinite depth.
constexpr double leastDepth = 1e-6;
constexpr double leastNearest = 1e-9;

/// A perspective with this near distance or more, in units of the depth, counts as uniform.
constexpr double largestNearWarp = 1e6;

glm::dvec2 meanOf(const std::vector<glm::dvec2>& points)
{
  glm::dvec2 result(0.0);
  for (const glm::dvec2& point : points)
  {
    result += point / static_cast<double>(points.size());
  }
  return result;
}

/// The image of the camera's axis on the plane of the light's rays.
struct AxisImage
{
  glm::dvec2 along; ///< unit vector, growing with the distance from the camera
  double offset;    ///< the line's coordinate along (along.y, -along.x)
};

/// Return the axis' image; nothing if it is a point.
/// @param eye, direction of the camera in the light's view space
std::optional<AxisImage> imageOfAxis(
  const glm::dvec3& eye, const glm::dvec3& direction, bool positional)
{
  if (!positional)
  {
    const double length = glm::length(glm::dvec2(direction));
    if (!(length > leastSine))
    {
      return std::nullopt;
    }
    const glm::dvec2 along = glm::dvec2(direction) / length;
    return AxisImage{ along, along.y * eye.x - along.x * eye.y };
  }
  // The plane through the light and the axis is dot(plane, (across, 1)) = 0. Along the axis, slopes
  // change by (plane.y, -plane.x) / z^2, so they grow in one direction on the whole axis.
  const glm::dvec3 plane = glm::cross(eye, direction);
  const double length = glm::length(glm::dvec2(plane));
  if (!(length > leastSine * glm::length(eye)))
  {
    return std::nullopt;
  }
  return AxisImage{ { plane.y / length, -plane.x / length }, plane.z / length };
}

/// Return half the field of view in the plane of the direction of view and `aside`.
/// @param asideCamera unit vector across the direction of view, in the camera's view space
double halfFieldOfViewDegrees(const CameraView& camera, const glm::dvec3& asideCamera)
{
  const double tangent = std::abs(asideCamera.x / camera.clipFromView[0][0]) +
    std::abs(asideCamera.y / camera.clipFromView[1][1]);
  return glm::degrees(std::atan(tangent));
}

} // namespace

std::optional<WarpFrame> warpFrame(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  if (bodyView.empty() || camera.isParallel())
  {
    return std::nullopt;
  }
  const glm::dvec3 eye(rays.viewFromCentred * glm::dvec4(camera.eyeCentred(), 1.0));
  const glm::dvec3 direction = glm::dmat3(rays.viewFromCentred) * camera.directionCentred();
  const auto axis = imageOfAxis(eye, direction, rays.positional);
  const std::vector<glm::dvec2> across = rays.across(bodyView);
  const glm::dvec3 ray =
    rays.positional ? glm::normalize(glm::dvec3(meanOf(across), 1.0)) : glm::dvec3(0.0, 0.0, 1.0);
  const double cosine = std::clamp(glm::dot(ray, direction), -1.0, 1.0);
  const glm::dvec3 aside = ray - cosine * direction;
  const double sine = glm::length(aside);
  const DistanceRange distances = distancesOf(bodyView, camera, rays);
  if (!axis || !(sine > leastSine) || !(distances.lower > leastNearest * distances.upper) ||
    !(distances.upper > distances.lower * (1.0 + leastDepth)))
  {
    return std::nullopt;
  }

  const glm::dmat3 rotation = glm::transpose(glm::dmat3(
    axis->along.y, -axis->along.x, 0.0, axis->along.x, axis->along.y, 0.0, 0.0, 0.0, 1.0));
  const Rectangle range = rangeOf(rotation, across);
  WarpFrame frame;
  frame.depth = range.upper.y - range.lower.y;
  if (!(frame.depth > leastDepth * (range.upper.x - range.lower.x)))
  {
    return std::nullopt;
  }
  const glm::dvec2 origin(std::clamp(axis->offset, range.lower.x, range.upper.x), range.lower.y);
  frame.frameFromAcross =
    glm::dmat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -origin.x, -origin.y, 1.0) * rotation;
  frame.nearest = distances.lower;
  frame.farthest = distances.upper;
  frame.gammaDegrees = glm::degrees(std::atan2(sine, cosine));
  const glm::dvec3 asideCamera = glm::dmat3(camera.viewFromCentred) *
    (glm::transpose(glm::dmat3(rays.viewFromCentred)) * (aside / sine));
  frame.thetaDegrees = halfFieldOfViewDegrees(camera, asideCamera);
  return frame;
}

glm::dmat3 warpedFromAcross(
  const WarpFrame& frame, double nearWarp, const std::vector<glm::dvec2>& across)
{
  const double n = nearWarp;
  const double f = n + frame.depth;
  // Columns; the last one includes the offset by n.
  const glm::dmat3 perspective(1.0, 0.0, 0.0, 0.0, (f + n) / frame.depth, 1.0, 0.0,
    (f + n) / frame.depth * n - 2.0 * f * n / frame.depth, n);
  const glm::dmat3 warped = perspective * frame.frameFromAcross;
  return uniformFromRange(rangeOf(warped, across)) * warped;
}

double warpEta(double gammaDegrees, double thetaDegrees)
{
  const double gamma = std::min(gammaDegrees, 180.0 - gammaDegrees);
  const double gammaA = thetaDegrees / 3.0;
  const double gammaB = thetaDegrees;
  const double gammaC = thetaDegrees + 0.3 * (90.0 - thetaDegrees);
  constexpr double etaB = -0.2;
  constexpr double etaC = 0.0;
  // A field of view of 0 or 180 degrees leaves an interval empty, and its branch is not entered.
  if (gamma <= gammaA)
  {
    return -1.0;
  }
  if (gamma < gammaB)
  {
    const double angle = glm::radians(90.0 * (gamma - gammaA) / (gammaB - gammaA));
    return -1.0 + (etaB + 1.0) * (1.0 - std::cos(angle));
  }
  if (gamma < gammaC)
  {
    const double angle = glm::radians(90.0 * (gamma - gammaB) / (gammaC - gammaB));
    return etaB + (etaC - etaB) * std::sin(angle);
  }
  return etaC;
}

double fallOff(const WarpFrame& frame, double nearWarp)
{
  const double eta = warpEta(frame.gammaDegrees, frame.thetaDegrees);
  return eta > -1.0 ? (nearWarp - eta) / (1.0 + eta) : std::numeric_limits<double>::infinity();
}

double leastAliasingNear(const WarpFrame& frame, const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays)
{
  const std::vector<glm::dvec2> across = rays.across(bodyView);
  const auto aliasing = [&](double logarithm)
  {
    const double nearWarp = std::exp(logarithm) * frame.depth;
    return perspectiveAliasing(bodyView, camera, rays, warpedFromAcross(frame, nearWarp, across))
      .side;
  };
  // Golden section search. Aliasing grows with the near distance at the near end and shrinks at the
  // far end, so the larger of both has one minimum.
  const double section = 0.5 * (std::sqrt(5.0) - 1.0);
  double lower = std::log(1e-4);
  double upper = std::log(1e4);
  double a = upper - section * (upper - lower);
  double b = lower + section * (upper - lower);
  double aliasingA = aliasing(a);
  double aliasingB = aliasing(b);
  while (upper - lower > 1e-4)
  {
    if (aliasingA <= aliasingB)
    {
      upper = b;
      b = a;
      aliasingB = aliasingA;
      a = upper - section * (upper - lower);
      aliasingA = aliasing(a);
    }
    else
    {
      lower = a;
      a = b;
      aliasingA = aliasingB;
      b = lower + section * (upper - lower);
      aliasingB = aliasing(b);
    }
  }
  return std::exp(0.5 * (lower + upper));
}

glm::dmat3 warpedOrUniform(const WarpFrame& frame, double nearWarp,
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const std::vector<glm::dvec2> across = rays.across(bodyView);
  const glm::dmat3 uniform = uniformFromAcross(across);
  if (!(nearWarp < largestNearWarp))
  {
    return uniform;
  }
  const glm::dmat3 warped = warpedFromAcross(frame, nearWarp * frame.depth, across);
  return perspectiveAliasing(bodyView, camera, rays, warped).area <
      largestAreaShare * perspectiveAliasing(bodyView, camera, rays, uniform).area
    ? warped
    : uniform;
}

} // namespace gnomon
