#include "shadowtech/tracing/EdgeSamples.h"

#include "shadowtech/base/ReceiverSpans.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace gnomon
{
namespace
{

constexpr std::size_t mostSamples = 64;
constexpr std::size_t pixelsAtOnce = 256;         ///< of a task
constexpr std::size_t samplesInMemory = 1u << 20; ///< 35 MB
constexpr std::size_t probes = 4; ///< samples that decide if a pixel between surfaces needs all

/// Return the Hammersley points of a pixel. Each row and each column holds one sample, so edges
/// along the picture's sides have as many steps as there are samples. Source: Dick and
/// Pillichshammer, Digital Nets and Sequences, 2010, definition 3.44 (base 2).
std::vector<glm::dvec2> samplePlaces(std::size_t count)
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

/// True if a TracedClass is of a receiver that the light can reach.
bool canBeLit(std::uint8_t ofReceiver)
{
  const auto traced = static_cast<TracedClass>(ofReceiver);
  return traced != TracedClass::Unreached && traced != TracedClass::NoReceiver;
}

/// The surfaces that a picture shows.
struct ShownSurfaces
{
  int width, height;
  const std::vector<glm::vec2>& numbers; ///< x: the pixel's surface
};

/// The edge pixels of a picture, in order.
struct EdgePixels
{
  std::vector<std::uint32_t> ofShadows;  ///< lit and dark pixels meet
  std::vector<std::uint32_t> ofSurfaces; ///< several surfaces, all lit or all dark
};

/// The surfaces and visibility of a row's pixels, each combined with its two neighbours.
class ShownRow
{
public:
  void look(const ShownSurfaces& surfaces, const std::vector<float>& visibility,
    const std::vector<std::uint8_t>& classes, int row)
  {
    const int width = surfaces.width;
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
    const auto places = static_cast<std::size_t>(width) + 2;
    this->ownSurface_.resize(places);
    this->ownKinds_.resize(places);
    this->leastSurface_.resize(places);
    this->mostSurface_.resize(places);
    this->kinds_.resize(places);
    // Shifted by one place, for copies of the border's pixels on both sides.
    float* const surface = this->ownSurface_.data() + 1;
    int* const kinds = this->ownKinds_.data() + 1;
    for (int x = 0; x < width; ++x)
    {
      surface[x] = surfaces.numbers[first + static_cast<std::size_t>(x)].x;
    }
    for (int x = 0; x < width; ++x)
    {
      const std::size_t pixel = first + static_cast<std::size_t>(x);
      kinds[x] = canBeLit(classes[pixel]) ? (visibility[pixel] > 0.0f ? lit : dark) : 0;
    }
    surface[-1] = surface[0];
    surface[width] = surface[width - 1];
    kinds[-1] = kinds[0];
    kinds[width] = kinds[width - 1];
    for (int x = 0; x < width; ++x)
    {
      const auto i = static_cast<std::size_t>(x);
      this->leastSurface_[i] = std::min(std::min(surface[x - 1], surface[x]), surface[x + 1]);
      this->mostSurface_[i] = std::max(std::max(surface[x - 1], surface[x]), surface[x + 1]);
      this->kinds_[i] = kinds[x - 1] | kinds[x] | kinds[x + 1];
    }
  }

  /// Append the edge pixels of the middle one of three rows.
  static void findEdges(const ShownRow& below, const ShownRow& row, const ShownRow& above,
    std::size_t firstPixel, EdgePixels& found)
  {
    const std::size_t width = row.kinds_.size() - 2;
    for (std::size_t x = 0; x < width; ++x)
    {
      const bool isOneSurface = below.leastSurface_[x] == above.mostSurface_[x] &&
        row.leastSurface_[x] == above.mostSurface_[x] &&
        row.mostSurface_[x] == above.leastSurface_[x] &&
        below.mostSurface_[x] == above.leastSurface_[x];
      const bool hasBoth = (below.kinds_[x] | row.kinds_[x] | above.kinds_[x]) == (lit | dark);
      if ((!isOneSurface || hasBoth) && row.ownKinds_[x + 1] != 0)
      {
        (hasBoth ? found.ofShadows : found.ofSurfaces)
          .push_back(static_cast<std::uint32_t>(firstPixel + x));
      }
    }
  }

private:
  static constexpr int lit = 1, dark = 2;

  std::vector<float> ownSurface_;                 ///< ShownSurfaces::numbers
  std::vector<float> leastSurface_, mostSurface_; ///< of three pixels
  std::vector<int> ownKinds_;                     ///< lit, dark or neither
  std::vector<int> kinds_;                        ///< of three pixels, combined by or
};

/// Return the edge pixels of a band of rows.
EdgePixels findEdges(const ShownSurfaces& surfaces, const std::vector<float>& visibility,
  const std::vector<std::uint8_t>& classes, int firstRow, int endRow)
{
  EdgePixels found;
  std::array<ShownRow, 3> rows; // by number modulo three
  const auto rowAt = [&](int row) -> ShownRow&
  { return rows[static_cast<std::size_t>(glm::clamp(row, 0, surfaces.height - 1) % 3)]; };
  for (int row = std::max(firstRow - 1, 0); row < std::min(firstRow + 1, endRow); ++row)
  {
    rowAt(row).look(surfaces, visibility, classes, row);
  }
  for (int row = firstRow; row < endRow; ++row)
  {
    if (row + 1 < surfaces.height)
    {
      rowAt(row + 1).look(surfaces, visibility, classes, row + 1);
    }
    const std::size_t firstPixel =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(surfaces.width);
    ShownRow::findEdges(rowAt(row - 1), rowAt(row), rowAt(row + 1), firstPixel, found);
  }
  return found;
}

/// The layout of samples in ReceiverPixels: a square per pixel, because tracers gather rays of
/// squares in packets.
struct SampleBlocks
{
  static constexpr std::size_t columns = ReceiverTile::mostColumns;

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
  /// Return the first sample of a block's row.
  std::size_t firstOfRow(std::size_t block, std::size_t row) const
  {
    const std::size_t perRow = columns / this->side;
    return (block / perRow * this->side + row) * columns + block % perRow * this->side;
  }
  /// Return the index of a block's n-th sample.
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
    this->samples_.resize(static_cast<int>(places.size()), 1, drawn.findsCurves);
    this->centre_.resize(1, 1, drawn.findsCurves);
  }

  /// @param block the pixel's index among the pixels with samples
  /// @return true if the pixel is at an outline: a neighbour shows something that does not continue
  /// its surface
  bool place(std::uint32_t pixel, std::size_t block)
  {
    const auto width = static_cast<std::uint32_t>(this->drawn_.images.width);
    this->pixel_ = { static_cast<int>(pixel % width), static_cast<int>(pixel / width) };
    this->block_ = block;
    this->next_ = 0;
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
    return shown && this->isAtOutline(pixel);
  }

private:
  /// What a pixel's centre shows.
  struct Shown
  {
    glm::dvec3 position, normal; ///< of the receiver, as the picture has it on a flat triangle
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
    this->fill(own, 0.0f);
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
        this->cache_.find(this->drawn_, this->drawn_.images.fragments[pixel]);
      const PixelRays& rays = this->drawn_.images.rays;
      !seen.finite   ? leaveUncovered(span, this->centre_)
        : seen.solid ? projectSolid(seen, rays, span, this->centre_)
                     : projectFlat(seen, rays, span, this->centre_);
    }
    if (receivers->surface[i] == ReceiverPixels::notCovered)
    {
      return std::nullopt;
    }
    return Shown{ { receivers->positionX[i], receivers->positionY[i], receivers->positionZ[i] },
      { receivers->normalX[i], receivers->normalY[i], receivers->normalZ[i] } };
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

  bool isAtOutline(std::size_t own)
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
          this->fill(this->cache_.find(this->drawn_, this->drawn_.images.fragments[pixel]),
            static_cast<float>(order));
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

  /// Add receivers for the missing samples that lie on a triangle or solid.
  /// @param seen if not finite, none do
  void fill(const SeenTriangle& seen, float order)
  {
    const std::size_t first = this->next_;
    std::size_t left = 0;
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
        this->add(seen, met, place, sample);
      }
    }
    this->remaining_ = seen.finite ? left : this->remaining_;
    const std::size_t count = this->next_ - first;
    if (count > 0 && seen.smoothNormals)
    {
      findCurves(seen, { 0.0, 0.0, count, first }, this->samples_);
    }
    for (std::size_t i = first; i < this->next_; ++i)
    {
      this->copy(i, order);
    }
  }

  /// Copy a receiver to its place among those of all pixels.
  void copy(std::size_t i, float order)
  {
    const std::size_t to = this->blocks_.sample(this->block_, this->taken_[i]);
    for (const auto plane : ReceiverPixels::planes)
    {
      (this->receivers_.*plane)[to] = (this->samples_.*plane)[i];
    }
    this->receivers_.surface[to] = this->samples_.surface[i];
    this->receivers_.curved[to] = this->samples_.curved[i];
    if (this->samples_.curved[i] != 0)
    {
      this->receivers_.curves[to] = this->samples_.curves[i];
    }
    if (this->several_)
    {
      this->orders_[to] = order;
    }
  }

  void add(const SeenTriangle& seen, const Met& met, const glm::dvec2& place, std::size_t sample)
  {
    const std::size_t i = this->next_++;
    this->taken_[i] = sample;
    if (seen.solid)
    {
      projectSolid(seen, this->drawn_.images.rays, { place.x, place.y, 1, i }, this->samples_);
      return;
    }
    ReceiverPixels& samples = this->samples_;
    samples.positionX[i] = static_cast<float>(met.position.x);
    samples.positionY[i] = static_cast<float>(met.position.y);
    samples.positionZ[i] = static_cast<float>(met.position.z);
    samples.normalX[i] = seen.normal.x;
    samples.normalY[i] = seen.normal.y;
    samples.normalZ[i] = seen.normal.z;
    samples.offset[i] = met.offset;
    samples.surface[i] = seen.surface;
    samples.curved[i] = 0;
  }

  const Drawn& drawn_;
  const SharedPicture* several_;
  const std::vector<glm::vec2>& surfaces_;
  const std::vector<glm::dvec2>& places_;
  const SampleBlocks blocks_;
  ReceiverPixels& receivers_; ///< of all pixels' samples
  std::vector<float>& orders_;
  ReceiverPixels samples_; ///< of one pixel's samples, in the order in which they were found
  ReceiverPixels centre_;  ///< of one pixel
  SeenTriangles cache_;

  glm::ivec2 pixel_{ 0 };
  std::size_t block_ = 0;
  Shown shown_{};
  bool isSolid_ = false;   ///< the pixel shows a solid of this process
  double mostApart_ = 0.0; ///< of planes that go on: a pixel's side, and the position's rounding
  std::array<std::size_t, mostSamples> taken_; ///< the samples of samples_
  std::array<std::size_t, mostSamples> missing_{};
  std::size_t remaining_ = 0; ///< number of missing samples
  std::size_t next_ = 0;      ///< index of the next receiver
};

/// Return a picture's edge pixels, in order.
EdgePixels findEdgePixels(const ShownSurfaces& surfaces, const std::vector<float>& visibility,
  const std::vector<std::uint8_t>& classes)
{
  constexpr int rowsOfBand = 32;
  const int bands = (surfaces.height + rowsOfBand - 1) / rowsOfBand;
  std::vector<EdgePixels> found(static_cast<std::size_t>(bands));
  tbb::parallel_for(0, bands,
    [&](int band)
    {
      found[static_cast<std::size_t>(band)] = findEdges(surfaces, visibility, classes,
        band * rowsOfBand, std::min((band + 1) * rowsOfBand, surfaces.height));
    });
  EdgePixels all;
  for (const EdgePixels& ofBand : found)
  {
    all.ofShadows.insert(all.ofShadows.end(), ofBand.ofShadows.begin(), ofBand.ofShadows.end());
    all.ofSurfaces.insert(all.ofSurfaces.end(), ofBand.ofSurfaces.begin(), ofBand.ofSurfaces.end());
  }
  return all;
}

} // namespace

//------------------------------------------------------------------------------
void EdgeSamples::smooth(CpuScreenTechnique& technique, const ScreenInput& input,
  const std::vector<std::uint8_t>& classes, std::size_t perPixel, std::vector<float>& visibility,
  const SharedPicture* several, LightReport& report)
{
  const Drawn drawn = several ? several->drawn : input.receivers.drawn();
  const ReceiverImages& images = drawn.images;
  EdgePixels edges =
    findEdgePixels({ images.width, images.height, several ? several->surfaces : images.fragments },
      visibility, classes);
  // Calls take(pixel, mean of its samples) for pixels with `count` samples each.
  const auto trace =
    [&](const std::vector<std::uint32_t>& pixels, std::size_t count, bool drops, const auto& take)
  {
    const std::size_t most = samplesInMemory / count;
    for (std::size_t first = 0; first < pixels.size(); first += most)
    {
      const std::vector<std::uint32_t> some(pixels.begin() + static_cast<std::ptrdiff_t>(first),
        pixels.begin() + static_cast<std::ptrdiff_t>(std::min(first + most, pixels.size())));
      this->place(drawn, several, some, count);
      if (several)
      {
        this->share(*several);
      }
      if (drops)
      {
        this->dropHidden(images, input.tracer, several, some, count);
      }
      Receivers samples(this->receivers_);
      LightReport ofSamples;
      technique.computeVisibility(
        { input.light, input.fitting, input.occluders, samples, input.tracer, input.usesMap,
          &this->classes_, nullptr, nullptr, input.mapBakes },
        this->visibility_, ofSamples);
      report.rays += ofSamples.rays;
      for (std::size_t i = 0; i < some.size(); ++i)
      {
        take(some[i], this->mean(i, count, visibility[some[i]]));
      }
    }
  };
  std::vector<std::uint32_t>& pixels = edges.ofShadows;
  if (perPixel > probes)
  {
    trace(edges.ofSurfaces, probes, false,
      [&](std::uint32_t pixel, float mean)
      {
        if (mean != visibility[pixel])
        {
          pixels.push_back(pixel);
        }
      });
  }
  else
  {
    pixels.insert(pixels.end(), edges.ofSurfaces.begin(), edges.ofSurfaces.end());
  }
  trace(pixels, perPixel, true, [&](std::uint32_t pixel, float mean) { visibility[pixel] = mean; });
}

//------------------------------------------------------------------------------
/// Compute the samples' receivers on the triangles that this process drew. Samples without a
/// receiver are not covered.
void EdgeSamples::place(const Drawn& drawn, const SharedPicture* several,
  const std::vector<std::uint32_t>& pixels, std::size_t perPixel)
{
  constexpr std::size_t columns = SampleBlocks::columns;
  const std::size_t rows = SampleBlocks(perPixel).rows(pixels.size());
  this->receivers_.resize(static_cast<int>(columns), static_cast<int>(rows), drawn.findsCurves);
  std::fill(this->receivers_.surface.begin(), this->receivers_.surface.end(),
    ReceiverPixels::notCovered); // after the last pixel's samples
  this->orders_.assign(
    several ? this->receivers_.size() : 0, std::numeric_limits<float>::infinity());
  this->outline_.resize(pixels.size());
  const std::vector<glm::dvec2> places = samplePlaces(perPixel);
  tbb::enumerable_thread_specific<SamplePlacing> placings(
    [&] { return SamplePlacing(drawn, several, places, this->receivers_, this->orders_); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), pixelsAtOnce),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      SamplePlacing& placing = placings.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        this->outline_[i] = placing.place(pixels[i], i) ? 1 : 0;
      }
    });
}

//------------------------------------------------------------------------------
/// Replace this process's receivers of samples by those of all processes.
void EdgeSamples::share(const SharedPicture& several)
{
  std::vector<float> least = this->orders_;
  several.reduceToLeast(least);
  for (std::size_t i = 0; i < least.size(); ++i)
  {
    if (this->orders_[i] != least[i])
    {
      this->receivers_.surface[i] = ReceiverPixels::notCovered;
    }
  }
  this->receivers_ = several.share(this->receivers_);
}

//------------------------------------------------------------------------------
/// Drop samples of pixels at outlines that casters hide from the camera.
void EdgeSamples::dropHidden(const ReceiverImages& images, const EmbreeTracer& hiders,
  const SharedPicture* several, const std::vector<std::uint32_t>& pixels, std::size_t perPixel)
{
  const std::vector<glm::dvec2> places = samplePlaces(perPixel);
  const SampleBlocks blocks(perPixel);
  const auto width = static_cast<std::uint32_t>(images.width);
  ReceiverPixels& samples = this->receivers_;
  this->hidden_.assign(pixels.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), pixelsAtOnce),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      std::array<float, mostSamples> fromX, fromY, fromZ, toX, toY, toZ;
      std::array<std::size_t, mostSamples> tested;
      std::array<std::uint8_t, mostSamples> isSeen;
      for (std::size_t pixel = range.begin(); pixel != range.end(); ++pixel)
      {
        std::size_t count = 0;
        const glm::dvec2 centre(pixels[pixel] % width, pixels[pixel] / width);
        for (std::size_t n = 0; n < perPixel && this->outline_[pixel] != 0; ++n)
        {
          const std::size_t i = blocks.sample(pixel, n);
          if (samples.surface[i] == ReceiverPixels::notCovered)
          {
            continue;
          }
          const glm::vec3 normal(samples.normalX[i], samples.normalY[i], samples.normalZ[i]);
          const glm::vec3 from =
            glm::vec3(samples.positionX[i], samples.positionY[i], samples.positionZ[i]) +
            samples.offset[i] * normal;
          const glm::vec3 to(images.rays.origin(centre.x + places[n].x, centre.y + places[n].y));
          fromX[count] = from.x;
          fromY[count] = from.y;
          fromZ[count] = from.z;
          toX[count] = to.x;
          toY[count] = to.y;
          toZ[count] = to.z;
          tested[count++] = n;
        }
        hiders.areFree(count, { fromX.data(), fromY.data(), fromZ.data() },
          { toX.data(), toY.data(), toZ.data() }, isSeen.data());
        for (std::size_t k = 0; k < count; ++k)
        {
          this->hidden_[pixel] |= std::uint64_t(isSeen[k] == 0) << tested[k];
        }
      }
    });
  if (several)
  {
    several->uniteBits(this->hidden_);
  }
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
  {
    for (std::uint64_t bits = this->hidden_[pixel]; bits != 0; bits &= bits - 1)
    {
      samples.surface[blocks.sample(pixel, static_cast<std::size_t>(__builtin_ctzll(bits)))] =
        ReceiverPixels::notCovered;
    }
  }
}

//------------------------------------------------------------------------------
/// Return the mean of a pixel's samples, without those that face away from the light.
/// @param pixel its index among the pixels with samples
/// @param ofCentre returned if no sample counts
float EdgeSamples::mean(std::size_t pixel, std::size_t perPixel, float ofCentre) const
{
  const SampleBlocks blocks(perPixel);
  float sum = 0.0f;
  int count = 0;
  for (std::size_t row = 0; row < blocks.side; ++row)
  {
    const std::size_t first = blocks.firstOfRow(pixel, row);
    for (std::size_t i = first; i < first + blocks.side; ++i)
    {
      const bool counts = canBeLit(this->classes_[i]);
      sum += counts ? this->visibility_[i] : 0.0f;
      count += counts ? 1 : 0;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : ofCentre;
}

} // namespace gnomon
