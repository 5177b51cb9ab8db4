#include "lights/CasterViews.h"

#include "lights/MapFit.h"
#include "lights/VisibleBody.h"

#include <algorithm>

namespace gnomon
{
namespace
{

struct SlopeInterval
{
  double lower;
  double upper;
};

SlopeInterval within(const SlopeInterval& interval, double limit)
{
  return { std::max(interval.lower, -limit), std::min(interval.upper, limit) };
}

bool empty(const SlopeInterval& interval)
{
  return !(interval.lower <= interval.upper);
}

double halfOf(const SlopeInterval& interval)
{
  return empty(interval) ? 0.0 : 0.5 * (interval.upper - interval.lower);
}

SlopeInterval around(const SlopeInterval& interval, double half)
{
  const double middle = 0.5 * (interval.lower + interval.upper);
  return { middle - half, middle + half };
}

/// Return the slopes x/z of points with x in `across` and z in `along` (> 0).
SlopeInterval slopesOf(const SlopeInterval& across, const SlopeInterval& along)
{
  return { across.lower / (across.lower < 0.0 ? along.lower : along.upper),
    across.upper / (across.upper > 0.0 ? along.lower : along.upper) };
}

/// The casters in front of a light, in the space of a view.
struct Casters
{
  SlopeInterval distances;             ///< along the view, > 0
  std::array<SlopeInterval, 2> slopes; ///< x/z and y/z
};

/// Return the casters' distances and slopes; nothing if all casters lie behind the light.
std::optional<Casters> castersInFront(const Bounds& castersView)
{
  const glm::dvec3& lower = castersView.lower;
  const glm::dvec3& upper = castersView.upper;
  if (!(upper.z > 0.0))
  {
    return std::nullopt;
  }
  // A caster may touch the light. So near stays positive, but far below the depth resolution at the
  // far end. A small near plane costs linear depth no precision, unlike z/w.
  const SlopeInterval distances{ std::max(lower.z, nearestShare * upper.z), upper.z };
  return Casters{ distances,
    { { slopesOf({ lower.x, upper.x }, distances), slopesOf({ lower.y, upper.y }, distances) } } };
}

/// Return the view of a positional light whose map spans these slopes.
LightView perspectiveView(const SlopeInterval& distances,
  const std::array<SlopeInterval, 2>& slopes, const glm::dmat4& viewFromCentred)
{
  LightView view;
  view.rays.viewFromCentred = viewFromCentred;
  view.rays.positional = true;
  view.mapFromAcross = uniformFromRange(
    { { slopes[0].lower, slopes[1].lower }, { slopes[0].upper, slopes[1].upper } });
  view.depthScale = 1.0 / (distances.upper * (1.0 + roomBehindCasters));
  view.beginsAt = distances.lower * 0.999; // so that rounding cuts no caster off
  return view;
}

/// Return the slopes that a cube face's map spans along an axis, without its border. They hold the
/// casters on the face, and those beyond its edges that a technique reads: up to a border's width.
/// @param casters their slopes
/// @param least lower limit of half the span
/// @return nothing if no caster is read
std::optional<SlopeInterval> spanOfFace(const SlopeInterval& casters, double least, double inside)
{
  const double half = std::max(halfOf(within(casters, 1.0)), least) + 1e-6;
  const double border = half / inside - half;
  const SlopeInterval seen = within(casters, 1.0 + border);
  if (empty(seen))
  {
    return std::nullopt;
  }
  const SlopeInterval read = within({ seen.lower - border, seen.upper + border }, 1.0 + border);
  return around(read, half);
}

} // namespace

LightView parallelCasterView(
  const Bounds& castersView, double radius, const glm::dmat4& viewFromCentred)
{
  const double smallest = 1e-6 * std::max(radius, 1e-300);
  const glm::dvec3 widening(smallest);
  const glm::dvec3 lower = castersView.lower - widening;
  const glm::dvec3 upper = castersView.upper + widening;
  // Depths are compared relative to this range, so flat boxes get a deeper one.
  const double depth = std::max((1.0 + roomBehindCasters) * (upper.z - lower.z), radius);

  LightView view;
  view.rays.viewFromCentred = viewFromCentred;
  view.mapFromAcross = uniformFromRange({ lower, upper });
  view.depthScale = 1.0 / depth;
  view.depthOffset = -lower.z / depth;
  return view;
}

std::optional<LightView> spotCasterView(
  const Bounds& castersView, const glm::dmat4& viewFromCentred, double slopeLimit)
{
  const std::optional<Casters> casters = castersInFront(castersView);
  if (!casters)
  {
    return std::nullopt;
  }
  std::array<SlopeInterval, 2> slopes{};
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const SlopeInterval seen = within(casters->slopes[axis], slopeLimit);
    if (empty(seen))
    {
      return std::nullopt; // the light misses all casters
    }
    slopes[axis] = around(seen, halfOf(seen) + 1e-6 * slopeLimit);
  }
  return perspectiveView(casters->distances, slopes, viewFromCentred);
}

std::array<std::optional<LightView>, cubeFaces> cubeCasterViews(
  const Bounds& castersLight, const glm::dmat4& lightFromCentred, double inside)
{
  std::array<std::optional<Casters>, cubeFaces> castersOfFace;
  double widest = 0.0; // half of the largest span
  for (int face = 0; face < cubeFaces; ++face)
  {
    const auto casters =
      castersInFront(affinelyTransformed(castersLight, glm::dmat4(cubeFaceFromLight(face))));
    castersOfFace[static_cast<std::size_t>(face)] = casters;
    if (casters && !empty(within(casters->slopes[0], 1.0)) &&
      !empty(within(casters->slopes[1], 1.0)))
    {
      widest = std::max({ widest, halfOf(within(casters->slopes[0], 1.0)),
        halfOf(within(casters->slopes[1], 1.0)) });
    }
  }
  std::array<std::optional<LightView>, cubeFaces> views;
  for (int face = 0; face < cubeFaces; ++face)
  {
    const std::optional<Casters>& casters = castersOfFace[static_cast<std::size_t>(face)];
    if (!casters)
    {
      continue;
    }
    const auto nearsEdge = [&](const SlopeInterval& slopes)
    { return slopes.lower < -inside || slopes.upper > inside; };
    const bool atEdge = nearsEdge(casters->slopes[0]) || nearsEdge(casters->slopes[1]);
    const double least = atEdge ? 0.5 * widest : 0.0;
    const std::optional<SlopeInterval> x = spanOfFace(casters->slopes[0], least, inside);
    const std::optional<SlopeInterval> y = spanOfFace(casters->slopes[1], least, inside);
    if (x && y)
    {
      views[static_cast<std::size_t>(face)] = perspectiveView(
        casters->distances, { { *x, *y } }, glm::dmat4(cubeFaceFromLight(face)) * lightFromCentred);
    }
  }
  return views;
}

} // namespace gnomon
