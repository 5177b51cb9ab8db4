#include "lights/MapAliasing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon
{
namespace
{

/// d(image)/d(u, v) of a projection, at a point that two tangents span a surface around.
/// @param homogeneous the point's image and those of the tangents: (numerators, w)
glm::dmat2 jacobian(
  const glm::dvec3& homogeneous, const glm::dvec3& tangentU, const glm::dvec3& tangentV)
{
  // d(a/w) = (da - (a/w) dw) / w
  const glm::dvec2 image = glm::dvec2(homogeneous) / homogeneous.z;
  return { (glm::dvec2(tangentU) - image * tangentU.z) / homogeneous.z,
    (glm::dvec2(tangentV) - image * tangentV.z) / homogeneous.z };
}

/// The rows of x, y and w alone.
glm::dvec3 xyw(const glm::dvec4& clip)
{
  return { clip.x, clip.y, clip.w };
}

} // namespace

//------------------------------------------------------------------------------
std::optional<glm::dvec2> texelPixels(const SurfacePoint& point, const CameraView& camera,
  const glm::dvec2& viewportPixels, const LightRays& rays, const glm::dmat3& mapFromAcross,
  int mapSizeTexels)
{
  const glm::dvec3 normal = glm::normalize(point.normalCentred);
  const glm::dvec3 magnitude = glm::abs(normal);
  const glm::dvec3 aside =
    magnitude.x < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, normal));
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
  // Both from device coordinates, of which each side has 2.
  const glm::dvec2 texel(
    glm::length(screenFromMap[0] * viewportPixels), glm::length(screenFromMap[1] * viewportPixels));
  return texel / static_cast<double>(mapSizeTexels);
}

//------------------------------------------------------------------------------
PerspectiveAliasing perspectiveAliasing(const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays, const glm::dmat3& mapFromAcross)
{
  const glm::dmat3 acrossFromMap = glm::inverse(mapFromAcross);
  const glm::dmat4 cameraFromLight = camera.viewFromCentred * glm::inverse(rays.viewFromCentred);
  PerspectiveAliasing result;
  for (const glm::dvec3& point : bodyView)
  {
    const glm::dvec3 map = mapFromAcross * glm::dvec3(rays.across(point), 1.0);
    const glm::dmat2 acrossFromDevice =
      jacobian(acrossFromMap * (map / map.z), acrossFromMap[0], acrossFromMap[1]);
    const glm::dvec3 ray = rays.positional ? glm::normalize(point) : glm::dvec3(0.0, 0.0, 1.0);
    const double reach = rays.positional ? point.z : 1.0;
    const double distance =
      camera.isParallel() ? 1.0 : -(cameraFromLight * glm::dvec4(point, 1.0)).z;
    std::array<glm::dvec3, 2> sides;
    for (int axis = 0; axis < 2; ++axis)
    {
      const glm::dvec3 inPlane(reach / distance * acrossFromDevice[axis], 0.0);
      glm::dvec3& side = sides[static_cast<std::size_t>(axis)];
      side = inPlane - glm::dot(inPlane, ray) * ray;
      result.side = std::max(result.side, glm::length(side));
    }
    result.area = std::max(result.area, glm::length(glm::cross(sides[0], sides[1])));
  }
  return result;
}

} // namespace gnomon
