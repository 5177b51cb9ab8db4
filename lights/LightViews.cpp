#include "lights/LightViews.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon
{
namespace
{

Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix)
{
  Bounds result;
  for (const glm::dvec3& corner : bounds.corners())
  {
    result.add(glm::dvec3(matrix * glm::dvec4(corner, 1.0)));
  }
  return result;
}

struct Interval
{
  double lower;
  double upper;
};

/// The share of a view's side between its borders, of which the casters get at least a half.
double shareInside(int mapSizeTexels, int borderTexels)
{
  return std::max(1.0 - 2.0 * borderTexels / mapSizeTexels, 0.5);
}

/// Maps an interval to [-1, 1] less the borders on either side.
struct Axis
{
  double scale;
  double offset;
};
Axis fitAxis(const Interval& interval, double inside)
{
  const double half = 0.5 * (interval.upper - interval.lower);
  const double scale = inside / half;
  return { scale, -scale * 0.5 * (interval.upper + interval.lower) };
}

/// @param castersView what to cover; not empty
/// @param radius of all casters: what their positions are rounded in proportion to
LightView fitParallel(
  const Bounds& castersView, double radius, const glm::dmat4& viewFromCentred, double inside)
{
  const double smallest = 1e-6 * std::max(radius, 1e-300);
  const glm::dvec3 widening(smallest);
  const glm::dvec3 lower = castersView.lower - widening;
  const glm::dvec3 upper = castersView.upper + widening;
  // Depths are compared relative to this range: flat boxes get a deeper one.
  const double depth = std::max((1.0 + roomBehindCasters) * (upper.z - lower.z), radius);

  LightView view;
  view.viewFromCentred = viewFromCentred;
  view.depthScale = 1.0 / depth;
  view.depthOffset = -lower.z / depth;
  const Axis x = fitAxis({ lower.x, upper.x }, inside);
  const Axis y = fitAxis({ lower.y, upper.y }, inside);
  view.clipFromView = glm::dmat4(glm::dvec4(x.scale, 0.0, 0.0, 0.0),
    glm::dvec4(0.0, y.scale, 0.0, 0.0), glm::dvec4(0.0, 0.0, 2.0 * view.depthScale, 0.0),
    glm::dvec4(x.offset, y.offset, 2.0 * view.depthOffset - 1.0, 1.0));
  return view;
}

/// The slopes x/z of the points with x in `across`, z in `along` (> 0), as far as they lie within
/// the limit; lower > upper where none does.
Interval slopesOf(const Interval& across, const Interval& along, double limit)
{
  const double lower = across.lower / (across.lower < 0.0 ? along.lower : along.upper);
  const double upper = across.upper / (across.upper > 0.0 ? along.lower : along.upper);
  return { std::max(lower, -limit), std::min(upper, limit) };
}

/// @param slopeLimit the largest |x/z| and |y/z| of what the light reaches
/// @return nothing where no caster can be seen
std::optional<LightView> fitPerspective(
  const Bounds& castersView, const glm::dmat4& viewFromCentred, double slopeLimit, double inside)
{
  const double farthest = castersView.upper.z;
  if (!(farthest > 0.0))
  {
    return std::nullopt; // all casters lie behind the light
  }
  // A caster may touch the light: near stays positive, but well below anything that can be told
  // apart at the far end. Linear depth does not suffer from a small near plane as z/w does.
  const double nearest = std::max(castersView.lower.z, 1e-5 * farthest);
  const glm::dvec3& lower = castersView.lower;
  const glm::dvec3& upper = castersView.upper;
  Interval slopesX = slopesOf({ lower.x, upper.x }, { nearest, farthest }, slopeLimit);
  Interval slopesY = slopesOf({ lower.y, upper.y }, { nearest, farthest }, slopeLimit);
  if (!(slopesX.lower <= slopesX.upper && slopesY.lower <= slopesY.upper))
  {
    return std::nullopt; // the light misses all casters
  }
  const double smallest = 1e-6 * slopeLimit;
  const Axis x = fitAxis({ slopesX.lower - smallest, slopesX.upper + smallest }, inside);
  const Axis y = fitAxis({ slopesY.lower - smallest, slopesY.upper + smallest }, inside);
  // clip = (x.scale X + x.offset Z, ..., a Z + b, Z) with z/w = -1 at near and 1 at far; near is
  // moved by a thousandth so that rounding clips no caster.
  const double n = nearest * 0.999;
  const double f = farthest * (1.0 + roomBehindCasters);
  LightView view;
  view.viewFromCentred = viewFromCentred;
  view.perspective = true;
  view.clipFromView = glm::dmat4(glm::dvec4(x.scale, 0.0, 0.0, 0.0),
    glm::dvec4(0.0, y.scale, 0.0, 0.0), glm::dvec4(x.offset, y.offset, (f + n) / (f - n), 1.0),
    glm::dvec4(0.0, 0.0, -2.0 * f * n / (f - n), 0.0));
  view.depthScale = 1.0 / f;
  return view;
}

/// Directional lights: the casters, and of a box only what lies in it.
void fitDirectional(Bounds castersLight, bool hasBox, double inside, LightViews& result)
{
  const double radius = castersLight.radius();
  if (!hasBox)
  {
    // Depths are told apart best where they are small.
    result.lightFromCentred =
      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -castersLight.lower.z)) *
      result.lightFromCentred;
    castersLight.upper.z -= castersLight.lower.z;
    castersLight.lower.z = 0.0;
    result.views = { fitParallel(castersLight, radius, result.lightFromCentred, inside) };
    return;
  }
  const glm::dvec3& box = result.box;
  const bool beginsAtNear = castersLight.lower.z < 0.0;
  castersLight.lower = glm::max(castersLight.lower, glm::dvec3(-box.x, -box.y, 0.0));
  castersLight.upper = glm::min(castersLight.upper, box);
  if (!castersLight.empty())
  {
    result.views = { fitParallel(castersLight, radius, result.lightFromCentred, inside) };
    result.views.front().beginsAtNear = beginsAtNear;
  }
}

void fitCube(const Bounds& castersLight, double inside, LightViews& result)
{
  for (int face = 0; face < cubeFaces; ++face)
  {
    const glm::dmat4 faceFromLight(cubeFaceFromLight(face));
    if (const auto view = fitPerspective(transformed(castersLight, faceFromLight),
          faceFromLight * result.lightFromCentred, 1.0, inside))
    {
      result.viewOfFace[static_cast<std::size_t>(face)] = static_cast<int>(result.views.size());
      result.views.push_back(*view);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
ViewLayout viewLayout(const ShadowLight& light)
{
  const bool wide =
    light.kind == LightKind::Spot && light.coneAngleDegrees > largestSingleViewConeDegrees;
  return wide || light.kind == LightKind::Point ? ViewLayout::Cube : ViewLayout::Single;
}

//------------------------------------------------------------------------------
LightViews fitLightViews(const ShadowLight& light, const glm::dvec3& centreWorld,
  const Bounds& castersCentred, int mapSizeTexels, int borderTexels)
{
  const double inside = shareInside(mapSizeTexels, borderTexels);
  LightViews result;
  result.layout = viewLayout(light);
  result.lightFromCentred = lightFromCentred(light, centreWorld);
  const double coneTangent = std::tan(glm::radians(light.coneAngleDegrees));
  if (light.kind == LightKind::Spot)
  {
    result.coneTangentSquared = coneTangent * coneTangent;
  }
  if (light.box)
  {
    result.box = { 0.5 * light.box->width, 0.5 * light.box->height, light.box->depth };
  }
  if (castersCentred.empty())
  {
    return result;
  }
  Bounds castersLight = transformed(castersCentred, result.lightFromCentred);
  if (light.kind == LightKind::Directional)
  {
    fitDirectional(castersLight, light.box.has_value(), inside, result);
  }
  else if (result.layout == ViewLayout::Single)
  {
    if (const auto view =
          fitPerspective(castersLight, result.lightFromCentred, coneTangent, inside))
    {
      result.views = { *view };
    }
  }
  else
  {
    if (light.kind == LightKind::Spot)
    {
      castersLight.lower.z = std::max(castersLight.lower.z, 0.0); // no cone reaches behind itself
    }
    if (!castersLight.empty())
    {
      fitCube(castersLight, inside, result);
    }
  }
  return result;
}

} // namespace gnomon
