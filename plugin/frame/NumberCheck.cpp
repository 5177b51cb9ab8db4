#include "plugin/frame/NumberCheck.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>

namespace gnomon
{
namespace
{

constexpr double missPixels = 1.0 / 64.0;
constexpr double solidMissPixels = 1.0;
/// The last two digits of a 24-bit depth buffer.
constexpr double depthNoise = 4.0 / 16777216.0;
/// Rasterisers interpolate depths in float: on steep triangles they are off by more than corners
/// that move.
constexpr double interpolationPixels = 2.0;

class NumberComparison
{
public:
  NumberComparison(const Drawn& drawn, const NumberTruth& truth)
    : rays_(drawn.images.rays)
    , truth_(truth)
    , halfSize_(0.5 * glm::dvec2(drawn.images.width, drawn.images.height))
  {
    const glm::dvec3& column =
      this->rays_.parallel() ? this->rays_.originPerColumn : this->rays_.directionPerColumn;
    const glm::dvec3& row =
      this->rays_.parallel() ? this->rays_.originPerRow : this->rays_.directionPerRow;
    this->pixelSide_ = std::min(glm::length(column), glm::length(row));
  }

  bool agrees(const SeenTriangle& seen, double x, double y, std::size_t pixel) const
  {
    if (seen.solid)
    {
      return this->isSolidNear(*seen.solid, x, y);
    }
    const double t = seen.planeDistance.row(y).at(x) / seen.alongNormal.row(y).at(x);
    // In perspective a pixel's side grows with t. A triangle along the ray has no t, and agrees.
    const double side = this->rays_.parallel() ? this->pixelSide_ : t * this->pixelSide_;
    const double miss = missPixels + this->truth_.vertexNoise / side;
    const std::vector<float>& depths = this->truth_.windowDepths;
    return !(side > 0.0) ||
      (depthInside(seen, x, y) >= -miss &&
        (depths.empty() || this->isAt(seen, x, y, t, miss, depths[pixel])));
  }

private:
  /// Where a centred point is seen: in pixels from the centre of pixel (0, 0), and window depth.
  glm::dvec3 windowOf(const glm::dvec3& point) const
  {
    const glm::dvec4 clip = this->truth_.clipFromCentred * glm::dvec4(point, 1.0);
    const glm::dvec3 device = glm::dvec3(clip) / clip.w;
    return { (glm::dvec2(device) + 1.0) * this->halfSize_ - 0.5, 0.5 * device.z + 0.5 };
  }

  bool isSolidNear(const PlacedSolid& solid, double x, double y) const
  {
    const SolidPoint point =
      seenPoint(solid, this->rays_.origin(x, y), this->rays_.direction(x, y));
    return point.isMet ||
      glm::distance(glm::dvec2(this->windowOf(point.position)), glm::dvec2(x, y)) <=
      solidMissPixels;
  }

  /// The window depth of the triangle's plane.
  double depthAt(const SeenTriangle& seen, double x, double y) const
  {
    const double t = seen.planeDistance.row(y).at(x) / seen.alongNormal.row(y).at(x);
    return this->depthAlong(x, y, t);
  }

  double depthAlong(double x, double y, double t) const
  {
    return this->windowOf(this->rays_.origin(x, y) + t * this->rays_.direction(x, y)).z;
  }

  /// @param t of the pixel's ray
  bool isAt(const SeenTriangle& seen, double x, double y, double t, double missedPixels,
    double windowDepth) const
  {
    const double depth = this->depthAlong(x, y, t);
    const double slope = std::max(std::abs(this->depthAt(seen, x + missPixels, y) - depth),
                           std::abs(this->depthAt(seen, x, y + missPixels) - depth)) /
      missPixels;
    const double moved =
      this->truth_.vertexNoise / glm::length(this->rays_.direction(x, y)); // along the ray
    const double tolerance = depthNoise + (missedPixels + interpolationPixels) * slope +
      std::abs(this->depthAlong(x, y, t + moved) - depth);
    // Written so that a depth that is not a number agrees.
    return !(std::abs(windowDepth - depth) > tolerance);
  }

  const PixelRays& rays_;
  const NumberTruth& truth_;
  glm::dvec2 halfSize_;
  double pixelSide_; ///< at t = 1 in perspective
};

/// True if the images cannot hold all numbers of a surface, which is no fault of the driver.
bool exceedsImages(const DrawnSurface& surface)
{
  const DrawnSurface::Block& last = surface.blocks.back();
  return static_cast<double>(last.firstPrimitive) + last.primitiveCount > primitiveLimit;
}

NumberCheck emptyCheck(std::size_t surfaces)
{
  return { std::vector<std::int64_t>(surfaces), std::vector<std::int64_t>(surfaces) };
}

} // namespace

std::int64_t NumberCheck::allPixels() const
{
  return std::accumulate(this->pixels.begin(), this->pixels.end(), std::int64_t(0));
}

std::int64_t NumberCheck::allWrong() const
{
  return std::accumulate(this->wrong.begin(), this->wrong.end(), std::int64_t(0));
}

NumberCheck checkNumbers(const ReceiverImages& images, const NumberTruth& truth,
  const std::vector<DrawnSurface>& drawnSurfaces, const std::vector<std::uint8_t>& compared,
  const Occluders& occluders)
{
  const Drawn drawn(images, drawnSurfaces, occluders, nullptr, false);
  const NumberComparison comparison(drawn, truth);
  std::vector<std::uint8_t> looksAt(drawnSurfaces.size(), 0);
  for (std::size_t i = 0; i < std::min(compared.size(), drawnSurfaces.size()); ++i)
  {
    looksAt[i] = compared[i] != 0 && !exceedsImages(drawnSurfaces[i]) ? 1 : 0;
  }
  const auto width = static_cast<std::size_t>(images.width);
  const auto checkRows = [&](const tbb::blocked_range<std::size_t>& rows, NumberCheck check)
  {
    const auto cache = std::make_unique<SeenTriangles>();
    for (std::size_t i = rows.begin() * width; i != rows.end() * width; ++i)
    {
      const glm::vec2& fragment = images.fragments[i];
      const auto number = static_cast<std::size_t>(std::abs(fragment.x));
      if (number == 0 || number > looksAt.size() || looksAt[number - 1] == 0)
      {
        continue;
      }
      ++check.pixels[number - 1];
      const SeenTriangle& seen = cache->find(drawn, fragment);
      if (!seen.finite ||
        !comparison.agrees(seen, static_cast<double>(i % width), static_cast<double>(i / width), i))
      {
        ++check.wrong[number - 1];
      }
    }
    return check;
  };
  const auto join = [](NumberCheck a, const NumberCheck& b)
  {
    const auto add = [](std::vector<std::int64_t>& to, const std::vector<std::int64_t>& from)
    { std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>()); };
    add(a.pixels, b.pixels);
    add(a.wrong, b.wrong);
    return a;
  };
  return tbb::parallel_reduce(
    tbb::blocked_range<std::size_t>(0, static_cast<std::size_t>(images.height), 64),
    emptyCheck(drawnSurfaces.size()), checkRows, join);
}

} // namespace gnomon
