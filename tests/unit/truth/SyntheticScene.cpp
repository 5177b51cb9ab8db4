#include "SyntheticScene.h"

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>

namespace gnomon::test
{

//------------------------------------------------------------------------------
Mesh makePlane(double side, int cells)
{
  Mesh mesh;
  const auto row = static_cast<unsigned int>(cells + 1);
  for (int y = 0; y <= cells; ++y)
  {
    for (int x = 0; x <= cells; ++x)
    {
      mesh.points.emplace_back(side * (1.0 * x / cells - 0.5), side * (1.0 * y / cells - 0.5), 0.0);
    }
  }
  for (unsigned int y = 0; y + 1 < row; ++y)
  {
    for (unsigned int x = 0; x + 1 < row; ++x)
    {
      const unsigned int i = y * row + x;
      mesh.triangles.emplace_back(i, i + 1, i + row + 1);
      mesh.triangles.emplace_back(i, i + row + 1, i + row);
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
Prop makePerforatedPlane(double side, int cells, const glm::dmat4& worldFromMesh)
{
  Prop prop{ makePlane(side, cells), worldFromMesh };
  CutoutMask mask;
  mask.width = 5;
  mask.height = 4;
  mask.interpolated = true;
  mask.texels = { 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0, 0 };
  prop.cutout = std::make_shared<const CutoutMask>(mask);
  for (const glm::dvec3& point : prop.mesh.points)
  {
    prop.textureCoordinates.emplace_back(2.3 * glm::dvec2(point) / side - glm::dvec2(0.1, 0.2));
  }
  return prop;
}

//------------------------------------------------------------------------------
Mesh makeTerrain(double side, int cells, double height)
{
  Mesh mesh = makePlane(side, cells);
  for (glm::dvec3& point : mesh.points)
  {
    const double x = 40.0 * point.x / side;
    const double y = 40.0 * point.y / side;
    point.z = height *
      (0.6 * std::sin(0.31 * x + 0.8) * std::cos(0.27 * y) + 0.3 * std::sin(0.9 * x + 1.3 * y) +
        0.1 * std::sin(3.1 * x) * std::sin(2.7 * y));
  }
  return mesh;
}

//------------------------------------------------------------------------------
Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper)
{
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.emplace_back(
      (i & 1) ? upper.x : lower.x, (i & 2) ? upper.y : lower.y, (i & 4) ? upper.z : lower.z);
  }
  const unsigned int quads[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  for (const auto& quad : quads)
  {
    mesh.triangles.emplace_back(quad[0], quad[1], quad[2]);
    mesh.triangles.emplace_back(quad[0], quad[2], quad[3]);
  }
  return mesh;
}

//------------------------------------------------------------------------------
Mesh makeSphere(int rings, int segments, double bumps)
{
  Mesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
  {
    const double theta = glm::pi<double>() * ring / rings;
    for (int segment = 0; segment < segments; ++segment)
    {
      const double phi = 2.0 * glm::pi<double>() * segment / segments;
      const glm::dvec3 normal(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      const double bump =
        std::sin(9.0 * normal.x) * std::sin(7.0 * normal.y + 1.0) * std::sin(8.0 * normal.z + 2.0);
      mesh.points.push_back((1.0 + bumps * bump) * normal);
    }
  }
  const auto row = static_cast<unsigned int>(segments);
  for (unsigned int ring = 0; ring < static_cast<unsigned int>(rings); ++ring)
  {
    for (unsigned int segment = 0; segment < row; ++segment)
    {
      const unsigned int next = (segment + 1) % row;
      const unsigned int a = ring * row + segment;
      const unsigned int b = ring * row + next;
      const unsigned int c = a + row;
      const unsigned int d = b + row;
      if (ring > 0)
      {
        mesh.triangles.emplace_back(a, c, b);
      }
      if (ring + 1 < static_cast<unsigned int>(rings))
      {
        mesh.triangles.emplace_back(b, c, d);
      }
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
Mesh makeTriangleSoup(int count, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&]
  {
    const double x = uniform(random);
    const double y = uniform(random);
    return glm::dvec3(x, y, uniform(random));
  };
  Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const auto first = static_cast<unsigned int>(mesh.points.size());
    const double size = std::pow(10.0, -1.5 + uniform(random));
    const double thinness = i % 8 == 0 ? 1e-3 : 1.0;
    const glm::dvec3 corner = 0.5 * vector();
    const glm::dvec3 edge = size * vector();
    mesh.points.push_back(corner);
    mesh.points.push_back(corner + edge);
    mesh.points.push_back(corner + 0.5 * edge + thinness * size * vector());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

//------------------------------------------------------------------------------
Mesh apart(const Mesh& mesh)
{
  Mesh result;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    const auto first = static_cast<unsigned int>(result.points.size());
    for (int k = 0; k < 3; ++k)
    {
      result.points.push_back(mesh.points[triangle[k]]);
    }
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

//------------------------------------------------------------------------------
Mesh readObj(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error("cannot read " + path);
  }
  Mesh mesh;
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v")
    {
      glm::dvec3 point;
      words >> point.x >> point.y >> point.z;
      mesh.points.push_back(point);
    }
    else if (kind == "f")
    {
      std::vector<unsigned int> corners;
      for (std::string corner; words >> corner;)
      {
        corners.push_back(static_cast<unsigned int>(std::stoul(corner)) - 1);
      }
      for (std::size_t i = 2; i < corners.size(); ++i)
      {
        mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
      }
    }
  }
  return mesh;
}

namespace
{

Bounds boundsOf(const Occluders& occluders, const Surface& surface)
{
  Bounds bounds;
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    bounds.add(glm::dvec3(occluders.positionsCentred[surface.firstVertex + i]));
  }
  return bounds;
}

} // namespace

//------------------------------------------------------------------------------
Occluders makeOccluders(const std::vector<Prop>& props)
{
  static std::uint64_t version = 0;
  std::vector<glm::dvec3> world;
  Bounds bounds;
  Occluders occluders;
  for (const Prop& prop : props)
  {
    Surface surface;
    surface.firstVertex = static_cast<std::uint32_t>(world.size());
    surface.vertexCount = static_cast<std::uint32_t>(prop.mesh.points.size());
    surface.firstTriangle = static_cast<std::uint32_t>(occluders.triangles.size());
    surface.triangleCount = static_cast<std::uint32_t>(prop.mesh.triangles.size());
    surface.casts = prop.casts;
    surface.receives = prop.receives;
    surface.oneSided = prop.oneSided;
    surface.cutout = prop.cutout;
    surface.textureCoordinates = prop.textureCoordinates;
    surface.topologyVersion = surface.positionsVersion = ++version;
    for (const glm::dvec3& point : prop.mesh.points)
    {
      world.emplace_back(prop.worldFromMesh * glm::dvec4(point, 1.0));
      bounds.add(world.back());
    }
    for (const glm::uvec3& triangle : prop.mesh.triangles)
    {
      occluders.triangles.push_back(triangle + surface.firstVertex);
    }
    occluders.surfaces.push_back(surface);
  }
  if (!bounds.empty())
  {
    occluders.frame.centre = bounds.centre();
  }
  occluders.positionsCentred.reserve(world.size() + 1);
  for (const glm::dvec3& point : world)
  {
    occluders.positionsCentred.emplace_back(point - occluders.frame.centre);
    occluders.allCentred.add(glm::dvec3(occluders.positionsCentred.back()));
  }
  for (Surface& surface : occluders.surfaces)
  {
    surface.boundsCentred = boundsOf(occluders, surface);
    if (surface.casts)
    {
      occluders.castersCentred.add(surface.boundsCentred);
    }
  }
  occluders.topologyVersion = occluders.positionsVersion = ++version;
  return occluders;
}

//------------------------------------------------------------------------------
void moveSurface(Occluders& occluders, std::size_t index, const glm::dvec3& by)
{
  Surface& surface = occluders.surfaces[index];
  for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
  {
    glm::vec3& position = occluders.positionsCentred[surface.firstVertex + i];
    position = glm::vec3(glm::dvec3(position) + by);
  }
  surface.boundsCentred = boundsOf(occluders, surface);
  surface.positionsVersion = occluders.positionsVersion += 1000000;
}

namespace
{

/// Finds the nearest triangles along rays, for makeView().
class Caster
{
public:
  explicit Caster(const Occluders& occluders)
    : device_(rtcNewDevice(nullptr), rtcReleaseDevice)
    , scene_(rtcNewScene(this->device_.get()), rtcReleaseScene)
  {
    rtcSetSceneFlags(this->scene_.get(), RTC_SCENE_FLAG_ROBUST);
    for (const Surface& surface : occluders.surfaces)
    {
      RTCGeometry geometry = rtcNewGeometry(this->device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* positions =
        static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
          RTC_FORMAT_FLOAT3, sizeof(glm::vec3), std::max(surface.vertexCount, 1u)));
      auto* triangles =
        static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
          RTC_FORMAT_UINT3, sizeof(glm::uvec3), std::max(surface.triangleCount, 1u)));
      triangles[0] = glm::uvec3(0);
      for (std::uint32_t i = 0; i < surface.vertexCount; ++i)
      {
        positions[i] = occluders.positionsCentred[surface.firstVertex + i];
      }
      for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
      {
        triangles[i] = occluders.triangles[surface.firstTriangle + i] - surface.firstVertex;
      }
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(this->scene_.get(), geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(this->scene_.get());
  }

  RTCHit nearest(const glm::dvec3& origin, const glm::dvec3& direction) const
  {
    RTCRayHit query = {};
    const glm::vec3 from(origin);
    const glm::vec3 along(direction);
    query.ray = { from.x, from.y, from.z, 0.0f, along.x, along.y, along.z, 0.0f,
      std::numeric_limits<float>::infinity(), ~0u, 0, 0 };
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    EmbreeContext context;
    intersect(this->scene_.get(), context, query);
    return query.hit;
  }

private:
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

/// Return a pseudo-random number in [-1, 1] for a pixel.
double jitter(std::uint32_t seed)
{
  seed = (seed ^ 61u) ^ (seed >> 16);
  seed *= 9u;
  seed ^= seed >> 4;
  seed *= 0x27d4eb2du;
  seed ^= seed >> 15;
  return seed / 2147483648.0 - 1.0;
}

} // namespace

//------------------------------------------------------------------------------
View makeView(const Occluders& occluders, const Camera& camera)
{
  View view;
  ReceiverImages& images = view.images;
  images.width = camera.width;
  images.height = camera.height;
  const bool parallel = camera.parallelHeight > 0.0;
  const double halfHeight =
    parallel ? 0.5 * camera.parallelHeight : std::tan(0.5 * glm::radians(camera.fovDegrees));
  const double halfWidth = halfHeight * camera.width / camera.height;
  const glm::dmat4 clipFromView = parallel
    ? glm::ortho(-halfWidth, halfWidth, -halfHeight, halfHeight, 0.1, 1e3)
    : glm::frustum(
        -0.1 * halfWidth, 0.1 * halfWidth, -0.1 * halfHeight, 0.1 * halfHeight, 0.1, 1e3);
  const glm::dmat4 viewFromCentred = glm::lookAt(camera.position, camera.target, camera.up) *
    glm::translate(glm::dmat4(1.0), occluders.frame.centre);
  images.rays = pixelRays(clipFromView, glm::inverse(viewFromCentred), camera.width, camera.height);
  const auto pixels =
    static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  images.fragments.assign(pixels, glm::vec2(0.0f));
  for (std::uint32_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    view.drawnSurfaces.push_back({ { { 0, occluders.surfaces[i].triangleCount, i } } });
  }

  const Caster caster(occluders);
  tbb::parallel_for(0, camera.height,
    [&](int y)
    {
      for (int x = 0; x < camera.width; ++x)
      {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
          static_cast<std::size_t>(x);
        const double column = x + jitter(static_cast<std::uint32_t>(2 * i)) / 512.0;
        const double row = y + jitter(static_cast<std::uint32_t>(2 * i + 1)) / 512.0;
        const RTCHit hit = caster.nearest(
          images.rays.origin(column, row), glm::normalize(images.rays.direction(column, row)));
        if (hit.geomID != RTC_INVALID_GEOMETRY_ID)
        {
          images.fragments[i] = { static_cast<float>(hit.geomID + 1),
            static_cast<float>(hit.primID) };
        }
      }
    });
  return view;
}

//------------------------------------------------------------------------------
ReceiverPixels makeReceivers(const Occluders& occluders, const Camera& camera)
{
  const View view = makeView(occluders, camera);
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  return receivers;
}

//------------------------------------------------------------------------------
ReceiverPixels rowOf(const std::vector<PlacedReceiver>& receivers, std::uint32_t surface)
{
  ReceiverPixels pixels;
  pixels.resize(static_cast<int>(receivers.size()), 1);
  std::fill(pixels.surface.begin(), pixels.surface.end(), surface);
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const auto& [position, normal, offset] = receivers[i];
    pixels.positionX[i] = position.x;
    pixels.positionY[i] = position.y;
    pixels.positionZ[i] = position.z;
    pixels.normalX[i] = normal.x;
    pixels.normalY[i] = normal.y;
    pixels.normalZ[i] = normal.z;
    pixels.offset[i] = offset;
  }
  return pixels;
}

//------------------------------------------------------------------------------
ShadowLight directionalLight(const glm::dvec3& direction)
{
  ShadowLight light;
  light.directionWorld = glm::normalize(direction);
  return light;
}

//------------------------------------------------------------------------------
ShadowLight spotLight(const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees)
{
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.positionWorld = position;
  light.directionWorld = glm::normalize(target - position);
  light.coneAngleDegrees = coneAngleDegrees;
  return light;
}

//------------------------------------------------------------------------------
ShadowLight pointLight(const glm::dvec3& position)
{
  ShadowLight light;
  light.kind = LightKind::Point;
  light.positionWorld = position;
  return light;
}

//------------------------------------------------------------------------------
ShadowLight boxLight(
  const glm::dvec3& direction, const glm::dvec3& position, const glm::dvec3& size)
{
  ShadowLight light = directionalLight(direction);
  light.positionWorld = position;
  light.box = LightBox{ size.x, size.y, size.z, { 0.0, 0.0, 1.0 } };
  return light;
}

namespace
{

struct Segment
{
  glm::dvec3 a;
  glm::dvec3 b;
};

/// Return the distance between two segments (Ericson, Real-Time Collision Detection, 5.1.9). The
/// first one has a length; the second need not.
double distanceBetween(const Segment& first, const Segment& second)
{
  const glm::dvec3 d = first.b - first.a;
  const glm::dvec3 e = second.b - second.a;
  const glm::dvec3 between = first.a - second.a;
  const double dd = glm::dot(d, d);
  const double ee = glm::dot(e, e);
  const double de = glm::dot(d, e);
  const double db = glm::dot(d, between);
  const double eb = glm::dot(e, between);
  const double denominator = dd * ee - de * de; // 0 for parallels
  double s = denominator > 0.0 ? std::clamp((de * eb - db * ee) / denominator, 0.0, 1.0) : 0.0;
  const double t = ee > 0.0 ? std::clamp((de * s + eb) / ee, 0.0, 1.0) : 0.0;
  s = std::clamp((de * t - db) / dd, 0.0, 1.0);
  return glm::length(first.a + s * d - (second.a + t * e));
}

/// Return the ray of a pixel, if one is traced.
ShadowRay rayOf(const ShadowRayLight& light, const Occluders& occluders,
  const ReceiverPixels& receivers, std::size_t i)
{
  const std::uint32_t surface = receivers.surface[i];
  if (surface == ReceiverPixels::notCovered || !occluders.surfaces[surface].receives)
  {
    return { glm::vec3(0.0f), glm::vec3(0.0f), false };
  }
  const glm::vec3 position(receivers.positionX[i], receivers.positionY[i], receivers.positionZ[i]);
  const glm::vec3 normal(receivers.normalX[i], receivers.normalY[i], receivers.normalZ[i]);
  return visitShadowRays(light,
    [&](const auto& makeRay, float) { return makeRay(position, normal, receivers.offset[i]); });
}

/// A triangle that casts.
struct CastingTriangle
{
  glm::dvec3 a, b, c;
  bool oneSided;
  const CutoutMask* cutout = nullptr;
  std::array<glm::dvec2, 3> textureCoordinates = {}; ///< with a cut-out
};
std::vector<CastingTriangle> castingTriangles(const Occluders& occluders)
{
  std::vector<CastingTriangle> result;
  for (const Surface& surface : occluders.surfaces)
  {
    for (std::uint32_t k = 0; surface.casts && k < surface.triangleCount; ++k)
    {
      const glm::uvec3 corners = occluders.triangles[surface.firstTriangle + k];
      result.push_back({ glm::dvec3(occluders.positionsCentred[corners.x]),
        glm::dvec3(occluders.positionsCentred[corners.y]),
        glm::dvec3(occluders.positionsCentred[corners.z]), surface.oneSided });
      if (surface.cutout)
      {
        result.back().cutout = surface.cutout.get();
        for (int corner = 0; corner < 3; ++corner)
        {
          result.back().textureCoordinates[static_cast<std::size_t>(corner)] =
            surface.textureCoordinates[corners[corner] - surface.firstVertex];
        }
      }
    }
  }
  return result;
}

/// Differences of floats are exact in double, so neighbours agree on their common edge.
bool hits(const glm::dvec3& origin, const glm::dvec3& direction, double rayFar,
  const CastingTriangle& triangle)
{
  // The signed volumes of the ray's line with the three edges have one sign if it passes inside.
  const glm::dvec3 v0 = triangle.a - origin;
  const glm::dvec3 v1 = triangle.b - origin;
  const glm::dvec3 v2 = triangle.c - origin;
  const double u = glm::dot(glm::cross(v1, v2), direction);
  const double v = glm::dot(glm::cross(v2, v0), direction);
  const double w = glm::dot(glm::cross(v0, v1), direction);
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double cosine = glm::dot(normal, direction);
  if (!inside || cosine == 0.0 || (triangle.oneSided && cosine < 0.0))
  {
    return false;
  }
  const double t = glm::dot(v0, normal) / cosine;
  if (t < 0.0 || t > rayFar)
  {
    return false;
  }
  const auto& [a, b, c] = triangle.textureCoordinates;
  return !triangle.cutout ||
    triangle.cutout->isDrawn(glm::vec2((u * a + v * b + w * c) / (u + v + w)));
}

} // namespace

//------------------------------------------------------------------------------
std::vector<float> traceBruteForce(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  const ShadowRayLight rayLight(light, occluders.frame.centre);
  const double rayFar =
    visitShadowRays(rayLight, [](const auto&, float end) { return static_cast<double>(end); });
  const std::vector<CastingTriangle> triangles = castingTriangles(occluders);
  std::vector<float> visibility(receivers.size(), 1.0f);
  tbb::parallel_for(std::size_t(0), receivers.size(),
    [&](std::size_t i)
    {
      const std::uint32_t surface = receivers.surface[i];
      if (surface == ReceiverPixels::notCovered || !occluders.surfaces[surface].receives)
      {
        return;
      }
      const ShadowRay ray = rayOf(rayLight, occluders, receivers, i);
      const bool lit = ray.traced &&
        std::none_of(triangles.begin(), triangles.end(),
          [&](const CastingTriangle& triangle)
          { return hits(glm::dvec3(ray.origin), glm::dvec3(ray.direction), rayFar, triangle); });
      visibility[i] = lit ? 1.0f : 0.0f;
    });
  return visibility;
}

//------------------------------------------------------------------------------
double edgeDistance(const ShadowLight& light, const Occluders& occluders,
  const ReceiverPixels& receivers, std::size_t pixel)
{
  const ShadowRayLight rayLight(light, occluders.frame.centre);
  const ShadowRay ray = rayOf(rayLight, occluders, receivers, pixel);
  if (!ray.traced)
  {
    return 1.0;
  }
  const glm::dvec3 origin(ray.origin);
  // A directional light's ray ends where it has left the scene for certain.
  const double rayFar =
    visitShadowRays(rayLight, [](const auto&, float end) { return static_cast<double>(end); });
  const double length = std::min(rayFar, 4.0 * occluders.allCentred.radius());
  const Segment segment{ origin, origin + length * glm::dvec3(ray.direction) };
  double closest = std::numeric_limits<double>::infinity();
  for (const CastingTriangle& triangle : castingTriangles(occluders))
  {
    closest = std::min({ closest, distanceBetween(segment, { triangle.a, triangle.b }),
      distanceBetween(segment, { triangle.b, triangle.c }),
      distanceBetween(segment, { triangle.c, triangle.a }) });
  }
  return closest / occluders.allCentred.radius();
}

//------------------------------------------------------------------------------
std::vector<float> trace(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  EmbreeTracer tracer;
  tracer.update(occluders);
  std::vector<float> visibility;
  tracer.trace(light, occluders, receivers, visibility);
  return visibility;
}

//------------------------------------------------------------------------------
ReceiverPixels withOffset(const ReceiverPixels& receivers, float factor)
{
  ReceiverPixels result = receivers;
  for (float& offset : result.offset)
  {
    offset *= factor;
  }
  return result;
}

//------------------------------------------------------------------------------
glm::dmat4 at(const glm::dvec3& position, double scale)
{
  return glm::scale(glm::translate(glm::dmat4(1.0), position), glm::dvec3(scale));
}

//------------------------------------------------------------------------------
std::size_t countDifferent(const std::vector<float>& a, const std::vector<float>& b)
{
  std::size_t different = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    different += a[i] != b[i] ? 1 : 0;
  }
  return different;
}

//------------------------------------------------------------------------------
std::size_t countCovered(const ReceiverPixels& receivers)
{
  return receivers.size() -
    static_cast<std::size_t>(
      std::count(receivers.surface.begin(), receivers.surface.end(), ReceiverPixels::notCovered));
}

} // namespace gnomon::test
