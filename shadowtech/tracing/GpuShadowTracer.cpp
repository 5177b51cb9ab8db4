#include "shadowtech/tracing/GpuShadowTracer.h"

#include "shadowtech/base/Bytes.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon
{
namespace
{

/// The side in pixels of squares whose rays the GPU traces side by side: they stay closer together
/// than the rays of a row.
constexpr std::size_t side = 8;
constexpr std::size_t squaresAcross = TracedTile::columns / side;
static_assert(
  TracedTile::columns % side == 0 && TracedTile::rows % side == 0, "squares fill a tile");

/// The largest number of rays collected at once, if pixels have several.
constexpr std::size_t roomForRays = std::size_t(1) << 22;

/// Write the rays that a tile needs, square by square.
/// @param to has room for all rays of a tile
/// @param samplesTo set to the number of samples that each ray stands for, by channel
/// @return the number of rays
std::size_t writeRays(const TracedTile& tile, float rayFar, TracedRay* to, float* samplesTo)
{
  TracedRay* const first = to;
  for (std::size_t square = 0; square < TracedTile::pixels / (side * side); ++square)
  {
    const std::size_t column = square % squaresAcross * side;
    const std::size_t row = square / squaresAcross * side;
    for (std::size_t i = 0; i < side * side; ++i)
    {
      const std::size_t x = column + i % side;
      const std::size_t y = row + i / side;
      const std::size_t pixel = y * TracedTile::columns + x;
      if (tile.needed[pixel] != 0)
      {
        *to++ = { { tile.originX[pixel], tile.originY[pixel], tile.originZ[pixel] }, rayFar,
          { tile.directionX[pixel], tile.directionY[pixel], tile.directionZ[pixel] },
          static_cast<std::uint32_t>(tile.firstPixel + y * tile.columnsOfPicture + x) };
        for (std::size_t channel = 0; channel < tile.channels; ++channel)
        {
          *samplesTo++ = tile.samplesOfRay[channel][pixel];
        }
      }
    }
  }
  return static_cast<std::size_t>(to - first);
}

} // namespace

//------------------------------------------------------------------------------
GpuShadowTracer::GpuShadowTracer(OccluderBuffers& buffers, ShaderLibrary& shaders)
  : buffers_(buffers)
  , shaders_(shaders)
{
}

//------------------------------------------------------------------------------
ShadowTracer::Update GpuShadowTracer::update(const Occluders& occluders)
{
  if (occluders.castsSolids())
  {
    throw std::runtime_error("it does not support spheres and cylinders (impostors)");
  }
  this->buffers_.update(occluders);
  const CasterBvh::Change change = this->tracer_.update(occluders, this->buffers_);
  if (this->tracer_.empty())
  {
    return {};
  }
  return { change == CasterBvh::Change::Built ? 1 : 0,
    change == CasterBvh::Change::Refitted ? 1 : 0 };
}

//------------------------------------------------------------------------------
/// Fill the picture without its rays, and collect these in the order of the tiles, whichever thread
/// visits them.
/// @return the number of rays
std::size_t GpuShadowTracer::collectRays(
  const TracedPicture& picture, const TracedPicture::SampleRange& samples)
{
  const std::size_t raysOfTile =
    TracedTile::pixels * static_cast<std::size_t>(samples.end - samples.first);
  this->rays_.resize(picture.tiles() * raysOfTile);
  const std::size_t channels = picture.channels();
  this->samplesOfRays_.resize(channels * this->rays_.size());
  std::vector<std::size_t> counts(picture.tiles(), 0);
  picture.visitTiles(samples,
    [&](const TracedTile& tile)
    {
      const std::size_t to = tile.number * raysOfTile + counts[tile.number];
      const std::size_t written =
        writeRays(tile, picture.rayFar(), &this->rays_[to], &this->samplesOfRays_[channels * to]);
      counts[tile.number] += written;
      return written;
    });
  std::size_t count = 0;
  for (std::size_t tile = 0; tile < counts.size(); ++tile)
  {
    const std::size_t first = tile * raysOfTile;
    if (first != count)
    {
      std::copy_n(&this->rays_[first], counts[tile], &this->rays_[count]);
      std::copy_n(&this->samplesOfRays_[channels * first], channels * counts[tile],
        &this->samplesOfRays_[channels * count]);
    }
    count += counts[tile];
  }
  return count;
}

//------------------------------------------------------------------------------
std::size_t GpuShadowTracer::tracePicture(const TracedPicture& picture)
{
  if (this->tracer_.empty())
  {
    return picture.visitTiles(
      picture.allSamples(), [](const TracedTile&) { return std::size_t(0); });
  }
  const std::size_t pixels = picture.tiles() * TracedTile::pixels;
  const auto samplesAtOnce =
    static_cast<int>(std::max<std::size_t>(roomForRays / std::max<std::size_t>(pixels, 1), 1));
  std::size_t rays = 0;
  for (int first = 0; first < picture.samples(); first += samplesAtOnce)
  {
    const std::size_t count =
      this->collectRays(picture, { first, std::min(first + samplesAtOnce, picture.samples()) });
    this->tracer_.trace(this->rays_.data(), count, this->shaders_, this->blocked_);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->blocked_[i] != 0)
      {
        picture.darken(this->rays_[i].pixel, &this->samplesOfRays_[picture.channels() * i]);
      }
    }
    rays += count;
  }
  return rays;
}

//------------------------------------------------------------------------------
std::size_t GpuShadowTracer::bytes() const
{
  return this->tracer_.bytes() + this->tracer_.bytesOnGpu();
}

//------------------------------------------------------------------------------
std::size_t GpuShadowTracer::bytesOfRays() const
{
  return bytesOf(this->rays_) + bytesOf(this->samplesOfRays_) + bytesOf(this->blocked_);
}

} // namespace gnomon
