#include "shadowtech/base/RayTracer.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/EmbreeHandle.h"
#include "shadowtech/base/ShadowRay.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>

namespace gnomon
{
namespace
{

using Device = EmbreeDevice;
using Scene = EmbreeScene;
using Geometry = EmbreeGeometry;

/// Rejects hits on the back of a one-sided surface: those whose front does not face the light.
/// Embree's geometric normal is that of counter-clockwise winding. Of an instance, ray and normal are
/// in source coordinates, where a mirrored one shows its other side.
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

/// Where a hit on a surface with a cut-out finds its texture coordinates.
struct CutoutSurface
{
  std::shared_ptr<const CutoutMask> mask;
  const glm::vec2* textureCoordinates = nullptr; ///< of its vertices
  const glm::uvec3* triangles = nullptr;         ///< its own, indices into all positions
  std::uint32_t firstVertex = 0;
};

/// Rejects hits in the holes of a surface, so that the ray goes on behind it. Of an instance, the triangle
/// is the source's, whose place on the texture all instances share.
void rejectHoles(const RTCFilterFunctionNArguments* arguments)
{
  const auto& surface = *static_cast<const CutoutSurface*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (!arguments->valid[i])
    {
      continue; // no hit; its numbers mean nothing
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

template <bool mirrored>
void rejectBackFacesAndHoles(const RTCFilterFunctionNArguments* arguments)
{
  rejectBackFaces<mirrored>(arguments);
  rejectHoles(arguments);
}

/// What has to agree to a hit on a surface; null where every hit counts.
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

/// One casting surface in the scene.
struct Caster
{
  Geometry geometry;
  /// Of a surface with instances, the scene that holds its triangles once.
  Scene source;
  /// What is attached to the tracer's scene, by Embree's numbers: the triangles, or those instances of
  /// the source's scene that are not left out.
  std::vector<unsigned int> attached;
  RTCFilterFunctionN filter = nullptr;
  std::unique_ptr<CutoutSurface> cutout; ///< stays where it is, since Embree is told
  std::uint64_t positionsVersion = 0;
  /// Where Embree was told to look.
  const glm::vec3* positions = nullptr;
  std::size_t positionCount = 0;
  const glm::uvec3* triangles = nullptr;
};

constexpr std::size_t tileColumns = 64;
constexpr std::size_t tileRows = 4;
constexpr std::size_t tilePixels = tileColumns * tileRows;

/// One number for each pixel of a tile, row by row, or for each of its rays.
template <typename Number>
using TileArray = std::array<Number, tilePixels>;

/// The rays of all pixels of a tile, wanted or not.
struct alignas(64) TilePixels
{
  TileArray<float> originX, originY, originZ;
  TileArray<float> directionX, directionY, directionZ;
  TileArray<int> traced; ///< Embree's mask: -1 where the ray is needed, else 0
};

void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay16* rays)
{
  rtcOccluded16(valid, scene, context, rays);
}
void occluded(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* rays)
{
  rtcOccluded8(valid, scene, context, rays);
}

/// Traces a tile's rays in squares of 4 x 4 pixels, whose rays stay closer together than those of a
/// row. Squares where none is needed are left out.
template <typename Packet>
class TileTracer
{
public:
  TileTracer(float rayFar, RTCIntersectContextFlags coherence)
    : rayFar_(rayFar)
  {
    rtcInitIntersectContext(&this->context_);
    this->context_.flags = coherence;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      this->packet_.tnear[lane] = shadowRayNear;
      this->packet_.time[lane] = 0.0f;
      this->packet_.mask[lane] = 0xffffffffu;
      this->packet_.id[lane] = 0;
      this->packet_.flags[lane] = 0;
    }
  }

  /// Clears the visibility of pixels whose ray is blocked.
  void trace(RTCScene scene, const TilePixels& pixels, TileArray<float>& visibility)
  {
    for (std::size_t y = 0; y < tileRows; y += rowsOfPacket)
    {
      for (std::size_t x = 0; x < tileColumns; x += side)
      {
        this->tracePacket(scene, pixels, y * tileColumns + x, visibility);
      }
    }
  }

private:
  static constexpr std::size_t lanes = std::extent_v<decltype(Packet::tfar)>;
  static constexpr std::size_t side = 4;
  static constexpr std::size_t rowsOfPacket = lanes / side;

  void tracePacket(
    RTCScene scene, const TilePixels& pixels, std::size_t corner, TileArray<float>& visibility)
  {
    const auto load = [corner](auto* to, const auto& from)
    {
      for (std::size_t row = 0; row < rowsOfPacket; ++row)
      {
        std::copy_n(&from[corner + row * tileColumns], side, to + row * side);
      }
    };
    alignas(64) std::array<int, lanes> valid;
    load(valid.data(), pixels.traced);
    if (std::none_of(valid.begin(), valid.end(), [](int traced) { return traced != 0; }))
    {
      return;
    }
    load(this->packet_.org_x, pixels.originX);
    load(this->packet_.org_y, pixels.originY);
    load(this->packet_.org_z, pixels.originZ);
    load(this->packet_.dir_x, pixels.directionX);
    load(this->packet_.dir_y, pixels.directionY);
    load(this->packet_.dir_z, pixels.directionZ);
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      // Where a processor lacks the lanes Embree goes by the interval instead of the mask.
      this->packet_.tfar[lane] =
        valid[lane] ? this->rayFar_ : -std::numeric_limits<float>::infinity();
    }
    occluded(valid.data(), scene, &this->context_, &this->packet_);
    for (std::size_t row = 0; row < rowsOfPacket; ++row)
    {
      float* lit = &visibility[corner + row * tileColumns];
      for (std::size_t column = 0; column < side; ++column)
      {
        const std::size_t lane = row * side + column;
        // Embree sets the far end of a ray that hits to minus infinity.
        const bool blocked = this->packet_.tfar[lane] < 0.0f;
        lit[column] = valid[lane] && blocked ? 0.0f : lit[column];
      }
    }
  }

  Packet packet_;
  RTCIntersectContext context_;
  float rayFar_;
};

/// The receivers of one row of a tile.
struct ReceiverRow
{
  const float *positionX, *positionY, *positionZ;
  const float *normalX, *normalY, *normalZ;
  const float* offset;
  const std::uint32_t* surface;

  ReceiverRow(const ReceiverPixels& receivers, std::size_t first)
    : positionX(&receivers.positionX[first])
    , positionY(&receivers.positionY[first])
    , positionZ(&receivers.positionZ[first])
    , normalX(&receivers.normalX[first])
    , normalY(&receivers.normalY[first])
    , normalZ(&receivers.normalZ[first])
    , offset(&receivers.offset[first])
    , surface(&receivers.surface[first])
  {
  }
};

/// The rays of one row of a tile from its receivers, and what is known of their visibility without:
/// 1 for pixels that receive no shadow, 0 for those that the light does not reach in any case.
/// @param columns a number, or a constant so that the loops become vector code
/// @param receives by surface + 1, so that `notCovered` + 1 = 0 is the first: 1 or 0
template <typename Columns, typename MakeRay>
void makeRays(const ReceiverRow& row, Columns columns, const std::uint8_t* receives,
  const MakeRay& makeRay, std::size_t first, TilePixels& pixels, TileArray<float>& visibility)
{
  const std::size_t count = columns;
#pragma GCC ivdep
  for (std::size_t x = 0; x < count; ++x)
  {
    const ShadowRay ray = makeRay(glm::vec3(row.positionX[x], row.positionY[x], row.positionZ[x]),
      glm::vec3(row.normalX[x], row.normalY[x], row.normalZ[x]), row.offset[x]);
    pixels.originX[first + x] = ray.origin.x;
    pixels.originY[first + x] = ray.origin.y;
    pixels.originZ[first + x] = ray.origin.z;
    pixels.directionX[first + x] = ray.direction.x;
    pixels.directionY[first + x] = ray.direction.y;
    pixels.directionZ[first + x] = ray.direction.z;
    pixels.traced[first + x] = ray.traced ? -1 : 0;
  }
  for (std::size_t x = 0; x < columns; ++x)
  {
    const int receiving = receives[row.surface[x] + 1u];
    visibility[first + x] = receiving > -pixels.traced[first + x] ? 0.0f : 1.0f;
    pixels.traced[first + x] &= -receiving;
  }
}

/// Leaves out the rays of one row of a tile whose answer is known.
void takeCertain(const Certainty* certain, std::size_t columns, std::size_t first,
  TilePixels& pixels, TileArray<float>& visibility)
{
  for (std::size_t x = 0; x < columns; ++x)
  {
    const bool traced = pixels.traced[first + x] != 0;
    visibility[first + x] =
      traced && certain[x] == Certainty::Shadow ? 0.0f : visibility[first + x];
    pixels.traced[first + x] = traced && certain[x] == Certainty::Uncertain ? -1 : 0;
  }
}

/// The whole image, tile by tile.
/// @param scene null where nothing casts
/// @param coherence of the rays of a packet
/// @return the number of rays traced
template <typename Packet, typename MakeRay>
std::size_t traceImage(RTCScene scene, RTCIntersectContextFlags coherence,
  const ReceiverPixels& receivers, const std::vector<std::uint8_t>& receives,
  const MakeRay& makeRay, float rayFar, std::vector<float>& visibility,
  const std::vector<Certainty>& certain)
{
  const auto width = static_cast<std::size_t>(receivers.width);
  const auto height = static_cast<std::size_t>(receivers.height);
  const std::size_t tilesX = (width + tileColumns - 1) / tileColumns;
  const std::size_t tilesY = (height + tileRows - 1) / tileRows;
  std::atomic<int> traced{ 0 };
  const auto traceTiles = [&](const tbb::blocked_range<std::size_t>& tiles)
  {
    TilePixels pixels;
    TileTracer<Packet> tracer(rayFar, coherence);
    TileArray<float> tileVisibility;
    for (std::size_t tile = tiles.begin(); tile != tiles.end(); ++tile)
    {
      const std::size_t x0 = tile % tilesX * tileColumns;
      const std::size_t y0 = tile / tilesX * tileRows;
      const std::size_t columns = std::min(tileColumns, width - x0);
      const std::size_t rows = std::min(tileRows, height - y0);
      if (columns < tileColumns || rows < tileRows)
      {
        pixels.traced.fill(0);
      }
      for (std::size_t y = 0; y < rows; ++y)
      {
        const ReceiverRow row(receivers, (y0 + y) * width + x0);
        const auto make = [&](auto count) {
          makeRays(row, count, receives.data(), makeRay, y * tileColumns, pixels, tileVisibility);
        };
        columns == tileColumns ? make(std::integral_constant<std::size_t, tileColumns>())
                               : make(columns);
      }
      for (std::size_t y = 0; y < rows && !certain.empty(); ++y)
      {
        takeCertain(
          &certain[(y0 + y) * width + x0], columns, y * tileColumns, pixels, tileVisibility);
      }
      if (scene)
      {
        tracer.trace(scene, pixels, tileVisibility);
        traced -= std::accumulate(pixels.traced.begin(), pixels.traced.end(), 0);
      }
      for (std::size_t y = 0; y < rows; ++y)
      {
        std::copy_n(&tileVisibility[y * tileColumns], columns, &visibility[(y0 + y) * width + x0]);
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tilesX * tilesY, 16), traceTiles);
  return static_cast<std::size_t>(traced);
}

} // namespace

//------------------------------------------------------------------------------
struct RayTracer::Impl
{
  Impl();

  void setBuffers(Caster& caster, const Surface& surface, const Occluders& occluders) const;
  Caster makeCaster(const Surface& surface, const Occluders& occluders) const;
  void attachInstances(Caster& caster, const Surface& surface) const;
  void move(Caster& caster, const Surface& surface) const;
  void check(const char* what) const;

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // outlives the device, which counts into it
  Device device;
  Scene scene;
  bool lanes16 = false; ///< packets of 16; else of 8, whose answers are the same
  std::unordered_map<std::uint64_t, Caster> casters; ///< by the surface's topologyVersion
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
  this->lanes16 =
    rtcGetDeviceProperty(this->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
  this->scene = Scene(rtcNewScene(this->device.get()));
  // Two levels, one structure per surface below: that is what these two settings mean together. A
  // moved surface then costs its own refit, and tracing 2 % more than in one level (with 400
  // surfaces 7 %). The structures below are as good as ever: surfaces ask for refits, not for speed.
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

Caster RayTracer::Impl::makeCaster(const Surface& surface, const Occluders& occluders) const
{
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

void RayTracer::Impl::attachInstances(Caster& caster, const Surface& surface) const
{
  rtcCommitGeometry(caster.geometry.get());
  caster.attached.reserve(surface.centredFromSource.size());
  caster.source = Scene(rtcNewScene(this->device.get()));
  rtcSetSceneFlags(caster.source.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(caster.source.get(), caster.geometry.get());
  rtcCommitScene(caster.source.get());
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    if (!Surface::isLeftOut(instance))
    {
      const Geometry geometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
      rtcSetGeometryInstancedScene(geometry.get(), caster.source.get());
      caster.attached.push_back(rtcAttachGeometry(this->scene.get(), geometry.get()));
    }
  }
  this->move(caster, surface);
}

/// Refits a surface's structure to its moved vertices, or takes over its instances' matrices: as many
/// as are attached, in their order.
void RayTracer::Impl::move(Caster& caster, const Surface& surface) const
{
  if (!surface.isInstanced())
  {
    rtcUpdateGeometryBuffer(caster.geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(caster.geometry.get());
    return;
  }
  auto attached = caster.attached.begin();
  for (const glm::mat4x3& instance : surface.centredFromSource)
  {
    if (!Surface::isLeftOut(instance))
    {
      const RTCGeometry geometry = rtcGetGeometry(this->scene.get(), *attached++);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &instance[0][0]);
      rtcCommitGeometry(geometry);
    }
  }
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
      rtcDetachGeometry(impl.scene.get(), attached);
    }
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
  const ReceiverPixels& receivers, std::vector<float>& visibility,
  const std::vector<Certainty>& certain) const
{
  visibility.resize(receivers.size());
  std::vector<std::uint8_t> receives{ 0 };
  for (const Surface& surface : occluders.surfaces)
  {
    receives.push_back(surface.receives ? 1 : 0);
  }
  const ShadowRayLight rayLight(light, occluders.centreWorld);
  // In scenes with instances, Embree 3.13.5 hangs on coherent packets of 16 that hit some: it keeps
  // numbers in AVX-512 registers that the traversal of an instance overwrites. Without coherence the
  // answers are the same, and of a million triangles and more the time is, too.
  const bool instanced = std::any_of(occluders.surfaces.begin(), occluders.surfaces.end(),
    [](const Surface& surface) { return surface.casts && surface.isInstanced(); });
  const RTCIntersectContextFlags coherence =
    instanced ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCScene scene = this->impl_->casters.empty() ? nullptr : this->impl_->scene.get();
  return visitShadowRays(rayLight,
    [&](const auto& makeRay, float rayFar)
    {
      return this->impl_->lanes16 ? traceImage<RTCRay16>(scene, coherence, receivers, receives,
                                      makeRay, rayFar, visibility, certain)
                                  : traceImage<RTCRay8>(scene, coherence, receivers, receives,
                                      makeRay, rayFar, visibility, certain);
    });
}

//------------------------------------------------------------------------------
std::size_t RayTracer::bytes() const
{
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(this->impl_->bytes, 0));
}

//------------------------------------------------------------------------------
std::size_t RayTracer::bytesOfTable() const
{
  std::size_t bytes = gnomon::bytesOfTable(this->impl_->casters);
  for (const auto& entry : this->impl_->casters)
  {
    bytes += bytesOf(entry.second.attached) + (entry.second.cutout ? sizeof(CutoutSurface) : 0);
  }
  return bytes;
}

} // namespace gnomon
