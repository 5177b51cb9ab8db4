#pragma once

#include "lights/Bounds.h"
#include "lights/SceneFrame.h"
#include "shadowtech/base/CutoutMask.h"
#include "shadowtech/base/Patches.h"
#include "shadowtech/base/Sheet.h"
#include "shadowtech/base/Solid.h"
#include "shadowtech/base/Volume.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon
{

/// One surface as VTK draws it: the polygons, or the strips, of one polydata under one prop (a
/// block of a composite data set, a leaf of an assembly). Its vertices and triangles are contiguous
/// in the snapshot. It has no triangles if all of them were dropped.
struct Surface
{
  std::uint32_t firstVertex = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangleCount = 0;

  bool casts = true;     ///< its triangles block light; false if they let some through
  bool receives = true;  ///< its pixels are shadowed; else their visibility is 1
  bool oneSided = false; ///< only triangles whose front (counter-clockwise) faces the light cast
  bool isMoved = false;  ///< a user's shader code may show it elsewhere than the snapshot has it

  /// Set if it casts and lets light through; null, as nearly always, if it does not.
  std::shared_ptr<const Sheet> sheet;

  /// The holes that its texture cuts; null, as nearly always, if it has none. Of a sheet, with all
  /// values of the texture's alpha.
  std::shared_ptr<const CutoutMask> cutout;
  /// One per vertex, only if the surface has a cut-out. They are affine on each triangle.
  std::vector<glm::vec2> textureCoordinates;

  /// One normal of any length per vertex, if VTK shades the surface with normals of its points;
  /// else empty (SmoothFacet.h).
  std::vector<glm::vec3> pointNormals;
  /// The linear part of the transformation from the normals' space to centred coordinates. A
  /// surface with instances uses each instance's matrix instead.
  glm::mat3 centredFromNormals{ 1.0f };
  /// The largest height of the curved surface that these normals imply above its triangles, in
  /// centred coordinates. 0 without normals, or with more than `mostFacets` triangles.
  float facetHeight = 0.0f;
  /// Patches that its triangles' edges connect; new ones once vertices move against each other.
  std::shared_ptr<Patches> patches = std::make_shared<Patches>();

  Bounds boundsCentred; ///< box around all that VTK draws of it

  /// Changes with this surface's triangles (its mapper's input) or their texture coordinates, not
  /// with its place in the list. Versions are unique within a snapshot, so this one identifies a
  /// surface.
  std::uint64_t topologyVersion = 0;
  /// Changes with its centred positions or normals: with the topology, or because the prop moved.
  std::uint64_t positionsVersion = 0;

  /// For the n-th triangle that VTK draws of this surface, the triangle in the snapshot, counted
  /// from firstTriangle; `noTriangle` if it was dropped. Empty if the n-th drawn triangle is the
  /// n-th of the surface. A triangle that a clipping plane cuts maps to its first piece, which the
  /// others follow.
  std::vector<std::uint32_t> triangleOfDrawn;

  static constexpr std::uint32_t noTriangle = 0xffffffffu;

  /// The *instances* of a surface that VTK draws many times (glyphs), in VTK's drawing order. The
  /// snapshot holds the vertices and triangles once, in source coordinates. Each matrix takes them
  /// to centred coordinates; VTK draws the exact image under the matrix. The zero matrix marks an
  /// instance that was left out. All others are regular, and either all or none of them mirror.
  /// Empty: drawn once, with centred vertices.
  std::vector<glm::mat4x3> centredFromSource;
  bool mirrored = false; ///< they mirror: source coordinates show the other side
  /// The shape of an instance. VTK draws a solid as one primitive; the triangles are those of
  /// meshOf().
  Solid solid = Solid::None;

  bool isInstanced() const { return !this->centredFromSource.empty(); }
  static bool isLeftOut(const glm::mat4x3& instance) { return instance == glm::mat4x3(0.0f); }
  /// Return how many primitives VTK draws of it, or of each of its instances, dropped ones
  /// included.
  std::uint32_t drawnCount() const
  {
    return this->solid != Solid::None ? 1
      : this->triangleOfDrawn.empty() ? this->triangleCount
                                      : static_cast<std::uint32_t>(this->triangleOfDrawn.size());
  }
};

/// The snapshot: one list of all surface triangles that VTK draws, whether they cast or only
/// receive.
///
/// Positions are *centred* (SceneFrame.h), computed in double precision and then rounded to float.
/// Surfaces with instances have source coordinates instead (Surface::centredFromSource).
struct Occluders
{
  using Versions = std::pair<std::uint64_t, std::uint64_t>;

  SceneFrame frame; ///< sceneFrameOf(), in all snapshots of plugin/
  /// The allocation extends at least 4 bytes beyond the last position: Embree reads each position
  /// as 16 bytes.
  std::vector<glm::vec3> positionsCentred;
  std::vector<glm::uvec3> triangles;                  ///< indices into positionsCentred
  std::vector<Surface> surfaces;                      ///< in order of their triangles
  std::vector<std::shared_ptr<const Volume>> volumes; ///< that cast; the boxes leave them out

  Bounds castersCentred; ///< box around the casting surfaces
  Bounds allCentred;     ///< box around all surfaces

  std::size_t droppedNonFinite = 0; ///< triangles with missing data: largestOfWorld
  std::size_t droppedZeroArea = 0;

  /// True if VTK shades a surface with normals of its points.
  bool hasPointNormals() const
  {
    return std::any_of(this->surfaces.begin(), this->surfaces.end(),
      [](const Surface& surface) { return !surface.pointNormals.empty(); });
  }

  /// True if a caster is a solid. Triangles describe solids only approximately.
  bool castsSolids() const
  {
    return std::any_of(this->surfaces.begin(), this->surfaces.end(),
      [](const Surface& surface) { return surface.casts && surface.solid != Solid::None; });
  }

  /// True if a surface lets light through.
  bool hasSheets() const
  {
    return std::any_of(this->surfaces.begin(), this->surfaces.end(),
      [](const Surface& surface) { return surface.sheet && surface.triangleCount > 0; });
  }

  bool hasCasters() const
  {
    return !this->castersCentred.empty() || !this->volumes.empty() || this->hasSheets();
  }

  /// Changes when surfaces are added or removed, or change their triangles, flags or cut-outs, and
  /// with the volumes.
  std::uint64_t topologyVersion = 0;
  /// Changes with any centred position, and with topologyVersion.
  std::uint64_t positionsVersion = 0;

  /// Return both versions, the key of what is computed from all casters.
  Versions versions() const { return { this->topologyVersion, this->positionsVersion }; }
};

} // namespace gnomon
