#include "lights/Trapezoid.h"

#include "lights/MapFit.h"
#include "lights/MapWarp.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// Lower limit of the focus region's share of the depth, and of its difference from the region's
/// share of the map. It keeps the warp finite if the region has no length, or all of the depth.
constexpr double leastFocus = 1e-3;

/// Return the focus region's extent in the frame's y, as a share of the frame's depth: delta' /
/// lambda.
double focusOf(const WarpFrame& frame, const CameraView& camera, const LightRays& rays)
{
  const double distance =
    frame.nearest * std::pow(frame.farthest / frame.nearest, trapezoidFocusLine);
  const glm::dvec3 centred = camera.eyeCentred() + distance * camera.directionCentred();
  const glm::dvec3 view(rays.viewFromCentred * glm::dvec4(centred, 1.0));
  if (rays.positional && !(view.z > 0.0))
  {
    // The axis' image passes infinity at the light. That is beyond the far end of the visible range
    // if the axis runs towards the light, and before the near end if it runs away.
    const double directionZ = (glm::dmat3(rays.viewFromCentred) * camera.directionCentred()).z;
    return directionZ < 0.0 ? 1.0 : 0.0;
  }
  return mapped(frame.frameFromAcross, rays.across(view)).y / frame.depth;
}

} // namespace

glm::dmat3 trapezoidFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const auto frame = warpFrame(bodyView, camera, rays);
  if (!frame)
  {
    return uniformFromAcross(rays.across(bodyView));
  }
  // eta is the distance of the centre of projection from the near side. The focus region ends on
  // the 80 % line if eta = lambda delta' (1 + xi) / (lambda - 2 delta' - lambda xi), xi = 1 - 2 *
  // 80 %. A region that has 80 % of the depth needs no perspective.
  const double focus =
    std::clamp(focusOf(*frame, camera, rays), leastFocus, trapezoidFocusLine - leastFocus);
  const double xi = 1.0 - 2.0 * trapezoidFocusLine;
  const double eta = focus * (1.0 + xi) / (1.0 - 2.0 * focus - xi);
  // The published method has no fall-off, and is worse than uniform if one end of the frustum hides
  // the other. So LiSPSM's fall-off is used.
  return warpedOrUniform(*frame, fallOff(*frame, eta), bodyView, camera, rays);
}

} // namespace gnomon
