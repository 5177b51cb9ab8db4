#pragma once

#include "shadowtech/exact/TexelCells.h"
#include "shadowtech/exact/TexelShapes.h"

#include <glm/glm.hpp>
#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// @file
/// Records from which compute shaders rasterize some rows of a conservative map.

/// Invocations per work group.
constexpr int invocationsPerGroup = 64;

/// Lists of which invocations rasterize which rows.
struct RowWalks
{
  ///@{ Pairs of a shape's number and a row of it.
  std::vector<glm::uvec2> ofShapes; ///< one invocation rasterizes this row and all that follow
  /// Each invocation of a work group rasterizes one row, from this one on.
  std::vector<glm::uvec2> ofRows;
  ///@}

  /// Add the rows of a shape to one of the lists.
  /// @param columns the shape's approximate width, in texels
  void add(std::size_t shape, Span rows, double columns);
  /// Return the bytes of the larger list. The functions of this name below return those of their
  /// largest buffer.
  std::size_t largestBytes() const;
};

/// Polygons and their sides.
struct PolygonBatch
{
  std::vector<PolygonRecord> records;
  std::vector<SideRecord> sides;

  /// @return the polygon's number
  std::size_t add(const PolygonOnTexels& polygon);
  std::size_t largestBytes() const;
};

/// Edges and their rows.
struct SegmentBatch
{
  std::vector<SegmentRecord> records;
  RowWalks walks;

  void add(const SegmentOnTexels& segment);
  std::size_t largestBytes() const;
};

/// Triangles and their rows.
struct TriangleBatch
{
  PolygonBatch polygons;
  RowWalks walks;

  void add(const MapPolygon& polygon, double margin, int width, Span rows);
  std::size_t largestBytes() const;
};

/// A ring: its polygons, the middle first, and the edges around it.
struct RingRecord
{
  std::uint32_t firstPolygon, polygonCount;
  std::uint32_t firstSegment, segmentCount;
};
static_assert(sizeof(RingRecord) == 16, "as shaders read it");

/// Rings of triangles, the edges around them, and their rows.
struct RingBatch
{
  PolygonBatch polygons;
  std::vector<SegmentRecord> borders;
  std::vector<RingRecord> records;
  RowWalks walks;

  void add(const MapRing& ring, double margin, Span rows);
  std::size_t largestBytes() const;
};

/// Batches of one kind that threads fill, each small enough for the buffers of shaders.
template <typename Batch>
class CollectedBatches
{
public:
  /// @param mostBytes of a buffer after which the next batch begins. The item added last may exceed
  /// it.
  explicit CollectedBatches(std::size_t mostBytes)
    : mostBytes_(mostBytes)
  {
  }

  /// Return the batch that the calling thread adds to.
  Batch& local()
  {
    std::vector<Batch>& mine = this->ofThreads_.local();
    if (mine.empty() || mine.back().largestBytes() >= this->mostBytes_)
    {
      mine.emplace_back();
    }
    return mine.back();
  }

  /// Pass all batches to `draw`, then drop them. No thread may add meanwhile.
  template <typename Draw>
  void drawAll(const Draw& draw)
  {
    for (std::vector<Batch>& batches : this->ofThreads_)
    {
      for (const Batch& batch : batches)
      {
        draw(batch);
      }
      batches.clear();
    }
  }

private:
  std::size_t mostBytes_;
  tbb::enumerable_thread_specific<std::vector<Batch>> ofThreads_;
};

} // namespace gnomon
