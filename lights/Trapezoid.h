#ifndef gnomon_lights_Trapezoid_h
#define gnomon_lights_Trapezoid_h

#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The share of the map's height that the focus region gets: Martin and Tan's 80 % line.
constexpr double trapezoidFocusLine = 0.8;
/// The share of the visible depth that the focus region takes from its near end.
constexpr double trapezoidFocusShare = 0.2;

/// Trapezoidal shadow maps (Martin, Tan: Anti-aliasing and Continuity with Trapezoidal Shadow Maps,
/// 2004): the trapezoid around what is visible, as the light sees it, fills the map. Its parallel
/// sides stand across the centre line, the image of the camera's axis between the nearest and the
/// farthest visible distance; its legs touch the visible points from a point on that line, chosen so
/// that the focus region fills 80 % of the map (section 5.2).
///
/// @param bodyView the visible body's vertices in the light's view space; with z > 0 of a positional
/// light
/// @return mapFromAcross, which takes the body into [-1, 1]^2, near points at the bottom, with w > 0
/// over the body and a positive determinant. Uniform where the centre line has no length (light
/// along the view: "duelling frusta"), and for parallel cameras; the identity without vertices.
glm::dmat3 trapezoidFromAcross(
  const std::vector<glm::dvec3>& bodyView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon

#endif
