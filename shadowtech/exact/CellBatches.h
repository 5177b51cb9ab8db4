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
/// What some rows of a conservative map are drawn from on the GPU, as shaders read it.

/// How many invocations a work group has.
constexpr int invocationsPerGroup = 64;

/// Who walks which rows of what is drawn by compute shaders.
struct RowWalks
{
  ///@{ The number of a shape and a row of it.
  std::vector<glm::uvec2> ofShapes; ///< an invocation walks all that follow
  std::vector<glm::uvec2> ofRows;   ///< those of a work group walk a row each
  ///@}

  /// @param columns how many the shape has, about
  void add(std::size_t shape, Span rows, double columns);
  /// That the larger of them takes; so of all below.
  std::size_t largestBytes() const;
};

/// Polygons.
struct PolygonBatch
{
  std::vector<PolygonRecord> records;
  std::vector<SideRecord> sides;

  /// @return its number
  std::size_t add(const PolygonOnTexels& polygon);
  std::size_t largestBytes() const;
};

/// Edges.
struct SegmentBatch
{
  std::vector<SegmentRecord> records;
  RowWalks walks;

  void add(const SegmentOnTexels& segment);
  std::size_t largestBytes() const;
};

/// Triangles, of which some spoil texels.
struct TriangleBatch
{
  PolygonBatch polygons;
  RowWalks walks;

  void add(const MapPolygon& polygon, double margin, int width, Span rows);
  std::size_t largestBytes() const;
};

/// Which polygons are a ring, the middle first, and which edges are around it.
struct RingRecord
{
  std::uint32_t firstPolygon, polygonCount;
  std::uint32_t firstSegment, segmentCount;
};
static_assert(sizeof(RingRecord) == 16, "as shaders read it");

/// Parts of the casters' surface.
struct RingBatch
{
  PolygonBatch polygons;
  std::vector<SegmentRecord> borders;
  std::vector<RingRecord> records;
  RowWalks walks;

  void add(const MapRing& ring, double margin, Span rows);
  std::size_t largestBytes() const;
};

/// What threads collect of a kind of batch, in so many that shaders can read each from one buffer.
template <typename Batch>
class CollectedBatches
{
public:
  /// @param mostBytes of a buffer, after which another batch begins; so it may become larger by
  /// what is added last
  explicit CollectedBatches(std::size_t mostBytes)
    : mostBytes_(mostBytes)
  {
  }

  /// Where the calling thread adds.
  Batch& local()
  {
    std::vector<Batch>& mine = this->ofThreads_.local();
    if (mine.empty() || mine.back().largestBytes() >= this->mostBytes_)
    {
      mine.emplace_back();
    }
    return mine.back();
  }

  /// Hands over all batches and forgets them. No thread may add meanwhile.
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
