#pragma once

#include "lights/LightView.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace gnomon
{

/// @file
/// Triangles and edges of casters on the plane of a conservative map's texels, with bounds on how
/// far rounding may move them.

/// Width by which a texel grows on each side, in texels. It covers rounding of shadow rays across
/// the light, and how far beside their receiver rays start.
constexpr double marginTexels = 1.0 / 128.0;
/// The share of marginTexels that covers where rays start.
constexpr double offsetTexels = 1.0 / 256.0;
/// The largest margin, in texels. Larger texels would decide little, so casters whose rounding asks
/// for more leave their texels undecided.
constexpr double largestMargin = 1.0;
/// Height, in texels, up to which a triangle counts as edges alone. Rays start less far beside
/// their receivers, so none starts behind the neighbour of a triangle that is this thin.
constexpr double thinTexels = 1.0 / 128.0;

/// A point in the map's homogeneous coordinates: texels X/W and Y/W, depth Q/W. z is the distance
/// along the view.
struct MapPoint
{
  double X, Y, W, Q, z;
};

/// The mapping from centred coordinates to the map's coordinates.
struct MapSpace
{
  bool positional;
  glm::dmat4 viewFromCentred;
  glm::dmat3 texelFromAcross;
  double depthScale;
  double depthOffset;
  double size;
  /// The most that W changes per unit of length.
  double gradientOfW;
  /// For parallel rays, the largest |z| of any geometry; 0 for rays from a position.
  double farthestZ;

  MapPoint at(const glm::dvec3& centred) const
  {
    const glm::dvec3 view(this->viewFromCentred * glm::dvec4(centred, 1.0));
    const glm::dvec3 map =
      this->texelFromAcross * (this->positional ? view : glm::dvec3(view.x, view.y, 1.0));
    // Q/W is scaled affinely, so the offset adds its multiple of W to Q.
    const double depth = this->positional ? -1.0 : view.z;
    return { map.x, map.y, map.z, this->depthScale * depth + this->depthOffset * map.z, view.z };
  }

  /// Return the mapping as a matrix to (X, Y, Q, W).
  /// @param constant replaces `depthOffset` as the constant part of Q / W
  glm::dmat4 mapFromCentred(double constant) const;

  /// Bound the change of depth per unit of length in any direction, as (a, b) of a / W + b / W^2.
  glm::dvec2 depthPerUnit() const
  {
    return this->positional
      ? glm::dvec2(0.0, this->depthScale * this->gradientOfW)
      : this->depthScale * glm::dvec2(1.0, this->farthestZ * this->gradientOfW);
  }
  double depthPerUnit(double W) const
  {
    const glm::dvec2 perUnit = this->depthPerUnit();
    return (perUnit.x + perUnit.y / W) / W;
  }
};

/// A corner of a clipped polygon or segment: texels and depth.
struct MapCorner
{
  double x, y, depth;
};

/// Values that all casters of a view share.
struct CasterScene
{
  const Occluders& occluders;
  MapSpace space;
  double begins;  ///< the least z at which casters count
  double nearW;   ///< points at or below this W are at the light
  double lateral; ///< how far beside a ray a tracer may find a hit, in world units
  /// The most texels per unit across the light; for positional lights at distance 1.
  double texelsPerUnit;
  /// For parallel rays the direction towards the light; else the light's centred position.
  glm::dvec3 towards;

  /// Return how far across the light a shadow ray may start beside its receiver, in world units.
  /// @param distance from the light; without effect for parallel rays
  double largestOffset(double distance) const
  {
    // Rays off the view's axis are up to twice as long.
    return offsetTexels / (this->texelsPerUnit * (this->space.positional ? 2.0 : 1.0)) *
      (this->space.positional ? distance : 1.0);
  }
};

/// Return the values that the casters of a light's view share.
/// @param hasBox true if the light begins at the near face of a box
/// @param sizeTexels side of the map
CasterScene casterScene(
  const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders);

/// How a caster counts in the texels that it touches.
struct Role
{
  bool present = false; ///< it may block
  bool covers = false;  ///< it blocks every ray through its inside
  bool poison = false;  ///< all texels within its own margin are undecided
};

/// Enough for a triangle clipped by four planes, even if rounding makes corners alternate.
constexpr std::size_t mostCorners = 16;

/// Marks a polygon's side that clipping made.
constexpr std::uint8_t noSide = 3;

/// A part of the casters' surface (CasterEdges::partOf()), separate for each instance.
using CasterPart = std::uint64_t;
constexpr CasterPart noPart = 0xffffffffffffffffu;

/// A convex piece of a caster on the map.
struct MapPolygon
{
  Role role;
  CasterPart part = noPart; ///< the part that it belongs to
  int facing = 0;           ///< 1 or -1 by its winding on the map; 0 if all its edges are ends
  std::size_t count = 0;
  std::array<MapCorner, mostCorners> corners;
  /// For each side of the polygon, the corner at which the same side of the triangle starts. It is
  /// `noSide` where clipping made the side.
  std::array<std::uint8_t, mostCorners> sides;
  /// Width that rounding asks for, in texels; infinite if the caster is at the light.
  double margin = 0.0;
  double nearestZ = 0.0;     ///< the least distance of its clipped part along the view
  double depthPerUnit = 0.0; ///< the most that depth changes per unit of length
  double slack = 0.0;        ///< how far off its plane a tracer may see it, as depth
  double noise = 0.0;        ///< the same along its normal, in world units

  /// Return its least and largest y, in texels.
  std::pair<double, double> rows() const;
};

/// A polygon's plane as depth over the map, and its area there.
struct MapPlane
{
  double perX = 0.0, perY = 0.0; ///< change of depth per texel
  double area = 0.0;             ///< in square texels; its sign tells the winding
  MapCorner origin;

  double depthAt(double x, double y) const
  {
    return this->origin.depth + this->perX * (x - this->origin.x) +
      this->perY * (y - this->origin.y);
  }
};

/// Return a polygon's plane. Without area, it has the first corner's depth everywhere.
MapPlane planeOf(const MapPolygon& polygon);

/// Return the part of a triangle that lies on the map or its border.
/// @param instance of a surface with instances; else 0
MapPolygon polygonOf(
  const CasterScene& scene, const Surface& surface, std::uint32_t instance, std::uint32_t triangle);

struct MapSegment
{
  std::array<MapCorner, 2> ends;
  double slack = 0.0;
  bool isEnd = false;       ///< true if the casters' surface ends here; false for a sharp edge
  CasterPart part = noPart; ///< the part that its triangles belong to
};

/// `absentFacing` marks a one-sided triangle that faces away, and so does not exist. Others face
/// one way on the map or the other (1, -1), or lie along the light (0).
constexpr std::int8_t absentFacing = 2;
enum class EdgeKind
{
  Inner, ///< the casters' surface continues
  Sharp, ///< it continues, but shadow rays from one side may start behind the other
  End,   ///< it ends or folds over
  Unsure ///< it ends, at a triangle whose depth a tracer cannot tell
};
EdgeKind kindOf(const CasterEdge& edge, std::int8_t firstFacing, std::int8_t secondFacing);

/// Find the part of an edge that lies on the map or its border.
/// @return false if none does
bool segmentOf(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  const CasterEdge& edge, EdgeKind kind, MapSegment& segment);

} // namespace gnomon
