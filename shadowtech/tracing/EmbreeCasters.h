#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/EmbreeCallbacks.h"
#include "shadowtech/tracing/EmbreeHandle.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/glm.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace gnomon
{

/// The scene that EmbreeTracer traces: the casting surfaces of the snapshot, each with an
/// acceleration structure of its own.
struct EmbreeCasters
{
  /// One casting surface.
  struct Caster
  {
    EmbreeGeometry geometry;
    /// For a surface with instances, the scene that holds its triangles once.
    EmbreeScene source;
    /// The geometries attached to the scene, by Embree's numbers: the triangles, or all
    /// instances of the source's scene, with an invalid number for those that are left out.
    std::vector<unsigned int> attached;
    RTCFilterFunctionN filter = nullptr;
    std::unique_ptr<CutoutSurface> cutout; ///< on the heap, because Embree keeps its address
    std::unique_ptr<CastingSolids> solids; ///< likewise
    std::uint64_t positionsVersion = 0;
    /// The arrays that Embree's buffers share.
    const glm::vec3* positions = nullptr;
    std::size_t positionCount = 0;
    const glm::uvec3* triangles = nullptr;
  };

  /// The surface of an attached geometry.
  struct Named
  {
    std::uint32_t surface;       ///< Occluders::surfaces index
    std::uint32_t instance;      ///< of the surface; 0 without instances
    std::uint32_t firstTriangle; ///< of the surface in the snapshot
    const CastingSolids* solids; ///< null if it casts triangles
  };

  /// @throws std::runtime_error if Embree cannot be started
  EmbreeCasters();
  /// See EmbreeTracer::update().
  EmbreeTracer::Update update(const Occluders& occluders);
  /// Return the bytes of the tables that find each surface's structure.
  std::size_t bytesOfTable() const;

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // must outlive the device, which counts into it
  EmbreeDevice device;
  EmbreeScene scene; ///< Embree may not have seen it while there are no casters
  std::unordered_map<std::uint64_t, Caster> casters; ///< by the surface's topologyVersion
  std::vector<Named> named;                          ///< by Embree's numbers

private:
  void setBuffers(Caster& caster, const Surface& surface, const Occluders& occluders) const;
  Caster makeCaster(const Surface& surface, const Occluders& occluders) const;
  void attachOne(Caster& caster) const;
  void attachInstances(Caster& caster, const Surface& surface) const;
  void move(Caster& caster, const Surface& surface) const;
  void nameSurfaces(const Occluders& occluders);

  Occluders::Versions versions_;
};

} // namespace gnomon
