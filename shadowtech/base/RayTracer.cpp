#include "shadowtech/base/RayTracer.h"

#include "shadowtech/base/ShadowRay.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace gnomon
{
namespace
{

/// Owns one reference to an Embree object.
template <typename Object, void (*release)(Object)>
class EmbreeHandle
{
public:
  EmbreeHandle() = default;
  explicit EmbreeHandle(Object object)
    : object_(object)
  {
  }
  EmbreeHandle(EmbreeHandle&& other) noexcept
    : object_(std::exchange(other.object_, nullptr))
  {
  }
  EmbreeHandle& operator=(EmbreeHandle&& other) noexcept
  {
    std::swap(this->object_, other.object_);
    return *this;
  }
  ~EmbreeHandle()
  {
    if (this->object_)
    {
      release(this->object_);
    }
  }
  Object get() const { return this->object_; }

private:
  Object object_ = nullptr;
};
using Device = EmbreeHandle<RTCDevice, rtcReleaseDevice>;
using Scene = EmbreeHandle<RTCScene, rtcReleaseScene>;
using Geometry = EmbreeHandle<RTCGeometry, rtcReleaseGeometry>;

/// Rejects hits on the back of a one-sided surface: those whose front does not face the light.
/// Embree's geometric normal is that of counter-clockwise winding.
void rejectBackFaces(const RTCFilterFunctionNArguments* arguments)
{
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    const float cosine =
      RTCHitN_Ng_x(arguments->hit, count, i) * RTCRayN_dir_x(arguments->ray, count, i) +
      RTCHitN_Ng_y(arguments->hit, count, i) * RTCRayN_dir_y(arguments->ray, count, i) +
      RTCHitN_Ng_z(arguments->hit, count, i) * RTCRayN_dir_z(arguments->ray, count, i);
    if (!(cosine > 0.0f))
    {
      arguments->valid[i] = 0;
    }
  }
}

/// One casting surface in the scene.
struct Caster
{
  Geometry geometry;
  unsigned int id = 0;
  bool oneSided = false;
  std::uint64_t positionsVersion = 0;
  /// Where Embree was told to look.
  const glm::vec3* positions = nullptr;
  std::size_t positionCount = 0;
  const glm::uvec3* triangles = nullptr;
};

constexpr int tileSide = 16;
constexpr int packetSize = 16;
constexpr int tilePixels = tileSide * tileSide;

/// Numbers of a tile's pixels or rays, one array each. A packet may read past the last ray.
using TileFloats = std::array<float, tilePixels + packetSize>;
struct alignas(64) TileRays
{
  TileFloats originX, originY, originZ;
  TileFloats directionX, directionY, directionZ;
  std::array<std::size_t, tilePixels + packetSize> pixel;
  int count = 0;

  void append(const ShadowRay& ray, std::size_t at)
  {
    const auto i = static_cast<std::size_t>(this->count);
    this->originX[i] = ray.origin.x;
    this->originY[i] = ray.origin.y;
    this->originZ[i] = ray.origin.z;
    this->directionX[i] = ray.direction.x;
    this->directionY[i] = ray.direction.y;
    this->directionZ[i] = ray.direction.z;
    this->pixel[i] = at;
    this->count += ray.traced ? 1 : 0;
  }
};

/// Traces a tile's rays and writes 0 where they hit.
void traceTile(RTCScene scene, const TileRays& rays, float rayFar, float* visibility)
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int first = 0; first < rays.count; first += packetSize)
  {
    RTCRay16 packet = {};
    alignas(64) int valid[packetSize];
    const auto at = static_cast<std::size_t>(first);
    std::copy_n(&rays.originX[at], packetSize, packet.org_x);
    std::copy_n(&rays.originY[at], packetSize, packet.org_y);
    std::copy_n(&rays.originZ[at], packetSize, packet.org_z);
    std::copy_n(&rays.directionX[at], packetSize, packet.dir_x);
    std::copy_n(&rays.directionY[at], packetSize, packet.dir_y);
    std::copy_n(&rays.directionZ[at], packetSize, packet.dir_z);
    for (int i = 0; i < packetSize; ++i)
    {
      // Where processors have no 16 lanes Embree goes by the interval, not by the mask.
      const bool used = first + i < rays.count;
      valid[i] = used ? -1 : 0;
      packet.tnear[i] = shadowRayNear;
      packet.tfar[i] = used ? rayFar : -std::numeric_limits<float>::infinity();
      packet.mask[i] = 0xffffffffu;
    }
    rtcOccluded16(valid, scene, &context, &packet);
    const int used = std::min(packetSize, rays.count - first);
    for (int i = 0; i < used; ++i)
    {
      if (packet.tfar[i] < 0.0f)
      {
        visibility[rays.pixel[at + static_cast<std::size_t>(i)]] = 0.0f;
      }
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
struct RayTracer::Impl
{
  Impl();

  void setBuffers(Caster& caster, const Surface& surface, const Occluders& occluders) const;
  Caster makeCaster(const Surface& surface, const Occluders& occluders) const;
  void check(const char* what) const;

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // outlives the device, which counts into it
  Device device;
  Scene scene;
  std::unordered_map<std::uint64_t, Caster> casters; ///< by the surface's topologyVersion
  /// Embree reads 16 bytes per vertex, so 4 past the last one: a copy for snapshots without room.
  std::vector<glm::vec3> padded;
  const glm::vec3* positions = nullptr;
  std::uint64_t topologyVersion = 0;
  std::uint64_t positionsVersion = 0;
};

RayTracer::Impl::Impl()
  : device(rtcNewDevice(nullptr))
{
  if (!this->device.get())
  {
    throw std::runtime_error("Embree cannot be started on this machine");
  }
  rtcSetDeviceMemoryMonitorFunction(
    this->device.get(),
    [](void* user, ssize_t change, bool)
    {
      *static_cast<std::atomic<std::ptrdiff_t>*>(user) += change;
      return true;
    },
    &this->bytes);
  this->scene = Scene(rtcNewScene(this->device.get()));
  rtcSetSceneFlags(
    this->scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
  rtcSetSceneBuildQuality(this->scene.get(), RTC_BUILD_QUALITY_LOW);
}

void RayTracer::Impl::check(const char* what) const
{
  const RTCError error = rtcGetDeviceError(this->device.get());
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error(std::string("Embree failed while ") + what + ": " +
      (error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory"
                                        : "error " + std::to_string(static_cast<int>(error))));
  }
}

/// Points Embree to the snapshot's arrays, where they are now. Indices count over all its vertices.
void RayTracer::Impl::setBuffers(
  Caster& caster, const Surface& surface, const Occluders& occluders) const
{
  const glm::uvec3* triangles = occluders.triangles.data() + surface.firstTriangle;
  if (caster.triangles != triangles)
  {
    rtcSetSharedGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
      triangles, 0, sizeof(glm::uvec3), surface.triangleCount);
    caster.triangles = triangles;
  }
  const std::size_t count = occluders.positionsCentred.size();
  if (caster.positions != this->positions || caster.positionCount != count)
  {
    rtcSetSharedGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
      this->positions, 0, sizeof(glm::vec3), count);
    caster.positions = this->positions;
    caster.positionCount = count;
  }
}

Caster RayTracer::Impl::makeCaster(const Surface& surface, const Occluders& occluders) const
{
  Caster caster;
  caster.geometry = Geometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  caster.oneSided = surface.oneSided;
  caster.positionsVersion = surface.positionsVersion;
  rtcSetGeometryBuildQuality(caster.geometry.get(), RTC_BUILD_QUALITY_REFIT);
  if (surface.oneSided)
  {
    rtcSetGeometryOccludedFilterFunction(caster.geometry.get(), rejectBackFaces);
  }
  this->setBuffers(caster, surface, occluders);
  rtcCommitGeometry(caster.geometry.get());
  caster.id = rtcAttachGeometry(this->scene.get(), caster.geometry.get());
  return caster;
}

//------------------------------------------------------------------------------
RayTracer::RayTracer()
  : impl_(std::make_unique<Impl>())
{
}
RayTracer::~RayTracer() = default;

//------------------------------------------------------------------------------
RayTracer::Update RayTracer::update(const Occluders& occluders)
{
  Impl& impl = *this->impl_;
  if (impl.topologyVersion == occluders.topologyVersion &&
    impl.positionsVersion == occluders.positionsVersion)
  {
    return {};
  }
  const std::vector<glm::vec3>& positions = occluders.positionsCentred;
  if (positions.capacity() > positions.size())
  {
    impl.padded.clear();
    impl.positions = positions.data();
  }
  else
  {
    impl.padded.reserve(positions.size() + 1);
    impl.padded.assign(positions.begin(), positions.end());
    impl.positions = impl.padded.data();
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
    if (found == impl.casters.end() || found->second.oneSided != surface.oneSided)
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
      rtcUpdateGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
      rtcCommitGeometry(caster.geometry.get());
      ++update.refits;
    }
  }
  for (const auto& gone : impl.casters)
  {
    rtcDetachGeometry(impl.scene.get(), gone.second.id);
  }
  impl.casters = std::move(casters);
  rtcCommitScene(impl.scene.get());
  impl.check("building the acceleration structure");
  impl.topologyVersion = occluders.topologyVersion;
  impl.positionsVersion = occluders.positionsVersion;
  return update;
}

//------------------------------------------------------------------------------
std::size_t RayTracer::trace(const ShadowLight& light, const Occluders& occluders,
  const ReceiverPixels& receivers, std::vector<float>& visibility) const
{
  const ShadowRayLight rayLight(light, occluders.centreWorld);
  const bool spot = light.kind == LightKind::Spot;
  const float rayFar = spot ? shadowRayFarSpot : shadowRayFarDirectional;
  const bool anyCaster = !this->impl_->casters.empty();
  visibility.resize(receivers.size());

  std::atomic<std::size_t> traced{ 0 };
  const auto tilesOf = [](int pixels) { return (pixels + tileSide - 1) / tileSide; };
  const int tilesX = tilesOf(receivers.width);
  tbb::parallel_for(tbb::blocked_range<int>(0, tilesX * tilesOf(receivers.height)),
    [&](const tbb::blocked_range<int>& tiles)
    {
      TileRays rays;
      std::size_t tracedHere = 0;
      for (int tile = tiles.begin(); tile != tiles.end(); ++tile)
      {
        const int x0 = tile % tilesX * tileSide;
        const int y0 = tile / tilesX * tileSide;
        const int x1 = std::min(x0 + tileSide, receivers.width);
        const int y1 = std::min(y0 + tileSide, receivers.height);
        rays.count = 0;
        for (int y = y0; y < y1; ++y)
        {
          for (int x = x0; x < x1; ++x)
          {
            const std::size_t i =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(receivers.width) +
              static_cast<std::size_t>(x);
            const std::uint32_t surface = receivers.surface[i];
            if (surface == ReceiverPixels::notCovered || !occluders.surfaces[surface].receives)
            {
              visibility[i] = 1.0f;
              continue;
            }
            const glm::vec3 position(
              receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i]);
            const glm::vec3 normal(
              receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);
            const ShadowRay ray = spot
              ? shadowRaySpot(rayLight, position, normal, receivers.offset[i])
              : shadowRayDirectional(rayLight, position, normal, receivers.offset[i]);
            visibility[i] = ray.traced ? 1.0f : 0.0f;
            rays.append(ray, i);
          }
        }
        if (anyCaster)
        {
          traceTile(this->impl_->scene.get(), rays, rayFar, visibility.data());
          tracedHere += static_cast<std::size_t>(rays.count);
        }
      }
      traced += tracedHere;
    });
  return traced;
}

//------------------------------------------------------------------------------
std::size_t RayTracer::bytes() const
{
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(this->impl_->bytes, 0)) +
    this->impl_->padded.capacity() * sizeof(glm::vec3);
}

} // namespace gnomon
