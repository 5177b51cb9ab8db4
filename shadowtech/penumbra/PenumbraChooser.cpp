#include "shadowtech/penumbra/PenumbraChooser.h"

#include "shadowtech/penumbra/EdgeSums.h"
#include "shadowtech/penumbra/EdgeView.h"
#include "shadowtech/penumbra/ShaftEdges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace gnomon
{
namespace
{

/// Side of the squares of pixels that share a shaft.
constexpr std::size_t sideOfBlock = 8;

/// The fewest pixels that are halved where something other than edges lies between them and the
/// light.
constexpr std::size_t fewestToHalve = 8;

///@{
/// Tracing is faster than counting more edges than these: edges of a square per sample, and at
/// most; edges of a pixel per sample. If the first pixels of a square all exceed their limit, the
/// rest is traced without trying.
constexpr std::size_t edgesPerSample = 4;
constexpr std::size_t mostEdges = 8192;
constexpr std::size_t seenPerSample = 2;
constexpr std::int64_t triesOfBlock = 4;
///@}

///@{
/// Splits squares whose pixels see surfaces far apart. The longest side of the starts' box is
/// divided into parts; a split needs this many empty ones in a row.
constexpr std::size_t partsOfStarts = 8;
constexpr std::size_t emptyOfStarts = 3;
///@}

/// Chooses the rays of one tile.
class Choice
{
public:
  Choice(const EdgeTree& tree, const ShaftLight& light, std::size_t samples, TracedTile& tile,
    const SampleChooser::DirectionsOf& directionsOf, SampleRays& rays)
    : tree_(tree)
    , light_(light)
    , tile_(tile)
    , directionsOf_(directionsOf)
    , rays_(rays)
    , samples_(samples)
  {
    for (std::vector<float>& axis : this->directions_)
    {
      axis.resize(samples);
    }
  }

  /// Choose the rays of some pixels.
  /// @return how many of them have all their rays traced
  std::int64_t choose(std::uint16_t* pixels, std::size_t count)
  {
    this->starts_.clear();
    for (std::size_t i = 0; i < count; ++i)
    {
      this->starts_.add(this->tile_.origin(pixels[i]));
    }
    if (const std::size_t nearer = this->splitAtGap(pixels, count))
    {
      return this->choose(pixels, nearer) + this->choose(pixels + nearer, count - nearer);
    }
    this->starts_.finish();
    ShaftEdges::Found found = ShaftEdges::Found::Unclear;
    if (const std::optional<LightShaft> shaft = LightShaft::make(this->light_, this->starts_))
    {
      found = this->edges_.find(
        this->tree_, *shaft, this->starts_, std::min(edgesPerSample * this->samples_, mostEdges));
      if (found == ShaftEdges::Found::All)
      {
        return this->choose(pixels, count, *shaft);
      }
    }
    if (found == ShaftEdges::Found::TooMany || count < fewestToHalve)
    {
      return static_cast<std::int64_t>(count);
    }
    // Halve across the longest side of the starts' box.
    const int axis = longestAxis(this->starts_.bounds());
    std::uint16_t* const middle = pixels + count / 2;
    std::nth_element(pixels, middle, pixels + count,
      [&](std::uint16_t a, std::uint16_t b)
      { return this->tile_.origin(a)[axis] < this->tile_.origin(b)[axis]; });
    return this->choose(pixels, count / 2) + this->choose(middle, count - count / 2);
  }

private:
  static int longestAxis(const Bounds& bounds)
  {
    const glm::dvec3 size = bounds.upper - bounds.lower;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  /// Partition pixels at a gap, as between two surfaces far apart, whose common shaft would hold
  /// all that lies between.
  /// @return the number of pixels before the gap; 0 if there is no gap
  std::size_t splitAtGap(std::uint16_t* pixels, std::size_t count) const
  {
    const Bounds& bounds = this->starts_.bounds();
    const int axis = longestAxis(bounds);
    const double lower = bounds.lower[axis];
    const double size = bounds.upper[axis] - lower;
    if (!(size > 0.0))
    {
      return 0;
    }
    const auto partOf = [&](std::uint16_t pixel)
    {
      const double share = (static_cast<double>(this->tile_.origin(pixel)[axis]) - lower) / size;
      return std::min(
        static_cast<std::size_t>(share * static_cast<double>(partsOfStarts)), partsOfStarts - 1);
    };
    std::array<bool, partsOfStarts> taken{};
    for (std::size_t i = 0; i < count; ++i)
    {
      taken[partOf(pixels[i])] = true;
    }
    // The first part and the last one are never empty.
    std::size_t empty = 0;
    for (std::size_t part = 1; part < partsOfStarts; ++part)
    {
      if (taken[part] && empty >= emptyOfStarts)
      {
        std::uint16_t* const behind = std::partition(
          pixels, pixels + count, [&](std::uint16_t pixel) { return partOf(pixel) < part; });
        return static_cast<std::size_t>(behind - pixels);
      }
      empty = taken[part] ? 0 : empty + 1;
    }
    return 0;
  }

  /// Find the records that rays may start on, allowing for rounding.
  void findUnderStarts()
  {
    this->tree_.find(this->starts_.bounds(), this->under_);
    const auto isCertain = [&](std::uint32_t place)
    {
      const BvhRecord& record = this->tree_.record(place);
      if (record.opaque)
      {
        return false;
      }
      const EdgeTriangle& triangle = this->tree_.triangle(record.number);
      const glm::dvec2 behind = this->starts_.behind(triangle);
      return behind.x > triangle.noise || behind.y < -triangle.noise;
    };
    this->under_.erase(
      std::remove_if(this->under_.begin(), this->under_.end(), isCertain), this->under_.end());
  }

  bool isOnTriangle(const glm::vec3& start) const
  {
    return std::any_of(this->under_.begin(), this->under_.end(),
      [&](std::uint32_t place) { return this->tree_.isOn(start, this->tree_.record(place)); });
  }

  /// Return true if a pixel's rays end where the shaft's do. Rays that start nearer to the near
  /// face of a light's box than their offset end beyond it.
  bool endsAsShaft(std::size_t pixel, const LightShaft& shaft) const
  {
    const glm::dvec3 direction(this->tile_.direction(pixel));
    return !(shaft.lastEnd() < std::numeric_limits<double>::infinity()) ||
      shaft.endDepth(shaft.toShaft(this->tile_.origin(pixel)) + shaft.rotation() * direction) <=
      shaft.lastEnd();
  }

  std::int64_t choose(const std::uint16_t* pixels, std::size_t count, const LightShaft& shaft)
  {
    this->findUnderStarts();
    std::int64_t traced = 0;
    std::int64_t tooMany = 0;
    bool anyFew = false;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint16_t pixel = pixels[i];
      const glm::vec3 start = this->tile_.origin(pixel);
      if (this->isOnTriangle(start) || !this->endsAsShaft(pixel, shaft))
      {
        ++traced;
        continue;
      }
      this->seen_.clear();
      if (this->edges_.size() == 0)
      {
        this->decideByOneRay(pixel);
        continue;
      }
      const EdgeView see(this->tree_, shaft, start);
      this->edges_.select(see.startShaft(), see.slopes(), this->numbers_);
      if (this->numbers_.size() > seenPerSample * this->samples_)
      {
        ++traced;
        ++tooMany;
        if (tooMany == triesOfBlock && !anyFew)
        {
          return traced + static_cast<std::int64_t>(count - i - 1);
        }
        continue;
      }
      anyFew = true;
      for (const std::uint32_t number : this->numbers_)
      {
        if (const std::optional<SeenEdge> seen = see(this->edges_, number))
        {
          this->seen_.push_back(*seen);
        }
      }
      if (this->seen_.empty())
      {
        this->decideByOneRay(pixel);
        continue;
      }
      this->count(pixel, shaft);
    }
    return traced;
  }

  /// Choose one ray for a pixel whose rays pass no edge.
  void decideByOneRay(std::uint16_t pixel)
  {
    const auto all = static_cast<std::uint32_t>(this->samples_);
    this->rays_.pixels[pixel] = { all, all, 0, 1 };
    this->tile_.classes[pixel] = static_cast<std::uint8_t>(TracedClass::Lit);
  }

  /// Choose the rays of a pixel whose rays pass edges.
  void count(std::uint16_t pixel, const LightShaft& shaft)
  {
    const LightSamples::Coordinates directions{ this->directions_[0].data(),
      this->directions_[1].data(), this->directions_[2].data() };
    this->directionsOf_(pixel, directions);
    this->sums_.setRays(glm::mat3(shaft.rotation()), directions, this->samples_);
    this->sums_.add(this->seen_);
    std::vector<std::uint32_t>& samples = this->rays_.samples;
    const std::size_t before = samples.size();
    // The first ray stands for all that meet the fewest triangles.
    const EdgeSums::Fewest fewest = this->sums_.fewest();
    if (fewest.count > 0)
    {
      samples.push_back(fewest.first);
    }
    const std::size_t certain = samples.size();
    this->sums_.appendUncertain(samples);
    PixelSamples& chosen = this->rays_.pixels[pixel];
    chosen.lit = fewest.count + static_cast<std::uint32_t>(samples.size() - certain);
    chosen.ofFirstRay = std::max(fewest.count, 1u);
    chosen.first = static_cast<std::uint32_t>(before);
    chosen.count = static_cast<std::uint32_t>(samples.size() - before);
    this->tile_.classes[pixel] = penumbraClass;
  }

  const EdgeTree& tree_;
  const ShaftLight& light_;
  TracedTile& tile_;
  const SampleChooser::DirectionsOf& directionsOf_;
  SampleRays& rays_;
  std::size_t samples_;
  std::array<std::vector<float>, 3> directions_; ///< x, y, z of a pixel's rays
  RayStarts starts_;
  std::vector<std::uint32_t> under_; ///< places of records that some rays may start on
  ShaftEdges edges_;
  std::vector<std::uint32_t> numbers_;
  std::vector<SeenEdge> seen_;
  EdgeSums sums_;
};

} // namespace

std::vector<PixelClass> classesOfPenumbra()
{
  std::vector<PixelClass> classes = classesOfTracing();
  classes.push_back({ "penumbra, by its edges", { 250, 170, 30 }, true });
  return classes;
}

void PenumbraChooser::choose(
  TracedTile& tile, const DirectionsOf& directionsOf, SampleRays& rays, bool again) const
{
  Choice choice(this->tree_, this->light_, this->samples_, tile, directionsOf, rays);
  std::int64_t traced = 0;
  for (std::size_t row = 0; row < TracedTile::rows; row += sideOfBlock)
  {
    for (std::size_t column = 0; column < TracedTile::columns; column += sideOfBlock)
    {
      std::array<std::uint16_t, sideOfBlock * sideOfBlock> pixels;
      std::size_t count = 0;
      for (std::size_t i = 0; i < pixels.size(); ++i)
      {
        const std::size_t pixel =
          (row + i / sideOfBlock) * TracedTile::columns + column + i % sideOfBlock;
        pixels[count] = static_cast<std::uint16_t>(pixel);
        count += tile.needed[pixel] != 0 ? 1 : 0;
      }
      traced += count > 0 ? choice.choose(pixels.data(), count) : 0;
    }
  }
  this->tracedPixels_ += again ? 0 : traced;
}

} // namespace gnomon
