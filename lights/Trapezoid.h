#pragma once

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The share of the map's height that the focus region gets: Martin and Tan's 80 % line.
constexpr double trapezoidFocusLine = 0.8;

/// Trapezoidal shadow maps (Martin, Tan: Anti-aliasing and Continuity with Trapezoidal Shadow Maps,
/// 2004): the trapezoid around what is visible, as the light sees it, fills the map. Its parallel
/// sides stand across the centre line, the image of the camera's axis between the nearest and the
/// farthest visible distance; its legs touch the visible points from a point on that line, chosen
/// so that the focus region fills 80 % of the map (section 5.2).
///
/// The focus region, which the paper leaves to the user, is the nearest 80 % of the visible depth
/// on a logarithmic scale, up to n (f/n)^0.8: texels spread like logarithms have even perspective
/// aliasing (Wimmer et al. 2004, section 4), and little depth needs little perspective.
///
/// @param bodyView the visible body's vertices in the light's view space; with z > 0 of a
/// positional light
/// @return mapFromAcross, which takes the body into [-1, 1]^2, near points at the bottom, with w >
/// 0 over the body and a positive determinant. Exactly the uniform map where the centre line has no
/// length (light along the view: "duelling frusta"), for parallel cameras, and wherever a warp
/// would hardly gain (warpedOrUniform); the identity without vertices.
glm::dmat3 trapezoidFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
