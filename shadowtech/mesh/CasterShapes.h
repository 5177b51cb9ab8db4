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
/// Casters as a conservative map sees them: triangles and edges on the plane of its texels, with
/// how far rounding may move them.

/// How much larger than it is a texel counts, on each side, in texels: for what rounding moves
/// shadow rays across the light, and for how far beside the receiver they start.
constexpr double marginTexels = 1.0 / 128.0;
/// The part of it that is there for where rays start.
constexpr double offsetTexels = 1.0 / 256.0;
/// With a larger margin a texel would not decide much: casters of which rounding asks for more make
/// texels undecided.
constexpr double largestMargin = 1.0;
/// Triangles that are no higher than this seem to be edges alone. Rays start less far beside their
/// receivers, so that they do not start behind such a triangle's neighbour.
constexpr double thinTexels = 1.0 / 128.0;

/// A point as the map sees it, in homogeneous coordinates: texels X/W and Y/W, depth Q/W; z along
/// the view.
struct MapPoint
{
  double X, Y, W, Q, z;
};

/// From centred coordinates to the map's.
struct MapSpace
{
  bool positional;
  glm::dmat4 viewFromCentred;
  glm::dmat3 texelFromAcross;
  double depthScale;
  double depthOffset;
  double size;
  /// What W changes by, per unit of length, at most.
  double gradientOfW;
  /// The largest |z| of anything, of parallel rays; 0 of those from a position.
  double farthestZ;

  MapPoint at(const glm::dvec3& centred) const
  {
    const glm::dvec3 view(this->viewFromCentred * glm::dvec4(centred, 1.0));
    const glm::dvec3 map =
      this->texelFromAcross * (this->positional ? view : glm::dvec3(view.x, view.y, 1.0));
    // The scale of depth is affine in Q/W, and so W's share of it.
    const double depth = this->positional ? -1.0 : view.z;
    return { map.x, map.y, map.z, this->depthScale * depth + this->depthOffset * map.z, view.z };
  }

  /// The same as a matrix, to (X, Y, Q, W).
  /// @param constant what Q / W has everywhere, in place of `depthOffset`
  glm::dmat4 mapFromCentred(double constant) const;

  /// How much depth changes at most where a point moves by a unit of length in any direction: a / W
  /// + b / W^2.
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

/// A corner of what is drawn.
struct MapCorner
{
  double x, y, depth;
};

/// What is true of all casters of a view.
struct CasterScene
{
  const Occluders& occluders;
  MapSpace space;
  double begins;  ///< the z from which on casters count
  double nearW;   ///< what is at the light
  double lateral; ///< how far beside a ray a tracer may look, in world units
  /// The most texels to a unit across the light, of positional ones at distance 1.
  double texelsPerUnit;
  /// Towards the light, of parallel rays; else the light's position, centred.
  glm::dvec3 towards;

  /// How far a shadow ray may start beside its receiver, across the light, at a distance from it
  /// (of parallel rays: at any).
  double largestOffset(double distance) const
  {
    // Off the view's axis rays are longer, twice at most.
    return offsetTexels / (this->texelsPerUnit * (this->space.positional ? 2.0 : 1.0)) *
      (this->space.positional ? distance : 1.0);
  }
};

/// How casters are to be looked at in a view of a light.
/// @param hasBox whether the light begins at the near face of a box
CasterScene casterScene(
  const LightView& view, bool hasBox, int sizeTexels, const Occluders& occluders);

/// How a caster counts.
struct Role
{
  bool present = false; ///< may block
  bool covers = false;  ///< does block, all over
  bool poison = false;  ///< where it is, by its own margin, nothing is certain
};

/// Enough for a triangle cut by four planes, even where rounding makes corners alternate.
constexpr std::size_t mostCorners = 16;

/// Of a polygon's side that is none of the triangle's.
constexpr std::uint8_t noSide = 3;

/// One of the parts that the casters' surface falls into (CasterEdges::partOf()), those of
/// instances told apart.
using CasterPart = std::uint64_t;
constexpr CasterPart noPart = 0xffffffffffffffffu;

/// A convex piece of a caster on the map.
struct MapPolygon
{
  Role role;
  CasterPart part = noPart; ///< that it belongs to
  int facing = 0; ///< 1 or -1 by the way that it is wound on the map; 0: all its edges are ends
  std::size_t count = 0;
  std::array<MapCorner, mostCorners> corners;
  /// Which side of the triangle runs from each corner to the next, by the corner of the triangle
  /// that it starts at; `noSide` where the polygon was cut.
  std::array<std::uint8_t, mostCorners> sides;
  /// That rounding asks for, in texels; infinite where the caster is at the light.
  double margin = 0.0;
  double nearestZ = 0.0; ///< of what is drawn of it, along the view
  double depthPerUnit =
    0.0; ///< how much depth changes at most where a point of it moves by a unit of length
  double slack = 0.0; ///< depth that a tracer may see it off its plane
  double noise = 0.0; ///< and how far it may see it off, along its normal, in world units

  /// Between which rows it lies, in texels.
  std::pair<double, double> rows() const;
};

/// A polygon's depth on the map, and its area there.
struct MapPlane
{
  double perX = 0.0, perY = 0.0; ///< that depth changes by, to a texel
  double area = 0.0;             ///< in square texels; its sign says which way the corners run
  MapCorner origin;

  double depthAt(double x, double y) const
  {
    return this->origin.depth + this->perX * (x - this->origin.x) +
      this->perY * (y - this->origin.y);
  }
};

/// The plane of a polygon; one at its first corner's depth where it has no area.
MapPlane planeOf(const MapPolygon& polygon);

/// One triangle, or what of it lies on the map.
/// @param instance of a surface with instances; else 0
MapPolygon polygonOf(
  const CasterScene& scene, const Surface& surface, std::uint32_t instance, std::uint32_t triangle);

/// An edge on the map.
struct MapSegment
{
  std::array<MapCorner, 2> ends;
  double slack = 0.0;
  bool isEnd = false;       ///< the casters' surface ends here; else a sharp edge
  CasterPart part = noPart; ///< that its triangles belong to
};

/// What an edge is to its triangles, of which each faces one way on the map or the other (1, -1),
/// lies along the light (0), or is not there at all (`absentFacing`).
constexpr std::int8_t absentFacing = 2;
enum class EdgeKind
{
  Inner, ///< the casters' surface goes on
  Sharp, ///< it goes on, but shadow rays from one side may start behind the other
  End,   ///< it ends or folds over
  Unsure ///< it ends, and a tracer cannot tell how far the triangle is
};
EdgeKind kindOf(const CasterEdge& edge, std::int8_t firstFacing, std::int8_t secondFacing);

/// One edge, or what of it lies on the map.
/// @return false where nothing does
bool segmentOf(const CasterScene& scene, const Surface& surface, std::uint32_t instance,
  const CasterEdge& edge, EdgeKind kind, MapSegment& segment);

} // namespace gnomon
