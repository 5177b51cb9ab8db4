#include "shadowtech/base/Receivers.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/base/SmoothFacet.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

/// Triangles that a tile meets again and again, by the fragments that name them; one entry per
/// primitive's number modulo the size.
class SeenTriangles
{
public:
  template <typename Make>
  const SeenTriangle& find(const glm::vec2& fragment, Make make)
  {
    const std::size_t slot =
      (std::abs(fragment.y) < primitiveLimit ? static_cast<std::size_t>(std::abs(fragment.y)) : 0) %
      size;
    if (!this->filled_[slot] || this->fragments_[slot] != fragment)
    {
      this->filled_[slot] = true;
      this->fragments_[slot] = fragment;
      make(this->seen_[slot]);
    }
    return this->seen_[slot];
  }

private:
  static constexpr std::size_t size = 256;
  std::array<bool, size> filled_{};
  std::array<glm::vec2, size> fragments_;
  std::array<SeenTriangle, size> seen_;
};

/// Neighbours in a row that show the same triangle.
struct Span
{
  std::size_t y, firstColumn, lastColumn; ///< in the picture
  std::size_t first;                      ///< where the first one's receiver goes

  std::size_t count() const { return this->lastColumn - this->firstColumn; }
};

/// Where the rays meet the triangle; of those that pass it by, inside is 0.
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void meetSpan(const SeenTriangle& seen,
  const PixelRays& rays, const Span& span, ReceiverPixels& receivers, std::uint8_t* inside)
{
  const auto y = static_cast<double>(span.y);
  const auto component = [&](const glm::dvec3& first, const glm::dvec3& perColumn,
                           const glm::dvec3& perRow, int axis) {
    return AffineOverRow{ first[axis] + y * perRow[axis], perColumn[axis] };
  };
  const auto origin = [&](int axis)
  { return component(rays.firstOrigin, rays.originPerColumn, rays.originPerRow, axis); };
  const auto direction = [&](int axis)
  { return component(rays.firstDirection, rays.directionPerColumn, rays.directionPerRow, axis); };
  const AffineOverRow originX = origin(0), originY = origin(1), originZ = origin(2);
  const AffineOverRow directionX = direction(0), directionY = direction(1),
                      directionZ = direction(2);
  const AffineOverRow planeDistance = seen.planeDistance.row(y);
  const AffineOverRow alongNormal = seen.alongNormal.row(y);
  const AffineOverRow edge0 = seen.insideEdge[0].row(y);
  const AffineOverRow edge1 = seen.insideEdge[1].row(y);
  const AffineOverRow edge2 = seen.insideEdge[2].row(y);
  // A pixel's side is one of these times 1 or t; the other is 0.
  const double sideParallel = glm::length(rays.originPerRow);
  const double sidePerDepth = glm::length(rays.directionPerRow);

  float* const positionX = &receivers.positionX[span.first];
  float* const positionY = &receivers.positionY[span.first];
  float* const positionZ = &receivers.positionZ[span.first];
  float* const offset = &receivers.offset[span.first];
  const auto firstColumn = static_cast<int>(span.firstColumn);
  const auto count = static_cast<int>(span.count());
  const float noise = seen.noise;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
  {
    const double x = firstColumn + i;
    const double along = alongNormal.at(x);
    const double t = planeDistance.at(x) / along;
    positionX[i] = static_cast<float>(originX.at(x) + t * directionX.at(x));
    positionY[i] = static_cast<float>(originY.at(x) + t * directionY.at(x));
    positionZ[i] = static_cast<float>(originZ.at(x) + t * directionZ.at(x));
    offset[i] = shadowRayOffsetInside(noise, static_cast<float>(sideParallel + t * sidePerDepth));
    // Written so that NaN fails.
    inside[i] = (edge0.at(x) >= 0.0) & (edge1.at(x) >= 0.0) & (edge2.at(x) >= 0.0) & (along > 0.0);
  }
}

/// The receivers of a span.
void projectSpan(
  const SeenTriangle& seen, const PixelRays& rays, const Span& span, ReceiverPixels& receivers)
{
  std::array<std::uint8_t, ReceiverTile::mostColumns> inside;
  meetSpan(seen, rays, span, receivers, inside.data());
  const std::size_t first = span.first;
  const std::size_t count = span.count();
  std::fill_n(&receivers.normalX[first], count, seen.normal.x);
  std::fill_n(&receivers.normalY[first], count, seen.normal.y);
  std::fill_n(&receivers.normalZ[first], count, seen.normal.z);
  std::fill_n(&receivers.surface[first], count, seen.surface);
  std::fill_n(&receivers.lifted[first], count, 0);
  for (std::size_t j = 0; j < count; ++j)
  {
    if (inside[j])
    {
      continue;
    }
    const auto x = static_cast<double>(span.firstColumn + j);
    const auto y = static_cast<double>(span.y);
    const glm::dvec3 origin = rays.origin(x, y);
    const glm::dvec3 direction = rays.direction(x, y);
    const glm::dvec3 edge = closestToRay(seen.corners, origin, direction, rays.parallel());
    const double t = glm::dot(edge - origin, direction) / glm::dot(direction, direction);
    const double footprint = glm::length(rays.originPerRow + t * rays.directionPerRow);
    const glm::dvec3 position = inwards(edge, seen.corners, footprint);
    const std::size_t i = first + j;
    receivers.positionX[i] = static_cast<float>(position.x);
    receivers.positionY[i] = static_cast<float>(position.y);
    receivers.positionZ[i] = static_cast<float>(position.z);
    receivers.offset[i] = shadowRayOffset(seen.noise, static_cast<float>(footprint));
    if (seen.normal == glm::vec3(0.0f))
    {
      const glm::vec3 toCamera = -glm::normalize(direction);
      receivers.normalX[i] = toCamera.x;
      receivers.normalY[i] = toCamera.y;
      receivers.normalZ[i] = toCamera.z;
    }
  }
}

/// Has a span's shadow rays start above the curved surface rather than its triangle, and gives its
/// receivers that surface's normal, where nothing is in between.
void liftSpan(const SeenTriangle& seen, const FreeSegments& freeSegments, const Span& span,
  ReceiverPixels& receivers)
{
  using Row = std::array<float, ReceiverTile::mostColumns>;
  const std::size_t first = span.first;
  const std::size_t count = span.count();
  const PointArrays points{ &receivers.positionX[first], &receivers.positionY[first],
    &receivers.positionZ[first] };
  float* const offsets = &receivers.offset[first];
  Row heights, normalX, normalY, normalZ;
  SmoothFacet(seen.corners, *seen.smoothNormals)
    .look(count, points, heights.data(), { normalX.data(), normalY.data(), normalZ.data() });
  Row fromX, fromY, fromZ, toX, toY, toZ;
  for (std::size_t i = 0; i < count; ++i)
  {
    fromX[i] = points.x[i] + offsets[i] * seen.normal.x;
    fromY[i] = points.y[i] + offsets[i] * seen.normal.y;
    fromZ[i] = points.z[i] + offsets[i] * seen.normal.z;
    heights[i] += offsets[i];
    toX[i] = points.x[i] + heights[i] * normalX[i];
    toY[i] = points.y[i] + heights[i] * normalY[i];
    toZ[i] = points.z[i] + heights[i] * normalZ[i];
  }
  std::uint8_t* const isLifted = &receivers.lifted[first];
  freeSegments.areFree(count, { fromX.data(), fromY.data(), fromZ.data() },
    { toX.data(), toY.data(), toZ.data() }, isLifted);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (isLifted[i] != 0)
    {
      receivers.normalX[first + i] = normalX[i];
      receivers.normalY[first + i] = normalY[i];
      receivers.normalZ[first + i] = normalZ[i];
      offsets[i] = heights[i];
    }
  }
}

/// The receivers of a span that shows a solid.
void projectSolid(
  const SeenTriangle& seen, const PixelRays& rays, const Span& span, ReceiverPixels& receivers)
{
  for (std::size_t j = 0; j < span.count(); ++j)
  {
    const auto x = static_cast<double>(span.firstColumn + j);
    const auto y = static_cast<double>(span.y);
    const glm::dvec3 origin = rays.origin(x, y);
    const glm::dvec3 direction = rays.direction(x, y);
    const SolidPoint point = seenPoint(*seen.solid, origin, direction);
    const double t = glm::dot(point.position - origin, direction) / glm::dot(direction, direction);
    const auto footprint =
      static_cast<float>(glm::length(rays.originPerRow + t * rays.directionPerRow));
    const glm::vec3 position(point.position);
    const glm::vec3 normal(point.normal);
    const float noise = noiseOf(*seen.solid, point);
    const std::size_t i = span.first + j;
    receivers.positionX[i] = position.x;
    receivers.positionY[i] = position.y;
    receivers.positionZ[i] = position.z;
    receivers.normalX[i] = normal.x;
    receivers.normalY[i] = normal.y;
    receivers.normalZ[i] = normal.z;
    receivers.offset[i] =
      point.isMet ? shadowRayOffsetInside(noise, footprint) : shadowRayOffset(noise, footprint);
    receivers.surface[i] = seen.surface;
    receivers.lifted[i] = 0;
  }
}

/// A span's part from one column to before another.
Span partOf(const Span& span, std::size_t firstColumn, std::size_t lastColumn)
{
  return { span.y, firstColumn, lastColumn, span.first + (firstColumn - span.firstColumn) };
}

/// The receivers of spans, or what is known of them without.
class SpanMaking
{
public:
  /// @param known where not null, gets what is decided of each receiver
  SpanMaking(const Drawn& drawn, ReceiverPixels& receivers, std::vector<Certainty>* known)
    : rays_(drawn.images.rays)
    , receivers_(receivers)
    , known_(known)
    , decider_(drawn.decider)
    , freeSegments_(drawn.freeSegments)
  {
  }

  void make(const SeenTriangle& seen, const Span& span)
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
      this->project(seen, span);
    }
  }

private:
  /// Below that many pixels it is no dearer to look at each.
  static constexpr std::size_t shortestAsked = 12;

  void project(const SeenTriangle& seen, const Span& span)
  {
    projectSpan(seen, this->rays_, span, this->receivers_);
    if (seen.smoothNormals)
    {
      liftSpan(seen, *this->freeSegments_, span, this->receivers_);
    }
  }

  /// Leaves out receivers of which everything is known: their numbers mean nothing.
  void leaveOut(const Span& span, Certainty certainty)
  {
    std::fill_n(&this->receivers_.surface[span.first], span.count(), ReceiverPixels::notCovered);
    std::fill_n(&(*this->known_)[span.first], span.count(), certainty);
  }

  void makeByHalves(const SeenTriangle& seen, const Span& span)
  {
    if (span.count() < shortestAsked)
    {
      this->project(seen, span);
      return;
    }
    const Certainty certainty = this->askAbout(seen, span);
    if (isDecided(certainty))
    {
      this->leaveOut(span, certainty);
      return;
    }
    const std::size_t middle = (span.firstColumn + span.lastColumn) / 2;
    this->makeByHalves(seen, partOf(span, span.firstColumn, middle));
    this->makeByHalves(seen, partOf(span, middle, span.lastColumn));
  }

  /// What is known of a span whose pixels all lie inside the triangle, and so in a line.
  Certainty askAbout(const SeenTriangle& seen, const Span& span) const
  {
    const auto y = static_cast<double>(span.y);
    ReceiverSegment segment;
    segment.surface = seen.surface;
    segment.leastOffset = std::numeric_limits<float>::infinity();
    segment.mostOffset = 0.0f;
    const auto meet = [&](std::size_t column, glm::dvec3& position)
    {
      const auto x = static_cast<double>(column);
      const double along = seen.alongNormal.row(y).at(x);
      const double t = seen.planeDistance.row(y).at(x) / along;
      position = this->rays_.origin(x, y) + t * this->rays_.direction(x, y);
      const double footprint =
        glm::length(this->rays_.originPerRow) + t * glm::length(this->rays_.directionPerRow);
      const float offset = shadowRayOffsetInside(seen.noise, static_cast<float>(footprint));
      segment.leastOffset = std::min(segment.leastOffset, offset * 0.999999f);
      segment.mostOffset = std::max(segment.mostOffset, offset * 1.000001f);
      // Affine numbers that are not negative at both ends are not between them. Written so that NaN
      // fails.
      return seen.insideEdge[0].row(y).at(x) >= 0.0 && seen.insideEdge[1].row(y).at(x) >= 0.0 &&
        seen.insideEdge[2].row(y).at(x) >= 0.0 && along > 0.0;
    };
    return meet(span.firstColumn, segment.firstCentred) &&
        meet(span.lastColumn - 1, segment.lastCentred)
      ? this->decider_->ofSegment(segment)
      : Certainty::Uncertain;
  }

  const PixelRays& rays_;
  ReceiverPixels& receivers_;
  std::vector<Certainty>* known_;
  const ReceiverDecider* decider_;
  const FreeSegments* freeSegments_;
};

void leaveUncovered(const Span& span, ReceiverPixels& receivers)
{
  const std::size_t first = span.first;
  const std::size_t count = span.count();
  for (const auto plane : ReceiverPixels::planes)
  {
    std::fill_n(&(receivers.*plane)[first], count, 0.0f);
  }
  std::fill_n(&receivers.surface[first], count, ReceiverPixels::notCovered);
  std::fill_n(&receivers.lifted[first], count, 0);
}

/// A tile's place in the picture.
struct Rectangle
{
  std::size_t firstColumn, firstRow, columns, rows;
};

/// Whether two fragments' numbers are the same, bit by bit.
bool isSame(const glm::vec2& a, const glm::vec2& b)
{
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// The receivers of a tile.
/// @param known where not null, gets what is decided of each; null where there is no decider
/// @param first where the first one goes
/// @param perRow and how much farther on those of the next row
void projectTile(const Drawn& drawn, const Rectangle& tile, SeenTriangles& cache,
  ReceiverPixels& receivers, std::vector<Certainty>* known, std::size_t first, std::size_t perRow)
{
  const auto width = static_cast<std::size_t>(drawn.images.width);
  const std::size_t lastColumn = tile.firstColumn + tile.columns;
  const auto seeFragment = [&](const glm::vec2& fragment, SeenTriangle& seen)
  {
    const TriangleOfFragment found =
      findTriangle(std::abs(fragment.x), fragment.y, drawn.drawnSurfaces, drawn.occluders);
    seen.finite = false;
    if (found.triangle != notFound)
    {
      see(drawn, found, seen);
    }
  };
  SpanMaking spans(drawn, receivers, known);
  for (std::size_t row = 0; row < tile.rows; ++row)
  {
    const std::size_t y = tile.firstRow + row;
    const glm::vec2* const fragments = drawn.images.fragments.data() + y * width;
    Span span{ y, tile.firstColumn, tile.firstColumn, first + row * perRow };
    while (span.lastColumn < lastColumn)
    {
      // Neighbours mostly share their triangle, and so what was looked up for it.
      const glm::vec2 fragment = fragments[span.firstColumn];
      do
      {
        ++span.lastColumn;
      } while (span.lastColumn < lastColumn && isSame(fragments[span.lastColumn], fragment));
      const SeenTriangle& seen =
        cache.find(fragment, [&](SeenTriangle& empty) { seeFragment(fragment, empty); });
      seen.finite ? spans.make(seen, span) : leaveUncovered(span, receivers);
      span.first += span.count();
      span.firstColumn = span.lastColumn;
    }
  }
}

void copyTile(const ReceiverPixels& picture, const Rectangle& tile, ReceiverPixels& receivers)
{
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t row = 0; row < tile.rows; ++row)
  {
    const std::size_t from = (tile.firstRow + row) * width + tile.firstColumn;
    const std::size_t to = row * tile.columns;
    const auto copy = [&](auto array)
    { std::copy_n(&(picture.*array)[from], tile.columns, &(receivers.*array)[to]); };
    for (const auto plane : ReceiverPixels::planes)
    {
      copy(plane);
    }
    copy(&ReceiverPixels::surface);
    copy(&ReceiverPixels::lifted);
  }
}

/// All tiles of a picture, by several threads at once.
/// @param visitTile with something of the thread's own
template <typename Local, typename VisitTile>
void visitRectangles(std::size_t width, std::size_t height, const VisitTile& visitTile)
{
  const std::size_t tilesX = (width + ReceiverTile::mostColumns - 1) / ReceiverTile::mostColumns;
  const std::size_t tilesY = (height + ReceiverTile::mostRows - 1) / ReceiverTile::mostRows;
  tbb::enumerable_thread_specific<Local> locals;
  constexpr std::size_t tilesAtOnce = 8;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tilesX * tilesY, tilesAtOnce),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      Local& local = locals.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        Rectangle tile{ i % tilesX * ReceiverTile::mostColumns, i / tilesX * ReceiverTile::mostRows,
          0, 0 };
        tile.columns = std::min(ReceiverTile::mostColumns, width - tile.firstColumn);
        tile.rows = std::min(ReceiverTile::mostRows, height - tile.firstRow);
        visitTile(tile, local);
      }
    });
}

/// What a thread needs to make receivers of tiles.
struct TileMaking
{
  SeenTriangles cache;
  ReceiverPixels receivers;
  std::vector<Certainty> known;
};

} // namespace

//------------------------------------------------------------------------------
Receivers::Receivers(const ReceiverImages& images, const std::vector<DrawnSurface>& drawnSurfaces,
  const Occluders& occluders, ReceiverPixels& stored, const FreeSegments* freeSegments)
  : images_(&images)
  , drawnSurfaces_(&drawnSurfaces)
  , occluders_(&occluders)
  , freeSegments_(freeSegments)
  , toFill_(&stored)
  , width_(static_cast<std::size_t>(images.width))
  , height_(static_cast<std::size_t>(images.height))
{
  stored.resize(0, 0);
}

//------------------------------------------------------------------------------
Receivers::Receivers(const ReceiverPixels& stored)
  : stored_(&stored)
  , width_(static_cast<std::size_t>(stored.width))
  , height_(static_cast<std::size_t>(stored.height))
{
}

//------------------------------------------------------------------------------
void Receivers::visitTiles(
  const std::function<void(const ReceiverTile&)>& visit, const ReceiverDecider* decider) const
{
  const std::optional<Drawn> drawn = this->stored_
    ? std::nullopt
    : std::optional<Drawn>(std::in_place, *this->images_, *this->drawnSurfaces_, *this->occluders_,
        decider, this->freeSegments_);
  visitRectangles<TileMaking>(this->width_, this->height_,
    [&](const Rectangle& tile, TileMaking& making)
    {
      making.receivers.resize(static_cast<int>(tile.columns), static_cast<int>(tile.rows));
      making.known.assign(making.receivers.size(), Certainty::Uncertain);
      if (!drawn)
      {
        copyTile(*this->stored_, tile, making.receivers);
      }
      else
      {
        projectTile(*drawn, tile, making.cache, making.receivers, decider ? &making.known : nullptr,
          0, tile.columns);
      }
      visit({ tile.firstColumn, tile.firstRow, making.receivers, making.known });
    });
}

//------------------------------------------------------------------------------
const ReceiverPixels& Receivers::all()
{
  if (!this->stored_)
  {
    this->toFill_->resize(this->images_->width, this->images_->height);
    const Drawn drawn(
      *this->images_, *this->drawnSurfaces_, *this->occluders_, nullptr, this->freeSegments_);
    visitRectangles<SeenTriangles>(this->width_, this->height_,
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
