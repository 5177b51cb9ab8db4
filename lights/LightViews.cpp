#include "lights/LightViews.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
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

/// The slopes x/z of the points with x in `across`, z in `along` (> 0).
Interval slopesOf(const Interval& across, const Interval& along)
{
  return { across.lower / (across.lower < 0.0 ? along.lower : along.upper),
    across.upper / (across.upper > 0.0 ? along.lower : along.upper) };
}

Interval within(const Interval& interval, double limit)
{
  return { std::max(interval.lower, -limit), std::min(interval.upper, limit) };
}

bool empty(const Interval& interval)
{
  return !(interval.lower <= interval.upper);
}

double halfOf(const Interval& interval)
{
  return empty(interval) ? 0.0 : 0.5 * (interval.upper - interval.lower);
}

/// The casters in front of a light, in the space of a view.
struct Casters
{
  Interval distances;             ///< along the view, > 0
  std::array<Interval, 2> slopes; ///< x/z and y/z
};

/// @return nothing where all of them lie behind the light
std::optional<Casters> castersInFront(const Bounds& castersView)
{
  const glm::dvec3& lower = castersView.lower;
  const glm::dvec3& upper = castersView.upper;
  if (!(upper.z > 0.0))
  {
    return std::nullopt;
  }
  // A caster may touch the light: near stays positive, but well below anything that can be told
  // apart at the far end. Linear depth does not suffer from a small near plane as z/w does.
  const Interval distances{ std::max(lower.z, 1e-5 * upper.z), upper.z };
  return Casters{ distances,
    { { slopesOf({ lower.x, upper.x }, distances), slopesOf({ lower.y, upper.y }, distances) } } };
}

/// The view of a positional light whose map spans these slopes.
LightView makePerspective(const Interval& distances, const std::array<Interval, 2>& slopes,
  const glm::dmat4& viewFromCentred)
{
  const Axis x = fitAxis(slopes[0], 1.0);
  const Axis y = fitAxis(slopes[1], 1.0);
  // clip = (x.scale X + x.offset Z, ..., a Z + b, Z) with z/w = -1 at near and 1 at far; near is
  // moved by a thousandth so that rounding clips no caster.
  const double n = distances.lower * 0.999;
  const double f = distances.upper * (1.0 + roomBehindCasters);
  LightView view;
  view.viewFromCentred = viewFromCentred;
  view.perspective = true;
  view.clipFromView = glm::dmat4(glm::dvec4(x.scale, 0.0, 0.0, 0.0),
    glm::dvec4(0.0, y.scale, 0.0, 0.0), glm::dvec4(x.offset, y.offset, (f + n) / (f - n), 1.0),
    glm::dvec4(0.0, 0.0, -2.0 * f * n / (f - n), 0.0));
  view.depthScale = 1.0 / f;
  return view;
}

/// @param slopeLimit the largest |x/z| and |y/z| of what the light reaches
/// @return nothing where no caster can be seen
std::optional<LightView> fitPerspective(
  const Bounds& castersView, const glm::dmat4& viewFromCentred, double slopeLimit, double inside)
{
  const std::optional<Casters> casters = castersInFront(castersView);
  if (!casters)
  {
    return std::nullopt;
  }
  std::array<Interval, 2> slopes{};
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const Interval seen = within(casters->slopes[axis], slopeLimit);
    if (empty(seen))
    {
      return std::nullopt; // the light misses all casters
    }
    const double half = (halfOf(seen) + 1e-6 * slopeLimit) / inside;
    const double middle = 0.5 * (seen.lower + seen.upper);
    slopes[axis] = { middle - half, middle + half };
  }
  return makePerspective(casters->distances, slopes, viewFromCentred);
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

/// What the map of a cube's face spans along an axis: the casters on the face and those that a
/// technique reads across its edges, which are as far away as the map's border is wide.
/// @param casters slopes
/// @param least half of what the map spans at least, without the border
/// @return nothing where no caster is read
std::optional<Interval> spanOfFace(const Interval& casters, double least, double inside)
{
  const double half = std::max(halfOf(within(casters, 1.0)), least) + 1e-6;
  const double halfOfMap = half / inside;
  const double border = halfOfMap - half;
  const Interval seen = within(casters, 1.0 + border);
  if (empty(seen))
  {
    return std::nullopt;
  }
  const Interval read = within({ seen.lower - border, seen.upper + border }, 1.0 + border);
  const double middle = 0.5 * (read.lower + read.upper);
  return Interval{ middle - halfOfMap, middle + halfOfMap };
}

/// A technique's kernel is as wide as the texels make it, and so should they be on both sides of a
/// face's edge. The maps of faces with casters near an edge have texels no smaller than half of the
/// largest ones; faces whose only casters are beyond the edge, too, which see them for that reason.
void fitCube(const Bounds& castersLight, double inside, LightViews& result)
{
  std::array<std::optional<Casters>, cubeFaces> castersOfFace;
  double widest = 0.0; // half of the largest span
  for (int face = 0; face < cubeFaces; ++face)
  {
    const auto casters =
      castersInFront(transformed(castersLight, glm::dmat4(cubeFaceFromLight(face))));
    castersOfFace[static_cast<std::size_t>(face)] = casters;
    if (casters && !empty(within(casters->slopes[0], 1.0)) &&
      !empty(within(casters->slopes[1], 1.0)))
    {
      widest = std::max({ widest, halfOf(within(casters->slopes[0], 1.0)),
        halfOf(within(casters->slopes[1], 1.0)) });
    }
  }
  for (int face = 0; face < cubeFaces; ++face)
  {
    const std::optional<Casters>& casters = castersOfFace[static_cast<std::size_t>(face)];
    if (!casters)
    {
      continue;
    }
    const auto nearsEdge = [&](const Interval& slopes)
    { return slopes.lower < -inside || slopes.upper > inside; };
    const bool atEdge = nearsEdge(casters->slopes[0]) || nearsEdge(casters->slopes[1]);
    const double least = atEdge ? 0.5 * widest : 0.0;
    const std::optional<Interval> x = spanOfFace(casters->slopes[0], least, inside);
    const std::optional<Interval> y = spanOfFace(casters->slopes[1], least, inside);
    if (x && y)
    {
      const glm::dmat4 faceFromLight(cubeFaceFromLight(face));
      result.viewOfFace[static_cast<std::size_t>(face)] = static_cast<int>(result.views.size());
      result.views.push_back(makePerspective(
        casters->distances, { { *x, *y } }, faceFromLight * result.lightFromCentred));
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
