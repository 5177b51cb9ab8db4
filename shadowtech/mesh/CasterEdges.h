#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/CasterSeams.h"
#include "shadowtech/mesh/KeptOfCasters.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The cosine of the angle up to which the normals of neighbours count as one side: a shadow ray
/// that starts off one of them starts that share of its offset off the other.
constexpr double sharpCosine = 0.75;

/// Where two triangles of a surface meet, or one ends.
struct CasterEdge
{
  std::uint32_t from = 0, to = 0; ///< vertices in the snapshot
  /// Triangles in the snapshot; the second is `none` where the surface ends here, or where more
  /// than two meet, each of which then has an edge of its own.
  std::array<std::uint32_t, 2> triangles{ { none, none } };
  /// Whether both triangles run through it the same way, so that they are wound differently.
  bool sameDirection = false;
  /// Whether a shadow ray that starts off one of the triangles may begin behind the other: their
  /// normals, or those of the triangles around one of its corners, are farther apart than
  /// sharpCosine, or one is too thin to say.
  bool sharp = false;

  static constexpr std::uint32_t none = 0xffffffffu;

  bool meets(std::uint32_t vertex) const { return this->from == vertex || this->to == vertex; }

  /// The triangle across it from one of its triangles.
  std::uint32_t other(std::uint32_t triangle) const
  {
    return this->triangles[0] == triangle ? this->triangles[1] : this->triangles[0];
  }
};

/// Where the normals of all triangles around a vertex are.
struct NormalCone
{
  glm::vec3 axis{ 0.0f };    ///< of unit length; either side of the surface is meant
  float leastCosine = -1.0f; ///< of the angle between a normal, or its opposite, and the axis
};

/// An edge at which a surface ends, of one triangle alone: another surface may go on there
/// (CasterSeams.h).
struct Rim
{
  std::uint32_t edge;                ///< of the surface
  std::array<NormalCone, 2> corners; ///< around the vertices that it leads from and to
};

/// The edges of one surface.
struct SurfaceEdges
{
  std::vector<CasterEdge> edges;
  /// For each of its triangles, from the first, the edges from each corner to the next.
  std::vector<std::array<std::uint32_t, 3>> ofTriangle;
  std::vector<Rim>
    rims; ///< those of its edges that have one triangle, and that no other triangle has

  ///@{
  /// By what its triangles were joined: as of weldedVertices(), and from where vertices and
  /// triangles count.
  std::vector<std::uint32_t> welded;
  std::uint32_t firstVertex = 0, firstTriangle = 0;
  ///@}

  std::size_t bytes() const;
};

/// Brings the edges of a surface up to date with where its vertices are, and with its place in the
/// snapshot.
///
/// All that hangs on positions is found again: which edges are sharp, and the rims' corners. Which
/// triangles meet in which edge hangs on nothing but which vertices are at the same place. So
/// vertices are welded anew, and where that comes out as before, however they moved, all that is
/// kept.
/// @param edges of the same triangles at any other place; or empty, and then all is found
void updateCasterEdges(const Occluders& occluders, const Surface& surface, SurfaceEdges& edges);

/// The edges of the casting surfaces, kept from snapshot to snapshot.
///
/// Vertices at exactly the same place count as one (WeldedVertices.h). Edges where a vertex lies on
/// another triangle's edge (T-junctions) are ends. Those between different surfaces are, too,
/// unless they are seams.
class CasterEdges
{
public:
  /// Finds the edges of surfaces that are new, brings those of others up to date, and finds the
  /// seams and the parts.
  void update(const Occluders& occluders);

  /// Edges of a casting surface.
  /// @param surface index into the snapshot's surfaces, as of the last update
  const SurfaceEdges& of(std::size_t surface) const { return this->kept_.of(surface); }

  const CasterSeams& seams() const { return this->seams_; }

  /// The part of the casters' surface that a casting triangle belongs to: all triangles that one
  /// comes to across edges and seams, whichever way they are seen. Instances are apart from each
  /// other.
  /// @param triangle of the snapshot
  /// @return the least of those triangles
  std::uint32_t partOf(std::uint32_t triangle) const { return this->parts_[triangle]; }

  std::size_t bytes() const;

private:
  void joinParts(const Occluders& occluders);

  KeptOfCasters<SurfaceEdges> kept_;
  CasterSeams seams_;
  std::vector<std::uint32_t> parts_;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon
