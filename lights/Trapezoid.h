#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The focus region's share of the map's height: Martin and Tan's 80 % line.
constexpr double trapezoidFocusLine = 0.8;

/// Return the warp of trapezoidal shadow maps (Martin, Tan: Anti-aliasing and Continuity with
/// Trapezoidal Shadow Maps, 2004). The trapezoid around the visible points, as the light sees them,
/// fills the map. Its parallel sides are across the centre line, the image of the camera's axis
/// between the nearest and farthest visible distance. Its legs meet at a point on that line and
/// touch the visible points. The focus region fills 80 % of the map for one choice of that point
/// (section 5.2).
///
/// The paper leaves the focus region to the user. Here it is the nearest 80 % of the visible depth
/// on a logarithmic scale, up to n (f/n)^0.8. Texels with logarithmic spacing have uniform
/// perspective aliasing (Wimmer et al. 2004, section 4), and little depth needs little perspective.
///
/// @param bodyView the visible body's vertices in the light's view space, with z > 0 for a
/// positional light
/// @return mapFromAcross, with w > 0 over the body and a positive determinant; the body's image
/// lies in [-1, 1]^2, near points at the bottom. It is exactly the uniform map for a centre line
/// without length (light along the view: "duelling frusta"), a parallel camera, and a warp that
/// would gain little (warpedOrUniform). Without vertices it is the identity.
glm::dmat3 trapezoidFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
