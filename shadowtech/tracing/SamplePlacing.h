#pragma once

#include "shadowtech/base/ReceiverSpans.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/tracing/EdgeSamples.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace gnomon
{

/// Return the Hammersley points of a pixel. Each row and each column holds one sample, so edges
/// along the picture's sides have as many steps as there are samples. Source: Dick and
/// Pillichshammer, Digital Nets and Sequences, 2010, definition 3.44 (base 2).
inline std::vector<glm::dvec2> samplePlaces(std::size_t count)
{
  std::vector<glm::dvec2> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    double inverse = 0.0; // of the index's binary digits, behind the point
    double digit = 0.5;
    for (std::size_t rest = i; rest > 0; rest /= 2, digit *= 0.5)
    {
      inverse += rest % 2 == 1 ? digit : 0.0;
    }
    const double half = 0.5 / static_cast<double>(count);
    places.emplace_back(static_cast<double>(i) * 2.0 * half + half - 0.5, inverse + half - 0.5);
  }
  return places;
}

/// The layout of samples in ReceiverPixels: a square per pixel, because tracers gather rays of
/// squares in packets.
struct SampleBlocks
{
  static constexpr std::size_t columns = ReceiverTile::mostColumns;
  static constexpr std::size_t mostSamples = 64;

  explicit SampleBlocks(std::size_t perPixel)
    : side(perPixel == 4   ? 2
          : perPixel == 16 ? 4
                           : 8)
  {
  }

  std::size_t rows(std::size_t pixels) const
  {
    const std::size_t perRow = columns / this->side;
    return (pixels + perRow - 1) / perRow * this->side;
  }
  std::size_t firstOfRow(std::size_t block, std::size_t row) const
  {
    const std::size_t perRow = columns / this->side;
    return (block / perRow * this->side + row) * columns + block % perRow * this->side;
  }
  std::size_t sample(std::size_t block, std::size_t n) const
  {
    return this->firstOfRow(block, n / this->side) + n % this->side;
  }

  std::size_t side; ///< of a square
};

/// Computes the receivers of samples, pixel by pixel.
///
/// A sample's receiver lies on the first triangle that holds it, in this *order*: 0 is the pixel's
/// own, then come those of its neighbours, row by row.
class SamplePlacing
{
public:
  /// @param several null if this process draws the picture alone
  /// @param orders set to the samples' orders if others draw it, too
  SamplePlacing(const Drawn& drawn, const SharedPicture* several,
    const std::vector<glm::dvec2>& places, ReceiverPixels& receivers, std::vector<float>& orders)
    : drawn_(drawn)
    , several_(several)
    , surfaces_(several ? several->surfaces : drawn.images.fragments)
    , places_(places)
    , blocks_(places.size())
    , receivers_(receivers)
    , orders_(orders)
  {
    this->centre_.resize(1, 1, drawn.findsCurves);
  }

  /// @param block the pixel's index among the pixels with samples
  /// @return true if the pixel shows a receiver
  bool place(std::uint32_t pixel, std::size_t block)
  {
    const auto width = static_cast<std::uint32_t>(this->drawn_.images.width);
    this->pixel_ = { static_cast<int>(pixel % width), static_cast<int>(pixel / width) };
    this->block_ = block;
    this->remaining_ = this->places_.size();
    std::iota(this->missing_.begin(), this->missing_.begin() + this->remaining_, 0);
    const std::optional<Shown> shown = this->shownAt(this->pixel_);
    if (shown)
    {
      this->fillAll(*shown, pixel);
    }
    for (std::size_t i = 0; i < this->remaining_; ++i)
    {
      leaveUncovered(
        { 0.0, 0.0, 1, this->blocks_.sample(block, this->missing_[i]) }, this->receivers_);
    }
    return shown.has_value();
  }

  /// True if the receiver that was placed last is at an outline: a neighbour shows something that
  /// does not continue its surface.
  bool isAtOutline(std::uint32_t own)
  {
    bool isOutline = false;
    this->visitNeighbours(
      [&](const glm::ivec2& at, int)
      {
        const std::size_t pixel = this->pixelAt(at);
        if (!isOutline && (this->isSolid_ || !this->showSame(pixel, own)))
        {
          const std::optional<Shown> shown = this->shownAt(at);
          isOutline = this->surfaces_[pixel].x != this->surfaces_[own].x || !shown ||
            !this->goesOn(shown->position, shown->normal);
        }
      });
    return isOutline;
  }

private:
  /// The receiver at a pixel's centre.
  struct Shown
  {
    glm::dvec3 position, normal; ///< as the picture has them on a flat triangle
  };

  void fillAll(const Shown& shown, std::uint32_t pixel)
  {
    const PixelRays& rays = this->drawn_.images.rays;
    const glm::dvec3 direction = rays.direction(this->pixel_.x, this->pixel_.y);
    const double t =
      glm::dot(shown.position - rays.origin(this->pixel_.x, this->pixel_.y), direction) /
      glm::dot(direction, direction);
    this->shown_ = shown;
    this->mostApart_ = glm::length(rays.originPerRow + t * rays.directionPerRow) +
      std::ldexp(glm::length(shown.position), -23);
    const SeenTriangle& own = this->cache_.find(this->drawn_, this->drawn_.images.fragments[pixel]);
    this->isSolid_ = own.finite && own.solid;
    this->fillFrom(pixel, 0.0f);
    this->fillFromNeighbours(pixel);
  }

  std::optional<Shown> shownAt(const glm::ivec2& at)
  {
    const std::size_t pixel = this->pixelAt(at);
    const ReceiverPixels* receivers = &this->centre_;
    std::size_t i = 0;
    if (this->several_)
    {
      receivers = &this->several_->receivers;
      i = pixel;
    }
    else
    {
      const PixelSpan span{ static_cast<double>(at.x), static_cast<double>(at.y), 1, 0 };
      const SeenTriangle& seen =
        this->cache_.findAt(this->drawn_, this->drawn_.images.fragments[pixel], span.x, span.y);
      const PixelRays& rays = this->drawn_.images.rays;
      !seen.finite   ? leaveUncovered(span, this->centre_)
        : seen.solid ? projectSolid(seen, rays, span, this->centre_)
                     : projectFlat(seen, rays, span, this->centre_);
    }
    if (receivers->surface[i] == ReceiverPixels::notCovered)
    {
      return std::nullopt;
    }
    return Shown{ receivers->position(i), receivers->normal(i) };
  }

  std::size_t pixelAt(const glm::ivec2& at) const
  {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(this->drawn_.images.width) +
      static_cast<std::size_t>(at.x);
  }

  /// Call visit(neighbour, order) for the pixels around it.
  template <typename Visit>
  void visitNeighbours(const Visit& visit) const
  {
    int order = 1;
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        visit(glm::ivec2(glm::clamp(this->pixel_.x + dx, 0, this->drawn_.images.width - 1),
                glm::clamp(this->pixel_.y + dy, 0, this->drawn_.images.height - 1)),
          order++);
      }
    }
  }

  /// True if two pixels are known to show the same triangle or solid.
  bool showSame(std::size_t pixel, std::size_t other) const
  {
    const std::vector<glm::vec2>& fragments = this->drawn_.images.fragments;
    return fragments[pixel] == fragments[other] && fragments[pixel].x != 0.0f;
  }

  void fillFromNeighbours(std::size_t own)
  {
    std::size_t before = own;
    this->visitNeighbours(
      [&](const glm::ivec2& at, int order)
      {
        const std::size_t pixel = this->pixelAt(at);
        if (this->remaining_ > 0 && this->surfaces_[pixel].x == this->surfaces_[own].x &&
          !this->showSame(pixel, own) && !this->showSame(pixel, before))
        {
          before = pixel;
          this->fillFrom(pixel, static_cast<float>(order));
        }
      });
  }

  /// The point where a place's ray meets a triangle or solid.
  struct Met
  {
    glm::dvec3 position, normal;
    float offset; ///< of the shadow ray, on a triangle
    bool isMet;
  };
  Met meet(const SeenTriangle& seen, const glm::dvec2& place) const
  {
    const PixelRays& rays = this->drawn_.images.rays;
    if (!seen.solid)
    {
      const TrianglePoint point = meetTriangle(seen, rays, place.x, place.y);
      return { point.position, seen.normal, point.offset, point.isInside };
    }
    const SolidPoint point =
      seenPoint(*seen.solid, rays.origin(place.x, place.y), rays.direction(place.x, place.y));
    return { point.position, point.normal, 0.0f, point.isMet };
  }

  /// True if a point continues the surface that the pixel shows.
  bool goesOn(const glm::dvec3& position, const glm::dvec3& normal) const
  {
    constexpr double leastCosine = 0.70710678; // 45 degrees
    return glm::dot(normal, this->shown_.normal) >= leastCosine &&
      std::abs(glm::dot(position - this->shown_.position, this->shown_.normal)) <= this->mostApart_;
  }

  /// Add receivers for the missing samples that lie on what a pixel shows.
  void fillFrom(std::size_t pixel, float order)
  {
    const glm::vec2& fragment = this->drawn_.images.fragments[pixel];
    const std::uint32_t pieces = this->cache_.find(this->drawn_, fragment).found.pieces;
    for (std::uint32_t piece = 0; piece < pieces; ++piece)
    {
      this->fill(this->cache_.find(this->drawn_, fragment, piece), order);
    }
  }

  /// Add receivers for the missing samples that lie on a triangle or solid.
  /// @param seen if not finite, none do
  void fill(const SeenTriangle& seen, float order)
  {
    std::size_t left = 0;
    PixelSpan together{ 0.0, 0.0, 0, 0 }; // receivers side by side
    for (std::size_t i = 0; i < this->remaining_ && seen.finite; ++i)
    {
      const std::size_t sample = this->missing_[i];
      const glm::dvec2 place = glm::dvec2(this->pixel_) + this->places_[sample];
      const Met met = this->meet(seen, place);
      if (!met.isMet || !this->goesOn(met.position, met.normal))
      {
        this->missing_[left++] = sample;
      }
      else
      {
        const std::size_t to = this->blocks_.sample(this->block_, sample);
        this->add(seen, met, place, to, order);
        if (together.first + together.count != to)
        {
          this->bend(seen, together);
          together = { 0.0, 0.0, 0, to };
        }
        ++together.count;
      }
    }
    this->bend(seen, together);
    this->remaining_ = seen.finite ? left : this->remaining_;
  }

  /// @param to the receiver's index among those of all pixels
  void add(
    const SeenTriangle& seen, const Met& met, const glm::dvec2& place, std::size_t to, float order)
  {
    if (seen.solid)
    {
      projectSolid(seen, this->drawn_.images.rays, { place.x, place.y, 1, to }, this->receivers_);
    }
    else
    {
      this->receivers_.put(to, met.position, seen.normal, met.offset, seen.surface);
    }
    if (this->several_)
    {
      this->orders_[to] = order;
    }
  }

  /// Find the curved surface above receivers, if there is one.
  void bend(const SeenTriangle& seen, const PixelSpan& span)
  {
    if (span.count > 0 && seen.smoothNormals)
    {
      findCurves(seen, span, this->receivers_);
    }
  }

  const Drawn& drawn_;
  const SharedPicture* several_;
  const std::vector<glm::vec2>& surfaces_;
  const std::vector<glm::dvec2>& places_;
  const SampleBlocks blocks_;
  ReceiverPixels& receivers_; ///< of all pixels' samples
  std::vector<float>& orders_;
  ReceiverPixels centre_; ///< of one pixel
  SeenTriangles cache_;

  glm::ivec2 pixel_{ 0 };
  std::size_t block_ = 0;
  Shown shown_{};
  bool isSolid_ = false;   ///< the pixel shows a solid of this process
  double mostApart_ = 0.0; ///< of planes that go on: a pixel's side, and the position's rounding
  std::array<std::size_t, SampleBlocks::mostSamples> missing_{};
  std::size_t remaining_ = 0; ///< number of missing samples
};

} // namespace gnomon
