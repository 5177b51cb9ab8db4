#include "shadowtech/tracing/EdgeSamples.h"

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/RayFilter.h"
#include "shadowtech/tracing/SamplePlacing.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

namespace gnomon
{
namespace
{

constexpr std::size_t pixelsAtOnce = 256; ///< of a task
///@{
/// Samples in memory: they fit into caches, unless processes would wait for each other more often.
constexpr std::size_t samplesAlone = 1u << 16;  ///< 2 MB
constexpr std::size_t samplesShared = 1u << 20; ///< 35 MB
///@}
constexpr std::size_t probes = 4; ///< samples that decide if a pixel between surfaces needs all

/// The least difference of visibility that is an edge. Samples' means of opaque casters differ by
/// more, those of filters by rounding.
constexpr float leastStep = 1.0f / 512.0f;

/// True if a TracedClass is of a receiver that the light can reach.
bool canBeLit(std::uint8_t ofReceiver)
{
  const auto traced = static_cast<TracedClass>(ofReceiver);
  return traced != TracedClass::Unreached && traced != TracedClass::NoReceiver;
}

/// Return the visibility of a pixel, of an image for each channel or of one for all.
glm::vec3 channelsAt(const std::vector<float>& visibility, std::size_t pixel, std::size_t pixels)
{
  return visibility.size() == pixels
    ? glm::vec3(visibility[pixel])
    : glm::vec3(visibility[pixel], visibility[pixels + pixel], visibility[2 * pixels + pixel]);
}

/// Return the images of three channels as one. The weights differ, so that colours do.
std::vector<float> mixed(const std::vector<float>& visibility)
{
  const std::size_t pixels = visibility.size() / 3;
  std::vector<float> mix(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    mix[i] = glm::dot(channelsAt(visibility, i, pixels), glm::vec3(0.29f, 0.47f, 0.24f));
  }
  return mix;
}

bool differ(const glm::vec3& a, const glm::vec3& b)
{
  return glm::any(glm::greaterThan(glm::abs(a - b), glm::vec3(leastStep)));
}

struct ShownSurfaces
{
  int width, height;
  const std::vector<glm::vec2>& numbers; ///< x: the pixel's surface
};

struct EdgePixels
{
  std::vector<std::uint32_t> ofShadows;  ///< pixels meet that are not lit alike
  std::vector<std::uint32_t> ofSurfaces; ///< several surfaces, all lit alike
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
    this->ownLight_.resize(places);
    this->leastSurface_.resize(places);
    this->mostSurface_.resize(places);
    this->leastLight_.resize(places);
    this->mostLight_.resize(places);
    // Shifted by one place, for copies of the border's pixels on both sides.
    float* const surface = this->ownSurface_.data() + 1;
    float* const light = this->ownLight_.data() + 1;
    for (int x = 0; x < width; ++x)
    {
      surface[x] = surfaces.numbers[first + static_cast<std::size_t>(x)].x;
    }
    for (int x = 0; x < width; ++x)
    {
      const std::size_t pixel = first + static_cast<std::size_t>(x);
      light[x] = canBeLit(classes[pixel]) ? visibility[pixel] : unreached;
    }
    surface[-1] = surface[0];
    surface[width] = surface[width - 1];
    light[-1] = light[0];
    light[width] = light[width - 1];
    const auto orMost = [](float of) { return of < 0.0f ? -unreached : of; };
    for (int x = 0; x < width; ++x)
    {
      const auto i = static_cast<std::size_t>(x);
      this->leastSurface_[i] = std::min(std::min(surface[x - 1], surface[x]), surface[x + 1]);
      this->mostSurface_[i] = std::max(std::max(surface[x - 1], surface[x]), surface[x + 1]);
      this->leastLight_[i] =
        std::min(std::min(orMost(light[x - 1]), orMost(light[x])), orMost(light[x + 1]));
      this->mostLight_[i] = std::max(std::max(light[x - 1], light[x]), light[x + 1]);
    }
  }

  /// Append the edge pixels of the middle one of three rows.
  static void findEdges(const ShownRow& below, const ShownRow& row, const ShownRow& above,
    std::size_t firstPixel, EdgePixels& found)
  {
    const std::size_t width = row.ownLight_.size() - 2;
    for (std::size_t x = 0; x < width; ++x)
    {
      const bool isOneSurface = below.leastSurface_[x] == above.mostSurface_[x] &&
        row.leastSurface_[x] == above.mostSurface_[x] &&
        row.mostSurface_[x] == above.leastSurface_[x] &&
        below.mostSurface_[x] == above.leastSurface_[x];
      const float most =
        std::max(std::max(below.mostLight_[x], row.mostLight_[x]), above.mostLight_[x]);
      const float least =
        std::min(std::min(below.leastLight_[x], row.leastLight_[x]), above.leastLight_[x]);
      const bool hasStep = most - least > leastStep;
      if ((!isOneSurface || hasStep) && row.ownLight_[x + 1] >= 0.0f)
      {
        (hasStep ? found.ofShadows : found.ofSurfaces)
          .push_back(static_cast<std::uint32_t>(firstPixel + x));
      }
    }
  }

private:
  static constexpr float unreached = -2.0f; ///< by the light

  std::vector<float> ownSurface_;                 ///< ShownSurfaces::numbers
  std::vector<float> leastSurface_, mostSurface_; ///< of three pixels
  std::vector<float> ownLight_;                   ///< visibility, or `unreached`
  std::vector<float> leastLight_, mostLight_;     ///< of the reached ones of three pixels
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

std::vector<EdgePixel> EdgeSamples::smooth(CpuScreenTechnique& technique, const ScreenInput& input,
  const std::vector<std::uint8_t>& classes, std::size_t perPixel,
  const std::vector<float>& visibility, const RayFilter* filter, const SharedPicture* several,
  LightCounts& counts)
{
  const Drawn drawn = several ? several->drawn : input.receivers.drawn();
  const ReceiverImages& images = drawn.images;
  const std::size_t allPixels = classes.size();
  const bool isColoured = filter && filter->isColoured();
  EdgePixels edges =
    findEdgePixels({ images.width, images.height, several ? several->surfaces : images.fragments },
      isColoured ? mixed(visibility) : visibility, classes);
  const auto ofCentre = [&](std::uint32_t pixel)
  { return channelsAt(visibility, pixel, allPixels); };
  // Calls take(pixel, mean of its samples) for pixels with `count` samples each.
  const auto trace =
    [&](const std::vector<std::uint32_t>& pixels, std::size_t count, bool drops, const auto& take)
  {
    const std::size_t most = (several ? samplesShared : samplesAlone) / count;
    for (std::size_t first = 0; first < pixels.size(); first += most)
    {
      const std::vector<std::uint32_t> some(pixels.begin() + static_cast<std::ptrdiff_t>(first),
        pixels.begin() + static_cast<std::ptrdiff_t>(std::min(first + most, pixels.size())));
      this->place(drawn, several, some, count, drops);
      if (several)
      {
        this->share(*several);
      }
      if (drops)
      {
        this->dropHidden(images, input.tracer, several, some, count);
      }
      Receivers samples(this->receivers_);
      LightCounts ofSamples;
      ScreenInput ofEdges{ input.light, input.fitting, input.occluders, samples, input.tracer,
        input.mapBakes };
      ofEdges.usesMap = input.usesMap;
      ofEdges.classes = &this->classes_;
      technique.computeVisibility(ofEdges, this->visibility_, ofSamples);
      counts.rays += ofSamples.rays;
      if (filter)
      {
        counts.rays += static_cast<std::int64_t>(
          scaleByFilter(*filter, input.light, input.occluders, samples, this->visibility_));
      }
      for (std::size_t i = 0; i < some.size(); ++i)
      {
        take(some[i], this->mean(i, count, ofCentre(some[i])));
      }
    }
  };
  std::vector<std::uint32_t>& pixels = edges.ofShadows;
  if (perPixel > probes)
  {
    trace(edges.ofSurfaces, probes, false,
      [&](std::uint32_t pixel, const glm::vec3& mean)
      {
        if (differ(mean, ofCentre(pixel)))
        {
          pixels.push_back(pixel);
        }
      });
  }
  else
  {
    pixels.insert(pixels.end(), edges.ofSurfaces.begin(), edges.ofSurfaces.end());
  }
  std::vector<EdgePixel> smooth;
  trace(pixels, perPixel, true,
    [&](std::uint32_t pixel, const glm::vec3& mean)
    {
      if (differ(mean, ofCentre(pixel)))
      {
        smooth.push_back({ pixel, mean, ofCentre(pixel) });
      }
    });
  return smooth;
}

/// Compute the samples' receivers on the triangles that this process drew. Samples without a
/// receiver are not covered.
/// @param findsOutlines true if it is to be known which pixels are at outlines
void EdgeSamples::place(const Drawn& drawn, const SharedPicture* several,
  const std::vector<std::uint32_t>& pixels, std::size_t perPixel, bool findsOutlines)
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
        const bool isPlaced = placing.place(pixels[i], i);
        if (findsOutlines)
        {
          this->outline_[i] = isPlaced && placing.isAtOutline(pixels[i]) ? 1 : 0;
        }
      }
    });
}

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
      constexpr std::size_t mostSamples = SampleBlocks::mostSamples;
      std::array<float, mostSamples> fromX, fromY, fromZ, wayX, wayY, wayZ;
      std::array<std::size_t, mostSamples> tested;
      std::array<std::uint8_t, mostSamples> isHidden;
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
          const glm::vec3 from = samples.position(i) + samples.offset[i] * samples.normal(i);
          const glm::vec3 way =
            glm::vec3(images.rays.origin(centre.x + places[n].x, centre.y + places[n].y)) - from;
          fromX[count] = from.x;
          fromY[count] = from.y;
          fromZ[count] = from.z;
          wayX[count] = way.x;
          wayY[count] = way.y;
          wayZ[count] = way.z;
          tested[count++] = n;
        }
        hiders.areBlocked(count, { fromX.data(), fromY.data(), fromZ.data() },
          { wayX.data(), wayY.data(), wayZ.data() }, shadowRayFarAtLight, isHidden.data());
        for (std::size_t k = 0; k < count; ++k)
        {
          this->hidden_[pixel] |= std::uint64_t(isHidden[k]) << tested[k];
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

/// Return the mean of a pixel's samples, without those that face away from the light.
/// @param pixel its index among the pixels with samples
/// @param ofCentre returned if no sample counts
glm::vec3 EdgeSamples::mean(
  std::size_t pixel, std::size_t perPixel, const glm::vec3& ofCentre) const
{
  const SampleBlocks blocks(perPixel);
  glm::vec3 sum(0.0f);
  int count = 0;
  for (std::size_t row = 0; row < blocks.side; ++row)
  {
    const std::size_t first = blocks.firstOfRow(pixel, row);
    for (std::size_t i = first; i < first + blocks.side; ++i)
    {
      const bool counts = canBeLit(this->classes_[i]);
      sum += counts ? channelsAt(this->visibility_, i, this->classes_.size()) : glm::vec3(0.0f);
      count += counts ? 1 : 0;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : ofCentre;
}

} // namespace gnomon
