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
/// It starts off the surface by twice the rounding that a receiver and a float tracer may have,
/// planeNoise() plus instanceNoise(), so that half the offset still holds. To that comes a share of
/// the pixel's side. docs/theory/shadow_ray.md derives the bounds.

/// Return how far off a surface float storage may move a receiver on it and its ray's origin.
///
/// @param normal unit normal of the surface
/// @param largest largest magnitude of the receiver's centred coordinates, by axis; of any sign
inline float storageNoise(const glm::vec3& normal, const glm::vec3& largest)
{
  return 1.1920929e-7f * // 2^-23
    (std::abs(normal.x * largest.x) + std::abs(normal.y * largest.y) +
      std::abs(normal.z * largest.z));
}

/// Return how far off its plane a triangle's points may seem to lie, in the unit of the
/// coordinates.
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

/// Return the noise to add to planeNoise() for a triangle of an instance.
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

/// Return the offset of the shadow ray's start from the surface, along the normal.
///
/// @param noise planeNoise() of the receiver's triangle, plus instanceNoise() of an instance
/// @param footprint the pixel's side at the receiver's distance, in world units
inline float shadowRayOffset(float noise, float footprint)
{
  return 2.0f * noise + 0.00390625f * footprint; // 1/256
}

/// Return the offset of a receiver where the pixel's ray meets the inside of its triangle.
inline float shadowRayOffsetInside(float noise, float footprint)
{
  return shadowRayOffset(noise, 0.00390625f * footprint);
}

/// The shadow ray's interval, in lengths of its direction. Rays to a light's position or to the
/// near face of its box end there, because their direction is not normalised.
inline constexpr float shadowRayNear = 0.0f;
inline constexpr float shadowRayFarAtLight = 1.0f;
inline constexpr float shadowRayFarDirectional = std::numeric_limits<float>::infinity();

/// True if a surface faces the light: N.L > 2^-20 |L|. Rounding moves N.L by up to 2^-22 |L|, so
/// the sign of smaller values is noise on faces along the light.
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

/// True if a point lies inside a spot light's cone. Tangents stay precise for narrow cones, cosines
/// do not.
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

/// True if a point lies inside the box of a directional light.
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

/// A light in the form that shadow rays use: in centred coordinates, in float.
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

/// A shadow ray. `traced` is false if visibility is 0 without it: the surface faces away from the
/// light, or lies outside its cone or box.
struct ShadowRay
{
  glm::vec3 origin;
  glm::vec3 direction;
  bool traced;
};

/// Return the shadow ray to a directional light without a box.
inline ShadowRay shadowRayDirectional(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  // Copied number by number: GCC does not vectorise loops that copy the struct.
  const glm::vec3 toLight(light.toLight.x, light.toLight.y, light.toLight.z);
  return { position + offset * normal, toLight, facesLight(normal, toLight) };
}

/// Return the shadow ray to a directional light with a box. It ends at the box's near face, where
/// the light begins. The ray of a receiver in that face has the offset's length, so that it has a
/// direction.
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

/// Return the shadow ray to a point light; its direction ends at the light.
inline ShadowRay shadowRayPoint(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  const glm::vec3 origin = position + offset * normal;
  return { origin, light.position - origin, facesLight(normal, light.position - position) };
}

/// Return the shadow ray to a spot light; its direction ends at the light.
inline ShadowRay shadowRaySpot(
  const ShadowRayLight& light, const glm::vec3& position, const glm::vec3& normal, float offset)
{
  ShadowRay ray = shadowRayPoint(light, position, normal, offset);
  ray.traced &= insideCone(light.position - position, light.toLight, light.tangentSquared);
  return ray;
}

/// The second ray of a receiver whose triangle is turned away from the light, while the curved
/// surface that its corners' normals imply is not (SmoothFacet.h). Let the *own surface* be what
/// shared edges connect to the triangle, and P the plane across the curve's normal at its height.
/// The receiver is lit if nothing but the own surface below P blocks the shadow ray, and if the
/// own surface meets neither the lifted ray nor the segment between both starts.
struct LiftedRay
{
  glm::vec3 origin;    ///< on P
  glm::vec3 direction; ///< of a positional light's ray: to the same end
  float leaves;        ///< where the shadow ray passes P, in lengths of its direction
};

/// @param origin, direction of the shadow ray
/// @param normal of the curve, unit length
/// @param height of the curve, and the offset
inline LiftedRay liftedRay(const ShadowRayLight& light, const glm::vec3& position,
  const glm::vec3& origin, const glm::vec3& direction, const glm::vec3& normal, float height)
{
  const glm::vec3 up = position + height * normal - origin;
  const float along = glm::dot(normal, direction);
  return { origin + up, light.kind == LightKind::Directional ? direction : direction - up,
    along > 0.0f ? glm::dot(normal, up) / along : std::numeric_limits<float>::infinity() };
}

/// The common part of a receiver's shadow rays to the points of an area light. They start and end
/// as the centre's ray does.
struct AreaRays
{
  glm::vec3 normal;   ///< the receiver's
  glm::vec3 toCentre; ///< from the receiver to the light's centre, in the units of LightArea
  glm::vec3 ray;      ///< the direction of the ray to the centre, of any length
  float perUnit;      ///< movement of a ray's end if the point on the light moves by one
};

/// @param light the receiver faces it
/// @param ray the direction of the receiver's ray to the light's centre
inline AreaRays areaRays(const ShadowRayLight& light, const glm::vec3& position,
  const glm::vec3& normal, const glm::vec3& ray)
{
  const bool directional = light.kind == LightKind::Directional;
  // Rays to a box's near face have lengths of their own.
  return { normal, directional ? light.toLight : light.position - position, ray,
    directional && light.hasBox ? glm::dot(ray, light.toLight) : 1.0f };
}

/// Return which point of an area light stands for a sample (LightSamples.h) at a receiver: 1 for
/// the sample itself, -1 for the point opposite.
///
/// VTK shades from the centre. Its N.L is the mean over all of the light, where points behind the
/// receiver's plane count as negative. So the plane must not take these points off again, and an
/// unhidden receiver must be lit. Hence a point behind the plane is replaced by the opposite point,
/// which is in front of the plane if the centre is. The mean of both cosines is the centre's. A
/// texture's colour is replaced along with its point: nothing behind the plane reaches the receiver
/// (docs/theory/visibility.md).
///
/// @param sample from the light's centre
inline float sideOfSample(const AreaRays& rays, const glm::vec3& sample)
{
  return facesLight(rays.normal, rays.toCentre + sample) ? 1.0f : -1.0f;
}

/// Return the direction of a receiver's shadow ray to the point that stands for a sample.
///
/// @param sample from the light's centre
inline glm::vec3 directionToSample(const AreaRays& rays, const glm::vec3& sample)
{
  return rays.ray + sideOfSample(rays, sample) * rays.perUnit * sample;
}

/// Call `visit` with the function that makes this light's shadow rays from position, normal and
/// offset, and with the far end of the rays.
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
