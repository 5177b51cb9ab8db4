#include "shadowtech/base/PixelRays.h"

#include <cmath>

namespace gnomon
{

PixelRays pixelRays(
  const glm::dmat4& clipFromView, const glm::dmat4& centredFromView, int width, int height)
{
  // In clip coordinates, the lines of sight of all pixels meet at the infinite end of the z axis.
  // In view coordinates that is the centre of projection, or the common direction.
  const glm::dmat4 viewFromClip = glm::inverse(clipFromView);
  const glm::dvec4 meeting = viewFromClip[2];
  const glm::dvec4 perColumn = 2.0 / width * viewFromClip[0];
  const glm::dvec4 perRow = 2.0 / height * viewFromClip[1];
  const glm::dvec4 first =
    viewFromClip[3] + (0.5 - 0.5 * width) * perColumn + (0.5 - 0.5 * height) * perRow;

  const glm::dmat3 rotation(centredFromView);
  PixelRays rays;
  constexpr double parallelBelow = 1e-12; // rounding leaves this much of a zero
  if (std::abs(meeting.w) > parallelBelow * glm::length(glm::dvec3(meeting)))
  {
    const glm::dvec3 eye = glm::dvec3(meeting) / meeting.w;
    const auto fromEye = [&](const glm::dvec4& point) { return glm::dvec3(point) - point.w * eye; };
    // Where t is 1, the middle of the picture lies at depth 1.
    const double depth = -fromEye(viewFromClip[3]).z;
    rays.firstOrigin = glm::dvec3(centredFromView * glm::dvec4(eye, 1.0));
    rays.firstDirection = rotation * fromEye(first) / depth;
    rays.directionPerColumn = rotation * fromEye(perColumn) / depth;
    rays.directionPerRow = rotation * fromEye(perRow) / depth;
    return rays;
  }
  // Parallel: the origins lie where the rays pass z = 0.
  const glm::dvec3 direction = glm::dvec3(meeting) / -meeting.z;
  const auto atEye = [&](const glm::dvec4& point)
  {
    const glm::dvec3 position = glm::dvec3(point) / viewFromClip[3].w;
    return position + position.z * direction;
  };
  rays.firstOrigin = glm::dvec3(centredFromView * glm::dvec4(atEye(first), 1.0));
  rays.originPerColumn = rotation * atEye(perColumn);
  rays.originPerRow = rotation * atEye(perRow);
  rays.firstDirection = rotation * direction;
  return rays;
}

} // namespace gnomon
