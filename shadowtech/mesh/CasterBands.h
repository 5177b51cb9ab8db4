#pragma once

#include "shadowtech/base/Occluders.h"
#include "shadowtech/mesh/TexelRows.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// @file
/// Conservative maps are rasterized on all cores in two steps. The first sorts casters into bands
/// of rows. The second rasterizes each band on one core, so its texels stay in the processor's
/// cache.

/// A casting surface, or one instance of it.
struct Placement
{
  std::uint32_t surface;
  std::uint32_t instance;
  std::size_t firstTriangle; ///< number of its first triangle among the triangles of all placements
};

/// All placements of the casting surfaces of a snapshot.
class CasterPlacements
{
public:
  /// @param occluders must outlive this
  explicit CasterPlacements(const Occluders& occluders)
    : occluders_(occluders)
  {
    for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
    {
      const Surface& surface = occluders.surfaces[i];
      const std::size_t instances = surface.isInstanced() ? surface.centredFromSource.size() : 1;
      for (std::size_t instance = 0; surface.casts && instance < instances; ++instance)
      {
        if (!surface.isInstanced() || !Surface::isLeftOut(surface.centredFromSource[instance]))
        {
          this->placements_.push_back({ static_cast<std::uint32_t>(i),
            static_cast<std::uint32_t>(instance), this->triangleCount_ });
          this->triangleCount_ += surface.triangleCount;
        }
      }
    }
  }

  std::size_t triangleCount() const { return this->triangleCount_; }
  const Placement& operator[](std::uint32_t placement) const
  {
    return this->placements_[placement];
  }
  const Surface& surfaceOf(const Placement& placement) const
  {
    return this->occluders_.surfaces[placement.surface];
  }
  /// Return a triangle's number among the triangles of all placements.
  /// @param triangle number in the snapshot
  std::size_t numberOf(const Placement& placement, std::uint32_t triangle) const
  {
    return placement.firstTriangle + (triangle - this->surfaceOf(placement).firstTriangle);
  }

  /// Visit items of all placements on all cores.
  /// @param countOf returns how many items a placement has
  /// @param visit called with the placement's number and the item's number, from several threads
  template <typename CountOf, typename Visit>
  void visitAll(const CountOf& countOf, const Visit& visit) const
  {
    tbb::parallel_for(std::uint32_t(0), static_cast<std::uint32_t>(this->placements_.size()),
      [&](std::uint32_t placement)
      {
        const auto count = static_cast<std::uint32_t>(countOf(this->placements_[placement]));
        tbb::parallel_for(std::uint32_t(0), count, [&](std::uint32_t i) { visit(placement, i); });
      });
  }
  /// Visit all casting triangles by their numbers in the snapshot, once per placement.
  template <typename Visit>
  void visitTriangles(const Visit& visit) const
  {
    this->visitAll([this](const Placement& placement)
      { return this->surfaceOf(placement).triangleCount; },
      [&](std::uint32_t placement, std::uint32_t i)
      { visit(placement, this->surfaceOf(this->placements_[placement]).firstTriangle + i); });
  }

private:
  const Occluders& occluders_;
  std::vector<Placement> placements_;
  std::size_t triangleCount_ = 0;
};

/// A triangle or an edge in a band of rows.
struct BandItem
{
  std::uint32_t placement;
  std::uint32_t index; ///< of a triangle in the snapshot, or of an edge in its surface
};

/// Items sorted into bands of rows. Several threads may add at once.
class CasterBands
{
public:
  static constexpr int rows = 16; ///< per band

  /// @param size side of the map, in texels
  explicit CasterBands(int size)
    : size_(size)
    , lists_([size] { return Lists(static_cast<std::size_t>((size + rows - 1) / rows)); })
  {
  }

  /// Add an item to all bands that it touches.
  /// @param low, high the item's least and largest y on the map, in texels
  void add(double low, double high, const BandItem& item)
  {
    const Span span = spanOf(low, high, this->size_);
    Lists& lists = this->lists_.local();
    for (int band = span.first / rows; band <= span.last / rows && span.first <= span.last; ++band)
    {
      lists[static_cast<std::size_t>(band)].push_back(item);
    }
  }

  template <typename Visit>
  void visit(int band, const Visit& visitItem) const
  {
    for (const Lists& lists : this->lists_)
    {
      for (const BandItem& item : lists[static_cast<std::size_t>(band)])
      {
        visitItem(item);
      }
    }
  }

private:
  using Lists = std::vector<std::vector<BandItem>>;
  int size_;
  tbb::enumerable_thread_specific<Lists> lists_;
};

/// Visit the bands of a map on all cores.
/// @param size side of the map, in texels
/// @param visit called with the band's number and its rows
template <typename Visit>
void visitBands(int size, const Visit& visit)
{
  tbb::parallel_for(0, (size + CasterBands::rows - 1) / CasterBands::rows,
    [&](int band)
    {
      const int first = band * CasterBands::rows;
      visit(band, Span{ first, std::min(first + CasterBands::rows, size) - 1 });
    });
}

/// Rasterize all rows of a map, band by band.
/// @tparam Cell gathers the values of one texel
/// @param size side of the map, in texels
/// @param drawBand called with the band's number, its rows, and their cells, row by row
/// @param take called with each texel's number on the map and its cell, from several threads
template <typename Cell, typename DrawBand, typename Take>
void drawBands(int size, const DrawBand& drawBand, const Take& take)
{
  tbb::enumerable_thread_specific<std::vector<Cell>> cellsOfThread;
  visitBands(size,
    [&](int band, Span rows)
    {
      const auto width = static_cast<std::size_t>(size);
      const std::size_t first = static_cast<std::size_t>(rows.first) * width;
      std::vector<Cell>& cells = cellsOfThread.local();
      cells.assign(static_cast<std::size_t>(rows.last - rows.first + 1) * width, Cell());
      drawBand(band, rows, cells.data());
      for (std::size_t i = 0; i < cells.size(); ++i)
      {
        take(first + i, cells[i]);
      }
    });
}

} // namespace gnomon
