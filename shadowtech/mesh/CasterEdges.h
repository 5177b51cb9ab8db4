#pragma once

#include "lights/ShadowSettings.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/KeptOfCasters.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The cosine of the largest angle between the normals of neighbours that are not sharp. A shadow
/// ray that starts off one triangle starts at least this share of its offset off the neighbour.
constexpr double sharpCosine = 0.75;

/// An edge where two triangles of a surface meet, or where one ends.
struct CasterEdge
{
  std::uint32_t from = 0, to = 0; ///< vertices in the snapshot
  /// Triangles in the snapshot. The second is `none` if the surface ends here. If more than two
  /// triangles meet, each has its own edge, with `none` as second.
  std::array<std::uint32_t, 2> triangles{ { none, none } };
  /// True if both triangles run through the edge in the same direction, so their windings differ.
  bool sameDirection = false;
  /// True if a shadow ray that starts off one triangle may begin behind the other. The angle
  /// between their normals, or among those around one of its corners, exceeds that of sharpCosine.
  /// Edges of triangles too thin to have a normal are sharp, too.
  bool sharp = false;

  static constexpr std::uint32_t none = 0xffffffffu;

  bool meets(std::uint32_t vertex) const { return this->from == vertex || this->to == vertex; }

  /// Return the other triangle of the edge.
  std::uint32_t other(std::uint32_t triangle) const
  {
    return this->triangles[0] == triangle ? this->triangles[1] : this->triangles[0];
  }
};

struct SurfaceEdges
{
  std::vector<CasterEdge> edges;
  /// For each triangle of the surface, the edges from each corner to the next.
  std::vector<std::array<std::uint32_t, 3>> ofTriangle;

  ///@{
  /// The key of `edges`: weldedVertices(), and the surface's place in the snapshot.
  std::vector<std::uint32_t> welded;
  std::uint32_t firstVertex = 0, firstTriangle = 0;
  ///@}

  std::size_t bytes() const;
};

/// Update a surface's edges to its vertex positions and its place in the snapshot.
///
/// Sharp edges depend on positions, and are always computed again. Adjacency depends only on which
/// vertices share a place. It is reused if welding gives the same result.
/// @param edges of the same triangles at any earlier place; empty to compute everything
void updateCasterEdges(const Occluders& occluders, const Surface& surface, SurfaceEdges& edges);

/// The edges of the casting surfaces, cached across snapshots.
///
/// Vertices at exactly the same place count as one (WeldedVertices.h). Edges with another
/// triangle's vertex in their middle (T-junctions) are ends, and so are edges between different
/// surfaces.
class CasterEdges
{
public:
  /// Find the edges of new surfaces, update those of others, and find parts.
  void update(const Occluders& occluders);

  /// Return the edges of a casting surface.
  /// @param surface index into the snapshot's surfaces, as of the last update
  const SurfaceEdges& of(std::size_t surface) const { return this->kept_.of(surface); }

  /// Return the part of the casters' surface that a casting triangle belongs to: all triangles
  /// connected to it by edges. Windings do not matter. Instances are separate parts.
  /// @param triangle number in the snapshot
  /// @return the least triangle number of the part
  std::uint32_t partOf(std::uint32_t triangle) const { return this->parts_[triangle]; }

  std::size_t bytes() const;

private:
  void joinParts(const Occluders& occluders);

  KeptOfCasters<SurfaceEdges> kept_;
  std::vector<std::uint32_t> parts_;
  Occluders::Versions versions_;
};

} // namespace gnomon
