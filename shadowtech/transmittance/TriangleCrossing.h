#pragma once

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace gnomon
{

/// Where a line crosses a triangle.
struct TriangleCrossing
{
  double at;          ///< in lengths of the direction
  glm::dvec3 weights; ///< barycentric, by corner
  bool leavesFront;   ///< the line leaves on the side that shows the corners counter-clockwise
};

/// Return where a line crosses a triangle; none if it misses it or lies in its plane.
///
/// Triangles that share an edge or a corner partition the line's hits: of those around it, a line
/// through it crosses exactly as many as a line next to it. The signs of the three edge functions
/// are exact. Where one is 0, the line counts as moved by (e, e^2, e^3) for an infinitely small e
/// (Edelsbrunner and Muecke 1990, Simulation of Simplicity), by which no edge function is 0 unless
/// the line is parallel to the edge.
///
/// @param corners less the line's origin. Equal corners must be equal bit for bit
/// @param direction of any length but 0
std::optional<TriangleCrossing> crossingOf(
  const std::array<glm::dvec3, 3>& corners, const glm::dvec3& direction);

} // namespace gnomon
