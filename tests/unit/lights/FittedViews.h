#pragma once

#include "Random.h"
#include "ViewPoints.h"

#include "lights/LightSpace.h"
#include "lights/MapAliasing.h"
#include "lights/MapFit.h"
#include "lights/VisibleBody.h"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::test
{

using Points = std::vector<glm::dvec3>;

inline CameraView perspectiveCamera(const glm::dvec3& eye, const glm::dvec3& focus,
  double fieldOfViewDegrees, double nearDistance, double farDistance)
{
  const glm::dvec3 direction = glm::normalize(focus - eye);
  const glm::dvec3 up =
    std::abs(direction.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
  return { glm::lookAt(eye, focus, up),
    glm::perspective(glm::radians(fieldOfViewDegrees), 1.0, nearDistance, farDistance) };
}

/// Return the distance of a point from the eye's plane, along the direction of view.
inline double distanceOf(const CameraView& camera, const glm::dvec3& centred)
{
  return -(camera.viewFromCentred * glm::dvec4(centred, 1.0)).z;
}

inline LightRays directionalRays(const glm::dvec3& direction)
{
  ShadowLight light;
  light.kind = LightKind::Directional;
  light.directionWorld = glm::normalize(direction);
  return { lightFromCentred(light, glm::dvec3(0.0)), false };
}

inline LightRays spotRays(const glm::dvec3& position, const glm::dvec3& direction)
{
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.positionWorld = position;
  light.directionWorld = glm::normalize(direction);
  return { lightFromCentred(light, glm::dvec3(0.0)), true };
}

inline glm::dvec3 inView(const LightRays& rays, const glm::dvec3& centred)
{
  return glm::dvec3(rays.viewFromCentred * glm::dvec4(centred, 1.0));
}

/// A camera and a light over a scene.
struct Setting
{
  std::string name;
  CameraView camera;
  LightRays rays;
  std::vector<HalfSpace> reach;
  Bounds scene;

  ConvexBody body() const
  {
    return visibleBody(this->camera, this->scene, this->rays, this->reach);
  }

  bool sees(const glm::dvec3& centred) const
  {
    const glm::dvec4 clip = this->camera.clipFromCentred() * glm::dvec4(centred, 1.0);
    bool result = glm::all(glm::lessThanEqual(glm::abs(glm::dvec3(clip)), glm::dvec3(clip.w))) &&
      glm::all(glm::lessThanEqual(this->scene.lower, centred)) &&
      glm::all(glm::lessThanEqual(centred, this->scene.upper));
    for (const HalfSpace& halfSpace : this->reach)
    {
      result = result && glm::dot(halfSpace, glm::dvec4(inView(this->rays, centred), 1.0)) >= 0.0;
    }
    return result;
  }

  /// Return random points that the camera and the light see, in centred coordinates. They are found
  /// without the body, from the scene's box and the camera's frustum.
  Points visiblePoints(Random& random, int attempts) const
  {
    const glm::dmat4 centredFromClip = glm::inverse(this->camera.clipFromCentred());
    Points result;
    for (int i = 0; i < attempts; ++i)
    {
      const glm::dvec3 share = 0.5 + inCube(random, 0.5);
      glm::dvec3 point = glm::mix(this->scene.lower, this->scene.upper, share);
      if (i % 2 == 0)
      {
        const glm::dvec4 corner = centredFromClip * glm::dvec4(2.0 * share - 1.0, 1.0);
        point = glm::dvec3(corner) / corner.w;
      }
      if (this->sees(point))
      {
        result.push_back(point);
      }
    }
    return result;
  }
};

/// Return cameras and lights of all kinds around a scene of any size. Many are awkward: light along
/// the view, either way, along the axes, from the eye; cameras in the scene; flat scenes; parallel
/// projections.
inline Setting randomSetting(Random& random)
{
  const auto vector = [&] { return inCube(random); };
  const auto unit = [&] { return uniform(random, 0.0, 1.0); };
  const auto chance = [&](double probability) { return unit() < probability; };
  const double size = std::pow(10.0, uniform(random, -3.0, 6.0));

  Setting setting;
  setting.scene.add(size * vector());
  setting.scene.add(size * vector());
  if (chance(0.3))
  {
    setting.scene.upper.y = setting.scene.lower.y;
  }
  const double distance = chance(0.5) ? 1.0 : 4.0; // within the scene, or outside
  const glm::dvec3 eye = size * distance * vector();
  const double nearDistance = size * std::pow(10.0, -4.0 * unit());
  setting.camera = perspectiveCamera(
    eye, size * vector(), 1.0 + 119.0 * unit(), nearDistance, nearDistance + size * 10.0 * unit());
  if (chance(0.1))
  {
    setting.camera.clipFromView = glm::ortho(-size, size, -size, size, 0.0, 8.0 * size);
  }

  glm::dvec3 direction = vector();
  glm::dvec3 position = size * 2.0 * vector();
  if (chance(0.15))
  {
    direction = (chance(0.5) ? 1.0 : -1.0) * setting.camera.directionCentred();
    position = chance(0.5) ? setting.camera.eyeCentred()
                           : setting.camera.eyeCentred() - size * 3.0 * direction;
  }
  else if (chance(0.1))
  {
    direction = glm::dvec3(0.0, chance(0.5) ? 1.0 : -1.0, 0.0);
  }
  if (chance(0.5))
  {
    setting.name = "directional";
    setting.rays = directionalRays(direction);
    if (chance(0.2))
    {
      setting.name = "box";
      setting.reach = boxHalfSpaces(size * (0.1 + unit()) * glm::dvec3(1.0, 0.7, 2.0));
    }
    return setting;
  }
  setting.rays = spotRays(position, direction);
  const double nearest = nearestOf(setting.scene, setting.rays);
  if (chance(0.3))
  {
    setting.name = "cube face";
    setting.reach = cubeFaceHalfSpaces(nearest);
    return setting;
  }
  setting.name = "spot";
  setting.reach = coneHalfSpaces(std::tan(glm::radians(0.1 + 59.9 * unit())), nearest);
  return setting;
}

/// A point of a surface, in centred coordinates.
struct SurfacePoint
{
  glm::dvec3 positionCentred;
  glm::dvec3 normalCentred; ///< of any length but 0
};

/// Return d(image)/d(u, v) of a projection at a point, for a surface spanned by two tangents.
/// @param homogeneous images of the point and the tangents: (numerators, w)
inline glm::dmat2 jacobian(
  const glm::dvec3& homogeneous, const glm::dvec3& tangentU, const glm::dvec3& tangentV)
{
  // d(a/w) = (da - (a/w) dw) / w
  const glm::dvec2 image = glm::dvec2(homogeneous) / homogeneous.z;
  return { (glm::dvec2(tangentU) - image * tangentU.z) / homogeneous.z,
    (glm::dvec2(tangentV) - image * tangentV.z) / homogeneous.z };
}

/// Return the rows of x, y and w alone.
inline glm::dvec3 xyw(const glm::dvec4& clip)
{
  return { clip.x, clip.y, clip.w };
}

/// Return the sides of a map's texel on a surface, in pixels of the camera's picture. This is the
/// aliasing measure of both axes of the map (Apelles, eqs 3.17 and 3.18; Lloyd 2007, section 3.2).
/// A texel above 1 is visible.
///
/// @param mapFromAcross the projection with its fit
/// @return nothing if the measure is undefined: the surface is edge-on to the light, or the point
/// is not in front of the camera and in the light's view
inline std::optional<glm::dvec2> texelPixels(const SurfacePoint& point, const CameraView& camera,
  const glm::dvec2& viewportPixels, const LightRays& rays, const glm::dmat3& mapFromAcross,
  int mapSizeTexels)
{
  const glm::dvec3 normal = glm::normalize(point.normalCentred);
  const glm::dvec3 u = glm::normalize(glm::cross(axisAcross(normal), normal));
  const glm::dvec3 v = glm::cross(normal, u);

  const glm::dmat4 clipFromCentred = camera.clipFromCentred();
  const glm::dvec3 screen = xyw(clipFromCentred * glm::dvec4(point.positionCentred, 1.0));
  // Across coordinates are homogeneous, too: (x, y, z) of a positional light, else (x, y, 1).
  const auto acrossOf = [&](const glm::dvec4& centred)
  {
    const glm::dvec4 view = rays.viewFromCentred * centred;
    return mapFromAcross * glm::dvec3(view.x, view.y, rays.positional ? view.z : centred.w);
  };
  const glm::dvec4 position(point.positionCentred, 1.0);
  const glm::dvec3 map = acrossOf(position);
  if (!(screen.z > 0.0) || !(map.z > 0.0))
  {
    return std::nullopt;
  }
  const glm::dmat2 screenFromSurface = jacobian(
    screen, xyw(clipFromCentred * glm::dvec4(u, 0.0)), xyw(clipFromCentred * glm::dvec4(v, 0.0)));
  const glm::dmat2 mapFromSurface =
    jacobian(map, acrossOf(glm::dvec4(u, 0.0)), acrossOf(glm::dvec4(v, 0.0)));
  const double area = std::abs(glm::determinant(mapFromSurface));
  const double size = glm::length(mapFromSurface[0]) * glm::length(mapFromSurface[0]) +
    glm::length(mapFromSurface[1]) * glm::length(mapFromSurface[1]);
  if (!(area > 1e-12 * size))
  {
    return std::nullopt;
  }
  const glm::dmat2 screenFromMap = screenFromSurface * glm::inverse(mapFromSurface);
  // Both map from device coordinates, where each side is 2 long.
  const glm::dvec2 texel(
    glm::length(screenFromMap[0] * viewportPixels), glm::length(screenFromMap[1] * viewportPixels));
  return texel / static_cast<double>(mapSizeTexels);
}

/// Return the points of the plane z = 0 that the camera sees in the scene, for a grid of its
/// pixels.
inline std::vector<SurfacePoint> groundSeen(const Setting& setting)
{
  std::vector<SurfacePoint> result;
  constexpr int side = 64;
  for (int i = 0; i < side * side; ++i)
  {
    const glm::dvec2 device = 2.0 * (glm::dvec2(i % side, i / side) + 0.5) / double(side) - 1.0;
    const glm::dvec3 point = seenAt(setting.camera, device, { 0.0, 0.0, 1.0, 0.0 });
    if (setting.sees({ point.x, point.y, 0.0 }))
    {
      result.push_back({ { point.x, point.y, 0.0 }, { 0.0, 0.0, 1.0 } });
    }
  }
  return result;
}

/// Return the largest side of a texel on these points, in pixels, for a map and a picture of 1024 x
/// 1024.
inline double worstTexel(
  const std::vector<SurfacePoint>& points, const Setting& setting, const glm::dmat3& mapFromAcross)
{
  double result = 0.0;
  for (const SurfacePoint& point : points)
  {
    if (const auto texel =
          texelPixels(point, setting.camera, glm::dvec2(1024.0), setting.rays, mapFromAcross, 1024))
    {
      result = std::max({ result, texel->x, texel->y });
    }
  }
  return result;
}

/// A wide plain, seen from a low eye above it, up to its end.
inline Setting terrain(const LightRays& rays)
{
  Setting setting;
  setting.name = "terrain";
  setting.scene = { { -1000.0, -1000.0, -1.0 }, { 1000.0, 1000.0, 30.0 } };
  setting.camera = perspectiveCamera({ 0.0, -900.0, 10.0 }, { 0.0, 0.0, 0.0 }, 40.0, 1.0, 3000.0);
  setting.rays = rays;
  return setting;
}

} // namespace gnomon::test
