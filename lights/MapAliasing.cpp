#include "lights/MapAliasing.h"

#include "lights/KernelShape.h"

#include <algorithm>
#include <array>

namespace gnomon
{

PerspectiveAliasing perspectiveAliasing(const std::vector<glm::dvec3>& bodyView,
  const CameraView& camera, const LightRays& rays, const glm::dmat3& mapFromAcross)
{
  const glm::dmat3 acrossFromMap = glm::inverse(mapFromAcross);
  const glm::dmat4 cameraFromLight = camera.viewFromCentred * glm::inverse(rays.viewFromCentred);
  PerspectiveAliasing result;
  for (const glm::dvec3& point : bodyView)
  {
    const glm::dmat2 acrossFromDevice =
      texelJacobian(acrossFromMap, mapped(mapFromAcross, rays.across(point)));
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
