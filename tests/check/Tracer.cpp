#include "Tracer.h"

#include "shadowtech/tracing/Embree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace gnomon::check
{

namespace
{

/// Frees an Embree object.
struct Release
{
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>;

/// A surface as Embree's callbacks see it.
struct Geometry
{
  const Surface* surface = nullptr;
  std::size_t index = 0;
  Vec3 centre{ 0.0 };   ///< Embree's floats are relative to it
  double padding = 0.0; ///< of the boxes; above the float errors of ray and box together
};

/// A ray with its result so far, which Embree passes to the callbacks.
struct Query
{
  EmbreeContext context; ///< first: its address is that of the query
  const Ray* ray;
  double distance; ///< to the nearest hit so far
  std::size_t surface;
  std::size_t triangle;
};

Vec3 pointAt(const Ray& ray, double distance)
{
  return ray.origin + distance * ray.direction;
}

void computeBounds(const RTCBoundsFunctionArguments* arguments)
{
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  const Triangle& triangle = geometry.surface->triangles[arguments->primID];
  RTCBounds& bounds = *arguments->bounds_o;
  float* const lower = &bounds.lower_x;
  float* const upper = &bounds.upper_x;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] =
      std::minmax({ triangle[0][axis], triangle[1][axis], triangle[2][axis] });
    lower[axis] = static_cast<float>(low - geometry.centre[axis] - geometry.padding);
    upper[axis] = static_cast<float>(high - geometry.centre[axis] + geometry.padding);
  }
}

void intersectNearest(const RTCIntersectFunctionNArguments* arguments)
{
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  const auto distance = intersect(*query.ray, geometry.surface->triangles[arguments->primID]);
  if (distance && *distance < query.distance &&
    isDrawn(*geometry.surface, arguments->primID, pointAt(*query.ray, *distance)))
  {
    query.distance = *distance;
    query.surface = geometry.index;
    query.triangle = arguments->primID;
    auto& ray = *reinterpret_cast<RTCRayHit*>(arguments->rayhit); // N is 1
    ray.ray.tfar = static_cast<float>(*distance + geometry.padding);
    ray.hit.geomID = arguments->geomID;
    ray.hit.primID = arguments->primID;
  }
}

void intersectAny(const RTCOccludedFunctionNArguments* arguments)
{
  const auto& geometry = *static_cast<const Geometry*>(arguments->geometryUserPtr);
  const auto& query = *reinterpret_cast<const Query*>(arguments->context);
  const Triangle& triangle = geometry.surface->triangles[arguments->primID];
  if (geometry.surface->oneSided)
  {
    const Vec3 front = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    if (front.dot(query.ray->direction) <= 0.0)
    {
      return;
    }
  }
  const auto distance = intersect(*query.ray, triangle);
  if (distance && isDrawn(*geometry.surface, arguments->primID, pointAt(*query.ray, *distance)))
  {
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

Vec3 nearestPointOfEdge(const Vec3& point, const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double along = std::clamp((point - a).dot(edge) / edge.dot(edge), 0.0, 1.0);
  return a + along * edge;
}

/// A search for the triangle nearest to a point, which Embree passes to the callback.
struct NearbySearch
{
  const std::vector<Geometry>& geometries;
  const Vec3& point;
  double distance; ///< to the nearest accepted so far
  const std::function<bool(const Triangle&)>& accepts;
  std::optional<Hit> found;
};

bool testNearby(RTCPointQueryFunctionArguments* arguments)
{
  auto& search = *static_cast<NearbySearch*>(arguments->userPtr);
  const Geometry& geometry = search.geometries[arguments->geomID];
  const Triangle& triangle = geometry.surface->triangles[arguments->primID];
  const Vec3 nearest = nearestPoint(search.point, triangle);
  const double distance = (search.point - nearest).length();
  if (distance <= search.distance && search.accepts(triangle))
  {
    search.distance = distance;
    search.found = Hit{ nearest, distance, geometry.index, arguments->primID };
  }
  return false; // the radius stays as it is
}

} // namespace

//------------------------------------------------------------------------------
std::optional<double> intersect(const Ray& ray, const Triangle& triangle)
{
  const Vec3 a = triangle[0] - ray.origin;
  const Vec3 b = triangle[1] - ray.origin;
  const Vec3 c = triangle[2] - ray.origin;
  const double u = ray.direction.dot(b.cross(c));
  const double v = ray.direction.dot(c.cross(a));
  const double w = ray.direction.dot(a.cross(b));
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  if (!inside)
  {
    return std::nullopt;
  }
  const Vec3 normal = (b - a).cross(c - a);
  const double along = ray.direction.dot(normal);
  if (along == 0.0) // the ray lies in the triangle's plane
  {
    return std::nullopt;
  }
  const double distance = a.dot(normal) / along;
  return distance > 0.0 && distance < ray.length ? std::optional(distance) : std::nullopt;
}

//------------------------------------------------------------------------------
Vec3 nearestPoint(const Vec3& point, const Triangle& triangle)
{
  const auto& [a, b, c] = triangle;
  const Vec3 normal = (b - a).cross(c - a);
  const auto insideOf = [&](const Vec3& from, const Vec3& to)
  { return (to - from).cross(point - from).dot(normal) >= 0.0; };
  if (insideOf(a, b) && insideOf(b, c) && insideOf(c, a))
  {
    return point - (point - a).dot(normal) / normal.dot(normal) * normal;
  }
  Vec3 nearest = nearestPointOfEdge(point, a, b);
  for (const Vec3& other : { nearestPointOfEdge(point, b, c), nearestPointOfEdge(point, c, a) })
  {
    if ((other - point).length() < (nearest - point).length())
    {
      nearest = other;
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
struct Tracer::Impl
{
  DeviceHandle device;
  std::vector<Geometry> geometries; ///< complete before Embree is told their addresses
  SceneHandle all;
  SceneHandle casting;
  Vec3 centre{ 0.0 };

  explicit Impl(const Scene& scene)
    : device(rtcNewDevice(nullptr))
    , all(rtcNewScene(this->device.get()))
    , casting(rtcNewScene(this->device.get()))
  {
    this->describe(scene);
    for (SceneHandle* handle : { &this->all, &this->casting })
    {
      rtcSetSceneFlags(handle->get(), RTC_SCENE_FLAG_ROBUST);
    }
    for (Geometry& geometry : this->geometries)
    {
      this->attach(geometry);
    }
    for (SceneHandle* handle : { &this->all, &this->casting })
    {
      rtcCommitScene(handle->get());
    }
    if (rtcGetDeviceError(this->device.get()) != RTC_ERROR_NONE)
    {
      throw std::runtime_error("Embree cannot build the scene");
    }
  }

  /// Fill the geometries.
  void describe(const Scene& scene)
  {
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    const auto extend = [&](const Vec3& point)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
    };
    extend(scene.camera.position);
    for (const Surface& surface : scene.surfaces)
    {
      for (const Triangle& triangle : surface.triangles)
      {
        std::for_each(triangle.begin(), triangle.end(), extend);
      }
    }
    this->centre = 0.5 * (low + high);
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    {
      // A ray within the scene's box errs by at most 2^-22 of the box's size.
      this->geometries.push_back(
        { &scene.surfaces[i], i, this->centre, 1e-6 * (high - low).length() });
    }
  }

  void attach(Geometry& geometry)
  {
    RTCGeometry handle = rtcNewGeometry(this->device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(
      handle, static_cast<unsigned>(geometry.surface->triangles.size()));
    rtcSetGeometryUserData(handle, &geometry);
    rtcSetGeometryBoundsFunction(
      handle, [](const RTCBoundsFunctionArguments* arguments) { computeBounds(arguments); },
      nullptr);
    rtcSetGeometryIntersectFunction(handle, intersectNearest);
    rtcSetGeometryOccludedFunction(handle, intersectAny);
    rtcCommitGeometry(handle);
    rtcAttachGeometryByID(this->all.get(), handle, static_cast<unsigned>(geometry.index));
    if (geometry.surface->casts)
    {
      rtcAttachGeometry(this->casting.get(), handle);
    }
    rtcReleaseGeometry(handle);
  }

  RTCRay toEmbree(const Ray& ray) const
  {
    const Vec3 origin = ray.origin - this->centre;
    RTCRay result{};
    result.org_x = static_cast<float>(origin.x);
    result.org_y = static_cast<float>(origin.y);
    result.org_z = static_cast<float>(origin.z);
    result.dir_x = static_cast<float>(ray.direction.x);
    result.dir_y = static_cast<float>(ray.direction.y);
    result.dir_z = static_cast<float>(ray.direction.z);
    result.tnear = 0.0f;
    result.tfar = std::numeric_limits<float>::infinity(); // the callbacks keep to the length
    result.mask = ~0u;
    return result;
  }
};

//------------------------------------------------------------------------------
Tracer::Tracer(const Scene& scene)
  : impl_(std::make_unique<Impl>(scene))
{
}

Tracer::~Tracer() = default;

//------------------------------------------------------------------------------
std::optional<Hit> Tracer::nearest(const Ray& ray) const
{
  Query query{ EmbreeContext(), &ray, std::numeric_limits<double>::infinity(), 0, 0 };
  RTCRayHit embreeRay{ this->impl_->toEmbree(ray), {} };
  embreeRay.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  gnomon::intersect(this->impl_->all.get(), query.context, embreeRay);
  if (!std::isfinite(query.distance))
  {
    return std::nullopt;
  }
  return Hit{ ray.origin + query.distance * ray.direction, query.distance, query.surface,
    query.triangle };
}

//------------------------------------------------------------------------------
bool Tracer::blocked(const Ray& ray) const
{
  Query query{ EmbreeContext(), &ray, 0.0, 0, 0 };
  RTCRay embreeRay = this->impl_->toEmbree(ray);
  occlude(this->impl_->casting.get(), query.context, embreeRay);
  return embreeRay.tfar < 0.0f;
}

//------------------------------------------------------------------------------
std::optional<Hit> Tracer::nearestTo(
  const Vec3& point, double distance, const std::function<bool(const Triangle&)>& accepts) const
{
  const Vec3 centred = point - this->impl_->centre;
  RTCPointQuery query{};
  query.x = static_cast<float>(centred.x);
  query.y = static_cast<float>(centred.y);
  query.z = static_cast<float>(centred.z);
  query.radius = static_cast<float>(distance); // the boxes are padded
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  NearbySearch search{ this->impl_->geometries, point, distance, accepts, std::nullopt };
  rtcPointQuery(this->impl_->all.get(), &query, &context, testNearby, &search);
  return search.found;
}

} // namespace gnomon::check
