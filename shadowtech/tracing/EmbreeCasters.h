#pragma once

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/tracing/EmbreeCallbacks.h"
#include "shadowtech/tracing/EmbreeHandle.h"
#include "shadowtech/tracing/EmbreeInstances.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon
{

/// The scene that EmbreeTracer traces: the casting surfaces of the snapshot, each with an
/// acceleration structure of its own.
struct EmbreeCasters
{
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
  EmbreeCasters()
    : device(startEmbree())
  {
    countBytes(this->device.get(), this->bytes);
    this->scene = EmbreeScene(rtcNewScene(this->device.get()));
    // Together these two settings give two levels, with one structure per surface below. A moved
    // surface then costs only its own refit. Tracing takes 2 % longer than in one level (with 400
    // surfaces 7 %). The lower structures keep their full quality, because surfaces set the quality
    // REFIT, not LOW.
    rtcSetSceneFlags(this->scene.get(),
      static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC | queriesFilter));
    rtcSetSceneBuildQuality(this->scene.get(), RTC_BUILD_QUALITY_LOW);
  }

  EmbreeTracer::Update update(const Occluders& occluders)
  {
    if (this->versions_ == occluders.versions())
    {
      return {};
    }
    if (!occluders.castersCentred.empty())
    {
      checkEmbreeRange(occluders.castersCentred);
    }
    EmbreeTracer::Update update;
    std::unordered_map<std::uint64_t, Caster> casters;
    for (const Surface& surface : occluders.surfaces)
    {
      if (!surface.casts || surface.triangleCount == 0)
      {
        continue;
      }
      const auto found = this->casters.find(surface.topologyVersion);
      if (found == this->casters.end() || found->second.filter != filterOf(surface))
      {
        casters[surface.topologyVersion] = this->makeCaster(surface, occluders);
        ++update.builds;
        continue;
      }
      Caster& caster = casters[surface.topologyVersion] = std::move(found->second);
      this->casters.erase(found);
      this->setBuffers(caster, surface, occluders);
      if (caster.positionsVersion != surface.positionsVersion)
      {
        caster.positionsVersion = surface.positionsVersion;
        this->move(caster, surface);
        ++update.refits;
      }
    }
    for (const auto& gone : this->casters)
    {
      detachAll(this->scene.get(), gone.second.attached);
    }
    this->casters = std::move(casters);
    this->nameSurfaces(occluders);
    rtcCommitScene(this->scene.get());
    const RTCError error = rtcGetDeviceError(this->device.get());
    if (error != RTC_ERROR_NONE)
    {
      throw std::runtime_error("Embree failed while building the acceleration structure: " +
        (error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory"
                                          : "error " + std::to_string(static_cast<int>(error))));
    }
    this->versions_ = occluders.versions();
    return update;
  }

  /// Return the bytes of the tables that find each surface's structure.
  std::size_t bytesOfTable() const
  {
    std::size_t bytes = gnomon::bytesOfTable(this->casters) + bytesOf(this->named);
    for (const auto& entry : this->casters)
    {
      const Caster& caster = entry.second;
      bytes += bytesOf(caster.attached) + (caster.cutout ? sizeof(CutoutSurface) : 0) +
        (caster.solids ? bytesOf(caster.solids->solids) : 0);
    }
    return bytes;
  }

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // must outlive the device, which counts into it
  EmbreeDevice device;
  EmbreeScene scene; ///< Embree may not have seen it while there are no casters
  std::unordered_map<std::uint64_t, Caster> casters; ///< by the surface's topologyVersion
  std::vector<Named> named;                          ///< by Embree's numbers

private:
  /// Share the snapshot's current arrays with Embree. Indices count over all its vertices.
  void setBuffers(Caster& caster, const Surface& surface, const Occluders& occluders) const
  {
    if (caster.solids)
    {
      return;
    }
    const glm::uvec3* triangles = occluders.triangles.data() + surface.firstTriangle;
    if (caster.triangles != triangles)
    {
      rtcSetSharedGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
        triangles, 0, sizeof(glm::uvec3), surface.triangleCount);
      caster.triangles = triangles;
    }
    const glm::vec3* positions = occluders.positionsCentred.data();
    const std::size_t count = occluders.positionsCentred.size();
    if (caster.positions != positions || caster.positionCount != count)
    {
      rtcSetSharedGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
        RTC_FORMAT_FLOAT3, positions, 0, sizeof(glm::vec3), count);
      caster.positions = positions;
      caster.positionCount = count;
    }
    if (caster.cutout)
    {
      *caster.cutout = { surface.cutout, surface.textureCoordinates.data(), triangles,
        surface.firstVertex };
    }
  }

  Caster makeCaster(const Surface& surface, const Occluders& occluders) const
  {
    const bool isSolid = surface.solid != Solid::None;
    Caster caster;
    caster.geometry = EmbreeGeometry(rtcNewGeometry(
      this->device.get(), isSolid ? RTC_GEOMETRY_TYPE_USER : RTC_GEOMETRY_TYPE_TRIANGLE));
    caster.filter = filterOf(surface);
    caster.positionsVersion = surface.positionsVersion;
    if (isSolid)
    {
      caster.solids = std::make_unique<CastingSolids>();
      caster.solids->place(surface);
      setSolids(caster.geometry.get(), *caster.solids);
      this->attachOne(caster);
      return caster;
    }
    if (caster.filter)
    {
      rtcSetGeometryOccludedFilterFunction(caster.geometry.get(), caster.filter);
    }
    if (surface.cutout)
    {
      rtcSetGeometryIntersectFilterFunction(caster.geometry.get(), rejectHoles);
      caster.cutout = std::make_unique<CutoutSurface>();
      rtcSetGeometryUserData(caster.geometry.get(), caster.cutout.get());
    }
    this->setBuffers(caster, surface, occluders);
    surface.isInstanced() ? this->attachInstances(caster, surface) : this->attachOne(caster);
    return caster;
  }

  /// Attach a surface that is drawn once.
  void attachOne(Caster& caster) const
  {
    rtcSetGeometryBuildQuality(caster.geometry.get(), RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(caster.geometry.get());
    caster.attached = { rtcAttachGeometry(this->scene.get(), caster.geometry.get()) };
  }

  void attachInstances(Caster& caster, const Surface& surface) const
  {
    rtcCommitGeometry(caster.geometry.get());
    caster.source = EmbreeScene(rtcNewScene(this->device.get()));
    rtcSetSceneFlags(
      caster.source.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | queriesFilter));
    rtcAttachGeometry(caster.source.get(), caster.geometry.get());
    rtcCommitScene(caster.source.get());
    caster.attached =
      gnomon::attachInstances(this->device.get(), this->scene.get(), caster.source.get(), surface);
    this->move(caster, surface);
  }

  /// Refit a surface's structure to its moved vertices, or set the matrices of its attached
  /// instances.
  void move(Caster& caster, const Surface& surface) const
  {
    if (caster.solids)
    {
      caster.solids->place(surface); // their number is unchanged
      rtcCommitGeometry(caster.geometry.get());
      return;
    }
    if (!surface.isInstanced())
    {
      rtcUpdateGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
      rtcCommitGeometry(caster.geometry.get());
      return;
    }
    placeInstances(this->scene.get(), caster.attached, surface);
  }

  /// Record the surface of each of Embree's numbers.
  void nameSurfaces(const Occluders& occluders)
  {
    this->named.clear();
    for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
    {
      const Surface& surface = occluders.surfaces[i];
      const auto caster = this->casters.find(surface.topologyVersion);
      if (caster == this->casters.end())
      {
        continue;
      }
      std::uint32_t instance = 0;
      for (const unsigned int attached : caster->second.attached)
      {
        const std::uint32_t own = instance++;
        if (attached == RTC_INVALID_GEOMETRY_ID)
        {
          continue;
        }
        this->named.resize(std::max<std::size_t>(this->named.size(), attached + 1u));
        this->named[attached] = { static_cast<std::uint32_t>(i), own, surface.firstTriangle,
          caster->second.solids.get() };
      }
    }
  }

  Occluders::Versions versions_;
};

} // namespace gnomon
