#include "shadowtech/base/Receivers.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ReceiverSpans.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/SmoothFacet.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

/// Return the part of a span that begins `skipped` places in.
PixelSpan partOf(const PixelSpan& span, std::size_t skipped, std::size_t count)
{
  return { span.x + static_cast<double>(skipped), span.y, count, span.first + skipped };
}

/// Computes the receivers of spans, or decides them without.
class SpanMaking
{
public:
  /// @param known if not null, set to each receiver's certainty
  SpanMaking(const Drawn& drawn, ReceiverPixels& receivers, std::vector<Certainty>* known)
    : rays_(drawn.images.rays)
    , receivers_(receivers)
    , known_(known)
    , decider_(drawn.decider)
  {
  }

  void make(const SeenTriangle& seen, const PixelSpan& span)
  {
    if (seen.solid)
    {
      projectSolid(seen, this->rays_, span, this->receivers_);
    }
    else if (this->known_ && isDecided(seen.known))
    {
      this->leaveOut(span, seen.known);
    }
    else if (this->known_ && seen.known == Certainty::Reached)
    {
      this->makeByHalves(seen, span);
    }
    else
    {
      projectSpan(seen, this->rays_, span, this->receivers_);
    }
  }

private:
  /// Spans with fewer pixels are projected: asking about their halves would not be cheaper.
  static constexpr std::size_t shortestAsked = 12;

  /// Leave out decided receivers. Of their numbers only the surface is set.
  void leaveOut(const PixelSpan& span, Certainty certainty)
  {
    std::fill_n(&this->receivers_.surface[span.first], span.count, ReceiverPixels::notCovered);
    std::fill_n(&(*this->known_)[span.first], span.count, certainty);
  }

  void makeByHalves(const SeenTriangle& seen, const PixelSpan& span)
  {
    if (span.count < shortestAsked)
    {
      projectSpan(seen, this->rays_, span, this->receivers_);
      return;
    }
    const Certainty certainty = this->askAbout(seen, span);
    if (isDecided(certainty))
    {
      this->leaveOut(span, certainty);
      return;
    }
    const std::size_t half = span.count / 2;
    this->makeByHalves(seen, partOf(span, 0, half));
    this->makeByHalves(seen, partOf(span, half, span.count - half));
  }

  /// Return what is known of a span whose pixels all lie inside the triangle, and so on a line.
  Certainty askAbout(const SeenTriangle& seen, const PixelSpan& span) const
  {
    ReceiverSegment segment;
    segment.surface = seen.surface;
    segment.leastOffset = std::numeric_limits<float>::infinity();
    segment.mostOffset = 0.0f;
    const auto meet = [&](std::size_t place, glm::dvec3& position)
    {
      const TrianglePoint point =
        meetTriangle(seen, this->rays_, span.x + static_cast<double>(place), span.y);
      position = point.position;
      segment.leastOffset = std::min(segment.leastOffset, point.offset * 0.999999f);
      segment.mostOffset = std::max(segment.mostOffset, point.offset * 1.000001f);
      // Affine functions that are not negative at both ends are not negative in between.
      return point.isInside;
    };
    return meet(0, segment.firstCentred) && meet(span.count - 1, segment.lastCentred)
      ? this->decider_->ofSegment(segment)
      : Certainty::Uncertain;
  }

  const PixelRays& rays_;
  ReceiverPixels& receivers_;
  std::vector<Certainty>* known_;
  const ReceiverDecider* decider_;
};

/// A tile's pixels in the picture.
struct Rectangle
{
  std::size_t firstColumn, firstRow, columns, rows;
};

/// True if two fragments have the same bits.
bool isSame(const glm::vec2& a, const glm::vec2& b)
{
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// Compute the receivers of a tile.
/// @param known if not null, set to each receiver's certainty; null without a decider
/// @param first index of the first receiver
/// @param perRow step of the index from a row to the next
void projectTile(const Drawn& drawn, const Rectangle& tile, SeenTriangles& cache,
  ReceiverPixels& receivers, std::vector<Certainty>* known, std::size_t first, std::size_t perRow)
{
  const auto width = static_cast<std::size_t>(drawn.images.width);
  const std::size_t lastColumn = tile.firstColumn + tile.columns;
  SpanMaking spans(drawn, receivers, known);
  for (std::size_t row = 0; row < tile.rows; ++row)
  {
    const std::size_t y = tile.firstRow + row;
    const glm::vec2* const fragments = drawn.images.fragments.data() + y * width;
    std::size_t column = tile.firstColumn;
    while (column < lastColumn)
    {
      // Neighbours mostly share their triangle, so it is looked up once.
      const std::size_t firstColumn = column;
      const glm::vec2 fragment = fragments[firstColumn];
      do
      {
        ++column;
      } while (column < lastColumn && isSame(fragments[column], fragment));
      const PixelSpan span{ static_cast<double>(firstColumn), static_cast<double>(y),
        column - firstColumn, first + row * perRow + firstColumn - tile.firstColumn };
      const bool isCut = cache.find(drawn, fragment).found.pieces > 1;
      const std::size_t step = isCut ? 1 : span.count;
      for (std::size_t place = 0; place < span.count; place += step)
      {
        const PixelSpan part = partOf(span, place, step);
        const SeenTriangle& seen = cache.findAt(drawn, fragment, part.x, part.y);
        seen.finite ? spans.make(seen, part) : leaveUncovered(part, receivers);
      }
    }
  }
}

/// Visit all tiles of a picture, by several threads at once.
/// @param skipped by tile: 1 for tiles that are left out; null: none
/// @param visitTile called with a tile and the thread's own Local
template <typename Local, typename VisitTile>
void visitRectangles(std::size_t width, std::size_t height,
  const std::vector<std::uint8_t>* skipped, const VisitTile& visitTile)
{
  const std::size_t tilesX = tilesAcross(width, ReceiverTile::mostColumns);
  const std::size_t tilesY = tilesAcross(height, ReceiverTile::mostRows);
  tbb::enumerable_thread_specific<Local> locals;
  constexpr std::size_t tilesAtOnce = 8;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tilesX * tilesY, tilesAtOnce),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      Local& local = locals.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        if (skipped && (*skipped)[i] != 0)
        {
          continue;
        }
        Rectangle tile{ i % tilesX * ReceiverTile::mostColumns, i / tilesX * ReceiverTile::mostRows,
          0, 0 };
        tile.columns = std::min(ReceiverTile::mostColumns, width - tile.firstColumn);
        tile.rows = std::min(ReceiverTile::mostRows, height - tile.firstRow);
        visitTile(tile, local);
      }
    });
}

/// A thread's storage for computing receivers of tiles.
struct TileMaking
{
  SeenTriangles cache;
  ReceiverPixels receivers;
  std::vector<Certainty> known;
};

} // namespace

Receivers::Receivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, ReceiverPixels& stored, bool findCurves)
  : images_(&images)
  , drawnSurfaces_(&drawnSurfaces)
  , occluders_(&occluders)
  , findCurves_(findCurves)
  , toFill_(&stored)
  , width_(static_cast<std::size_t>(images.width))
  , height_(static_cast<std::size_t>(images.height))
{
  stored.resize(0, 0);
}

Receivers::Receivers(const ReceiverPixels& stored)
  : stored_(&stored)
  , width_(static_cast<std::size_t>(stored.width))
  , height_(static_cast<std::size_t>(stored.height))
{
}

Drawn Receivers::drawn(const ReceiverDecider* decider) const
{
  return { *this->images_, *this->drawnSurfaces_, *this->occluders_, decider, this->findCurves_ };
}

void Receivers::visitTiles(const std::function<void(const ReceiverTile&)>& visit,
  const ReceiverDecider* decider, const std::vector<std::uint8_t>* skipped) const
{
  const std::optional<Drawn> drawn =
    this->stored_ ? std::nullopt : std::optional<Drawn>(this->drawn(decider));
  visitRectangles<TileMaking>(this->width_, this->height_, skipped,
    [&](const Rectangle& tile, TileMaking& making)
    {
      making.known.assign(tile.columns * tile.rows, Certainty::Uncertain);
      if (drawn)
      {
        making.receivers.resize(
          static_cast<int>(tile.columns), static_cast<int>(tile.rows), drawn->findsCurves);
        projectTile(*drawn, tile, making.cache, making.receivers, decider ? &making.known : nullptr,
          0, tile.columns);
      }
      visit({ tile.firstColumn, tile.firstRow, tile.columns, tile.rows,
        drawn ? making.receivers : *this->stored_,
        drawn ? 0 : tile.firstRow * this->width_ + tile.firstColumn, making.known });
    });
}

const ReceiverPixels& Receivers::all()
{
  if (!this->stored_)
  {
    const Drawn drawn = this->drawn();
    this->toFill_->resize(this->images_->width, this->images_->height, drawn.findsCurves);
    visitRectangles<SeenTriangles>(this->width_, this->height_, nullptr,
      [&](const Rectangle& tile, SeenTriangles& cache)
      {
        projectTile(drawn, tile, cache, *this->toFill_, nullptr,
          tile.firstRow * this->width_ + tile.firstColumn, this->width_);
      });
    this->stored_ = this->toFill_;
  }
  return *this->stored_;
}

} // namespace gnomon
