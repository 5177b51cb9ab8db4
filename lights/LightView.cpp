#include "lights/LightView.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// A rigid rotation whose z axis is the light's axis. The other two are chosen against the world
/// axis that is least aligned with it, so that no direction is degenerate.
glm::dmat3 lightFromWorldRotation(const glm::dvec3& axis)
{
  const glm::dvec3 magnitude = glm::abs(axis);
  glm::dvec3 helper(0.0);
  if (magnitude.x <= magnitude.y && magnitude.x <= magnitude.z)
  {
    helper.x = 1.0;
  }
  else if (magnitude.y <= magnitude.z)
  {
    helper.y = 1.0;
  }
  else
  {
    helper.z = 1.0;
  }
  const glm::dvec3 x = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 y = glm::cross(axis, x);
  return glm::transpose(glm::dmat3(x, y, axis));
}

Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix)
{
  Bounds result;
  for (const glm::dvec3& corner : bounds.corners())
  {
    result.add(glm::dvec3(matrix * glm::dvec4(corner, 1.0)));
  }
  return result;
}

/// Maps [lower, upper] to [-1, 1] less a border of one texel on either side.
struct Axis
{
  double scale;
  double offset;
};
Axis fitAxis(double lower, double upper, int mapSizeTexels)
{
  const double inner = std::max(1.0 - 2.0 / mapSizeTexels, 0.5);
  const double half = 0.5 * (upper - lower);
  const double scale = inner / half;
  return { scale, -scale * 0.5 * (upper + lower) };
}

/// The far plane lies this share of the depth range behind the last caster: what a technique writes
/// for it, pushed back as that may be, stays apart from the depth 1 of texels without a caster.
constexpr double roomBehindCasters = 0.125;

LightView fitDirectional(const Bounds& castersLight, const glm::dmat4& rotation, int mapSizeTexels)
{
  const double smallest = 1e-6 * std::max(castersLight.radius(), 1e-300);
  const glm::dvec3 widening(smallest);
  const glm::dvec3 lower = castersLight.lower - widening;
  const glm::dvec3 upper = castersLight.upper + widening;
  // Positions are rounded relative to the box's size, and depths are compared relative to this
  // range: flat boxes get a deeper one.
  const double depth =
    std::max((1.0 + roomBehindCasters) * (upper.z - lower.z), castersLight.radius());

  LightView view;
  view.lightFromCentred =
    glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -lower.z)) * rotation;
  const Axis x = fitAxis(lower.x, upper.x, mapSizeTexels);
  const Axis y = fitAxis(lower.y, upper.y, mapSizeTexels);
  view.clipFromLight =
    glm::dmat4(glm::dvec4(x.scale, 0.0, 0.0, 0.0), glm::dvec4(0.0, y.scale, 0.0, 0.0),
      glm::dvec4(0.0, 0.0, 2.0 / depth, 0.0), glm::dvec4(x.offset, y.offset, -1.0, 1.0));
  view.perspective = false;
  view.depthScale = 1.0 / depth;
  view.depthOffset = 0.0;
  view.valid = true;
  return view;
}

LightView fitSpot(const ShadowLight& light, const Bounds& castersLight,
  const glm::dmat4& lightFromCentred, int mapSizeTexels)
{
  LightView view;
  view.lightFromCentred = lightFromCentred;
  view.perspective = true;

  const double farthest = castersLight.upper.z;
  if (!(farthest > 0.0))
  {
    return view; // all casters lie behind the light
  }
  // A caster may touch the light: near stays positive, but well below anything that can be told
  // apart at the far end. Linear depth does not suffer from a small near plane as z/w does.
  const double nearest = std::max(castersLight.lower.z, 1e-5 * farthest);
  const double slopeCone = std::tan(glm::radians(light.coneAngleDegrees));

  // The casters' slopes x/z and y/z, where the whole box lies in front of the light; else the
  // cone's.
  glm::dvec2 lower(-slopeCone);
  glm::dvec2 upper(slopeCone);
  if (castersLight.lower.z > 1e-5 * farthest)
  {
    Bounds slopes;
    for (const glm::dvec3& corner : castersLight.corners())
    {
      slopes.add(glm::dvec3(corner.x / corner.z, corner.y / corner.z, 0.0));
    }
    lower = glm::max(lower, glm::dvec2(slopes.lower));
    upper = glm::min(upper, glm::dvec2(slopes.upper));
  }
  if (!(lower.x <= upper.x && lower.y <= upper.y))
  {
    return view; // the cone misses all casters
  }
  const double smallest = 1e-6 * slopeCone;
  const Axis x = fitAxis(lower.x - smallest, upper.x + smallest, mapSizeTexels);
  const Axis y = fitAxis(lower.y - smallest, upper.y + smallest, mapSizeTexels);
  // clip = (x.scale X + x.offset Z, ..., a Z + b, Z) with z/w = -1 at near and 1 at far; near is
  // moved by a thousandth so that rounding clips no caster.
  const double n = nearest * 0.999;
  const double f = farthest * (1.0 + roomBehindCasters);
  view.clipFromLight = glm::dmat4(glm::dvec4(x.scale, 0.0, 0.0, 0.0),
    glm::dvec4(0.0, y.scale, 0.0, 0.0), glm::dvec4(x.offset, y.offset, (f + n) / (f - n), 1.0),
    glm::dvec4(0.0, 0.0, -2.0 * f * n / (f - n), 0.0));
  view.depthScale = 1.0 / f;
  view.depthOffset = 0.0;
  view.valid = true;
  return view;
}

} // namespace

//------------------------------------------------------------------------------
LightView fitUniform(const ShadowLight& light, const glm::dvec3& centreWorld,
  const Bounds& castersCentred, int mapSizeTexels)
{
  if (castersCentred.empty())
  {
    return {};
  }
  const glm::dmat4 rotation(lightFromWorldRotation(light.directionWorld));
  if (light.kind == LightKind::Directional)
  {
    return fitDirectional(transformed(castersCentred, rotation), rotation, mapSizeTexels);
  }
  const glm::dmat4 lightFromCentred =
    glm::translate(rotation, -(light.positionWorld - centreWorld));
  return fitSpot(
    light, transformed(castersCentred, lightFromCentred), lightFromCentred, mapSizeTexels);
}

} // namespace gnomon
