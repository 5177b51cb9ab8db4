#ifndef gnomon_shadowtech_conservative_CasterPlacements_h
#define gnomon_shadowtech_conservative_CasterPlacements_h

#include "shadowtech/base/Occluders.h"
#include "shadowtech/conservative/CasterShapes.h"
#include "shadowtech/conservative/TexelCells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// @file
/// All that casts, in a form in which maps are drawn on the CPU: on all cores, first which rows each
/// triangle lies in, then the rows, band by band.

/// A casting surface, or one instance of it.
struct Placement
{
  std::uint32_t surface;
  std::uint32_t instance;
  std::size_t firstTriangle; ///< of its triangles among those of all placements
};

/// All casting surfaces and instances of a snapshot, those left out excepted.
class CasterPlacements
{
public:
  explicit CasterPlacements(const Occluders& occluders);

  const Placement& operator[](std::size_t i) const { return this->placements_[i]; }
  std::size_t triangleCount() const { return this->triangleCount_; }
  const Surface& surfaceOf(const Placement& placement) const
  {
    return this->occluders_.surfaces[placement.surface];
  }

  /// Visits things of all placements on all cores.
  /// @param countOf how many things a placement has
  /// @param visit called with the placement's number and the thing's
  template <typename CountOf, typename Visit>
  void visitAll(const CountOf& countOf, const Visit& visit) const
  {
    tbb::parallel_for(std::uint32_t(0), static_cast<std::uint32_t>(this->placements_.size()),
      [&](std::uint32_t placement)
      {
        const auto count = static_cast<std::uint32_t>(countOf(this->placements_[placement]));
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 1024),
          [&](const tbb::blocked_range<std::uint32_t>& range)
          {
            for (std::uint32_t i = range.begin(); i != range.end(); ++i)
            {
              visit(placement, i);
            }
          });
      });
  }
  /// The same of their triangles.
  /// @param visit called with the placement's number and the triangle's in its surface
  template <typename Visit>
  void visitTriangles(const Visit& visit) const
  {
    this->visitAll([this](const Placement& placement)
      { return this->surfaceOf(placement).triangleCount; },
      visit);
  }

private:
  const Occluders& occluders_;
  std::vector<Placement> placements_;
  std::size_t triangleCount_ = 0;
};

/// What lies in one band of rows.
struct BandItem
{
  std::uint32_t placement;
  std::uint32_t index; ///< a triangle of the snapshot, or an edge of the surface
};
using Bands = std::vector<std::vector<BandItem>>;

/// Rows of a map that are drawn at once, so that their texels stay in the processor's cache.
constexpr int bandRows = 16;

constexpr int bandsOf(int sizeTexels)
{
  return (sizeTexels + bandRows - 1) / bandRows;
}
inline Span rowsOfBand(int band, int sizeTexels)
{
  return { band * bandRows, std::min((band + 1) * bandRows, sizeTexels) - 1 };
}

/// Visits the bands that a range of texel rows meets.
template <typename Visit>
void visitBands(double low, double high, double margin, int size, const Visit& visit)
{
  const Span rows = spanOf(low - margin, high + margin, size);
  for (int band = rows.first / bandRows; band <= rows.last / bandRows && rows.first <= rows.last;
       ++band)
  {
    visit(static_cast<std::size_t>(band));
  }
}

/// Visits the bands that a polygon meets; it has corners.
template <typename Visit>
void visitBands(const MapPolygon& polygon, double margin, int size, const Visit& visit)
{
  double low = polygon.corners[0].y;
  double high = low;
  for (std::size_t k = 1; k < polygon.count; ++k)
  {
    low = std::min(low, polygon.corners[k].y);
    high = std::max(high, polygon.corners[k].y);
  }
  visitBands(low, high, margin, size, visit);
}

} // namespace gnomon

#endif
