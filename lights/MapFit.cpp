#include "lights/MapFit.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// A range along one axis of a map.
struct Interval
{
  double lower;
  double upper;
  double length() const { return this->upper - this->lower; }
  double centre() const { return 0.5 * (this->upper + this->lower); }
};

std::optional<Interval> visibleInterval(const Interval& visible, const Interval& covered)
{
  const Interval cut{ std::max(visible.lower, covered.lower),
    std::min(visible.upper, covered.upper) };
  if (!(cut.lower <= cut.upper))
  {
    return std::nullopt; // also where a bound is not a number
  }
  const double least = leastVisibleShare * covered.length();
  if (cut.length() >= least)
  {
    return cut;
  }
  const double lower = std::clamp(cut.centre() - 0.5 * least, covered.lower, covered.upper - least);
  return Interval{ lower, lower + least };
}

/// Fit each axis separately.
/// @param axisFit returns scale and offset for the visible and the covered interval
template <typename AxisFit>
std::optional<MapFit> fitAxes(
  const Rectangle& visible, const Rectangle& covered, const AxisFit& axisFit)
{
  MapFit result;
  for (int axis = 0; axis < 2; ++axis)
  {
    const Interval all{ covered.lower[axis], covered.upper[axis] };
    const auto seen = visibleInterval({ visible.lower[axis], visible.upper[axis] }, all);
    if (!seen)
    {
      return std::nullopt;
    }
    const auto [scale, offset] = axisFit(*seen, all);
    result.scale[axis] = scale;
    result.offset[axis] = offset;
  }
  return result;
}

} // namespace

Rectangle rangeOf(const glm::dmat3& mapFromAcross, const std::vector<glm::dvec2>& across)
{
  Rectangle result;
  for (const glm::dvec2& point : across)
  {
    result.add(mapped(mapFromAcross, point));
  }
  return result;
}

glm::dmat3 uniformFromRange(const Rectangle& range)
{
  if (range.empty())
  {
    return glm::dmat3(1.0);
  }
  const glm::dvec2 size = glm::max(glm::abs(range.lower), glm::abs(range.upper));
  const double largest = std::max(size.x, size.y);
  const double least = largest > 0.0 ? 1e-9 * largest : 1.0;
  const glm::dvec2 half = glm::max(0.5 * (range.upper - range.lower), glm::dvec2(least));
  MapFit fit;
  fit.scale = 1.0 / half;
  fit.offset = -fit.scale * 0.5 * (range.upper + range.lower);
  return fit.matrix();
}

glm::dmat3 uniformFromAcross(const std::vector<glm::dvec2>& across)
{
  return uniformFromRange(rangeOf(glm::dmat3(1.0), across));
}

double MapTexels::inside() const
{
  return std::max(1.0 - 2.0 * this->border / this->side, 0.5);
}

Rectangle MapTexels::covered() const
{
  return { wholeMap.lower / this->inside(), wholeMap.upper / this->inside() };
}

std::optional<MapFit> fitTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered)
{
  const double inside = texels.inside();
  return fitAxes(visible, covered,
    [inside](const Interval& seen, const Interval&)
    {
      const double scale = 2.0 * inside / seen.length();
      return std::pair(scale, -scale * seen.centre());
    });
}

std::optional<MapFit> fitSnappedTo(
  const Rectangle& visible, const MapTexels& texels, const Rectangle& covered)
{
  const double halfTexel = 1.0 / texels.side;
  const double inside = texels.inside() - halfTexel;
  return fitAxes(visible, covered,
    [inside, halfTexel](const Interval& seen, const Interval& all)
    {
      const double steps = std::floor(4.0 * std::log2(all.length() / seen.length()));
      const double scale = 2.0 * inside / all.length() * std::exp2(0.25 * steps);
      const double texel = 2.0 * halfTexel;
      return std::pair(scale, std::round(-scale * seen.centre() / texel) * texel);
    });
}

} // namespace gnomon
