#include "lights/VisibleBody.h"

#include "lights/LightSpace.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

using Polygon = std::vector<glm::dvec3>;

bool isFinite(const glm::dvec4& vector)
{
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z) &&
    std::isfinite(vector.w);
}

double distanceFrom(const HalfSpace& halfSpace, const glm::dvec3& point)
{
  return glm::dot(glm::dvec3(halfSpace), point) + halfSpace.w;
}

void sortAndRemoveDuplicates(std::vector<glm::dvec3>& points)
{
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Sort coplanar corners of a convex polygon around their centre.
Polygon ordered(std::vector<glm::dvec3> corners, const glm::dvec3& normal)
{
  glm::dvec3 centre(0.0);
  for (const glm::dvec3& corner : corners)
  {
    centre += corner / static_cast<double>(corners.size());
  }
  // Two arbitrary axes in the plane.
  const glm::dvec3 u = glm::cross(normal, axisAcross(normal));
  const glm::dvec3 v = glm::cross(normal, u) / glm::length(normal);
  std::vector<std::pair<double, glm::dvec3>> byAngle;
  byAngle.reserve(corners.size());
  for (const glm::dvec3& corner : corners)
  {
    const glm::dvec3 outwards = corner - centre;
    byAngle.emplace_back(std::atan2(glm::dot(outwards, v), glm::dot(outwards, u)), corner);
  }
  std::sort(
    byAngle.begin(), byAngle.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Polygon result;
  result.reserve(byAngle.size());
  for (const auto& [angle, corner] : byAngle)
  {
    result.push_back(corner);
  }
  return result;
}

/// Clip a polygon by Sutherland's and Hodgman's algorithm.
/// @param cut receives the corners that lie on the plane
Polygon clippedPolygon(
  const Polygon& polygon, const HalfSpace& halfSpace, std::vector<glm::dvec3>& cut)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec3& from = polygon[i];
    const glm::dvec3& to = polygon[(i + 1) % polygon.size()];
    const double distanceFromStart = distanceFrom(halfSpace, from);
    const double distanceFromEnd = distanceFrom(halfSpace, to);
    if (distanceFromStart >= 0.0)
    {
      result.push_back(from);
      if (distanceFromStart == 0.0)
      {
        cut.push_back(from);
      }
    }
    if ((distanceFromStart > 0.0 && distanceFromEnd < 0.0) ||
      (distanceFromStart < 0.0 && distanceFromEnd > 0.0))
    {
      // Interpolate from the inner end, so both polygons at an edge get the same point.
      const bool leaves = distanceFromStart > 0.0;
      const glm::dvec3& inner = leaves ? from : to;
      const glm::dvec3& outer = leaves ? to : from;
      const double a = leaves ? distanceFromStart : distanceFromEnd;
      const double b = leaves ? distanceFromEnd : distanceFromStart;
      const glm::dvec3 point = inner + (outer - inner) * (a / (a - b));
      result.push_back(point);
      cut.push_back(point);
    }
  }
  return result;
}

glm::dmat4 centredFromLight(const LightRays& rays)
{
  return glm::inverse(rays.viewFromCentred);
}

/// Return the half space, in the light's view space, beyond this distance along the camera's
/// direction.
HalfSpace beyond(const CameraView& camera, const LightRays& rays, double distance)
{
  const glm::dmat4 cameraFromLight = camera.viewFromCentred * centredFromLight(rays);
  return { -cameraFromLight[0][2], -cameraFromLight[1][2], -cameraFromLight[2][2],
    -cameraFromLight[3][2] - distance };
}

} // namespace

ConvexBody::ConvexBody(const Bounds& box, const glm::dmat4& transformation)
{
  if (box.empty())
  {
    return;
  }
  std::array<glm::dvec3, 8> corners = box.corners();
  for (glm::dvec3& corner : corners)
  {
    corner = glm::dvec3(transformation * glm::dvec4(corner, 1.0));
    if (!isFinite(glm::dvec4(corner, 0.0)))
    {
      return;
    }
  }
  // The corners around each face. Bits 0, 1 and 2 of a corner's index are x, y and z.
  constexpr std::array<std::array<std::size_t, 4>, 6> faces{ { { 0, 2, 6, 4 }, { 1, 3, 7, 5 },
    { 0, 1, 5, 4 }, { 2, 3, 7, 6 }, { 0, 1, 3, 2 }, { 4, 5, 7, 6 } } };
  for (const auto& face : faces)
  {
    Polygon& polygon = this->polygons_.emplace_back();
    for (const std::size_t corner : face)
    {
      polygon.push_back(corners[corner]);
    }
  }
}

ConvexBody ConvexBody::clipped(const HalfSpace& halfSpace) const
{
  ConvexBody result;
  if (!isFinite(halfSpace))
  {
    return result;
  }
  if (glm::dvec3(halfSpace) == glm::dvec3(0.0))
  {
    return halfSpace.w >= 0.0 ? *this : result; // all or nothing, such as a far plane at infinity
  }
  std::vector<glm::dvec3> cut;
  for (const Polygon& polygon : this->polygons_)
  {
    if (Polygon rest = clippedPolygon(polygon, halfSpace, cut); !rest.empty())
    {
      result.polygons_.push_back(std::move(rest));
    }
  }
  sortAndRemoveDuplicates(cut);
  if (cut.size() >= 3)
  {
    result.polygons_.push_back(ordered(std::move(cut), glm::dvec3(halfSpace)));
  }
  return result;
}

ConvexBody ConvexBody::clipped(const std::vector<HalfSpace>& halfSpaces) const
{
  ConvexBody result = *this;
  for (const HalfSpace& halfSpace : halfSpaces)
  {
    result = result.clipped(halfSpace);
  }
  return result;
}

std::vector<glm::dvec3> ConvexBody::vertices() const
{
  std::vector<glm::dvec3> result;
  for (const Polygon& polygon : this->polygons_)
  {
    result.insert(result.end(), polygon.begin(), polygon.end());
  }
  sortAndRemoveDuplicates(result);
  return result;
}

std::vector<HalfSpace> coneHalfSpaces(double coneTangent, double nearest)
{
  std::vector<HalfSpace> result{ { 0.0, 0.0, 1.0, -nearest } };
  constexpr int sides = 8;
  for (int i = 0; i < sides; ++i)
  {
    const double angle = glm::radians(360.0 * i / sides);
    result.emplace_back(-std::cos(angle), -std::sin(angle), coneTangent, 0.0);
  }
  return result;
}

std::vector<HalfSpace> cubeFaceHalfSpaces(double nearest)
{
  return { { 0.0, 0.0, 1.0, -nearest }, { -1.0, 0.0, 1.0, 0.0 }, { 1.0, 0.0, 1.0, 0.0 },
    { 0.0, -1.0, 1.0, 0.0 }, { 0.0, 1.0, 1.0, 0.0 } };
}

std::vector<HalfSpace> boxHalfSpaces(const glm::dvec3& box)
{
  return { { 0.0, 0.0, 1.0, 0.0 }, { 0.0, 0.0, -1.0, box.z }, { -1.0, 0.0, 0.0, box.x },
    { 1.0, 0.0, 0.0, box.x }, { 0.0, -1.0, 0.0, box.y }, { 0.0, 1.0, 0.0, box.y } };
}

double nearestOf(const Bounds& sceneCentred, const LightRays& rays)
{
  double farthest = 0.0;
  for (const glm::dvec3& corner : sceneCentred.corners())
  {
    farthest = std::max(farthest, (rays.viewFromCentred * glm::dvec4(corner, 1.0)).z);
  }
  return nearestShare * farthest;
}

ConvexBody visibleBody(const CameraView& camera, const Bounds& sceneCentred, const LightRays& rays,
  const std::vector<HalfSpace>& reach)
{
  // The frustum's planes are sums and differences of its matrix' rows: -w <= x <= w and so on.
  const glm::dmat4 rows = glm::transpose(camera.clipFromCentred() * centredFromLight(rays));
  std::vector<HalfSpace> frustum;
  for (int axis = 0; axis < 3; ++axis)
  {
    frustum.push_back(rows[3] + rows[axis]);
    frustum.push_back(rows[3] - rows[axis]);
  }
  return ConvexBody(sceneCentred, rays.viewFromCentred).clipped(reach).clipped(frustum);
}

ConvexBody sliced(const ConvexBody& body, const CameraView& camera, const LightRays& rays,
  double nearDistance, double farDistance)
{
  return body.clipped(beyond(camera, rays, nearDistance))
    .clipped(-beyond(camera, rays, farDistance));
}

DistanceRange distancesOf(
  const std::vector<glm::dvec3>& pointsView, const CameraView& camera, const LightRays& rays)
{
  const HalfSpace before = beyond(camera, rays, 0.0);
  DistanceRange result{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (const glm::dvec3& point : pointsView)
  {
    const double distance = distanceFrom(before, point);
    result.lower = std::min(result.lower, distance);
    result.upper = std::max(result.upper, distance);
  }
  return result;
}

} // namespace gnomon
