#include "shadowtech/tracing/EmbreeTracer.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/EmbreeHandle.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon
{

/// The surface that a ray passes through near its start (LiftedRay).
struct OwnSurface
{
  unsigned int instance, geometry;           ///< Embree's numbers
  const std::vector<std::uint32_t>* patches; ///< Patches::numbers(); null: the ray has none
  std::uint32_t patch;                       ///< the receiver's
  float until;                               ///< LiftedRay::leaves

  bool has(unsigned int ofInstance, unsigned int ofGeometry, unsigned int triangle) const
  {
    return this->patches && ofInstance == this->instance && ofGeometry == this->geometry &&
      (*this->patches)[triangle] == this->patch;
  }
};

namespace
{

using Device = EmbreeDevice;
using Scene = EmbreeScene;
using Geometry = EmbreeGeometry;

/// Reject hits on the back of a one-sided surface: those whose front does not face the light.
/// Embree's geometric normal follows counter-clockwise winding. In an instance, ray and normal are
/// in source coordinates, where a mirrored instance shows its other side.
template <bool mirrored>
void rejectBackFaces(const RTCFilterFunctionNArguments* arguments)
{
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    const float cosine =
      RTCHitN_Ng_x(arguments->hit, count, i) * RTCRayN_dir_x(arguments->ray, count, i) +
      RTCHitN_Ng_y(arguments->hit, count, i) * RTCRayN_dir_y(arguments->ray, count, i) +
      RTCHitN_Ng_z(arguments->hit, count, i) * RTCRayN_dir_z(arguments->ray, count, i);
    if (!((mirrored ? -cosine : cosine) > 0.0f))
    {
      arguments->valid[i] = 0;
    }
  }
}

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
void rejectHoles(const RTCFilterFunctionNArguments* arguments)
{
  const auto& surface = *static_cast<const CutoutSurface*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue; // no hit; its numbers are undefined
    }
    const glm::uvec3 corners =
      surface.triangles[RTCHitN_primID(arguments->hit, count, i)] - surface.firstVertex;
    const glm::vec2 a = surface.textureCoordinates[corners.x];
    const glm::vec2 b = surface.textureCoordinates[corners.y];
    const glm::vec2 c = surface.textureCoordinates[corners.z];
    const float u = RTCHitN_u(arguments->hit, count, i);
    const float v = RTCHitN_v(arguments->hit, count, i);
    if (!surface.mask->isDrawn(a + u * (b - a) + v * (c - a)))
    {
      arguments->valid[i] = 0;
    }
  }
}

/// Reject a hit on the part of a single ray's own surface that it passes through.
void rejectOwn(const RTCFilterFunctionNArguments* arguments)
{
  // The context is the first member.
  const OwnSurface* const own = reinterpret_cast<const EmbreeContext*>(arguments->context)->own;
  // The ray's end is the hit's place.
  if (arguments->valid[0] && RTCRayN_tfar(arguments->ray, 1, 0) <= own->until &&
    own->has(RTCHitN_instID(arguments->hit, 1, 0, 0), RTCHitN_geomID(arguments->hit, 1, 0),
      RTCHitN_primID(arguments->hit, 1, 0)))
  {
    arguments->valid[0] = 0;
  }
}

template <bool mirrored>
void rejectBackFacesAndHoles(const RTCFilterFunctionNArguments* arguments)
{
  rejectBackFaces<mirrored>(arguments);
  rejectHoles(arguments);
}

/// Return the filter of hits on a surface; null if every hit counts.
RTCFilterFunctionN filterOf(const Surface& surface)
{
  if (!surface.oneSided)
  {
    return surface.cutout ? rejectHoles : nullptr;
  }
  if (surface.cutout)
  {
    return surface.mirrored ? rejectBackFacesAndHoles<true> : rejectBackFacesAndHoles<false>;
  }
  return surface.mirrored ? rejectBackFaces<true> : rejectBackFaces<false>;
}

/// The solids of a surface that are not left out, for Embree's callbacks.
struct CastingSolids
{
  std::vector<PlacedSolid> solids;
  bool oneSided = false;

  void place(const Surface& surface)
  {
    this->oneSided = surface.oneSided;
    this->solids.clear();
    for (const glm::mat4x3& instance : surface.centredFromSource)
    {
      if (!Surface::isLeftOut(instance))
      {
        this->solids.push_back(placedSolid(surface.solid, instance));
      }
    }
  }
};

void boundSolid(const RTCBoundsFunctionArguments* arguments)
{
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const Bounds bounds = boundsOf(casters.solids[arguments->primID]);
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = static_cast<float>(bounds.lower.x);
  box.lower_y = static_cast<float>(bounds.lower.y);
  box.lower_z = static_cast<float>(bounds.lower.z);
  box.upper_x = static_cast<float>(bounds.upper.x);
  box.upper_y = static_cast<float>(bounds.upper.y);
  box.upper_z = static_cast<float>(bounds.upper.z);
}

glm::dvec3 originOf(RTCRayN* rays, unsigned int count, unsigned int i)
{
  return { RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i),
    RTCRayN_org_z(rays, count, i) };
}

glm::dvec3 directionOf(RTCRayN* rays, unsigned int count, unsigned int i)
{
  return { RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i),
    RTCRayN_dir_z(rays, count, i) };
}

/// Test ray by ray, so that each ray has the same answer alone as in a packet.
void occludeBySolid(const RTCOccludedFunctionNArguments* arguments)
{
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue;
    }
    float& far = RTCRayN_tfar(arguments->ray, count, i);
    if (blocks(casters.solids[arguments->primID], casters.oneSided,
          originOf(arguments->ray, count, i), directionOf(arguments->ray, count, i), far))
    {
      far = -std::numeric_limits<float>::infinity();
    }
  }
}

/// Shorten rays to where they enter a solid, or leave it if they begin inside.
void meetSolid(const RTCIntersectFunctionNArguments* arguments)
{
  const auto& casters = *static_cast<const CastingSolids*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, count);
  RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, count);
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue;
    }
    const std::optional<Crossing> crossing = crossingOf(
      casters.solids[arguments->primID], originOf(rays, count, i), directionOf(rays, count, i));
    if (!crossing)
    {
      continue;
    }
    const double near = RTCRayN_tnear(rays, count, i);
    float& far = RTCRayN_tfar(rays, count, i);
    const double at = crossing->enters > near ? crossing->enters : crossing->leaves;
    if (at > near && at < far)
    {
      far = static_cast<float>(at);
      RTCHitN_geomID(hits, count, i) = arguments->geomID;
      RTCHitN_primID(hits, count, i) = arguments->primID;
      RTCHitN_instID(hits, count, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

/// One casting surface in the scene.
struct Caster
{
  Geometry geometry;
  /// For a surface with instances, the scene that holds its triangles once.
  Scene source;
  /// The geometries attached to the tracer's scene, by Embree's numbers: the triangles, or all
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

/// Subtract what a ray stands for from its pixel's visibility, if it is blocked.
void darken(TracedTile& tile, std::size_t pixel, bool blocked)
{
  // Nearly always there is one channel.
  tile.visibility[0][pixel] -= blocked ? tile.samplesOfRay[0][pixel] : 0.0f;
  for (std::size_t channel = 1; channel < tile.channels; ++channel)
  {
    tile.visibility[channel][pixel] -= blocked ? tile.samplesOfRay[channel][pixel] : 0.0f;
  }
}

/// Traces a tile's rays in squares of 4 x 4 pixels, whose rays stay closer together than those of a
/// row. Squares with few rays share a packet.
template <typename Packet>
class TileTracer
{
public:
  TileTracer(RTCScene scene, float rayFar)
    : scene_(scene)
    , rayFar_(rayFar)
  {
    // A ray's answer must not depend on the packet's other rays. Coherent packets enter boxes
    // together: if a ray meets an edge on its box's side, to within a rounding, its answer would
    // depend on the packet. In scenes with instances, Embree 3.13.5 also hangs on coherent packets
    // of 16 that hit some: it keeps numbers in AVX-512 registers that the traversal of an instance
    // overwrites.
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      this->packet_.tnear[lane] = shadowRayNear;
      this->packet_.time[lane] = 0.0f;
      this->packet_.mask[lane] = 0xffffffffu;
      this->packet_.id[lane] = 0;
      this->packet_.flags[lane] = 0;
    }
  }

  /// Subtract what blocked rays stand for from the visibility of their pixels.
  /// @return the number of rays
  std::size_t trace(TracedTile& tile)
  {
    std::size_t traced = 0;
    for (std::size_t y = 0; y < TracedTile::rows; y += rowsOfPacket)
    {
      for (std::size_t x = 0; x < TracedTile::columns; x += side)
      {
        traced += this->take(tile, y * TracedTile::columns + x);
      }
    }
    this->traceTaken(tile);
    return traced;
  }

private:
  static constexpr std::size_t lanes = std::extent_v<decltype(Packet::tfar)>;
  static constexpr std::size_t side = 4;
  static constexpr std::size_t rowsOfPacket = lanes / side;

  /// Add the rays that a square needs to the packet, which is traced whenever it is full.
  /// @return their number
  std::size_t take(TracedTile& tile, std::size_t corner)
  {
    std::array<std::uint16_t, lanes> needed;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const std::size_t pixel = corner + lane / side * TracedTile::columns + lane % side;
      needed[count] = static_cast<std::uint16_t>(pixel);
      count += tile.needed[pixel] != 0 ? 1 : 0;
    }
    // If the square does not fit, trace the packet first, so that no square is split between
    // packets.
    if (this->taken_ > 0 && this->taken_ + count > lanes)
    {
      this->traceTaken(tile);
    }
    const std::size_t first = this->taken_;
    std::copy_n(needed.begin(), count, &this->pixels_[first]);
    const auto load = [&](float* to, const TracedTile::Plane<float>& from)
    {
      if (count == lanes)
      {
        for (std::size_t row = 0; row < rowsOfPacket; ++row)
        {
          std::copy_n(&from[corner + row * TracedTile::columns], side, to + row * side);
        }
        return;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        to[first + i] = from[needed[i]];
      }
    };
    load(this->packet_.org_x, tile.originX);
    load(this->packet_.org_y, tile.originY);
    load(this->packet_.org_z, tile.originZ);
    load(this->packet_.dir_x, tile.directionX);
    load(this->packet_.dir_y, tile.directionY);
    load(this->packet_.dir_z, tile.directionZ);
    this->taken_ += count;
    return count;
  }

  void traceTaken(TracedTile& tile)
  {
    if (this->taken_ == 0)
    {
      return;
    }
    alignas(64) std::array<int, lanes> valid;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const bool taken = lane < this->taken_;
      valid[lane] = taken ? -1 : 0;
      // If the processor lacks the lanes, Embree uses the interval instead of the mask.
      this->packet_.tfar[lane] = taken ? this->rayFar_ : -std::numeric_limits<float>::infinity();
    }
    occlude(valid.data(), this->scene_, this->context_, this->packet_);
    for (std::size_t lane = 0; lane < this->taken_; ++lane)
    {
      // Embree sets the far end of a blocked ray to minus infinity.
      darken(tile, this->pixels_[lane], this->packet_.tfar[lane] < 0.0f);
    }
    this->taken_ = 0;
  }

  RTCScene scene_;
  Packet packet_{};
  EmbreeContext context_{ EmbreeRays::Incoherent };
  float rayFar_;
  std::size_t taken_ = 0;                     ///< rays in the packet
  std::array<std::uint16_t, lanes> pixels_{}; ///< the rays' pixels in the tile
};

/// Trace rays as packets in their order.
/// @param load fills the origins and directions of lanes with rays: load(packet, first, count)
/// @param ofBlocked the answer, 0 or 1, for a blocked ray; other rays get the other
template <typename Packet, typename Load>
void traceRays(RTCScene scene, std::size_t count, float rayFar, const Load& load,
  std::uint8_t ofBlocked, std::uint8_t* answers)
{
  constexpr std::size_t lanes = std::extent_v<decltype(Packet::tfar)>;
  EmbreeContext context(EmbreeRays::Incoherent); // as in TileTracer
  Packet packet{};
  std::fill_n(packet.tnear, lanes, shadowRayNear);
  std::fill_n(packet.mask, lanes, 0xffffffffu);
  alignas(64) std::array<int, lanes> valid;
  for (std::size_t first = 0; first < count; first += lanes)
  {
    const std::size_t taken = std::min(lanes, count - first);
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      valid[lane] = lane < taken ? -1 : 0;
      packet.tfar[lane] = lane < taken ? rayFar : -std::numeric_limits<float>::infinity();
    }
    load(packet, first, taken);
    occlude(valid.data(), scene, context, packet);
    for (std::size_t lane = 0; lane < taken; ++lane)
    {
      const bool blocked = packet.tfar[lane] < 0.0f;
      answers[first + lane] = static_cast<std::uint8_t>(blocked ? ofBlocked : 1 - ofBlocked);
    }
  }
}

template <typename Packet>
void loadOrigins(Packet& packet, const PointArrays& origins, std::size_t first, std::size_t count)
{
  std::copy_n(origins.x + first, count, packet.org_x);
  std::copy_n(origins.y + first, count, packet.org_y);
  std::copy_n(origins.z + first, count, packet.org_z);
}

/// Test if segments are free.
template <typename Packet>
void findFree(RTCScene scene, std::size_t count, const PointArrays& from, const PointArrays& to,
  std::uint8_t* free)
{
  traceRays<Packet>(
    scene, count, shadowRayFarAtLight,
    [&](Packet& packet, std::size_t first, std::size_t taken)
    {
      loadOrigins(packet, from, first, taken);
      for (std::size_t lane = 0; lane < taken; ++lane)
      {
        packet.dir_x[lane] = to.x[first + lane] - from.x[first + lane];
        packet.dir_y[lane] = to.y[first + lane] - from.y[first + lane];
        packet.dir_z[lane] = to.z[first + lane] - from.z[first + lane];
      }
    },
    0, free);
}

/// Test if rays are blocked.
template <typename Packet>
void findBlocked(RTCScene scene, std::size_t count, const PointArrays& origins,
  const PointArrays& directions, float rayFar, std::uint8_t* blocked)
{
  traceRays<Packet>(
    scene, count, rayFar,
    [&](Packet& packet, std::size_t first, std::size_t taken)
    {
      loadOrigins(packet, origins, first, taken);
      std::copy_n(directions.x + first, taken, packet.dir_x);
      std::copy_n(directions.y + first, taken, packet.dir_y);
      std::copy_n(directions.z + first, taken, packet.dir_z);
    },
    1, blocked);
}

} // namespace

//------------------------------------------------------------------------------
struct EmbreeTracer::Impl
{
  Impl();

  void setBuffers(Caster& caster, const Surface& surface, const Occluders& occluders) const;
  Caster makeCaster(const Surface& surface, const Occluders& occluders) const;
  Caster makeSolids(const Surface& surface) const;
  void attachInstances(Caster& caster, const Surface& surface) const;
  void move(Caster& caster, const Surface& surface) const;
  void nameSurfaces(const Occluders& occluders);
  glm::vec3 normalOf(const RTCHit& hit) const;
  void check(const char* what) const;
  RTCRayHit nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const;
  OwnSurface ownSurface(const Occluders& occluders, std::uint32_t number,
    const ReceiverPixels::Curve& curve, float until) const;
  bool meets(
    const OwnSurface& own, const glm::vec3& origin, const glm::vec3& direction, float rayFar) const;
  std::size_t traceTurned(const TracedPicture& picture, TracedTile& tile) const;
  template <typename Packet>
  std::size_t trace(const TracedPicture& picture) const;

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // must outlive the device, which counts into it
  Device device;
  Scene scene;
  bool lanes16 = false; ///< packets of 16, else of 8; the answers are the same
  std::unordered_map<std::uint64_t, Caster> casters; ///< by the surface's topologyVersion
  /// The surface of an attached geometry, by Embree's numbers.
  struct Named
  {
    std::uint32_t surface;       ///< Occluders::surfaces index
    std::uint32_t firstTriangle; ///< of the surface in the snapshot
    const CastingSolids* solids; ///< null if it casts triangles
  };
  std::vector<Named> named;
  std::uint64_t topologyVersion = 0;
  std::uint64_t positionsVersion = 0;
};

EmbreeTracer::Impl::Impl()
  : device(startEmbree())
{
  rtcSetDeviceMemoryMonitorFunction(
    this->device.get(),
    [](void* user, ssize_t change, bool)
    {
      *static_cast<std::atomic<std::ptrdiff_t>*>(user) += change;
      return true;
    },
    &this->bytes);
  this->lanes16 =
    rtcGetDeviceProperty(this->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  this->scene = Scene(rtcNewScene(this->device.get()));
  // Together these two settings give two levels, with one structure per surface below. A moved
  // surface then costs only its own refit. Tracing takes 2 % longer than in one level (with 400
  // surfaces 7 %). The lower structures keep their full quality, because surfaces set the quality
  // REFIT, not LOW.
  rtcSetSceneFlags(this->scene.get(),
    static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC | queriesFilter));
  rtcSetSceneBuildQuality(this->scene.get(), RTC_BUILD_QUALITY_LOW);
}

void EmbreeTracer::Impl::check(const char* what) const
{
  const RTCError error = rtcGetDeviceError(this->device.get());
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error(std::string("Embree failed while ") + what + ": " +
      (error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory"
                                        : "error " + std::to_string(static_cast<int>(error))));
  }
}

/// Share the snapshot's current arrays with Embree. Indices count over all its vertices.
void EmbreeTracer::Impl::setBuffers(
  Caster& caster, const Surface& surface, const Occluders& occluders) const
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
    rtcSetSharedGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
      positions, 0, sizeof(glm::vec3), count);
    caster.positions = positions;
    caster.positionCount = count;
  }
  if (caster.cutout)
  {
    *caster.cutout = { surface.cutout, surface.textureCoordinates.data(), triangles,
      surface.firstVertex };
  }
}

Caster EmbreeTracer::Impl::makeSolids(const Surface& surface) const
{
  Caster caster;
  caster.geometry = Geometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_USER));
  caster.solids = std::make_unique<CastingSolids>();
  caster.solids->place(surface);
  caster.filter = filterOf(surface);
  caster.positionsVersion = surface.positionsVersion;
  const RTCGeometry geometry = caster.geometry.get();
  rtcSetGeometryUserPrimitiveCount(
    geometry, static_cast<unsigned int>(caster.solids->solids.size()));
  rtcSetGeometryUserData(geometry, caster.solids.get());
  rtcSetGeometryBoundsFunction(geometry, boundSolid, nullptr);
  rtcSetGeometryOccludedFunction(geometry, occludeBySolid);
  rtcSetGeometryIntersectFunction(geometry, meetSolid);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  caster.attached = { rtcAttachGeometry(this->scene.get(), geometry) };
  return caster;
}

Caster EmbreeTracer::Impl::makeCaster(const Surface& surface, const Occluders& occluders) const
{
  if (surface.solid != Solid::None)
  {
    return this->makeSolids(surface);
  }
  Caster caster;
  caster.geometry = Geometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  caster.filter = filterOf(surface);
  caster.positionsVersion = surface.positionsVersion;
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
  if (surface.isInstanced())
  {
    this->attachInstances(caster, surface);
    return caster;
  }
  rtcSetGeometryBuildQuality(caster.geometry.get(), RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(caster.geometry.get());
  caster.attached = { rtcAttachGeometry(this->scene.get(), caster.geometry.get()) };
  return caster;
}

void EmbreeTracer::Impl::attachInstances(Caster& caster, const Surface& surface) const
{
  rtcCommitGeometry(caster.geometry.get());
  caster.attached.reserve(surface.centredFromSource.size());
  caster.source = Scene(rtcNewScene(this->device.get()));
  rtcSetSceneFlags(
    caster.source.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | queriesFilter));
  rtcAttachGeometry(caster.source.get(), caster.geometry.get());
  rtcCommitScene(caster.source.get());
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    if (Surface::isLeftOut(instance))
    {
      caster.attached.push_back(RTC_INVALID_GEOMETRY_ID);
      continue;
    }
    const Geometry geometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), caster.source.get());
    caster.attached.push_back(rtcAttachGeometry(this->scene.get(), geometry.get()));
  }
  this->move(caster, surface);
}

/// Refit a surface's structure to its moved vertices, or set the matrices of its attached
/// instances.
void EmbreeTracer::Impl::move(Caster& caster, const Surface& surface) const
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
  for (std::size_t i = 0; i < caster.attached.size(); ++i)
  {
    if (caster.attached[i] != RTC_INVALID_GEOMETRY_ID)
    {
      const RTCGeometry geometry = rtcGetGeometry(this->scene.get(), caster.attached[i]);
      rtcSetGeometryTransform(
        geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &surface.centredFromSource[i][0][0]);
      rtcCommitGeometry(geometry);
    }
  }
}

/// Record the surface of each of Embree's numbers.
void EmbreeTracer::Impl::nameSurfaces(const Occluders& occluders)
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
    for (const unsigned int attached : caster->second.attached)
    {
      if (attached == RTC_INVALID_GEOMETRY_ID)
      {
        continue;
      }
      this->named.resize(std::max<std::size_t>(this->named.size(), attached + 1u));
      this->named[attached] = { static_cast<std::uint32_t>(i), surface.firstTriangle,
        caster->second.solids.get() };
    }
  }
}

/// Return the nearest hit of a ray.
RTCRayHit EmbreeTracer::Impl::nearest(
  const glm::vec3& origin, const glm::vec3& direction, float after, float until) const
{
  RTCRayHit query{};
  query.ray = { origin.x, origin.y, origin.z, after, direction.x, direction.y, direction.z, 0.0f,
    until, 0xffffffffu, 0, 0 };
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  EmbreeContext context;
  intersect(this->scene.get(), context, query);
  return query;
}

/// Return the hit triangle's normal, in centred coordinates.
glm::vec3 EmbreeTracer::Impl::normalOf(const RTCHit& hit) const
{
  const glm::vec3 normal(hit.Ng_x, hit.Ng_y, hit.Ng_z);
  if (hit.instID[0] == RTC_INVALID_GEOMETRY_ID)
  {
    return normal;
  }
  glm::mat4x3 centredFromSource;
  rtcGetGeometryTransform(rtcGetGeometry(this->scene.get(), hit.instID[0]), 0.0f,
    RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &centredFromSource[0][0]);
  // The matrix is regular (Surface::centredFromSource).
  return glm::normalize(glm::inverseTranspose(glm::mat3(centredFromSource)) * normal);
}

//------------------------------------------------------------------------------
EmbreeTracer::EmbreeTracer()
  : impl_(std::make_unique<Impl>())
{
}
EmbreeTracer::~EmbreeTracer() = default;

//------------------------------------------------------------------------------
EmbreeTracer::Update EmbreeTracer::update(const Occluders& occluders)
{
  Impl& impl = *this->impl_;
  if (impl.topologyVersion == occluders.topologyVersion &&
    impl.positionsVersion == occluders.positionsVersion)
  {
    return {};
  }
  if (!occluders.castersCentred.empty())
  {
    checkEmbreeRange(occluders.castersCentred);
  }
  Update update;
  std::unordered_map<std::uint64_t, Caster> casters;
  for (const Surface& surface : occluders.surfaces)
  {
    if (!surface.casts || surface.triangleCount == 0)
    {
      continue;
    }
    const auto found = impl.casters.find(surface.topologyVersion);
    if (found == impl.casters.end() || found->second.filter != filterOf(surface))
    {
      casters[surface.topologyVersion] = impl.makeCaster(surface, occluders);
      ++update.builds;
      continue;
    }
    Caster& caster = casters[surface.topologyVersion] = std::move(found->second);
    impl.casters.erase(found);
    impl.setBuffers(caster, surface, occluders);
    if (caster.positionsVersion != surface.positionsVersion)
    {
      caster.positionsVersion = surface.positionsVersion;
      impl.move(caster, surface);
      ++update.refits;
    }
  }
  for (const auto& gone : impl.casters)
  {
    for (const unsigned int attached : gone.second.attached)
    {
      if (attached != RTC_INVALID_GEOMETRY_ID)
      {
        rtcDetachGeometry(impl.scene.get(), attached);
      }
    }
  }
  impl.casters = std::move(casters);
  impl.nameSurfaces(occluders);
  rtcCommitScene(impl.scene.get());
  impl.check("building the acceleration structure");
  impl.topologyVersion = occluders.topologyVersion;
  impl.positionsVersion = occluders.positionsVersion;
  return update;
}

//------------------------------------------------------------------------------
/// Return the surface that a receiver's ray passes through.
OwnSurface EmbreeTracer::Impl::ownSurface(const Occluders& occluders, std::uint32_t number,
  const ReceiverPixels::Curve& curve, float until) const
{
  const Surface& surface = occluders.surfaces[number];
  const auto caster = this->casters.find(surface.topologyVersion);
  if (caster == this->casters.end())
  {
    return {}; // casts nothing
  }
  const std::vector<std::uint32_t>& patches = surface.patches->numbers(occluders, surface);
  const unsigned int attached = caster->second.attached[surface.isInstanced() ? curve.instance : 0];
  return { surface.isInstanced() ? attached : RTC_INVALID_GEOMETRY_ID,
    surface.isInstanced() ? 0u : attached, &patches,
    patches[curve.triangle - surface.firstTriangle], until };
}

//------------------------------------------------------------------------------
/// True if a ray meets its own surface, on either side.
bool EmbreeTracer::Impl::meets(
  const OwnSurface& own, const glm::vec3& origin, const glm::vec3& direction, float rayFar) const
{
  float after = shadowRayNear;
  while (true)
  {
    const RTCRayHit found = this->nearest(origin, direction, after, rayFar);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
    {
      return false;
    }
    if (own.has(found.hit.instID[0], found.hit.geomID, found.hit.primID))
    {
      return true;
    }
    after = std::nextafter(found.ray.tfar, std::numeric_limits<float>::infinity());
  }
}

//------------------------------------------------------------------------------
/// Trace the rays of a tile's turned pixels, which are not needed afterwards.
/// @return their number
std::size_t EmbreeTracer::Impl::traceTurned(const TracedPicture& picture, TracedTile& tile) const
{
  const ReceiverPixels& receivers = *tile.receivers;
  std::size_t count = 0;
  for (const auto& [pixel, i] : tile.turned)
  {
    if (tile.needed[pixel] == 0)
    {
      continue;
    }
    tile.needed[pixel] = 0;
    ++count;
    const ReceiverPixels::Curve& curve = receivers.curves[i];
    const glm::vec3 origin(tile.originX[pixel], tile.originY[pixel], tile.originZ[pixel]);
    const glm::vec3 direction(
      tile.directionX[pixel], tile.directionY[pixel], tile.directionZ[pixel]);
    const LiftedRay lifted = liftedRay(picture.light(),
      { receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i] }, origin, direction,
      curve.normal, curve.height + receivers.offset[i]);
    const OwnSurface own =
      this->ownSurface(picture.occluders(), receivers.surface[i], curve, lifted.leaves);
    EmbreeContext context;
    context.own = &own;
    context.filter = rejectOwn;
    RTCRay ray{ origin.x, origin.y, origin.z, shadowRayNear, direction.x, direction.y, direction.z,
      0.0f, picture.rayFar(), 0xffffffffu, 0, 0 };
    occlude(this->scene.get(), context, ray);
    darken(tile, pixel,
      ray.tfar < 0.0f || this->meets(own, origin, lifted.origin - origin, 1.0f) ||
        this->meets(own, lifted.origin, lifted.direction, picture.rayFar()));
  }
  return count;
}

//------------------------------------------------------------------------------
template <typename Packet>
std::size_t EmbreeTracer::Impl::trace(const TracedPicture& picture) const
{
  return picture.visitTiles(picture.allSamples(),
    [&](TracedTile& tile)
    {
      const std::size_t turned = this->traceTurned(picture, tile);
      return turned + TileTracer<Packet>(this->scene.get(), picture.rayFar()).trace(tile);
    });
}

//------------------------------------------------------------------------------
std::size_t EmbreeTracer::tracePicture(const TracedPicture& picture)
{
  if (this->impl_->casters.empty())
  {
    return picture.visitTiles(
      picture.allSamples(), [](const TracedTile&) { return std::size_t(0); });
  }
  return this->impl_->lanes16 ? this->impl_->trace<RTCRay16>(picture)
                              : this->impl_->trace<RTCRay8>(picture);
}

//------------------------------------------------------------------------------
bool EmbreeTracer::hasCasters() const
{
  return !this->impl_->casters.empty();
}

//------------------------------------------------------------------------------
void EmbreeTracer::areFree(
  std::size_t count, const PointArrays& from, const PointArrays& to, std::uint8_t* free) const
{
  if (!this->hasCasters()) // then the scene may be one that Embree has not seen
  {
    std::fill_n(free, count, 1);
    return;
  }
  this->impl_->lanes16 ? findFree<RTCRay16>(this->impl_->scene.get(), count, from, to, free)
                       : findFree<RTCRay8>(this->impl_->scene.get(), count, from, to, free);
}

//------------------------------------------------------------------------------
void EmbreeTracer::areBlocked(std::size_t count, const PointArrays& origins,
  const PointArrays& directions, float rayFar, std::uint8_t* blocked) const
{
  const RTCScene scene = this->impl_->scene.get();
  this->impl_->lanes16 ? findBlocked<RTCRay16>(scene, count, origins, directions, rayFar, blocked)
                       : findBlocked<RTCRay8>(scene, count, origins, directions, rayFar, blocked);
}

//------------------------------------------------------------------------------
std::optional<CasterHits::Hit> EmbreeTracer::nearest(
  const glm::vec3& origin, const glm::vec3& direction, float after, float until) const
{
  const Impl& impl = *this->impl_;
  if (impl.casters.empty())
  {
    return std::nullopt;
  }
  const RTCRayHit query = impl.nearest(origin, direction, after, until);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
  {
    return std::nullopt;
  }
  const bool isInstance = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const Impl::Named& named = impl.named[isInstance ? query.hit.instID[0] : query.hit.geomID];
  if (named.solids)
  {
    return Hit{ named.surface, 0, query.ray.tfar, glm::vec3(0.0f),
      &named.solids->solids[query.hit.primID] };
  }
  return Hit{ named.surface, named.firstTriangle + query.hit.primID, query.ray.tfar,
    impl.normalOf(query.hit) };
}

//------------------------------------------------------------------------------
std::size_t EmbreeTracer::bytes() const
{
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(this->impl_->bytes, 0));
}

//------------------------------------------------------------------------------
std::size_t EmbreeTracer::bytesOfTable() const
{
  std::size_t bytes = gnomon::bytesOfTable(this->impl_->casters) + bytesOf(this->impl_->named);
  for (const auto& entry : this->impl_->casters)
  {
    const Caster& caster = entry.second;
    bytes += bytesOf(caster.attached) + (caster.cutout ? sizeof(CutoutSurface) : 0) +
      (caster.solids ? bytesOf(caster.solids->solids) : 0);
  }
  return bytes;
}

} // namespace gnomon
