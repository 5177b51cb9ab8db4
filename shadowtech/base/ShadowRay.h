#pragma once

#include "lights/LightSpace.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{

/// @file
/// The one shadow ray of the project: where it starts, where it goes, and when none is needed.
/// shadow_ray.glsl is its twin.
///
/// How far off the surface it starts follows from what may go wrong. Let u = 2^-24 be the unit
/// roundoff of float, N a triangle's unit normal, M its largest centred coordinates by magnitude
/// along each axis, X, Y, Z the extent of its box and A twice its area. The receiver was found
/// on the triangle in double precision. What is left:
///
/// - Storage. Rounding the receiver to float moves it by at most u M_i along axis i, so off the
///   plane by u sum |N_i| M_i. Adding the offset and rounding the ray's origin costs the same
///   again: together 2u sum |N_i| M_i. It is zero for the centred frame's own planes.
/// - Intersection. The ray O + t D is tested by the sign of T = (v0 - O) . (v1 - v0) x (v2 - v0).
///   Rounding the vertices relative to O to u per axis moves their plane by u sum |N_i| X_i, at
///   most 3u XYZ/A as |N_i| A <= X_j X_k. Each edge is rounded once more, and a component of the
///   cross product is two products of two edges and a subtraction: 7u X_j X_k; times v0, summed
///   over three axes, 21u XYZ. The dot product's own rounding adds at most 9u XYZ. Together 33u
///   XYZ/A: a forward error bound of Embree's robust test. A sliver's A is small, so its bound is
///   large, as it must be; but where it exceeds 1/1024 of the length, at about a thousand times as
///   long as wide, rays would start somewhere else altogether, and it ends there.
///
/// planeNoise() is the sum of both, with 32u for 33u, which no rounding reaches: random triangles
/// come to 0.7 of it. The offset is twice that, so that half of it still holds.
///
/// - Instances. A ray is taken into source coordinates, x_i = r_i.O + p_i with r_i the rows of the
///   inverse of the matrix (L, T) and p_i = -r_i.T, all in float as Embree does; the test that
///   follows is affine, so that what x_i is off by counts in the world by L's column c_i: along N
///   by N.c_i. The sum of four terms rounds to 4u (|r_i|.|O| + |p_i|), p_i itself to 3u |r_i|.|T|:
///   at most 8u |r_i|.M + 8u |r_i|.|T|, component by component. The rows are off as well, alike in
///   both of the sum's parts, and so by dr_i.(O - T), where O is no farther from T than the
///   triangle's corners are. A cross product of two columns a, b is off by 2 sqrt(3) u |a||b|, for
///   a skewness h (Instances.h) by 2 sqrt(3) h u of its length, the determinant by (3 + 2 sqrt(3))
///   h u of itself, and dividing by it costs 5u; with h <= 2 together less than 32u.
///   instanceNoise() is the sum of these, and the intersection's rounding with the extent of the
///   box in source coordinates, X'Y'Z' |det L| / A.
///
/// - Solids (Solid.h). Their rays are tested in double precision, so that storage is all that is
///   left. It moves a receiver along the surface as well, which is curved: off it by M^2 u^2 / 2R,
///   less than the storage along the normal unless the radius R is below float's spacing.
///
/// - Footprint. A rasteriser snaps vertices to 1/256 pixel, so a fragment near an edge may lie past
///   it by as much, behind the next triangle of a concave surface. There the offset grows by 1/256
///   of the pixel's side. It moves a shadow's edge by as much times the cotangent of the light's
///   elevation, which cannot be seen, but can be counted where edges are dense. So a receiver that
///   is known to lie inside its triangle gets 1/256 of it, which only has to be more than nothing,
///   as the noise of the centred frame's own planes is.

/// How far off a surface storing a receiver on it in float, and the ray's origin, may move them.
///
/// @param normal unit normal of the surface
/// @param largest largest magnitude of the receiver's centred coordinates, by axis; of any sign
inline float storageNoise(const glm::vec3& normal, const glm::vec3& largest)
{
  return 1.1920929e-7f * // 2^-23
    (std::abs(normal.x * largest.x) + std::abs(normal.y * largest.y) +
      std::abs(normal.z * largest.z));
}

/// How far from its plane the points of a triangle may seem to lie, in the unit of the coordinates.
///
/// @param normal unit normal of the triangle
/// @param largest largest magnitude of the vertices' centred coordinates, by axis
/// @param extent size of the triangle's box
/// @param doubleArea twice the triangle's area; > 0
inline float planeNoise(
  const glm::vec3& normal, const glm::vec3& largest, const glm::vec3& extent, float doubleArea)
{
  const float longest = std::max(extent.x, std::max(extent.y, extent.z));
  const float intersection = extent.x * (extent.y * extent.z / doubleArea);
  return storageNoise(normal, largest) +
    std::min(1.9073486e-6f * intersection, 9.765625e-4f * longest); // 2^-19, 2^-10
}

/// What is to be added to it for a triangle of an instance.
///
/// @param normal unit normal of the triangle
/// @param corners centred
/// @param cornersSource in source coordinates
/// @param doubleArea twice the triangle's area; > 0
inline float instanceNoise(const glm::vec3& normal, const std::array<glm::dvec3, 3>& corners,
  const std::array<glm::dvec3, 3>& cornersSource, const glm::mat4x3& centredFromSource,
  double doubleArea)
{
  const auto largestOf = [](const std::array<glm::dvec3, 3>& of)
  { return glm::max(glm::abs(of[0]), glm::max(glm::abs(of[1]), glm::abs(of[2]))); };
  const auto extentOf = [](const std::array<glm::dvec3, 3>& of)
  { return glm::max(of[0], glm::max(of[1], of[2])) - glm::min(of[0], glm::min(of[1], of[2])); };
  const glm::dmat4x3 matrix(centredFromSource);
  const glm::dmat3 linear(matrix[0], matrix[1], matrix[2]);
  const glm::dmat3 rows = glm::transpose(glm::inverse(linear));
  const glm::dvec3 magnitudes = largestOf(corners) + glm::abs(matrix[3]);
  double farthest = 0.0;
  for (const glm::dvec3& corner : corners)
  {
    farthest = std::max(farthest, glm::length(corner - matrix[3]));
  }
  double noise = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    noise += std::abs(glm::dot(glm::dvec3(normal), linear[i])) *
      (std::ldexp(1.0, -21) * glm::dot(glm::abs(rows[i]), magnitudes) +
        std::ldexp(1.0, -19) * glm::length(rows[i]) * farthest);
  }
  const glm::dvec3 extent = extentOf(corners);
  const glm::dvec3 source = extentOf(cornersSource);
  const double intersection =
    source.x * source.y * source.z * std::abs(glm::determinant(linear)) / doubleArea;
  const double longest = std::max(extent.x, std::max(extent.y, extent.z));
  return static_cast<float>(
    noise + std::min(std::ldexp(1.0, -19) * intersection, std::ldexp(1.0, -10) * longest));
}

/// How far off the surface, along the normal, the shadow ray starts.
///
/// @param noise planeNoise(), and instanceNoise() where it is one, of the receiver's triangle
/// @param footprint the pixel's side at the receiver's distance
inline float shadowRayOffset(float noise, float footprint)
{
  return 2.0f * noise + 0.00390625f * footprint; // 1/256
}

/// The same of a receiver that lies where the pixel's ray meets the inside of its triangle.
inline float shadowRayOffsetInside(float noise, float footprint)
{
  return shadowRayOffset(noise, 0.00390625f * footprint);
}

/// Where along its direction the shadow ray starts to count, and where it ends: one that goes to a
/// light's position or to the near face of its box, and whose direction is not normalised, there.
inline constexpr float shadowRayNear = 0.0f;
inline constexpr float shadowRayFarAtLight = 1.0f;
inline constexpr float shadowRayFarDirectional = std::numeric_limits<float>::infinity();

/// Whether a surface faces the light: N.L > 2^-20. Below that the sign of N.L, which rounding moves
/// by up to 2^-22, says nothing, and faces along the light would turn noisy.
///
/// @param normal unit normal
/// @param toLight towards the light, of any length
inline bool facesLight(const glm::vec3& normal, const glm::vec3& toLight)
{
  const float cosine = glm::dot(normal, toLight);
  bool faces = cosine > 0.0f;
  faces &= cosine * cosine > 9.094947e-13f * glm::dot(toLight, toLight); // 2^-40
  return faces;
}

/// Whether a point lies inside a spot light's cone. Tangents stay precise for narrow cones, where
/// cosines do not.
///
/// @param toLight from the point to the light
/// @param axis unit vector against the light's direction
/// @param tangentSquared of half the cone's angle
inline bool insideCone(const glm::vec3& toLight, const glm::vec3& axis, float tangentSquared)
{
  const float along = glm::dot(toLight, axis);
  const glm::vec3 across = toLight - along * axis;
  bool inside = along > 0.0f;
  inside &= glm::dot(across, across) <= tangentSquared * (along * along);
  return inside;
}

/// Whether a point lies inside the box of a directional light.
///
/// @param positionLight in the light's own space (LightSpace.h)
/// @param box half the width, half the height, and the depth
inline bool insideBox(const glm::vec3& positionLight, const glm::vec3& box)
{
  bool inside = std::abs(positionLight.x) <= box.x;
  inside &= std::abs(positionLight.y) <= box.y;
  inside &= positionLight.z >= 0.0f;
  inside &= positionLight.z <= box.z;
  return inside;
}

/// A light as shadow rays see it: in centred coordinates, in float.
struct ShadowRayLight
{
  LightKind kind = LightKind::Directional;
  glm::vec3 position{ 0.0f };  ///< of a positional light, or the middle of a box's near face
  glm::vec3 toLight{ 0.0f };   ///< unit vector against the light's direction
  float tangentSquared = 0.0f; ///< of half a spot light's cone
  bool hasBox = false;
  glm::mat3 lightFromCentred{ 1.0f }; ///< a box's rotation
  glm::vec3 box{ 0.0f };              ///< see insideBox()

  ShadowRayLight(const ShadowLight& light, const glm::dvec3& centreWorld)
    : kind(light.kind)
    , position(light.positionWorld - centreWorld)
    , toLight(-glm::normalize(light.directionWorld))
    , hasBox(light.box)
  {
    const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
    this->tangentSquared = static_cast<float>(tangent * tangent);
    if (light.box)
    {
      this->lightFromCentred = glm::mat3(gnomon::lightFromCentred(light, centreWorld));
      this->box = glm::dvec3(0.5 * light.box->width, 0.5 * light.box->height, light.box->depth);
    }
  }
};

/// A shadow ray. `traced` is false where visibility is 0 without it: the surface is turned away
/// from the light, or lies outside its cone or box.
struct ShadowRay
{
  glm::vec3 origin;
  glm::vec3 direction;
  bool traced;
};

inline ShadowRay shadowRayDirectional(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  return { position + offset * normal, light.toLight, facesLight(normal, light.toLight) };
}

/// Of a directional light with a box. It ends at the box's near face, where the light begins; that
/// of a receiver in that very face has the offset's length, so that it has a direction.
inline ShadowRay shadowRayBox(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  const glm::vec3 positionLight = light.lightFromCentred * (position - light.position);
  const glm::vec3 origin = position + offset * normal;
  const float length = std::max(glm::dot(light.position - origin, light.toLight), offset);
  bool traced = facesLight(normal, light.toLight);
  traced &= insideBox(positionLight, light.box);
  return { origin, length * light.toLight, traced };
}

inline ShadowRay shadowRayPoint(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  const glm::vec3 origin = position + offset * normal;
  return { origin, light.position - origin, facesLight(normal, light.position - position) };
}

inline ShadowRay shadowRaySpot(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  ShadowRay ray = shadowRayPoint(light, position, normal, offset);
  ray.traced &= insideCone(light.position - position, light.toLight, light.tangentSquared);
  return ray;
}

/// What a receiver's shadow rays to the points of an area light have in common. They start and end
/// as the centre's does.
struct AreaRays
{
  glm::vec3 normal;   ///< the receiver's
  glm::vec3 toCentre; ///< from the receiver to the light's centre, in the units of LightArea
  glm::vec3 ray;      ///< the direction of the ray to the centre, of any length
  float perUnit;      ///< how far a ray's end moves when the point on the light moves by one
};

/// @param light which the receiver faces
/// @param ray the direction of the receiver's ray to the light's centre
inline AreaRays areaRays(const ShadowRayLight& light, const glm::vec3& position,
  const glm::vec3& normal, const glm::vec3& ray)
{
  const bool directional = light.kind == LightKind::Directional;
  // The rays to a box's near face are as long as it takes.
  return { normal, directional ? light.toLight : light.position - position, ray,
    directional && light.hasBox ? glm::dot(ray, light.toLight) : 1.0f };
}

/// Which point of an area light a receiver is asked about in place of a sample of it
/// (LightSamples.h): 1 the sample, -1 the point opposite.
///
/// VTK shades from the centre: N.L there is the mean over all of the light, of what lies behind the
/// receiver's plane too, which then counts as negative. So that this is not taken off twice, and so
/// that what nothing is in the way of is lit: a point behind the plane gives way to the one
/// opposite, which is in front of it wherever the centre is. The mean of both cosines is the
/// centre's. Where the light has a texture, it gives way with its colour: none of what is behind
/// the plane reaches the receiver.
///
/// @param sample from the light's centre
inline float sideOfSample(const AreaRays& rays, const glm::vec3& sample)
{
  return facesLight(rays.normal, rays.toCentre + sample) ? 1.0f : -1.0f;
}

/// Where a receiver's shadow ray goes to that point instead of the light's centre.
///
/// @param sample from the light's centre
inline glm::vec3 directionToSample(const AreaRays& rays, const glm::vec3& sample)
{
  return rays.ray + sideOfSample(rays, sample) * rays.perUnit * sample;
}

/// Calls `visit` with the function that makes this light's shadow rays from position, normal and
/// offset, and with where they end.
template <typename Visit>
auto visitShadowRays(const ShadowRayLight& light, const Visit& visit)
{
  const auto with = [&](auto make, float rayFar)
  {
    return visit([&light, make](const glm::vec3& position, const glm::vec3& normal, float offset)
      { return make(light, position, normal, offset); },
      rayFar);
  };
  // Lambdas, since calls through function pointers would not be inlined.
  switch (light.kind)
  {
    case LightKind::Spot:
      return with([](const auto&... of) { return shadowRaySpot(of...); }, shadowRayFarAtLight);
    case LightKind::Point:
      return with([](const auto&... of) { return shadowRayPoint(of...); }, shadowRayFarAtLight);
    case LightKind::Directional:
      break;
  }
  return light.hasBox
    ? with([](const auto&... of) { return shadowRayBox(of...); }, shadowRayFarAtLight)
    : with([](const auto&... of) { return shadowRayDirectional(of...); }, shadowRayFarDirectional);
}

} // namespace gnomon
