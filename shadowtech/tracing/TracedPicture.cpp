#include "shadowtech/tracing/TracedPicture.h"

#include "shadowtech/tracing/AreaTile.h"

#include <algorithm>
#include <atomic>
#include <type_traits>

namespace gnomon
{
namespace
{

/// True if a pixel of this class is dark without a ray.
constexpr bool isDark(TracedClass of)
{
  return of == TracedClass::Unreached || of == TracedClass::Shadow;
}

/// Compute the rays of one row of a tile from its receivers.
/// @param columns a number, or a constant that lets the compiler vectorise the loop
/// @param from index of the row's first receiver
/// @param to index of the row's first pixel
template <typename Columns, typename MakeRay>
void makeRays(const ReceiverPixels& receivers, std::size_t from, Columns columns,
  const MakeRay& makeRay, std::size_t to, TracedTile& tile)
{
  const std::size_t count = columns;
  const float* const positionX = &receivers.positionX[from];
  const float* const positionY = &receivers.positionY[from];
  const float* const positionZ = &receivers.positionZ[from];
  const float* const normalX = &receivers.normalX[from];
  const float* const normalY = &receivers.normalY[from];
  const float* const normalZ = &receivers.normalZ[from];
  const float* const offset = &receivers.offset[from];
#pragma GCC ivdep
  for (std::size_t x = 0; x < count; ++x)
  {
    const ShadowRay ray = makeRay(glm::vec3(positionX[x], positionY[x], positionZ[x]),
      glm::vec3(normalX[x], normalY[x], normalZ[x]), offset[x]);
    tile.originX[to + x] = ray.origin.x;
    tile.originY[to + x] = ray.origin.y;
    tile.originZ[to + x] = ray.origin.z;
    tile.directionX[to + x] = ray.direction.x;
    tile.directionY[to + x] = ray.direction.y;
    tile.directionZ[to + x] = ray.direction.z;
    tile.needed[to + x] = ray.traced ? 1 : 0;
  }
}

/// Fill a row of a tile whose pixels need no rays.
/// @param known of all of them; Uncertain: they receive nothing
void fillRow(Certainty known, const std::array<float, 3>& lit, std::size_t columns, std::size_t to,
  TracedTile& tile)
{
  const TracedClass of =
    known == Certainty::Uncertain ? TracedClass::NoReceiver : static_cast<TracedClass>(known);
  std::fill_n(&tile.classes[to], columns, static_cast<std::uint8_t>(of));
  std::fill_n(&tile.needed[to], columns, 0);
  for (std::size_t channel = 0; channel < tile.channels; ++channel)
  {
    std::fill_n(&tile.visibility[channel][to], columns, isDark(of) ? 0.0f : lit[channel]);
  }
}

/// Classify the pixels of one row of a tile: which rays are needed, and the visibility without
/// them.
/// @param receives by surface + 1: 1 or 0
/// @param certain null: nothing is certain
/// @param lit the visibility of lit pixels, by channel
void classify(const ReceiverTile& tile, std::size_t row, const std::uint8_t* receives,
  const Certainty* certain, const std::array<float, 3>& lit, TracedTile& traced)
{
  const std::uint32_t* const surfaces = &tile.receivers.surface[tile.at(0, row)];
  const std::size_t from = row * tile.columns;
  const std::size_t to = row * TracedTile::columns;
  for (std::size_t x = 0; x < tile.columns; ++x)
  {
    const Certainty known = tile.known[from + x];
    const bool reached = traced.needed[to + x] != 0;
    const Certainty asked = !reached ? Certainty::Unreached
      : certain                      ? certain[from + x]
                                     : Certainty::Uncertain;
    const bool receiving = receives[surfaces[x] + 1u] != 0;
    const TracedClass of = known != Certainty::Uncertain ? static_cast<TracedClass>(known)
      : receiving                                        ? static_cast<TracedClass>(asked)
                                                         : TracedClass::NoReceiver;
    traced.classes[to + x] = static_cast<std::uint8_t>(of);
    traced.needed[to + x] = of == TracedClass::Traced ? 1 : 0;
    for (std::size_t channel = 0; channel < traced.channels; ++channel)
    {
      traced.visibility[channel][to + x] = isDark(of) ? 0.0f : lit[channel];
    }
  }
}

/// True if all pixels of a row are left out or not covered, and all are of one class.
bool isAlike(const ReceiverTile& tile, std::size_t row)
{
  const Certainty* const known = &tile.known[row * tile.columns];
  const std::uint32_t* const surfaces = &tile.receivers.surface[tile.at(0, row)];
  return std::all_of(surfaces, surfaces + tile.columns,
           [](std::uint32_t surface) { return surface == ReceiverPixels::notCovered; }) &&
    std::all_of(known, known + tile.columns, [&](Certainty other) { return other == known[0]; });
}

} // namespace

std::vector<PixelClass> classesOfTracing()
{
  return { { "traced", { 160, 40, 200 }, true }, { "lit for certain", { 230, 230, 230 } },
    { "in shadow for certain", { 90, 90, 90 } }, { "turned away from the light", { 0, 140, 60 } },
    { "no receiver", { 0, 0, 0 } } };
}

TracedPicture::TracedPicture(const ShadowLight& light, const Occluders& occluders,
  const Receivers& receivers, const ReceiverDecider* decider, std::vector<float>& visibility,
  std::vector<std::uint8_t>* classes, TracedTiles* tiles, const TileVerdicts* verdicts,
  const LightSamples* samples, const SampleChooser* chooser, bool isColoured)
  : occluders_(occluders)
  , receivers_(receivers)
  , decider_(decider)
  , visibility_(visibility)
  , classes_(classes)
  , tiles_(tiles)
  , verdicts_(verdicts)
  , light_(light, occluders.frame.centre)
  , samples_(samples)
  , texture_(samples && light.texture ? &*light.texture : nullptr)
  , chooser_(chooser)
  , isColoured_(isColoured)
{
  this->visibility_.resize(this->channels() * this->pixels());
  if (this->classes_)
  {
    this->classes_->resize(this->pixels());
  }
  if (this->decider_ || this->verdicts_)
  {
    this->certain_ = std::make_unique<std::vector<Certainty>[]>(this->tiles());
  }
  this->lit_.fill(static_cast<float>(this->samples()));
  if (this->texture_)
  {
    const auto whole = static_cast<float>(this->samples() * LightTexture::full);
    this->wholes_ = std::make_unique<float[]>(this->visibility_.size());
    std::fill_n(this->wholes_.get(), this->visibility_.size(), whole);
    for (int channel = 0; channel < 3; ++channel)
    {
      this->lit_[static_cast<std::size_t>(channel)] = whole * this->texture_->mean[channel];
    }
  }
  for (std::size_t tile = 0; tile < this->tiles(); ++tile)
  {
    const bool isDark = this->verdicts_ && this->verdicts_->darkTiles()[tile] != 0;
    this->skipped_.push_back(this->isKept(tile) || isDark ? 1 : 0);
  }
  this->receives_.push_back(0);
  for (const Surface& surface : occluders.surfaces)
  {
    this->receives_.push_back(surface.receives ? 1 : 0);
  }
}

std::size_t TracedPicture::tiles() const
{
  return tilesAcross(this->receivers_.width(), TracedTile::columns) *
    tilesAcross(this->receivers_.height(), TracedTile::rows);
}

float TracedPicture::rayFar() const
{
  return visitShadowRays(this->light_, [](const auto&, float rayFar) { return rayFar; });
}

/// Return what is known of a tile's receivers; null: nothing.
const Certainty* TracedPicture::certaintiesOf(const ReceiverTile& tile, const TracedTile& of) const
{
  if (!this->certain_)
  {
    return nullptr;
  }
  std::vector<Certainty>& certain = this->certain_[of.number];
  if (certain.empty())
  {
    certain.resize(tile.size());
    for (std::size_t row = 0; row < tile.rows; ++row)
    {
      const int* const needed = &of.needed[row * TracedTile::columns];
      std::transform(needed, needed + tile.columns, &certain[row * tile.columns],
        [](int is) { return is != 0 ? Certainty::Uncertain : Certainty::Unreached; });
    }
    if (this->verdicts_)
    {
      this->verdicts_->ofPixels(tile, certain);
    }
    if (this->decider_)
    {
      this->decider_->ofPixels(tile, certain);
    }
  }
  return certain.data();
}

void TracedPicture::fillDarkTiles() const
{
  for (std::size_t tile = 0; tile < this->tiles(); ++tile)
  {
    if (this->verdicts_->darkTiles()[tile] != 0 && !this->isKept(tile))
    {
      this->verdicts_->fillDark(tile, this->lit_[0], this->visibility_);
      if (this->classes_)
      {
        this->verdicts_->classifyDark(tile, *this->classes_);
      }
    }
  }
}

/// Prepare a tile: its visibility without rays, and the rays that it needs.
template <typename MakeRay>
void TracedPicture::prepare(
  const ReceiverTile& tile, const MakeRay& makeRay, TracedTile& traced) const
{
  traced.channels = this->channels();
  traced.receivers = &tile.receivers;
  traced.columnsOfPicture = this->receivers_.width();
  traced.number = tile.number(tilesAcross(traced.columnsOfPicture, TracedTile::columns));
  traced.firstPixel = tile.firstRow * traced.columnsOfPicture + tile.firstColumn;
  if (tile.size() < TracedTile::pixels)
  {
    traced.needed.fill(0);
  }
  std::array<bool, TracedTile::rows> alike;
  for (std::size_t y = 0; y < tile.rows; ++y)
  {
    alike[y] = isAlike(tile, y);
    if (alike[y])
    {
      fillRow(
        tile.known[y * tile.columns], this->lit_, tile.columns, y * TracedTile::columns, traced);
      continue;
    }
    const auto make = [&](auto count)
    { makeRays(tile.receivers, tile.at(0, y), count, makeRay, y * TracedTile::columns, traced); };
    tile.columns == TracedTile::columns
      ? make(std::integral_constant<std::size_t, TracedTile::columns>())
      : make(tile.columns);
  }
  const Certainty* const certain = this->certaintiesOf(tile, traced);
  for (std::size_t y = 0; y < tile.rows; ++y)
  {
    if (!alike[y])
    {
      classify(tile, y, this->receives_.data(), certain, this->lit_, traced);
    }
  }
}

/// Find the pixels whose triangle is turned away from the light, while the curve above is not.
/// They need their rays.
template <typename MakeRay>
void TracedPicture::findTurned(
  const ReceiverTile& tile, const MakeRay& makeRay, TracedTile& traced) const
{
  const ReceiverPixels& receivers = tile.receivers;
  for (std::size_t row = 0; row < tile.rows; ++row)
  {
    for (std::size_t column = 0; column < tile.columns; ++column)
    {
      const std::size_t i = tile.at(column, row);
      const std::size_t pixel = row * TracedTile::columns + column;
      if (receivers.curved[i] != 0 && this->receives_[receivers.surface[i] + 1u] != 0 &&
        traced.classes[pixel] == static_cast<std::uint8_t>(TracedClass::Unreached) &&
        makeRay(receivers.position(i), receivers.curves[i].normal, receivers.offset[i]).traced)
      {
        traced.turned.push_back({ pixel, i });
        traced.needed[pixel] = 1;
        traced.classes[pixel] = static_cast<std::uint8_t>(TracedClass::Traced);
        for (std::size_t channel = 0; channel < traced.channels; ++channel)
        {
          traced.visibility[channel][pixel] = this->lit_[channel];
        }
      }
    }
  }
}

void TracedPicture::keep(const ReceiverTile& tile, const TracedTile& traced) const
{
  for (std::size_t y = 0; y < tile.rows; ++y)
  {
    const std::size_t first = traced.firstPixel + y * traced.columnsOfPicture;
    for (std::size_t channel = 0; channel < traced.channels; ++channel)
    {
      std::copy_n(&traced.visibility[channel][y * TracedTile::columns], tile.columns,
        &this->visibility_[channel * this->pixels() + first]);
    }
    if (this->classes_)
    {
      std::copy_n(
        &traced.classes[y * TracedTile::columns], tile.columns, &(*this->classes_)[first]);
    }
  }
}

/// Visit a tile with a range of its rays to an area light.
std::size_t TracedPicture::visitSamples(const SampleRange& samples, const ReceiverTile& tile,
  TracedTile& traced, const std::function<std::size_t(TracedTile&)>& trace) const
{
  AreaTile area(tile, traced, this->light_, *this->samples_);
  SampleRays rays = raysToAll(traced, static_cast<std::uint32_t>(this->samples_->count()));
  if (this->chooser_)
  {
    // It knows no rays that pass through their own surface.
    const auto setTurned = [&](int needed)
    {
      for (const TurnedPixel& turned : traced.turned)
      {
        traced.needed[turned.pixel] = needed;
      }
    };
    setTurned(0);
    this->chooser_->choose(
      traced,
      [&](std::size_t pixel, const LightSamples::Coordinates& directions)
      { area.directionsOf(pixel, directions); },
      rays, samples.first > 0);
    setTurned(1);
  }
  for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
  {
    if (traced.needed[pixel] == 0)
    {
      continue;
    }
    traced.visibility[0][pixel] = static_cast<float>(rays.pixels[pixel].lit);
    if (this->texture_)
    {
      const AreaTile::Colours sums = area.coloursOf(pixel, *this->texture_);
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        traced.visibility[channel][pixel] = sums.lit[static_cast<glm::length_t>(channel)];
      }
      this->scale(traced.pixelOfPicture(pixel), sums.all);
    }
  }
  const auto repeatInChannels = [&](std::array<TracedTile::Plane<float>, 3>& planes)
  {
    if (this->isColoured_ && !this->texture_)
    {
      planes[1] = planes[2] = planes[0];
    }
  };
  repeatInChannels(traced.visibility);
  std::size_t count = 0;
  for (int number = samples.first; number < samples.end; ++number)
  {
    bool any = false;
    for (std::size_t first = 0; first < TracedTile::pixels; first += pixelsTogether)
    {
      Together<std::uint32_t> sampleOf{};
      bool anyOfThese = false;
      for (std::size_t i = 0; i < pixelsTogether; ++i)
      {
        const PixelSamples& wanted = rays.pixels[first + i];
        const bool needed = static_cast<std::uint32_t>(number) < wanted.count;
        traced.needed[first + i] = needed ? 1 : 0;
        if (needed)
        {
          anyOfThese = true;
          traced.samplesOfRay[0][first + i] =
            number == 0 ? static_cast<float>(wanted.ofFirstRay) : 1.0f;
          sampleOf[i] = rays.samples[wanted.first + static_cast<std::uint32_t>(number)];
        }
      }
      if (anyOfThese)
      {
        area.turn(first, sampleOf, traced);
        if (this->texture_)
        {
          area.colour(first, sampleOf, *this->texture_, traced);
        }
        any = true;
      }
    }
    if (!any)
    {
      break;
    }
    repeatInChannels(traced.samplesOfRay);
    count += trace(traced);
  }
  return count;
}

std::size_t TracedPicture::visitTiles(
  const SampleRange& samples, const std::function<std::size_t(TracedTile&)>& trace) const
{
  if (this->verdicts_ && samples.first == 0)
  {
    this->fillDarkTiles();
  }
  std::atomic<std::size_t> rays{ 0 };
  visitShadowRays(this->light_,
    [&](const auto& makeRay, float)
    {
      this->receivers_.visitTiles(
        [&](const ReceiverTile& tile)
        {
          if (this->tiles_ && samples.first == 0)
          {
            this->tiles_->note(tile);
          }
          TracedTile traced; // 56 KB, uninitialised on purpose
          this->prepare(tile, makeRay, traced);
          this->findTurned(tile, makeRay, traced);
          if (!this->samples_)
          {
            traced.samplesOfRay[0].fill(1.0f);
            rays += trace(traced);
          }
          else if (std::find(traced.needed.begin(), traced.needed.end(), 1) != traced.needed.end())
          {
            rays += this->visitSamples(samples, tile, traced, trace);
          }
          if (samples.first == 0)
          {
            this->keep(tile, traced);
          }
        },
        this->decider_, &this->skipped_);
    });
  return rays;
}

void TracedPicture::finish() const
{
  if (!this->samples_)
  {
    return;
  }
  const auto count = static_cast<float>(this->samples_->count());
  const std::size_t width = this->receivers_.width();
  const std::size_t across = tilesAcross(width, TracedTile::columns);
  for (std::size_t row = 0; row < this->channels() * this->receivers_.height(); ++row)
  {
    const std::size_t y = row % this->receivers_.height();
    for (std::size_t x = 0; x < width; x += TracedTile::columns)
    {
      if (this->isKept(y / TracedTile::rows * across + x / TracedTile::columns))
      {
        continue;
      }
      const std::size_t end = row * width + std::min(x + TracedTile::columns, width);
      for (std::size_t i = row * width + x; i < end; ++i)
      {
        // Samples replaced by brighter opposite ones may sum to more than all of the light.
        const float whole = this->texture_ ? this->wholes_[i] : count;
        this->visibility_[i] = std::min(this->visibility_[i] / whole, 1.0f);
      }
    }
  }
}

/// Scale a pixel's sums of colours so that all of its samples together have the texture's mean.
/// @param all the sum of their colours; channels without any colour stay as they are
void TracedPicture::scale(std::size_t pixel, const glm::vec3& all) const
{
  for (int channel = 0; channel < 3; ++channel)
  {
    if (all[channel] > 0.0f)
    {
      this->wholes_[static_cast<std::size_t>(channel) * this->pixels() + pixel] =
        all[channel] / this->texture_->mean[channel];
    }
  }
}

} // namespace gnomon
