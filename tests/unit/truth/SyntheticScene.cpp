#include "SyntheticScene.h"

#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace gnomon::test
{

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

Mesh makeTriangleSoup(int count, unsigned int seed)
{
  Random random(seed);
  Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const double size = std::pow(10.0, -1.5 + uniform(random, -1.0, 1.0));
    const double thinness = i % 8 == 0 ? 1e-3 : 1.0;
    const glm::dvec3 corner = 0.5 * inCube(random);
    const glm::dvec3 edge = size * inCube(random);
    addTriangle(
      mesh, corner, corner + edge, corner + 0.5 * edge + thinness * size * inCube(random));
  }
  return mesh;
}

void addTriangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const auto first = static_cast<unsigned int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), { a, b, c });
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

Mesh apart(const Mesh& mesh)
{
  Mesh result;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    addTriangle(result, mesh.points[triangle.x], mesh.points[triangle.y], mesh.points[triangle.z]);
  }
  return result;
}

namespace
{

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

Occluders makeOccluders(const std::vector<Prop>& props, const std::optional<glm::dvec3>& centre)
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
  occluders.frame.centre = centre ? *centre
    : bounds.empty()              ? occluders.frame.centre
                                  : bounds.centre();
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

  Occluders shown = occluders; // all of it, from both sides
  for (Surface& surface : shown.surfaces)
  {
    surface.casts = true;
    surface.oneSided = false;
    surface.cutout = nullptr;
  }
  EmbreeTracer tracer;
  tracer.update(shown);
  tbb::parallel_for(0, camera.height,
    [&](int y)
    {
      for (int x = 0; x < camera.width; ++x)
      {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
          static_cast<std::size_t>(x);
        const double column = x + jitter(static_cast<std::uint32_t>(2 * i)) / 512.0;
        const double row = y + jitter(static_cast<std::uint32_t>(2 * i + 1)) / 512.0;
        const auto hit = tracer.nearest(images.rays.origin(column, row),
          glm::normalize(images.rays.direction(column, row)), 0.0f,
          std::numeric_limits<float>::infinity());
        if (hit)
        {
          images.fragments[i] =
            glm::vec2(hit->surface + 1, hit->triangle - shown.surfaces[hit->surface].firstTriangle);
        }
      }
    });
  return view;
}

ReceiverPixels makeReceivers(const Occluders& occluders, const Camera& camera)
{
  const View view = makeView(occluders, camera);
  ReceiverPixels receivers;
  Receivers(view.images, view.drawnSurfaces, occluders, receivers).all();
  return receivers;
}

ReceiverPixels rowOf(const std::vector<PlacedReceiver>& receivers, std::uint32_t surface)
{
  ReceiverPixels pixels;
  pixels.resize(static_cast<int>(receivers.size()), 1);
  for (std::size_t i = 0; i < receivers.size(); ++i)
  {
    const auto& [position, normal, offset] = receivers[i];
    pixels.put(i, position, normal, offset, surface);
  }
  return pixels;
}

ShadowLight directionalLight(const glm::dvec3& direction)
{
  ShadowLight light;
  light.directionWorld = glm::normalize(direction);
  return light;
}

ShadowLight spotLight(const glm::dvec3& position, const glm::dvec3& target, double coneAngleDegrees)
{
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.positionWorld = position;
  light.directionWorld = glm::normalize(target - position);
  light.coneAngleDegrees = coneAngleDegrees;
  return light;
}

ShadowLight pointLight(const glm::dvec3& position)
{
  ShadowLight light;
  light.kind = LightKind::Point;
  light.positionWorld = position;
  return light;
}

ShadowLight boxLight(
  const glm::dvec3& direction, const glm::dvec3& position, const glm::dvec3& size)
{
  ShadowLight light = directionalLight(direction);
  light.positionWorld = position;
  light.box = LightBox{ size.x, size.y, size.z, { 0.0, 0.0, 1.0 } };
  return light;
}

ShadowLight withMap(ShadowLight light, int sizeTexels)
{
  light.mapSizeTexels = sizeTexels;
  return light;
}

ShadowLight withArea(ShadowLight light, const LightArea& area, int samples)
{
  light.area = area;
  light.lightSamples = samples;
  return light;
}

std::vector<CastingTriangle> castingTriangles(const Occluders& occluders)
{
  std::vector<CastingTriangle> result;
  for (std::uint32_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    const Surface& surface = occluders.surfaces[i];
    for (std::uint32_t k = 0; surface.casts && k < surface.triangleCount; ++k)
    {
      const std::uint32_t triangle = surface.firstTriangle + k;
      const glm::uvec3 corners = occluders.triangles[triangle];
      result.push_back({ i, triangle,
        { glm::dvec3(occluders.positionsCentred[corners.x]),
          glm::dvec3(occluders.positionsCentred[corners.y]),
          glm::dvec3(occluders.positionsCentred[corners.z]) } });
    }
  }
  return result;
}

std::optional<LineHit> meet(
  const CastingTriangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction)
{
  const auto& [a, b, c] = triangle.corners;
  const glm::dvec3 volumes(glm::dot(glm::cross(b - origin, c - origin), direction),
    glm::dot(glm::cross(c - origin, a - origin), direction),
    glm::dot(glm::cross(a - origin, b - origin), direction));
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double cosine = glm::dot(normal, direction);
  const double sum = volumes.x + volumes.y + volumes.z;
  if (cosine == 0.0 || sum == 0.0)
  {
    return std::nullopt;
  }
  return LineHit{ glm::dot(a - origin, normal) / cosine, cosine, volumes / sum };
}

std::vector<float> trace(
  const ShadowLight& light, const Occluders& occluders, const ReceiverPixels& receivers)
{
  EmbreeTracer tracer;
  tracer.update(occluders);
  std::vector<float> visibility;
  tracer.trace(light, occluders, receivers, visibility);
  return visibility;
}

glm::dmat4 at(const glm::dvec3& position, double scale)
{
  return glm::scale(glm::translate(glm::dmat4(1.0), position), glm::dvec3(scale));
}

std::size_t countDifferent(const std::vector<float>& a, const std::vector<float>& b)
{
  std::size_t different = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    different += a[i] != b[i] ? 1 : 0;
  }
  return different;
}

std::size_t countCovered(const ReceiverPixels& receivers)
{
  return receivers.size() -
    static_cast<std::size_t>(
      std::count(receivers.surface.begin(), receivers.surface.end(), ReceiverPixels::notCovered));
}

glm::dmat4 turned(Random& random, double spread)
{
  const glm::dmat4 turn =
    glm::rotate(glm::dmat4(1.0), uniform(random, -3.0, 3.0), unitVector(random));
  return glm::scale(turn, glm::pow(glm::dvec3(10.0), inCube(random, spread)));
}

void makeInstanced(Occluders& occluders, std::size_t surface,
  const std::vector<glm::dmat4>& centredFromSource, bool mirrored)
{
  for (const glm::dmat4& instance : centredFromSource)
  {
    occluders.surfaces[surface].centredFromSource.emplace_back(instance);
  }
  occluders.surfaces[surface].mirrored = mirrored;
}

Occluders expanded(const Occluders& instanced)
{
  Occluders result = instanced;
  result.positionsCentred.clear();
  result.triangles.clear();
  for (Surface& surface : result.surfaces)
  {
    const Surface source = surface;
    surface.centredFromSource.clear();
    surface.mirrored = false;
    surface.firstVertex = static_cast<std::uint32_t>(result.positionsCentred.size());
    surface.firstTriangle = static_cast<std::uint32_t>(result.triangles.size());
    const std::size_t count = std::max<std::size_t>(source.centredFromSource.size(), 1);
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto first = static_cast<std::uint32_t>(result.positionsCentred.size());
      for (std::uint32_t vertex = 0; vertex < source.vertexCount; ++vertex)
      {
        const glm::vec3 position = instanced.positionsCentred[source.firstVertex + vertex];
        result.positionsCentred.push_back(source.isInstanced()
            ? glm::vec3(
                glm::dmat4x3(source.centredFromSource[i]) * glm::dvec4(glm::dvec3(position), 1.0))
            : position);
      }
      for (std::uint32_t triangle = 0; triangle < source.triangleCount; ++triangle)
      {
        result.triangles.push_back(
          instanced.triangles[source.firstTriangle + triangle] - source.firstVertex + first);
      }
      if (i > 0)
      {
        surface.textureCoordinates.insert(surface.textureCoordinates.end(),
          source.textureCoordinates.begin(), source.textureCoordinates.end());
      }
    }
    surface.vertexCount = static_cast<std::uint32_t>(source.vertexCount * count);
    surface.triangleCount = static_cast<std::uint32_t>(source.triangleCount * count);
  }
  result.positionsCentred.emplace_back(0.0f); // padding that Occluders guarantees
  return result;
}

Occluders cupsOverFloor(bool mirrored, bool oneSided)
{
  Mesh cup = makeSphere(8, 12);
  cup.triangles.resize(cup.triangles.size() / 2);
  Occluders occluders =
    makeOccluders({ { makePlane(20.0), at({ 0.0, 0.0, -3.0 }) }, { cup, glm::dmat4(1.0) } });
  for (std::uint32_t i = 0; i < occluders.surfaces[1].vertexCount; ++i) // as if uncentred
  {
    occluders.positionsCentred[occluders.surfaces[1].firstVertex + i] = glm::vec3(cup.points[i]);
  }
  occluders.surfaces[1].oneSided = oneSided;
  Random random(3);
  std::vector<glm::dmat4> instances;
  for (int i = 0; i < 60; ++i)
  {
    glm::dmat4 instance = turned(random, 0.3);
    instance[3] = glm::dvec4(6.0, 6.0, 2.0, 1.0) * glm::dvec4(inCube(random), 1.0);
    instances.push_back(mirrored ? glm::scale(instance, glm::dvec3(1.0, -1.0, 1.0)) : instance);
  }
  makeInstanced(occluders, 1, instances, mirrored);
  return occluders;
}

void perforate(Occluders& occluders)
{
  Surface& cups = occluders.surfaces[1];
  cups.cutout = makePerforatedPlane(1.0, 1).cutout;
  for (std::uint32_t i = 0; i < cups.vertexCount; ++i)
  {
    const glm::vec3 position = occluders.positionsCentred[cups.firstVertex + i];
    cups.textureCoordinates.emplace_back(1.7f * position.x, position.y + 0.4f * position.z);
  }
}

} // namespace gnomon::test
