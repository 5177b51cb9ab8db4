#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/CutoutMask.h"
#include "shadowtech/base/Solid.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon
{

/// One surface as VTK draws it: the polygons, or the strips, of one polydata under one prop (a
/// block of a composite data set, a leaf of an assembly). Its vertices and triangles are contiguous
/// in the snapshot. It has no triangles if all that it draws were dropped.
struct Surface
{
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;

  bool casts = true;     ///< its triangles block light
  bool receives = true;  ///< its pixels are shadowed; else their visibility is 1
  bool oneSided = false; ///< only triangles whose front (counter-clockwise) faces the light cast

  /// What its texture leaves of it; null, as nearly always, for all of it.
  std::shared_ptr<const CutoutMask> cutout;
  /// Of a surface with a cut-out, one for each of its vertices. A triangle's are affine on it.
  std::vector<glm::vec2> textureCoordinates;

  /// Of a surface that VTK shades with normals of its points, one for each of its vertices, of any
  /// length; empty for all others (SmoothFacet.h).
  std::vector<glm::vec3> pointNormals;
  /// Takes vertices from where these normals are to centred coordinates, but for the place; of a
  /// surface with instances each instance's matrix does.
  glm::mat3 centredFromNormals{ 1.0f };
  /// How high the curved surface that these normals imply is above its triangles, at most, in
  /// centred coordinates; 0 without normals, or of more than `mostFacets` triangles.
  float facetHeight = 0.0f;

  Bounds boundsCentred; ///< box around all that is drawn of it

  /// Changes when the triangles of this surface change (its mapper's input) or their texture
  /// coordinates, not when it only gets another place in the list. Versions are never given twice
  /// within a snapshot, so that a surface can be found again by this one.
  std::uint64_t topologyVersion = 0;
  /// Changes when its centred positions or its normals change: with the topology, or because the
  /// prop moved.
  std::uint64_t positionsVersion = 0;

  /// For the n-th triangle that VTK draws of this surface, the triangle in the snapshot, counted
  /// from firstTriangle; `noTriangle` for one that was dropped. Empty when the n-th drawn triangle
  /// is the n-th of the surface. A triangle that a clipping plane cuts leads to its first piece,
  /// which lies in the same plane.
  std::vector<std::uint32_t> triangleOfDrawn;

  static constexpr std::uint32_t noTriangle = 0xffffffffu;

  /// Of a surface that is drawn many times, as glyphs are: the *instances*, in the order in which
  /// VTK draws them. Its vertices and triangles are there once, in source coordinates, and each of
  /// these takes them to centred coordinates; what is drawn is the exact image under the matrix.
  /// The zero matrix stands for an instance that was left out; all others are regular, and either
  /// all or none of them mirror. Empty: drawn once, and its vertices are centred.
  std::vector<glm::mat4x3> centredFromSource;
  bool mirrored = false; ///< whether they mirror, so that source coordinates show the other side
  /// What an instance is. VTK draws a solid as one primitive; the triangles are those of meshOf().
  Solid solid = Solid::None;

  bool isInstanced() const { return !this->centredFromSource.empty(); }
  static bool isLeftOut(const glm::mat4x3& instance) { return instance == glm::mat4x3(0.0f); }
  /// How many primitives VTK draws of it, or of each of its instances, dropped ones included.
  std::uint32_t drawnCount() const
  {
    return this->solid != Solid::None ? 1
      : this->triangleOfDrawn.empty() ? this->triangleCount
                                      : static_cast<std::uint32_t>(this->triangleOfDrawn.size());
  }
};

/// Return the point that positions of a scene with this box are relative to.
///
/// The centre is a function of the box alone, so that no picture depends on what the scene held
/// in earlier frames. It lies on a grid whose step is 2 to 4 radii of the box, a power of two:
/// - changes of the scene that are small beside it nearly always leave the centre;
/// - centred coordinates are at most three radii large;
/// - a box around the origin has the origin for its centre.
///
/// @param boundsWorld the box around all surfaces; empty: the centre is the origin
inline glm::dvec3 snapshotCentre(const Bounds& boundsWorld)
{
  const double radius = boundsWorld.radius();
  if (boundsWorld.empty() || !std::isfinite(radius)) // beyond 1e154, its square overflows
  {
    return glm::dvec3(0.0);
  }
  int exponent = 0; // 2^exponent is more than the radius, and no more than twice as much
  std::frexp(radius, &exponent);
  const double step = std::ldexp(2.0, exponent);
  return glm::round(boundsWorld.centre() / step) * step;
}

/// The snapshot: every surface triangle that VTK draws, cast or only receive, in one list.
///
/// Positions are *centred*: world coordinates less centreWorld, computed in double precision and
/// then rounded to float, so that scenes far from the origin keep their precision. Those of a
/// surface with instances are source coordinates instead (Surface::centredFromSource).
struct Occluders
{
  glm::dvec3 centreWorld{ 0.0 }; ///< the collector's is snapshotCentre()
  /// The memory goes on for at least 4 bytes behind the last position, so that every position can
  /// be read as 16 bytes (Embree does).
  std::vector<glm::vec3> positionsCentred;
  std::vector<glm::uvec3> triangles; ///< indices into positionsCentred
  std::vector<Surface> surfaces;     ///< in order of their triangles

  Bounds castersCentred; ///< box around the casting surfaces
  Bounds allCentred;     ///< box around all surfaces

  std::size_t droppedNonFinite = 0;
  std::size_t droppedZeroArea = 0;

  /// Whether any caster is a solid, whose triangles do not tell exactly what it blocks.
  bool castsSolids() const
  {
    return std::any_of(this->surfaces.begin(), this->surfaces.end(),
      [](const Surface& surface) { return surface.casts && surface.solid != Solid::None; });
  }

  /// Changes when surfaces come, go, change their triangles, their flags or their cut-outs.
  std::uint64_t topologyVersion = 0;
  /// Changes when any centred position changes (and with topologyVersion).
  std::uint64_t positionsVersion = 0;
};

} // namespace gnomon
