#include "lights/Trapezoid.h"

#include "lights/MapFit.h"
#include "lights/MapWarp.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// The focus region is taken to be at least this share of the depth, and this much less than what
/// it gets on the map: the warp stays finite where the region has no length, or all.
constexpr double leastFocus = 1e-3;

/// How far the focus region reaches in the frame's y, as a share of its depth: delta' / lambda.
double focusOf(const WarpFrame& frame, const CameraView& camera, const LightRays& rays)
{
  const double distance =
    frame.nearest * std::pow(frame.farthest / frame.nearest, trapezoidFocusLine);
  const glm::dvec3 centred = camera.eyeCentred() + distance * camera.directionCentred();
  const glm::dvec3 view(rays.viewFromCentred * glm::dvec4(centred, 1.0));
  if (rays.positional && !(view.z > 0.0))
  {
    // The axis' image runs through infinity where it passes the light: beyond the far end of what
    // is visible if it runs towards the light, before its near end if it comes from there.
    const double directionZ = (glm::dmat3(rays.viewFromCentred) * camera.directionCentred()).z;
    return directionZ < 0.0 ? 1.0 : 0.0;
  }
  return mapped(frame.frameFromAcross, rays.across(view)).y / frame.depth;
}

} // namespace

//------------------------------------------------------------------------------
glm::dmat3 trapezoidFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays)
{
  const auto frame = warpFrame(bodyView, camera, rays);
  if (!frame)
  {
    return uniformFromAcross(rays.across(bodyView));
  }
  // The distance of the centre of projection from the near side: the focus region ends on the 80 %
  // line where eta = lambda delta' (1 + xi) / (lambda - 2 delta' - lambda xi), xi = 1 - 2 * 80 %. A
  // region that has 80 % anyway needs no perspective.
  const double focus =
    std::clamp(focusOf(*frame, camera, rays), leastFocus, trapezoidFocusLine - leastFocus);
  const double xi = 1.0 - 2.0 * trapezoidFocusLine;
  const double eta = focus * (1.0 + xi) / (1.0 - 2.0 * focus - xi);
  // The published method has no fall-off, and is worse than uniform where one end of the frustum
  // hides the other; that of LiSPSM serves.
  return warpedOrUniform(*frame, fallOff(*frame, eta), bodyView, camera, rays);
}

} // namespace gnomon
