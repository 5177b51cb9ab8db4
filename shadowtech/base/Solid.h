#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

/// @file
/// Spheres and cylinders that VTK draws as impostors: a fragment shader intersects the pixel's ray
/// with them. Receivers and shadow rays use the exact shapes, in double precision. Maps draw the
/// surface's triangles, a mesh whose corners lie on the solid. The mesh lies behind the visible
/// surface, so no solid shadows itself.

/// The shape of each instance of a surface.
enum class Solid : std::uint8_t
{
  None,     ///< the surface's triangles
  Sphere,   ///< the image of the unit ball, under a matrix that scales all axes alike
  Cylinder, ///< the image of x^2 + y^2 <= 1, |z| <= 1, whose ends are flat
  /// A part of a line: a cylinder with a ball around either end, so that bends have no gaps. At a
  /// bend, parts overlap. Hence a tube blocks no ray that begins inside of it, and receivers lie on
  /// its cylinder, never on a ball.
  Tube
};

struct PlacedSolid
{
  Solid kind;
  glm::dvec3 centre;
  double radius;
  glm::dvec3 axis{ 0.0 };  ///< of a cylinder or tube: unit
  double halfLength = 0.0; ///< likewise
};

/// Return a solid in centred coordinates.
/// @param centredFromSource matrix of an instance that is not left out
PlacedSolid placedSolid(Solid kind, const glm::mat4x3& centredFromSource);

/// Return the box around a solid, large enough to hold it after rounding to float.
Bounds boundsOf(const PlacedSolid& solid);

/// Return the box around all solids of a surface, without those left out.
Bounds solidsBounds(Solid kind, const std::vector<glm::mat4x3>& centredFromSource);

/// The part of a line inside a solid.
struct Crossing
{
  double enters, leaves; ///< in lengths of the direction; may be infinite
};

/// Return the part of a line inside a solid; none if the line misses it. The quadratic is solved
/// from its middle, so it loses no digits. Hence a line that leaves the surface, from a point
/// outside it at any distance that doubles resolve, has no part inside ahead.
std::optional<Crossing> crossingOf(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction);

/// True if a solid blocks a shadow ray: the ray meets the surface between its ends.
/// @param oneSided true if only the side that faces the ray's origin blocks
bool blocks(const PlacedSolid& solid, bool oneSided, const glm::dvec3& origin,
  const glm::dvec3& direction, double far);

struct SolidPoint
{
  glm::dvec3 position;
  glm::dvec3 normal;  ///< unit, outwards
  bool isMet = false; ///< the ray meets the solid here
};

/// Return the point where a ray enters a solid. VTK's shader, in float, may draw a pixel whose ray
/// misses the solid. Then it is the surface's point below the ray's closest point to the centre.
SolidPoint seenPoint(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction);

/// Return how far off its surface rounding may move a receiver on a solid: twice storageNoise().
/// The other half of a bond is a stick of its own, whose place and axis are rounded as well.
float noiseOf(const PlacedSolid& solid, const SolidPoint& point);

/// A mesh inscribed in a solid, in source coordinates. Its fronts (counter-clockwise) face
/// outwards.
struct SolidMesh
{
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
};

/// Return the mesh of a solid.
/// @param count how many solids share it. All of them together have at most about a million
/// triangles, but a sphere has no fewer than 128
SolidMesh meshOf(Solid kind, std::size_t count);

} // namespace gnomon
