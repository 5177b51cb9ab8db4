#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

/// @file
/// Spheres and cylinders that VTK draws as impostors: a fragment shader meets the pixel's ray with
/// them. Receivers and shadow rays know them as what they are, in double precision. Maps draw the
/// surface's triangles, a mesh whose corners lie on the solid: it is behind what is seen of a
/// solid, so that no solid shadows itself.

/// What each instance of a surface is.
enum class Solid : std::uint8_t
{
  None,     ///< the surface's triangles
  Sphere,   ///< the image of the unit ball, under a matrix that scales all axes alike
  Cylinder, ///< the image of x^2 + y^2 <= 1, |z| <= 1, whose ends are flat
  /// A part of a line: a cylinder with a ball around either end, so that bends have no gaps. At a
  /// bend, parts reach into each other. Hence a tube blocks no ray that begins inside of it, and
  /// receivers lie on its cylinder, never on a ball.
  Tube
};

/// A solid where it stands, centred.
struct PlacedSolid
{
  Solid kind;
  glm::dvec3 centre;
  double radius;
  glm::dvec3 axis{ 0.0 };  ///< of a cylinder or tube: unit
  double halfLength = 0.0; ///< likewise
};

/// @param centredFromSource an instance that is not left out
PlacedSolid placedSolid(Solid kind, const glm::mat4x3& centredFromSource);

/// The box around a solid, closed under rounding to float.
Bounds boundsOf(const PlacedSolid& solid);

/// The box around all solids of a surface, those left out excepted.
Bounds solidsBounds(Solid kind, const std::vector<glm::mat4x3>& centredFromSource);

/// Where a line runs inside of a solid.
struct Crossing
{
  double enters, leaves; ///< in lengths of the direction; endless along a cylinder's axis
};

/// Nothing where the line passes by. Of a line that leaves the surface from a point outside it, by
/// any distance that doubles can tell, no part ahead is inside: the quadratic is solved from its
/// middle, so that it loses no digits there.
std::optional<Crossing> crossingOf(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction);

/// Whether a solid blocks a shadow ray: it meets the surface between its ends.
/// @param oneSided whether only the side that faces the ray's origin counts
bool blocks(const PlacedSolid& solid, bool oneSided, const glm::dvec3& origin,
  const glm::dvec3& direction, double far);

/// A point on a solid's surface.
struct SolidPoint
{
  glm::dvec3 position;
  glm::dvec3 normal;  ///< unit, outwards
  bool isMet = false; ///< by the ray that it was asked of
};

/// Where a ray enters a solid. VTK's shader, in float, may draw a pixel whose ray passes it by:
/// then the surface's point below the ray's closest one to the centre.
SolidPoint seenPoint(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction);

/// How far off its surface rounding may move a receiver on a solid: twice storageNoise(), since the
/// other half of a bond is a stick of its own, whose place and axis are rounded as well.
float noiseOf(const PlacedSolid& solid, const SolidPoint& point);

/// A mesh inscribed in a solid, in source coordinates, its fronts (counter-clockwise) outwards.
struct SolidMesh
{
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
};

/// @param count how many solids share it. It has as many triangles as keep all of them below a
/// million, but no fewer than a sphere's 128
SolidMesh meshOf(Solid kind, std::size_t count);

} // namespace gnomon
