#include "shadowtech/base/NumberCheck.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

namespace gnomon
{
namespace
{

constexpr double missPixels = 1.0 / 64.0;
constexpr double solidMissPixels = 1.0;
/// The last two bits of a 24-bit depth buffer, and VTK's usual polygon offset: 2 units, and twice
/// the slope.
constexpr double depthNoise = 4.0 / 16777216.0;
constexpr double offsetPixels = 2.0;

class NumberComparison
{
public:
  NumberComparison(const Drawn& drawn, const glm::dmat4& clipFromCentred)
    : rays_(drawn.images.rays)
    , clipFromCentred_(clipFromCentred)
    , halfSize_(0.5 * glm::dvec2(drawn.images.width, drawn.images.height))
  {
  }

  bool isThere(const SeenTriangle& seen, double x, double y) const
  {
    return seen.solid ? this->isSolidNear(*seen.solid, x, y) : isInside(seen, x, y);
  }

  bool isAt(const SeenTriangle& seen, double x, double y, double windowDepth) const
  {
    if (seen.solid)
    {
      return true;
    }
    const double depth = this->depthAt(seen, x, y);
    const double slope = std::max(std::abs(this->depthAt(seen, x + missPixels, y) - depth),
                           std::abs(this->depthAt(seen, x, y + missPixels) - depth)) /
      missPixels;
    // Written so that a triangle along the ray, whose depth is not a number, agrees.
    return !(std::abs(windowDepth - depth) > depthNoise + (missPixels + offsetPixels) * slope);
  }

private:
  /// Return where the camera sees a centred point: in pixels from the centre of pixel (0, 0), and
  /// the window depth.
  glm::dvec3 windowOf(const glm::dvec3& point) const
  {
    const glm::dvec4 clip = this->clipFromCentred_ * glm::dvec4(point, 1.0);
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

  static bool isInside(const SeenTriangle& seen, double x, double y)
  {
    return std::all_of(seen.insideEdge.begin(), seen.insideEdge.end(),
      [&](const AffineOverPixels& edge)
      {
        const double perPixel = std::hypot(edge.perColumn, edge.perRow);
        return edge.first + x * edge.perColumn + y * edge.perRow >= -missPixels * perPixel;
      });
  }

  double depthAt(const SeenTriangle& seen, double x, double y) const
  {
    const double t = seen.planeDistance.row(y).at(x) / seen.alongNormal.row(y).at(x);
    return this->windowOf(this->rays_.origin(x, y) + t * this->rays_.direction(x, y)).z;
  }

  const PixelRays& rays_;
  glm::dmat4 clipFromCentred_;
  glm::dvec2 halfSize_;
};

} // namespace

//------------------------------------------------------------------------------
NumberCheck checkNumbers(const ReceiverImages& images, const std::vector<float>& windowDepths,
  const std::vector<DrawnSurface>& drawnSurfaces, const std::vector<std::uint8_t>& compared,
  const Occluders& occluders, const glm::dmat4& clipFromCentred)
{
  const Drawn drawn(images, drawnSurfaces, occluders, nullptr, nullptr);
  const NumberComparison comparison(drawn, clipFromCentred);
  const auto width = static_cast<std::size_t>(images.width);
  const auto checkRows = [&](const tbb::blocked_range<std::size_t>& rows, NumberCheck check)
  {
    const auto cache = std::make_unique<SeenTriangles>();
    for (std::size_t i = rows.begin() * width; i != rows.end() * width; ++i)
    {
      const glm::vec2& fragment = images.fragments[i];
      const auto surface = static_cast<std::size_t>(std::abs(fragment.x));
      // Numbers too large for the images are not the driver's fault.
      if (surface == 0 || surface > compared.size() || compared[surface - 1] == 0 ||
        fragment.y >= primitiveLimit)
      {
        continue;
      }
      ++check.pixels;
      const SeenTriangle& seen = cache->find(drawn, fragment);
      const auto x = static_cast<double>(i % width);
      const auto y = static_cast<double>(i / width);
      if (!seen.finite || !comparison.isThere(seen, x, y) ||
        (!windowDepths.empty() && !comparison.isAt(seen, x, y, windowDepths[i])))
      {
        ++check.wrong;
      }
    }
    return check;
  };
  return tbb::parallel_reduce(
    tbb::blocked_range<std::size_t>(0, static_cast<std::size_t>(images.height)), NumberCheck{},
    checkRows,
    [](const NumberCheck& a, const NumberCheck& b) {
      return NumberCheck{ a.pixels + b.pixels, a.wrong + b.wrong };
    });
}

} // namespace gnomon
