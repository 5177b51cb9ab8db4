#include "shadowtech/transmittance/Sheets.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/WeldedVertices.h"
#include "shadowtech/tracing/EmbreeInstances.h"
#include "shadowtech/transmittance/TriangleCrossing.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon
{
namespace
{

/// A surface as Embree's callbacks see it.
struct CrossedSurface
{
  const Surface* surface = nullptr;
  const Occluders* occluders = nullptr;
  float margin = 0.0f;              ///< of its triangles' boxes
  std::vector<std::uint8_t> isCopy; ///< by triangle: 1 if an earlier one lies in the same place

  glm::uvec3 triangle(std::uint32_t number) const
  {
    return this->occluders->triangles[this->surface->firstTriangle + number];
  }
};

/// Return the margin of a surface's boxes, in the coordinates of its vertices.
///
/// Embree tests boxes of user geometries without its robust mode: along each axis it computes
/// (bound - origin) / direction as a difference of two products. Its error is that of a bound moved
/// by at most 2^-21 of the largest coordinate of rays and boxes. Rays start in the snapshot's box.
float marginOf(const Surface& surface, const Occluders& occluders)
{
  double largest = 0.0;
  const auto add = [&](const glm::dvec3& point) {
    largest = std::max({ largest, std::abs(point.x), std::abs(point.y), std::abs(point.z) });
  };
  for (const glm::dvec3& corner : occluders.allCentred.corners())
  {
    if (!surface.isInstanced())
    {
      add(corner);
    }
    for (const glm::mat4x3& instance : surface.centredFromSource)
    {
      if (!Surface::isLeftOut(instance))
      {
        const glm::dmat4x3 matrix(instance);
        add(glm::inverse(glm::dmat3(matrix)) * (corner - matrix[3])); // regular
      }
    }
  }
  // A power of two, so that it rarely changes.
  return static_cast<float>(std::exp2(std::ceil(std::log2(largest)) - 20.0));
}

/// A ray with the light that it has left, which Embree passes to the callbacks.
struct CrossingQuery
{
  EmbreeContext context; ///< first: its address is that of the query
  glm::dvec3 transmittance{ 1.0 };
  std::vector<SheetCrossing>* crossings = nullptr; ///< null: only their product is asked for
};

void boundSheet(const RTCBoundsFunctionArguments* arguments)
{
  const auto& sheet = *static_cast<const CrossedSurface*>(arguments->geometryUserPtr);
  const std::vector<glm::vec3>& positions = sheet.occluders->positionsCentred;
  const glm::uvec3 triangle = sheet.triangle(arguments->primID);
  const glm::vec3 a = positions[triangle.x];
  const glm::vec3 b = positions[triangle.y];
  const glm::vec3 c = positions[triangle.z];
  const glm::vec3 lower = glm::min(a, glm::min(b, c)) - sheet.margin;
  const glm::vec3 upper = glm::max(a, glm::max(b, c)) + sheet.margin;
  *arguments->bounds_o = { lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f };
}

/// Return a surface's colour and opacity at a crossing, as VTK interpolates them.
glm::dvec4 colourAt(const CrossedSurface& crossed, std::uint32_t triangle,
  const glm::uvec3& vertices, const glm::dvec3& weights)
{
  const Sheet& sheet = *crossed.surface->sheet;
  const glm::dvec4 own(sheet.colour);
  glm::dvec4 mapped(0.0);
  if (!sheet.ofTriangles.empty())
  {
    mapped = glm::dvec4(sheet.ofTriangles[triangle]);
  }
  else if (!sheet.ofVertices.empty())
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      mapped += weights[corner] * glm::dvec4(sheet.ofVertices[vertices[corner]]);
    }
  }
  else
  {
    return own;
  }
  mapped /= 255.0;
  return { glm::dvec3(mapped), own.a * mapped.a };
}

/// Return the alpha of a surface's texture at a crossing; 1 without one.
double textureAlphaAt(
  const CrossedSurface& crossed, const glm::uvec3& vertices, const glm::dvec3& weights)
{
  const Surface& surface = *crossed.surface;
  if (!surface.cutout)
  {
    return 1.0;
  }
  glm::dvec2 place(0.0);
  for (int corner = 0; corner < 3; ++corner)
  {
    place += weights[corner] * glm::dvec2(surface.textureCoordinates[vertices[corner]]);
  }
  return surface.cutout->alphaAt(glm::vec2(place));
}

/// Multiply a single ray's transmittance where it crosses a triangle. The ray goes on unless it is
/// dark, or its crossings are asked for.
void crossSheet(const RTCOccludedFunctionNArguments* arguments)
{
  const auto& crossed = *static_cast<const CrossedSurface*>(arguments->geometryUserPtr);
  const std::uint32_t number = arguments->primID;
  if (!arguments->valid[0] || crossed.isCopy[number] != 0)
  {
    return;
  }
  RTCRayN* const ray = arguments->ray;
  const glm::dvec3 origin(
    RTCRayN_org_x(ray, 1, 0), RTCRayN_org_y(ray, 1, 0), RTCRayN_org_z(ray, 1, 0));
  const glm::dvec3 direction(
    RTCRayN_dir_x(ray, 1, 0), RTCRayN_dir_y(ray, 1, 0), RTCRayN_dir_z(ray, 1, 0));
  const Surface& surface = *crossed.surface;
  const glm::uvec3 triangle = crossed.triangle(number);
  std::array<glm::dvec3, 3> corners;
  for (int corner = 0; corner < 3; ++corner)
  {
    corners[static_cast<std::size_t>(corner)] =
      glm::dvec3(crossed.occluders->positionsCentred[triangle[corner]]) - origin;
  }
  const std::optional<TriangleCrossing> crossing = crossingOf(corners, direction);
  if (!crossing || !(crossing->at > RTCRayN_tnear(ray, 1, 0)) ||
    !(crossing->at < RTCRayN_tfar(ray, 1, 0)) ||
    (surface.oneSided && crossing->leavesFront == surface.mirrored))
  {
    return;
  }
  const glm::uvec3 vertices = triangle - surface.firstVertex;
  glm::dvec4 colour = colourAt(crossed, number, vertices, crossing->weights);
  colour.a *= textureAlphaAt(crossed, vertices, crossing->weights);
  auto& query = *reinterpret_cast<CrossingQuery*>(arguments->context);
  const glm::dvec3 left = surface.sheet->isColoured ? 1.0 - colour.a * (1.0 - glm::dvec3(colour))
                                                    : glm::dvec3(1.0 - colour.a);
  if (query.crossings)
  {
    query.crossings->push_back({ crossing->at, left });
    return;
  }
  query.transmittance *= left;
  if (query.transmittance == glm::dvec3(0.0))
  {
    RTCRayN_tfar(ray, 1, 0) = -std::numeric_limits<float>::infinity();
  }
}

/// The places of a triangle's corners, in ascending order.
using TrianglePlaces = std::array<Place, 3>;

TrianglePlaces placesOf(const Occluders& occluders, const glm::uvec3& triangle)
{
  TrianglePlaces places;
  for (int corner = 0; corner < 3; ++corner)
  {
    places[static_cast<std::size_t>(corner)] =
      placeOf(occluders.positionsCentred[triangle[corner]]);
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Mark each triangle that lies where an earlier one of the same group does.
void markCopies(const Occluders& occluders, const std::vector<CrossedSurface*>& group)
{
  std::size_t count = 0;
  for (const CrossedSurface* crossed : group)
  {
    count += crossed->surface->triangleCount;
  }
  std::vector<TrianglePlaces> places;
  places.reserve(count);
  FirstOfSame firsts(count);
  for (CrossedSurface* const crossed : group)
  {
    crossed->isCopy.resize(crossed->surface->triangleCount);
    for (std::uint32_t i = 0; i < crossed->surface->triangleCount; ++i)
    {
      const TrianglePlaces own = placesOf(occluders, crossed->triangle(i));
      const auto number = static_cast<std::uint32_t>(places.size());
      places.push_back(own);
      const std::uint64_t hash = hashOf(own[0]) ^ 3u * hashOf(own[1]) ^ 5u * hashOf(own[2]);
      const std::uint32_t first =
        firsts.of(number, hash, [&](std::uint32_t other) { return places[other] == own; });
      crossed->isCopy[i] = first != number ? 1 : 0;
    }
  }
}

} // namespace

struct Sheets::Impl
{
  struct Structure
  {
    std::unique_ptr<CrossedSurface> crossed; ///< on the heap, because Embree keeps its address
    EmbreeGeometry geometry;
    EmbreeScene source; ///< of instances: holds their triangles once
    std::vector<unsigned int> attached;
    std::uint64_t positionsVersion = 0;
    std::shared_ptr<const Patches> patches; ///< others once vertices move against each other
    ///@{
    /// The surface's, at the last update.
    std::shared_ptr<const Sheet> sheet;
    std::shared_ptr<const CutoutMask> cutout;
    bool oneSided = false;
    ///@}
  };

  Impl();
  Structure make(const Surface& surface, const Occluders& occluders) const;
  void place(const Structure& structure) const;
  void findCopies(const Occluders& occluders);
  void trace(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar, CrossingQuery& query) const;

  std::atomic<std::ptrdiff_t> bytes{ 0 }; // must outlive the device, which counts into it
  EmbreeDevice device;
  EmbreeScene scene;
  std::unordered_map<std::uint64_t, Structure> structures; ///< by the surface's topologyVersion
  Occluders::Versions versions;
};

Sheets::Impl::Impl()
  : device(startEmbree())
  , scene(rtcNewScene(this->device.get()))
{
  countBytes(this->device.get(), this->bytes);
  // Two levels, as in EmbreeCasters: a moved surface costs its own refit.
  rtcSetSceneFlags(
    this->scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
  rtcSetSceneBuildQuality(this->scene.get(), RTC_BUILD_QUALITY_LOW);
}

Sheets::Impl::Structure Sheets::Impl::make(const Surface& surface, const Occluders& occluders) const
{
  Structure structure;
  structure.crossed = std::make_unique<CrossedSurface>();
  *structure.crossed = { &surface, &occluders, marginOf(surface, occluders), {} };
  structure.geometry = EmbreeGeometry(rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_USER));
  const RTCGeometry geometry = structure.geometry.get();
  rtcSetGeometryUserPrimitiveCount(geometry, surface.triangleCount);
  rtcSetGeometryUserData(geometry, structure.crossed.get());
  rtcSetGeometryBoundsFunction(geometry, boundSheet, nullptr);
  rtcSetGeometryOccludedFunction(geometry, crossSheet);
  if (!surface.isInstanced())
  {
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(geometry);
    structure.attached = { rtcAttachGeometry(this->scene.get(), geometry) };
    return structure;
  }
  structure.source = EmbreeScene(rtcNewScene(this->device.get()));
  rtcSetSceneFlags(structure.source.get(), RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(structure.source.get(), geometry);
  structure.attached =
    attachInstances(this->device.get(), this->scene.get(), structure.source.get(), surface);
  this->place(structure);
  return structure;
}

/// Refit a structure to its surface's present place.
void Sheets::Impl::place(const Structure& structure) const
{
  rtcCommitGeometry(structure.geometry.get());
  const Surface& surface = *structure.crossed->surface;
  if (!surface.isInstanced())
  {
    return;
  }
  rtcCommitScene(structure.source.get());
  placeInstances(this->scene.get(), structure.attached, surface);
}

/// Mark the copies of triangles within each prop, and within each source of instances.
void Sheets::Impl::findCopies(const Occluders& occluders)
{
  std::map<std::uint32_t, std::vector<CrossedSurface*>> groups;
  for (const Surface& surface : occluders.surfaces)
  {
    const auto found = this->structures.find(surface.topologyVersion);
    if (found == this->structures.end())
    {
      continue;
    }
    CrossedSurface* const crossed = found->second.crossed.get();
    surface.isInstanced() ? markCopies(occluders, { crossed })
                          : groups[surface.sheet->prop].push_back(crossed);
  }
  for (const auto& [prop, group] : groups)
  {
    markCopies(occluders, group);
  }
}

Sheets::Sheets()
  : impl_(std::make_unique<Impl>())
{
}
Sheets::~Sheets() = default;

bool Sheets::update(const Occluders& occluders)
{
  Impl& impl = *this->impl_;
  if (impl.versions == occluders.versions())
  {
    return false;
  }
  bool areOthers = false; // the places of triangles within a surface
  bool changes = false;
  std::unordered_map<std::uint64_t, Impl::Structure> structures;
  for (const Surface& surface : occluders.surfaces)
  {
    if (!surface.sheet || surface.triangleCount == 0)
    {
      continue;
    }
    checkEmbreeRange(surface.boundsCentred);
    Impl::Structure& structure = structures[surface.topologyVersion];
    const auto found = impl.structures.find(surface.topologyVersion);
    if (found == impl.structures.end())
    {
      structure = impl.make(surface, occluders);
    }
    else
    {
      structure = std::move(found->second);
      impl.structures.erase(found);
      CrossedSurface& crossed = *structure.crossed;
      crossed.surface = &surface;
      crossed.occluders = &occluders;
      const float margin = marginOf(surface, occluders);
      const bool isWider = std::exchange(crossed.margin, margin) != margin;
      if (isWider || structure.positionsVersion != surface.positionsVersion)
      {
        impl.place(structure);
      }
    }
    changes |= structure.positionsVersion != surface.positionsVersion ||
      structure.sheet != surface.sheet || structure.cutout != surface.cutout ||
      structure.oneSided != surface.oneSided;
    structure.positionsVersion = surface.positionsVersion;
    structure.sheet = surface.sheet;
    structure.cutout = surface.cutout;
    structure.oneSided = surface.oneSided;
    areOthers |= std::exchange(structure.patches, surface.patches) != surface.patches;
  }
  for (const auto& gone : impl.structures)
  {
    areOthers = true;
    detachAll(impl.scene.get(), gone.second.attached);
  }
  impl.structures = std::move(structures);
  if (areOthers)
  {
    impl.findCopies(occluders);
  }
  rtcCommitScene(impl.scene.get());
  if (rtcGetDeviceError(impl.device.get()) != RTC_ERROR_NONE)
  {
    throw std::runtime_error("Embree failed while building the structure of translucent casters");
  }
  impl.versions = occluders.versions();
  return changes || areOthers;
}

bool Sheets::isColoured() const
{
  return std::any_of(this->impl_->structures.begin(), this->impl_->structures.end(),
    [](const auto& entry) { return entry.second.crossed->surface->sheet->isColoured; });
}

void Sheets::Impl::trace(
  const glm::vec3& origin, const glm::vec3& direction, float rayFar, CrossingQuery& query) const
{
  RTCRay ray{ origin.x, origin.y, origin.z, shadowRayNear, direction.x, direction.y, direction.z,
    0.0f, rayFar, 0xffffffffu, 0, 0 };
  occlude(this->scene.get(), query.context, ray);
}

glm::dvec3 Sheets::transmittanceOf(
  const glm::vec3& origin, const glm::vec3& direction, float rayFar) const
{
  CrossingQuery query;
  this->impl_->trace(origin, direction, rayFar, query);
  return query.transmittance;
}

void Sheets::findCrossings(const glm::vec3& origin, const glm::vec3& direction, float rayFar,
  std::vector<SheetCrossing>& crossings) const
{
  crossings.clear();
  CrossingQuery query;
  query.crossings = &crossings;
  this->impl_->trace(origin, direction, rayFar, query);
  std::sort(crossings.begin(), crossings.end(),
    [](const SheetCrossing& a, const SheetCrossing& b) { return a.at < b.at; });
}

std::size_t Sheets::bytes() const
{
  const Impl& impl = *this->impl_;
  std::size_t bytes = bytesOfTable(impl.structures) +
    static_cast<std::size_t>(std::max<std::ptrdiff_t>(impl.bytes, 0));
  for (const auto& entry : impl.structures)
  {
    bytes += bytesOf(entry.second.attached) + bytesOf(entry.second.crossed->isCopy);
  }
  return bytes;
}

} // namespace gnomon
