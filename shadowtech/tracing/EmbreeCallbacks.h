#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/Embree.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon
{

/// The surface that a ray passes through near its start (LiftedRay).
struct OwnSurface
{
  float until = 0.0f; ///< LiftedRay::leaves

  virtual ~OwnSurface() = default;
  virtual bool has(RTCHitN* hit) const = 0;
};

/// Reject a hit on the part of a single ray's own surface that it passes through
/// (EmbreeContext::own).
void rejectOwn(const RTCFilterFunctionNArguments* arguments);
/// Reject a single ray's hits on all but its own surface.
void rejectOthers(const RTCFilterFunctionNArguments* arguments);

/// The data that finds a hit's texture coordinates on a surface with a cut-out.
struct CutoutSurface
{
  std::shared_ptr<const CutoutMask> mask;
  const glm::vec2* textureCoordinates = nullptr; ///< of its vertices
  const glm::uvec3* triangles = nullptr;         ///< of the surface; indices into all positions
  std::uint32_t firstVertex = 0;
};

/// Reject hits in the holes of a surface, so that the ray continues behind it. In an instance, the
/// triangle is the source's, whose texture coordinates all instances share.
/// @param arguments of a geometry whose data is a CutoutSurface
void rejectHoles(const RTCFilterFunctionNArguments* arguments);

/// Return the filter of hits that block rays; null if every hit counts.
RTCFilterFunctionN filterOf(const Surface& surface);

/// The solids of a surface that are not left out, for Embree's callbacks.
struct CastingSolids
{
  std::vector<PlacedSolid> solids;
  bool oneSided = false;

  /// Set the solids to those of a surface.
  void place(const Surface& surface);
};

/// Let Embree ask some solids for their boxes and hits.
/// @param geometry of the user's type
/// @param casters must outlive the geometry
void setSolids(RTCGeometry geometry, CastingSolids& casters);

} // namespace gnomon
