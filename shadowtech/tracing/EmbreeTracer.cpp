#include "shadowtech/tracing/EmbreeTracer.h"

#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/EmbreeCallbacks.h"
#include "shadowtech/tracing/EmbreeCasters.h"
#include "shadowtech/tracing/EmbreePackets.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon
{
namespace
{

RTCRayHit findNearest(const EmbreeCasters& casters, EmbreeContext& context, const glm::vec3& origin,
  const glm::vec3& direction, float after, float until)
{
  RTCRayHit query{};
  query.ray = { origin.x, origin.y, origin.z, after, direction.x, direction.y, direction.z, 0.0f,
    until, 0xffffffffu, 0, 0 };
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  intersect(casters.scene.get(), context, query);
  return query;
}

/// The own surface of a receiver whose picture this process draws alone.
struct OwnPatch : OwnSurface
{
  /// @param number of the receiver's surface
  OwnPatch(const EmbreeCasters& casters, const Occluders& occluders, std::uint32_t number,
    const ReceiverPixels::Curve& curve)
  {
    const Surface& surface = occluders.surfaces[number];
    const auto caster = casters.casters.find(surface.topologyVersion);
    if (caster == casters.casters.end())
    {
      return; // casts nothing
    }
    this->patches_ = &surface.patches->numbers(occluders, surface);
    this->patch_ = (*this->patches_)[curve.triangle - surface.firstTriangle];
    const unsigned int own = caster->second.attached[surface.isInstanced() ? curve.instance : 0];
    this->instance_ = surface.isInstanced() ? own : RTC_INVALID_GEOMETRY_ID;
    this->geometry_ = surface.isInstanced() ? 0u : own;
  }

  bool has(RTCHitN* hit) const override
  {
    return this->patches_ && RTCHitN_instID(hit, 1, 0, 0) == this->instance_ &&
      RTCHitN_geomID(hit, 1, 0) == this->geometry_ &&
      (*this->patches_)[RTCHitN_primID(hit, 1, 0)] == this->patch_;
  }

private:
  unsigned int instance_ = 0, geometry_ = 0;            ///< Embree's numbers
  const std::vector<std::uint32_t>* patches_ = nullptr; ///< Patches::numbers()
  std::uint32_t patch_ = 0;
};

/// This process's part of the own surface of a receiver that several processes share.
struct OwnPart : OwnSurface
{
  OwnPart(const EmbreeCasters& casters, const PatchNames& names, const ReceiverPixels::Curve& curve)
    : named_(casters.named)
    , names_(names)
    , patch_{ curve.process, curve.triangle }
    , instance_(curve.instance)
  {
  }

  bool has(RTCHitN* hit) const override
  {
    const unsigned int instance = RTCHitN_instID(hit, 1, 0, 0);
    const EmbreeCasters::Named& named =
      this->named_[instance != RTC_INVALID_GEOMETRY_ID ? instance : RTCHitN_geomID(hit, 1, 0)];
    const std::vector<PatchName>& patches = this->names_[named.surface];
    return !patches.empty() && patches[RTCHitN_primID(hit, 1, 0)] == this->patch_ &&
      named.instance == this->instance_;
  }

private:
  const std::vector<EmbreeCasters::Named>& named_;
  const PatchNames& names_;
  PatchName patch_;
  std::uint32_t instance_;
};

/// True if casters block a turned pixel's shadow ray, or its own surface the lifted one.
bool isTurnedBlocked(const EmbreeCasters& casters, const TracedPicture& picture,
  const TracedTile& tile, const TurnedPixel& turned, OwnSurface& own)
{
  const auto& [pixel, i] = turned;
  const ReceiverPixels& receivers = *tile.receivers;
  const ReceiverPixels::Curve& curve = receivers.curves[i];
  const glm::vec3 origin = tile.origin(pixel);
  const glm::vec3 direction = tile.direction(pixel);
  const LiftedRay lifted = liftedRay(picture.light(), receivers.position(i), origin, direction,
    curve.normal, curve.height + receivers.offset[i]);
  own.until = lifted.leaves;
  // True if a ray meets the own surface, on either side.
  const auto meets = [&](const glm::vec3& from, const glm::vec3& towards, float rayFar)
  {
    EmbreeContext context;
    context.own = &own;
    context.filter = rejectOthers;
    return findNearest(casters, context, from, towards, shadowRayNear, rayFar).hit.geomID !=
      RTC_INVALID_GEOMETRY_ID;
  };
  EmbreeContext context;
  context.own = &own;
  context.filter = rejectOwn;
  RTCRay ray{ origin.x, origin.y, origin.z, shadowRayNear, direction.x, direction.y, direction.z,
    0.0f, picture.rayFar(), 0xffffffffu, 0, 0 };
  occlude(casters.scene.get(), context, ray);
  return ray.tfar < 0.0f || meets(origin, lifted.origin - origin, 1.0f) ||
    meets(lifted.origin, lifted.direction, picture.rayFar());
}

/// Subtract what a filter keeps of a tile's rays from the visibility of their pixels.
/// @param needed, before the tile's rays, and its visibility before blocked ones took off theirs
void filterRays(const RayFilter& filter, const TracedTile::Plane<int>& needed,
  const std::array<TracedTile::Plane<float>, 3>& before, float rayFar, TracedTile& tile)
{
  const auto isBlocked = [&](std::size_t pixel)
  {
    bool is = false;
    for (std::size_t channel = 0; channel < tile.channels; ++channel)
    {
      is = is || tile.visibility[channel][pixel] != before[channel][pixel];
    }
    return is;
  };
  for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
  {
    if (needed[pixel] != 0 && !isBlocked(pixel))
    {
      const glm::dvec3 kept =
        1.0 - filter.transmittanceOf(tile.origin(pixel), tile.direction(pixel), rayFar);
      for (std::size_t channel = 0; channel < tile.channels; ++channel)
      {
        float& visibility = tile.visibility[channel][pixel];
        visibility = std::max(visibility -
            static_cast<float>(kept[static_cast<glm::length_t>(channel)]) *
              tile.samplesOfRay[channel][pixel],
          0.0f);
      }
    }
  }
}

/// Return the hit triangle's normal, in centred coordinates.
glm::vec3 normalOf(const EmbreeCasters& casters, const RTCHit& hit)
{
  const glm::vec3 normal(hit.Ng_x, hit.Ng_y, hit.Ng_z);
  if (hit.instID[0] == RTC_INVALID_GEOMETRY_ID)
  {
    return normal;
  }
  glm::mat4x3 centredFromSource;
  rtcGetGeometryTransform(rtcGetGeometry(casters.scene.get(), hit.instID[0]), 0.0f,
    RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &centredFromSource[0][0]);
  // The matrix is regular (Surface::centredFromSource).
  return glm::normalize(glm::inverseTranspose(glm::mat3(centredFromSource)) * normal);
}

} // namespace

struct EmbreeTracer::Impl : EmbreeCasters
{
  /// The widest packet of the processor; the answers are the same.
  const bool lanes16 =
    rtcGetDeviceProperty(this->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
};

EmbreeTracer::EmbreeTracer()
  : impl_(std::make_unique<Impl>())
{
}
EmbreeTracer::~EmbreeTracer() = default;

EmbreeTracer::Update EmbreeTracer::update(const Occluders& occluders)
{
  return this->impl_->update(occluders);
}

std::size_t EmbreeTracer::tracePicture(const TracedPicture& picture)
{
  const Impl& impl = *this->impl_;
  const RTCScene scene = impl.scene.get();
  const float rayFar = picture.rayFar();
  const auto traceBlocking = [&](TracedTile& tile) -> std::size_t
  {
    if (impl.casters.empty())
    {
      return 0;
    }
    const std::size_t turned = this->traceTurned(picture, tile, nullptr,
      [&](std::size_t pixel, bool isBlocked) { darken(tile, pixel, isBlocked); });
    return turned +
      (impl.lanes16 ? TileTracer<RTCRay16>(scene, rayFar).trace(tile)
                    : TileTracer<RTCRay8>(scene, rayFar).trace(tile));
  };
  if (!this->filter_ || !picture.isOfArea())
  {
    return picture.visitTiles(picture.allSamples(), traceBlocking);
  }
  return picture.visitTiles(picture.allSamples(),
    [&](TracedTile& tile)
    {
      const TracedTile::Plane<int> needed = tile.needed;
      const std::array<TracedTile::Plane<float>, 3> before = tile.visibility;
      const std::size_t rays = traceBlocking(tile);
      filterRays(*this->filter_, needed, before, rayFar, tile);
      return rays;
    });
}

std::size_t EmbreeTracer::traceTurned(const TracedPicture& picture, TracedTile& tile,
  const PatchNames* names, const std::function<void(std::size_t pixel, bool isBlocked)>& take) const
{
  const EmbreeCasters& casters = *this->impl_;
  std::size_t count = 0;
  for (const TurnedPixel& turned : tile.turned)
  {
    if (tile.needed[turned.pixel] == 0 || casters.casters.empty())
    {
      continue;
    }
    tile.needed[turned.pixel] = 0;
    ++count;
    const ReceiverPixels& receivers = *tile.receivers;
    const ReceiverPixels::Curve& curve = receivers.curves[turned.receiver];
    const auto isBlocked = [&](OwnSurface&& own)
    { return isTurnedBlocked(casters, picture, tile, turned, own); };
    take(turned.pixel,
      names ? isBlocked(OwnPart(casters, *names, curve))
            : isBlocked(
                OwnPatch(casters, picture.occluders(), receivers.surface[turned.receiver], curve)));
  }
  return count;
}

void EmbreeTracer::areBlocked(std::size_t count, const PointArrays& origins,
  const PointArrays& directions, float rayFar, std::uint8_t* blocked) const
{
  if (this->impl_->casters.empty())
  {
    std::fill_n(blocked, count, 0);
    return;
  }
  const auto load = [&](auto& packet, std::size_t first, std::size_t taken)
  {
    std::copy_n(origins.x + first, taken, packet.org_x);
    std::copy_n(origins.y + first, taken, packet.org_y);
    std::copy_n(origins.z + first, taken, packet.org_z);
    std::copy_n(directions.x + first, taken, packet.dir_x);
    std::copy_n(directions.y + first, taken, packet.dir_y);
    std::copy_n(directions.z + first, taken, packet.dir_z);
  };
  const RTCScene scene = this->impl_->scene.get();
  this->impl_->lanes16 ? traceRays<RTCRay16>(scene, count, rayFar, load, blocked)
                       : traceRays<RTCRay8>(scene, count, rayFar, load, blocked);
}

std::optional<CasterHits::Hit> EmbreeTracer::nearest(
  const glm::vec3& origin, const glm::vec3& direction, float after, float until) const
{
  const Impl& impl = *this->impl_;
  if (impl.casters.empty())
  {
    return std::nullopt;
  }
  EmbreeContext context;
  const auto [ray, hit] = findNearest(impl, context, origin, direction, after, until);
  if (hit.geomID == RTC_INVALID_GEOMETRY_ID)
  {
    return std::nullopt;
  }
  const bool isInstance = hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const EmbreeCasters::Named& named = impl.named[isInstance ? hit.instID[0] : hit.geomID];
  if (named.solids)
  {
    return Hit{ named.surface, 0, ray.tfar, glm::vec3(0.0f), &named.solids->solids[hit.primID] };
  }
  return Hit{ named.surface, named.firstTriangle + hit.primID, ray.tfar, normalOf(impl, hit) };
}

std::size_t EmbreeTracer::bytes() const
{
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(this->impl_->bytes, 0));
}

std::size_t EmbreeTracer::bytesOfTable() const
{
  return this->impl_->bytesOfTable();
}

} // namespace gnomon
