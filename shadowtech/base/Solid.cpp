#include "shadowtech/base/Solid.h"

#include "lights/LightSpace.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace gnomon
{
namespace
{

constexpr double endless = std::numeric_limits<double>::infinity();

/// Far above the rounding of a few products, relative to the largest.
constexpr double clearly = 0x1p-40;

/// Return where the line o + t d is within a distance of the origin. Both vectors lie in a plane or
/// in space.
std::optional<Crossing> crossBall(const glm::dvec3& o, const glm::dvec3& d, double radius)
{
  const double lengthSquared = glm::dot(d, d);
  if (!(lengthSquared > 0.0))
  {
    return glm::dot(o, o) <= radius * radius ? std::optional(Crossing{ -endless, endless })
                                             : std::nullopt;
  }
  const double middle = -glm::dot(o, d) / lengthSquared;
  const glm::dvec3 nearest = o + middle * d;
  const double rest = radius * radius - glm::dot(nearest, nearest);
  if (!(rest >= 0.0))
  {
    return std::nullopt;
  }
  const double half = std::sqrt(rest / lengthSquared);
  return Crossing{ middle - half, middle + half };
}

/// Return what a ball does to most rays: whether it blocks them; none if rounding might decide that
/// otherwise than crossBall(), which divides and takes a root.
/// @param from the ray's origin, relative to the ball's centre
std::optional<bool> clearlyBlocks(
  double radius, const glm::dvec3& from, const glm::dvec3& direction, double far)
{
  const double lengthSquared = glm::dot(direction, direction);
  const double toMiddle = -glm::dot(from, direction); // in squared lengths of the direction
  const double squares = glm::dot(from, from) + radius * radius;
  const double outside = glm::dot(from, from) - radius * radius;
  const double discriminant = toMiddle * toMiddle - lengthSquared * outside;
  if (discriminant < -clearly * squares * lengthSquared)
  {
    return false;
  }
  if (!(outside > clearly * squares))
  {
    return std::nullopt;
  }
  if (toMiddle < 0.0)
  {
    return false; // behind the ray
  }
  const bool blocks = discriminant > clearly * squares * lengthSquared &&
    toMiddle < (1.0 - clearly) * far * lengthSquared;
  return blocks ? std::optional(true) : std::nullopt;
}

/// Return where the line is between a cylinder's ends.
std::optional<Crossing> crossSlab(double o, double d, double halfLength)
{
  if (d == 0.0)
  {
    return std::abs(o) <= halfLength ? std::optional(Crossing{ -endless, endless }) : std::nullopt;
  }
  const double toLower = (-halfLength - o) / d;
  const double toUpper = (halfLength - o) / d;
  return Crossing{ std::min(toLower, toUpper), std::max(toLower, toUpper) };
}

std::optional<Crossing> united(const std::optional<Crossing>& a, const std::optional<Crossing>& b)
{
  if (!a || !b)
  {
    return a ? a : b;
  }
  return Crossing{ std::min(a->enters, b->enters), std::max(a->leaves, b->leaves) };
}

glm::dvec3 across(const glm::dvec3& vector, const glm::dvec3& axis)
{
  return vector - glm::dot(vector, axis) * axis;
}

/// @param from the line's origin, relative to the cylinder's centre
std::optional<Crossing> crossCylinder(
  const PlacedSolid& solid, const glm::dvec3& from, const glm::dvec3& direction)
{
  const auto around =
    crossBall(across(from, solid.axis), across(direction, solid.axis), solid.radius);
  const auto between =
    crossSlab(glm::dot(from, solid.axis), glm::dot(direction, solid.axis), solid.halfLength);
  if (!around || !between)
  {
    return std::nullopt;
  }
  const Crossing both{ std::max(around->enters, between->enters),
    std::min(around->leaves, between->leaves) };
  return both.enters <= both.leaves ? std::optional(both) : std::nullopt;
}

/// Return false if a line passes a cylinder's axis at more than its radius, as most lines through
/// its box do; none if it may meet the cylinder or its balls.
std::optional<bool> clearlyPasses(
  const PlacedSolid& solid, const glm::dvec3& from, const glm::dvec3& direction)
{
  const glm::dvec3 across = glm::cross(direction, solid.axis);
  const double apart = glm::dot(from, across);
  const double squares = glm::dot(from, from) + solid.radius * solid.radius;
  const bool passes = apart * apart > solid.radius * solid.radius * glm::dot(across, across) +
      clearly * squares * glm::dot(direction, direction);
  return passes ? std::optional(false) : std::nullopt;
}

/// Return the point of a solid's surface below a point outside, or above a point inside. A point on
/// the surface is returned as it is.
SolidPoint surfacePoint(const PlacedSolid& solid, const glm::dvec3& point)
{
  const glm::dvec3 from = point - solid.centre;
  if (solid.kind == Solid::Sphere)
  {
    const double length = glm::length(from);
    const glm::dvec3 normal = length > 0.0 ? from / length : glm::dvec3(0, 0, 1);
    return { solid.centre + solid.radius * normal, normal };
  }
  const double along = glm::dot(from, solid.axis);
  const glm::dvec3 off = across(from, solid.axis);
  const double length = glm::length(off);
  if (solid.kind == Solid::Tube || solid.radius - length <= solid.halfLength - std::abs(along))
  {
    const glm::dvec3 normal =
      length > 0.0 ? off / length : glm::normalize(glm::cross(solid.axis, axisAcross(solid.axis)));
    const double kept = glm::clamp(along, -solid.halfLength, solid.halfLength);
    return { solid.centre + kept * solid.axis + solid.radius * normal, normal };
  }
  const glm::dvec3 normal = along < 0.0 ? -solid.axis : solid.axis;
  const double kept = length > solid.radius ? solid.radius / length : 1.0;
  return { solid.centre + solid.halfLength * normal + kept * off, normal };
}

/// Return a sphere's mesh: an octahedron whose triangles are cut in four, `cuts` times.
SolidMesh sphereMesh(int cuts)
{
  SolidMesh mesh;
  mesh.positions = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  mesh.triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 }, { 2, 0, 5 }, { 1, 2, 5 },
    { 3, 1, 5 }, { 0, 3, 5 } };
  for (int cut = 0; cut < cuts; ++cut)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b)
    {
      const auto [found, isNew] =
        middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
      if (isNew)
      {
        mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
      }
      return found->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& t : mesh.triangles)
    {
      const glm::uvec3 m(middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x));
      finer.insert(finer.end(),
        { { t.x, m.x, m.z }, { m.x, t.y, m.y }, { m.z, m.y, t.z }, { m.x, m.y, m.z } });
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// Return a cylinder's mesh: a prism. A tube's mesh has no ends, and no balls around them.
SolidMesh cylinderMesh(std::uint32_t sides, bool isTube)
{
  SolidMesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / sides;
    for (const float z : { -1.0f, 1.0f })
    {
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
    }
    const std::uint32_t lower = 2 * i;
    const std::uint32_t nextLower = 2 * ((i + 1) % sides);
    mesh.triangles.emplace_back(lower, nextLower, nextLower + 1);
    mesh.triangles.emplace_back(lower, nextLower + 1, lower + 1);
    if (!isTube && i > 0 && i + 1 < sides)
    {
      mesh.triangles.emplace_back(0, nextLower, lower);
      mesh.triangles.emplace_back(1, lower + 1, nextLower + 1);
    }
  }
  return mesh;
}

} // namespace

PlacedSolid placedSolid(Solid kind, const glm::mat4x3& centredFromSource)
{
  const glm::dmat4x3 matrix(centredFromSource);
  PlacedSolid solid{ kind, matrix[3], glm::length(matrix[0]) };
  if (solid.kind != Solid::Sphere)
  {
    solid.halfLength = glm::length(matrix[2]);
    solid.axis = matrix[2] / solid.halfLength;
  }
  return solid;
}

Bounds boundsOf(const PlacedSolid& solid)
{
  glm::dvec3 reach(solid.radius);
  if (solid.kind != Solid::Sphere)
  {
    for (int i = 0; i < 3; ++i)
    {
      const double along = solid.axis[i];
      reach[i] = solid.halfLength * std::abs(along) +
        solid.radius *
          (solid.kind == Solid::Tube ? 1.0 : std::sqrt(std::max(0.0, 1.0 - along * along)));
    }
  }
  // Two roundings of the box's sides, and as much again for a ray that enters it in float.
  reach += std::ldexp(1.0, -22) * (glm::abs(solid.centre) + reach);
  return { solid.centre - reach, solid.centre + reach };
}

Bounds solidsBounds(Solid kind, const std::vector<glm::mat4x3>& centredFromSource)
{
  Bounds bounds;
  for (const glm::mat4x3& instance : centredFromSource)
  {
    if (!Surface::isLeftOut(instance))
    {
      bounds.add(boundsOf(placedSolid(kind, instance)));
    }
  }
  return bounds;
}

std::optional<Crossing> crossingOf(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction)
{
  const glm::dvec3 from = origin - solid.centre;
  if (solid.kind == Solid::Sphere)
  {
    return crossBall(from, direction, solid.radius);
  }
  std::optional<Crossing> crossing = crossCylinder(solid, from, direction);
  if (solid.kind == Solid::Tube)
  {
    // Their union is convex, so a line is inside of it only once.
    for (const double side : { -solid.halfLength, solid.halfLength })
    {
      crossing = united(crossing, crossBall(from - side * solid.axis, direction, solid.radius));
    }
  }
  return crossing;
}

bool blocks(const PlacedSolid& solid, bool oneSided, const glm::dvec3& origin,
  const glm::dvec3& direction, double far)
{
  const glm::dvec3 from = origin - solid.centre;
  const std::optional<bool> clear = solid.kind == Solid::Sphere
    ? clearlyBlocks(solid.radius, from, direction, far)
    : clearlyPasses(solid, from, direction);
  if (clear)
  {
    return *clear;
  }
  const auto crossing = crossingOf(solid, origin, direction);
  const auto isAhead = [far](double t) { return t >= 0.0 && t <= far; };
  const bool onlyOutside = oneSided || solid.kind == Solid::Tube;
  return crossing && (isAhead(crossing->enters) || (!onlyOutside && isAhead(crossing->leaves)));
}

SolidPoint seenPoint(
  const PlacedSolid& solid, const glm::dvec3& origin, const glm::dvec3& direction)
{
  const bool isTube = solid.kind == Solid::Tube;
  const auto crossing = isTube
    ? crossBall(across(origin - solid.centre, solid.axis), across(direction, solid.axis),
        solid.radius) // of an infinite cylinder
    : crossingOf(solid, origin, direction);
  const bool meets = crossing && std::isfinite(crossing->enters);
  const double t = meets
    ? crossing->enters
    : glm::dot(solid.centre - origin, direction) / glm::dot(direction, direction);
  const glm::dvec3 onRay = origin + t * direction;
  SolidPoint point = surfacePoint(solid, onRay);
  point.isMet =
    meets && (!isTube || std::abs(glm::dot(onRay - solid.centre, solid.axis)) <= solid.halfLength);
  return point;
}

float noiseOf(const PlacedSolid& solid, const SolidPoint& point)
{
  return 2.0f * storageNoise(point.normal, glm::abs(point.position) + solid.halfLength);
}

SolidMesh meshOf(Solid kind, std::size_t count)
{
  constexpr std::size_t mostTriangles = 1u << 20;
  const std::size_t each = mostTriangles / std::max<std::size_t>(count, 1);
  if (kind != Solid::Sphere)
  {
    return cylinderMesh(each >= 128 ? 32 : 16, kind == Solid::Tube);
  }
  return sphereMesh(each >= 2048 ? 4 : each >= 512 ? 3 : 2);
}

} // namespace gnomon
