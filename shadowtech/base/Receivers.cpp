#include "shadowtech/base/Receivers.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"

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

constexpr std::uint32_t none = 0xffffffffu;

/// Where a fragment's triangle is in the snapshot.
struct TriangleOfFragment
{
  std::uint32_t surface = none;
  std::uint32_t triangle = none;
  std::uint32_t instance = 0;

  bool operator==(const TriangleOfFragment& other) const
  {
    return this->triangle == other.triangle && this->instance == other.instance &&
      this->surface == other.surface;
  }
};

/// A number that is affine over a row of pixels.
struct AffineOverRow
{
  double first;
  double perColumn;

  double at(double x) const { return this->first + x * this->perColumn; }
};

/// A number that is affine over the picture.
struct AffineOverPixels
{
  double first = 0.0; ///< at pixel (0, 0)
  double perColumn = 0.0;
  double perRow = 0.0;

  AffineOverRow row(double y) const { return { this->first + y * this->perRow, this->perColumn }; }
};

/// A triangle as the pixels' rays meet it.
///
/// Let O + t D be a ray, v0, v1, v2 the corners and N = (v1 - v0) x (v2 - v0). The ray meets the
/// plane at t = N.(v0 - O) / N.D, and passes edge (vi, vj) on the side of the sign of
/// D.((vi - O) x (vj - O)); the three of them add up to N.D. All of these are affine over the
/// picture, as either O or D is the same for all pixels.
struct SeenTriangle
{
  AffineOverPixels planeDistance; ///< N.(v0 - O)
  AffineOverPixels alongNormal;   ///< N.D; both negated where the camera sees the triangle's back
  std::array<AffineOverPixels, 3> insideEdge; ///< not negative inside
  std::array<glm::dvec3, 3> corners;          ///< centred
  glm::vec3 normal{ 0.0f }; ///< unit, on the camera's side; zero for a triangle without one
  float noise = 0.0f;       ///< planeNoise()
  std::uint32_t surface = none;
  bool finite = false;
  Certainty known =
    Certainty::Uncertain; ///< of all its receivers; else the numbers above mean nothing
};

/// The largest primitive number that the images can hold exactly.
constexpr float primitiveLimit = 16777216.0f;

TriangleOfFragment findTriangle(float drawnPlusOne, float primitive,
  const std::vector<DrawnSurface>& drawnSurfaces, const Occluders& occluders)
{
  // Written so that NaN fails.
  if (!(drawnPlusOne >= 1.0f && drawnPlusOne <= static_cast<float>(drawnSurfaces.size()) &&
        primitive >= 0.0f && primitive < primitiveLimit))
  {
    return {};
  }
  const std::vector<DrawnSurface::Block>& blocks =
    drawnSurfaces[static_cast<std::size_t>(drawnPlusOne) - 1].blocks;
  const auto number = static_cast<std::uint32_t>(primitive);
  const auto after = std::upper_bound(blocks.begin(), blocks.end(), number,
    [](std::uint32_t value, const DrawnSurface::Block& block)
    { return value < block.firstPrimitive; });
  if (after == blocks.begin())
  {
    return {};
  }
  const DrawnSurface::Block& block = *(after - 1);
  std::uint32_t drawn = number - block.firstPrimitive;
  if (drawn >= block.primitiveCount || block.surface >= occluders.surfaces.size())
  {
    return {};
  }
  const Surface& surface = occluders.surfaces[block.surface];
  std::uint32_t instance = 0;
  if (surface.isInstanced())
  {
    // Blocks without primitives were left above, so that there is a count to divide by.
    instance = drawn / surface.drawnCount();
    drawn %= surface.drawnCount();
    if (instance >= surface.centredFromSource.size() ||
      Surface::isLeftOut(surface.centredFromSource[instance]))
    {
      return {};
    }
  }
  std::uint32_t triangle = drawn;
  if (!surface.triangleOfDrawn.empty())
  {
    triangle =
      drawn < surface.triangleOfDrawn.size() ? surface.triangleOfDrawn[drawn] : Surface::noTriangle;
  }
  if (triangle >= surface.triangleCount)
  {
    return {};
  }
  return { block.surface, surface.firstTriangle + triangle, instance };
}

bool isFinite(const glm::dvec3& vector)
{
  return std::isfinite(vector.x + vector.y + vector.z);
}

bool isFinite(const PixelRays& rays)
{
  return isFinite(rays.firstOrigin) && isFinite(rays.originPerColumn) &&
    isFinite(rays.originPerRow) && isFinite(rays.firstDirection) &&
    isFinite(rays.directionPerColumn) && isFinite(rays.directionPerRow);
}

/// How large pixels are where a triangle is seen.
class Footprints
{
public:
  explicit Footprints(const PixelRays& rays)
    : origin_(rays.firstOrigin)
    , parallel_(glm::length(rays.originPerRow))
    , perDistance_(0.0)
  {
    if (!rays.parallel())
    {
      // A pixel's side is t times that of directionPerRow where its ray, or the plane across it, has its receiver: at
      // distance d of it t is no more than d over the shortest direction's length.
      const glm::dvec3 across =
        glm::normalize(glm::cross(rays.directionPerColumn, rays.directionPerRow));
      this->perDistance_ =
        glm::length(rays.directionPerRow) / std::abs(glm::dot(across, rays.firstDirection));
    }
  }

  /// The most that a pixel's side measures at a receiver on a triangle, even one whose pixel's ray passes it by.
  double largest(const std::array<glm::dvec3, 3>& corners) const
  {
    return this->parallel_ +
      this->perDistance_ *
      std::max({ glm::length(corners[0] - this->origin_), glm::length(corners[1] - this->origin_),
        glm::length(corners[2] - this->origin_) });
  }

private:
  glm::dvec3 origin_;
  double parallel_;
  double perDistance_; ///< from the origin
};

/// What the receivers stage drew, of what, and who knows something of it.
struct Drawn
{
  const ReceiverImages& images;
  const std::vector<DrawnSurface>& drawnSurfaces;
  const Occluders& occluders;
  const ReceiverDecider* decider; ///< may be null
  Footprints footprints;
  bool raysFinite;

  Drawn(const ReceiverImages& ofImages, const std::vector<DrawnSurface>& surfaces,
    const Occluders& snapshot, const ReceiverDecider* deciderOrNull)
    : images(ofImages)
    , drawnSurfaces(surfaces)
    , occluders(snapshot)
    , decider(deciderOrNull)
    , footprints(ofImages.rays)
    , raysFinite(isFinite(ofImages.rays))
  {
  }
};

/// @param seen what it was before means nothing
void see(const Drawn& drawn, const TriangleOfFragment& found, SeenTriangle& seen)
{
  const Occluders& occluders = drawn.occluders;
  const PixelRays& rays = drawn.images.rays;
  const Surface& surface = occluders.surfaces[found.surface];
  const auto noise = [&](const SeenTriangle& of, const glm::vec3& normal, double doubleArea)
  {
    return noiseOf(
      occluders, surface, found.instance, found.triangle, of.corners, normal, doubleArea);
  };
  seen.surface = found.surface;
  seen.known = Certainty::Uncertain;
  seen.corners = centredCorners(occluders, surface, found.instance, found.triangle);
  seen.finite = drawn.raysFinite && isFinite(seen.corners[0] + seen.corners[1] + seen.corners[2]);
  glm::dvec3 areaVector =
    glm::cross(seen.corners[1] - seen.corners[0], seen.corners[2] - seen.corners[0]);
  const auto planeDistance = [&](const glm::dvec3& areaVectorSeen)
  {
    return AffineOverPixels{ glm::dot(areaVectorSeen, seen.corners[0] - rays.firstOrigin),
      -glm::dot(areaVectorSeen, rays.originPerColumn),
      -glm::dot(areaVectorSeen, rays.originPerRow) };
  };
  const auto alongNormal = [&](const glm::dvec3& areaVectorSeen)
  {
    return AffineOverPixels{ glm::dot(areaVectorSeen, rays.firstDirection),
      glm::dot(areaVectorSeen, rays.directionPerColumn),
      glm::dot(areaVectorSeen, rays.directionPerRow) };
  };
  // From the eye, the plane's distance has one sign everywhere; parallel rays pass it in one
  // direction.
  const double side =
    rays.parallel() ? alongNormal(areaVector).first : planeDistance(areaVector).first;
  if (!(std::abs(side) > 0.0 && std::isfinite(side)))
  {
    // No area, not finite, or seen along its plane: alongNormal stays 0, so that no ray meets it. No
    // shadow ray either, as if its area were endless.
    seen.planeDistance = seen.alongNormal = {};
    seen.insideEdge = {};
    seen.normal = glm::vec3(0.0f);
    seen.noise = noise(seen, glm::vec3(1.0f), std::numeric_limits<double>::infinity());
    return;
  }
  // The camera is on the side to which the area's vector does not point.
  if (drawn.decider && !surface.isInstanced())
  {
    seen.known = drawn.decider->ofTriangle(
      { found.triangle, side > 0.0, seen.corners, drawn.footprints.largest(seen.corners) });
    if (isDecided(seen.known))
    {
      return;
    }
  }
  const double orientation = side > 0.0 ? 1.0 : -1.0;
  areaVector *= orientation;
  seen.planeDistance = planeDistance(areaVector);
  seen.alongNormal = alongNormal(areaVector);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 from = seen.corners[i] - rays.firstOrigin;
    const glm::dvec3 edge = seen.corners[(i + 1) % 3] - seen.corners[i];
    const glm::dvec3 across = orientation * glm::cross(from, edge);
    const glm::dvec3 lever = orientation * glm::cross(edge, rays.firstDirection);
    seen.insideEdge[i] = { glm::dot(across, rays.firstDirection),
      glm::dot(across, rays.directionPerColumn) - glm::dot(lever, rays.originPerColumn),
      glm::dot(across, rays.directionPerRow) - glm::dot(lever, rays.originPerRow) };
  }
  const double doubleArea = glm::length(areaVector);
  seen.normal = -areaVector / doubleArea;
  seen.noise = noise(seen, seen.normal, doubleArea);
}

/// The point of a triangle that a ray which passes it by comes closest to, as the camera sees it: by
/// angle with perspective, by distance in parallel projection. Serves triangles without area, too.
glm::dvec3 closestToRay(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& origin,
  const glm::dvec3& direction, bool parallel)
{
  glm::dvec3 closest = corners[0];
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 from = corners[i] - origin;
    const glm::dvec3 edge = corners[(i + 1) % 3] - corners[i];
    // The plane in which the camera sees the edge. The ray is turned or moved into it, and meets the
    // edge at from + u edge. An edge seen end-on has no such plane; any of its points will do.
    const glm::dvec3 across = parallel ? glm::cross(direction, edge) : glm::cross(from, edge);
    const double acrossSquared = glm::dot(across, across);
    double u = 0.0;
    if (acrossSquared > 0.0)
    {
      const glm::dvec3 within = direction - glm::dot(direction, across) / acrossSquared * across;
      const double denominator = glm::dot(glm::cross(within, edge), across);
      u = denominator != 0.0 ? glm::dot(glm::cross(from, within), across) / denominator : 0.0;
      u = glm::clamp(u, 0.0, 1.0);
    }
    const glm::dvec3 candidate = from + u * edge;
    const glm::dvec3 off = glm::cross(candidate, direction);
    double gap = glm::dot(off, off);
    if (!parallel)
    {
      gap /= glm::dot(candidate, candidate);
      if (!(glm::dot(candidate, direction) > 0.0))
      {
        gap = 2.0 * glm::dot(direction, direction); // behind the camera: beyond a right angle
      }
    }
    if (gap < smallest)
    {
      smallest = gap;
      closest = origin + candidate;
    }
  }
  return closest;
}

/// A point on a triangle's edge, moved into the triangle by 1/256 of a pixel's side, which is how far
/// off a rasteriser looks. On the edge itself it would lie on the neighbour's plane as well, and its
/// shadow ray would meet the neighbour or not as rounding has it.
glm::dvec3 inwards(
  const glm::dvec3& edge, const std::array<glm::dvec3, 3>& corners, double footprint)
{
  const glm::dvec3 toMiddle = (corners[0] + corners[1] + corners[2]) / 3.0 - edge;
  const double length = glm::length(toMiddle);
  const double step = footprint / 256.0;
  return length > 2.0 * step ? edge + step / length * toMiddle : edge + 0.5 * toMiddle;
}

/// Triangles that a tile meets again and again, by the fragments that name them; one entry per primitive's number modulo
/// the size.
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
  /// @param decider may be null, and is where `known` is
  SpanMaking(const PixelRays& rays, ReceiverPixels& receivers, std::vector<Certainty>* known,
    const ReceiverDecider* decider)
    : rays_(rays)
    , receivers_(receivers)
    , known_(known)
    , decider_(decider)
  {
  }

  void make(const SeenTriangle& seen, const Span& span)
  {
    if (this->known_ && isDecided(seen.known))
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
      // Affine numbers that are not negative at both ends are not between them. Written so that NaN fails.
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
};

void leaveUncovered(const Span& span, ReceiverPixels& receivers)
{
  const std::size_t first = span.first;
  const std::size_t count = span.count();
  for (std::vector<float>* numbers :
    { &receivers.positionX, &receivers.positionY, &receivers.positionZ, &receivers.normalX,
      &receivers.normalY, &receivers.normalZ, &receivers.offset })
  {
    std::fill_n(&(*numbers)[first], count, 0.0f);
  }
  std::fill_n(&receivers.surface[first], count, ReceiverPixels::notCovered);
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
    if (found.triangle != none)
    {
      see(drawn, found, seen);
    }
  };
  SpanMaking spans(drawn.images.rays, receivers, known, drawn.decider);
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

/// One row of numbers of a tile, from the picture's.
template <typename Number>
void copyRow(const std::vector<Number>& picture, std::size_t from, std::size_t count,
  std::vector<Number>& tile, std::size_t to)
{
  std::copy_n(&picture[from], count, &tile[to]);
}

void copyTile(const ReceiverPixels& picture, const Rectangle& tile, ReceiverPixels& receivers)
{
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t row = 0; row < tile.rows; ++row)
  {
    const std::size_t from = (tile.firstRow + row) * width + tile.firstColumn;
    const std::size_t to = row * tile.columns;
    const auto copy = [&](auto array)
    { copyRow(picture.*array, from, tile.columns, receivers.*array, to); };
    copy(&ReceiverPixels::positionX);
    copy(&ReceiverPixels::positionY);
    copy(&ReceiverPixels::positionZ);
    copy(&ReceiverPixels::normalX);
    copy(&ReceiverPixels::normalY);
    copy(&ReceiverPixels::normalZ);
    copy(&ReceiverPixels::offset);
    copy(&ReceiverPixels::surface);
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
  const Occluders& occluders, ReceiverPixels& stored)
  : images_(&images)
  , drawnSurfaces_(&drawnSurfaces)
  , occluders_(&occluders)
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
    : std::optional<Drawn>(
        std::in_place, *this->images_, *this->drawnSurfaces_, *this->occluders_, decider);
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
    const Drawn drawn(*this->images_, *this->drawnSurfaces_, *this->occluders_, nullptr);
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
