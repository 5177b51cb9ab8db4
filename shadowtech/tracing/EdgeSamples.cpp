#include "shadowtech/tracing/EdgeSamples.h"

#include "shadowtech/base/ReceiverSpans.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace gnomon
{
namespace
{

constexpr std::size_t mostSamples = 64;
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
  void look(const ReceiverImages& images, const std::vector<float>& visibility,
    const std::vector<std::uint8_t>& classes, int row)
  {
    const int width = images.width;
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
      surface[x] = images.fragments[first + static_cast<std::size_t>(x)].x;
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

  std::vector<float> ownSurface_;                 ///< ReceiverImages::fragments
  std::vector<float> leastSurface_, mostSurface_; ///< of three pixels
  std::vector<int> ownKinds_;                     ///< lit, dark or neither
  std::vector<int> kinds_;                        ///< of three pixels, combined by or
};

/// Return the edge pixels of a band of rows.
EdgePixels findEdges(const ReceiverImages& images, const std::vector<float>& visibility,
  const std::vector<std::uint8_t>& classes, int firstRow, int endRow)
{
  EdgePixels found;
  std::array<ShownRow, 3> rows; // by number modulo three
  const auto rowAt = [&](int row) -> ShownRow&
  { return rows[static_cast<std::size_t>(glm::clamp(row, 0, images.height - 1) % 3)]; };
  for (int row = std::max(firstRow - 1, 0); row < std::min(firstRow + 1, endRow); ++row)
  {
    rowAt(row).look(images, visibility, classes, row);
  }
  for (int row = firstRow; row < endRow; ++row)
  {
    if (row + 1 < images.height)
    {
      rowAt(row + 1).look(images, visibility, classes, row + 1);
    }
    const std::size_t firstPixel =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(images.width);
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

  std::size_t side; ///< of a square
};

/// Computes the receivers of samples, pixel by pixel.
class SamplePlacing
{
public:
  /// @param hiders tests if casters hide samples from the camera; null: none do
  SamplePlacing(const Drawn& drawn, const FreeSegments* hiders,
    const std::vector<glm::dvec2>& places, ReceiverPixels& receivers)
    : drawn_(drawn)
    , hiders_(hiders)
    , places_(places)
    , receivers_(receivers)
  {
    this->samples_.resize(static_cast<int>(places.size()), 1);
  }

  /// @param block the pixel's index among the pixels with samples
  void place(std::uint32_t pixel, std::size_t block)
  {
    const auto width = static_cast<std::uint32_t>(this->drawn_.images.width);
    const int x = static_cast<int>(pixel % width);
    const int y = static_cast<int>(pixel / width);
    this->pixel_ = { x, y };
    this->next_ = 0;
    this->remaining_ = this->places_.size();
    std::iota(this->missing_.begin(), this->missing_.begin() + this->remaining_, 0);

    const glm::vec2 own = this->drawn_.images.fragments[pixel];
    const SeenTriangle& seen = this->cache_.find(this->drawn_, own);
    if (seen.finite)
    {
      this->look(seen);
      this->fill(seen);
      this->fillFromNeighbours(own);
      if (this->hiders_ && this->isAtOutline(own))
      {
        this->dropHidden();
      }
    }
    leaveUncovered({ 0.0, 0.0, this->remaining_, this->next_ }, this->samples_);
    this->copyTo(block);
  }

private:
  void copyTo(std::size_t block)
  {
    const SampleBlocks blocks(this->places_.size());
    for (std::size_t row = 0; row < blocks.side; ++row)
    {
      const std::size_t from = row * blocks.side;
      const std::size_t to = blocks.firstOfRow(block, row);
      const auto copy = [&](auto array)
      { std::copy_n(&(this->samples_.*array)[from], blocks.side, &(this->receivers_.*array)[to]); };
      for (const auto plane : ReceiverPixels::planes)
      {
        copy(plane);
      }
      copy(&ReceiverPixels::surface);
      copy(&ReceiverPixels::lifted);
    }
  }

  /// Remember the surface that the pixel shows.
  void look(const SeenTriangle& seen)
  {
    const PixelRays& rays = this->drawn_.images.rays;
    const Met met = this->meet(seen, this->pixel_);
    this->normal_ = met.normal;
    this->position_ = met.position;
    this->pixelSide_ = glm::length(rays.originPerRow + met.t * rays.directionPerRow);
  }

  /// Call visit(fragment, pixel) for the fragments of the pixels around it, skipping most
  /// repetitions.
  template <typename Visit>
  void visitNeighbours(const glm::vec2& own, const Visit& visit) const
  {
    const ReceiverImages& images = this->drawn_.images;
    glm::vec2 before = own;
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        const int x = glm::clamp(this->pixel_.x + dx, 0, images.width - 1);
        const int y = glm::clamp(this->pixel_.y + dy, 0, images.height - 1);
        const glm::vec2& fragment =
          images.fragments[static_cast<std::size_t>(y) * static_cast<std::size_t>(images.width) +
            static_cast<std::size_t>(x)];
        if (fragment != own && fragment != before)
        {
          before = fragment;
          visit(fragment, glm::dvec2(x, y));
        }
      }
    }
  }

  /// True if a neighbour shows something that does not continue the pixel's surface.
  bool isAtOutline(const glm::vec2& own)
  {
    bool isOutline = false;
    this->visitNeighbours(own,
      [&](const glm::vec2& fragment, const glm::dvec2& pixel)
      {
        if (!isOutline)
        {
          const SeenTriangle& seen = this->cache_.find(this->drawn_, fragment);
          isOutline = fragment.x != own.x || !seen.finite || !this->goesOn(this->meet(seen, pixel));
        }
      });
    return isOutline;
  }

  /// Drop samples that casters hide from the camera.
  void dropHidden()
  {
    const PixelRays& rays = this->drawn_.images.rays;
    const ReceiverPixels& samples = this->samples_;
    std::array<float, mostSamples> fromX, fromY, fromZ, toX, toY, toZ;
    for (std::size_t i = 0; i < this->next_; ++i)
    {
      const glm::vec3 position(samples.positionX[i], samples.positionY[i], samples.positionZ[i]);
      const glm::vec3 normal(samples.normalX[i], samples.normalY[i], samples.normalZ[i]);
      const glm::vec3 from = position + samples.offset[i] * normal;
      fromX[i] = from.x;
      fromY[i] = from.y;
      fromZ[i] = from.z;
      const glm::dvec2 place = this->taken_[i];
      const glm::vec3 to(rays.origin(place.x, place.y));
      toX[i] = to.x;
      toY[i] = to.y;
      toZ[i] = to.z;
    }
    std::array<std::uint8_t, mostSamples> isSeen;
    this->hiders_->areFree(this->next_, { fromX.data(), fromY.data(), fromZ.data() },
      { toX.data(), toY.data(), toZ.data() }, isSeen.data());
    for (std::size_t i = 0; i < this->next_; ++i)
    {
      if (isSeen[i] == 0)
      {
        this->samples_.surface[i] = ReceiverPixels::notCovered;
      }
    }
  }

  void fillFromNeighbours(const glm::vec2& own)
  {
    this->visitNeighbours(own,
      [&](const glm::vec2& fragment, const glm::dvec2&)
      {
        if (fragment.x == own.x && this->remaining_ > 0)
        {
          const SeenTriangle& seen = this->cache_.find(this->drawn_, fragment);
          if (seen.finite)
          {
            this->fill(seen);
          }
        }
      });
  }

  /// The point where a place's ray meets a triangle or solid.
  struct Met
  {
    double t; ///< along the ray (PixelRays)
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
      return { point.t, point.position, seen.normal, point.offset, point.isInside };
    }
    const glm::dvec3 origin = rays.origin(place.x, place.y);
    const glm::dvec3 direction = rays.direction(place.x, place.y);
    const SolidPoint point = seenPoint(*seen.solid, origin, direction);
    const double t = glm::dot(point.position - origin, direction) / glm::dot(direction, direction);
    return { t, point.position, point.normal, 0.0f, point.isMet };
  }

  /// True if a point continues the surface that the pixel shows.
  bool goesOn(const Met& met) const
  {
    constexpr double leastCosine = 0.70710678; // 45 degrees
    return glm::dot(met.normal, this->normal_) >= leastCosine &&
      std::abs(glm::dot(met.position - this->position_, this->normal_)) <= this->pixelSide_;
  }

  /// Add receivers for the missing samples that lie on a triangle or solid.
  void fill(const SeenTriangle& seen)
  {
    const std::size_t first = this->next_;
    std::size_t left = 0;
    for (std::size_t i = 0; i < this->remaining_; ++i)
    {
      const std::size_t sample = this->missing_[i];
      const glm::dvec2 place = glm::dvec2(this->pixel_) + this->places_[sample];
      const Met met = this->meet(seen, place);
      if (!met.isMet || !this->goesOn(met))
      {
        this->missing_[left++] = sample;
      }
      else
      {
        this->add(seen, met, place);
      }
    }
    this->remaining_ = left;
    const std::size_t count = this->next_ - first;
    if (count > 0 && seen.smoothNormals)
    {
      liftSpan(seen, *this->drawn_.freeSegments, { 0.0, 0.0, count, first }, this->samples_);
    }
  }

  void add(const SeenTriangle& seen, const Met& met, const glm::dvec2& place)
  {
    const std::size_t i = this->next_++;
    this->taken_[i] = place;
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
    samples.lifted[i] = 0;
  }

  const Drawn& drawn_;
  const FreeSegments* hiders_;
  const std::vector<glm::dvec2>& places_;
  ReceiverPixels& receivers_; ///< of all pixels' samples
  ReceiverPixels samples_;    ///< of one pixel's samples
  SeenTriangles cache_;

  glm::ivec2 pixel_{ 0 };
  glm::dvec3 position_{ 0.0 }, normal_{ 0.0 }; ///< of the surface that the pixel shows
  double pixelSide_ = 0.0;                     ///< there
  std::array<glm::dvec2, mostSamples> taken_;  ///< the receivers' places in the picture
  std::array<std::size_t, mostSamples> missing_{};
  std::size_t remaining_ = 0; ///< number of missing samples
  std::size_t next_ = 0;      ///< index of the next receiver
};

/// Return a picture's edge pixels, in order.
EdgePixels findEdgePixels(const ReceiverImages& images, const std::vector<float>& visibility,
  const std::vector<std::uint8_t>& classes)
{
  constexpr int rowsOfBand = 32;
  const int bands = (images.height + rowsOfBand - 1) / rowsOfBand;
  std::vector<EdgePixels> found(static_cast<std::size_t>(bands));
  tbb::parallel_for(0, bands,
    [&](int band)
    {
      found[static_cast<std::size_t>(band)] = findEdges(images, visibility, classes,
        band * rowsOfBand, std::min((band + 1) * rowsOfBand, images.height));
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
  LightReport& report)
{
  const Drawn drawn = input.receivers.drawn();
  EdgePixels edges = findEdgePixels(drawn.images, visibility, classes);
  const auto trace =
    [&](const std::vector<std::uint32_t>& pixels, std::size_t count, const FreeSegments* hiders)
  {
    this->place(drawn, hiders, pixels, count);
    Receivers samples(this->receivers_);
    LightReport ofSamples;
    technique.computeVisibility(
      { input.light, input.fitting, input.occluders, samples, input.tracer, input.usesMap,
        &this->classes_, nullptr, nullptr, input.mapBakes },
      this->visibility_, ofSamples);
    report.rays += ofSamples.rays;
  };
  std::vector<std::uint32_t>& pixels = edges.ofShadows;
  if (perPixel > probes && !edges.ofSurfaces.empty())
  {
    trace(edges.ofSurfaces, probes, nullptr);
    for (std::size_t i = 0; i < edges.ofSurfaces.size(); ++i)
    {
      const std::uint32_t pixel = edges.ofSurfaces[i];
      if (this->mean(i, probes, visibility[pixel]) != visibility[pixel])
      {
        pixels.push_back(pixel);
      }
    }
  }
  else
  {
    pixels.insert(pixels.end(), edges.ofSurfaces.begin(), edges.ofSurfaces.end());
  }
  if (!pixels.empty())
  {
    trace(pixels, perPixel, drawn.freeSegments);
  }
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    float& ofPixel = visibility[pixels[i]];
    ofPixel = this->mean(i, perPixel, ofPixel);
  }
}

//------------------------------------------------------------------------------
/// Compute the samples' receivers. Samples without a receiver are not covered.
/// @param hiders tests if casters hide samples from the camera; null: none do
void EdgeSamples::place(const Drawn& drawn, const FreeSegments* hiders,
  const std::vector<std::uint32_t>& pixels, std::size_t perPixel)
{
  constexpr std::size_t columns = SampleBlocks::columns;
  const std::size_t rows = SampleBlocks(perPixel).rows(pixels.size());
  this->receivers_.resize(static_cast<int>(columns), static_cast<int>(rows));
  std::fill(this->receivers_.surface.begin(), this->receivers_.surface.end(),
    ReceiverPixels::notCovered); // after the last pixel's samples
  const std::vector<glm::dvec2> places = samplePlaces(perPixel);
  tbb::enumerable_thread_specific<SamplePlacing> placings(
    [&] { return SamplePlacing(drawn, hiders, places, this->receivers_); });
  constexpr std::size_t pixelsAtOnce = 256;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), pixelsAtOnce),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      SamplePlacing& placing = placings.local();
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        placing.place(pixels[i], i);
      }
    });
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
