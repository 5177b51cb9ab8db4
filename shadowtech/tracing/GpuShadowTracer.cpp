#include "shadowtech/tracing/GpuShadowTracer.h"

#include "shadowtech/base/Bytes.h"

#include <algorithm>

namespace gnomon
{
namespace
{

/// Rays that the GPU traces side by side come from squares of so many pixels a side: they stay closer together
/// than those of a row.
constexpr std::size_t side = 8;
constexpr std::size_t squaresAcross = TracedTile::columns / side;
static_assert(
  TracedTile::columns % side == 0 && TracedTile::rows % side == 0, "squares fill a tile");

/// Writes the rays that a tile needs, square by square.
/// @param to has room for those of a whole tile
/// @return how many there are
std::size_t writeRays(const TracedTile& tile, float rayFar, TracedRay* to)
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
/// Fills the picture but for its rays, and collects these in the order of the tiles, whichever thread visits them.
/// @return how many there are
std::size_t GpuShadowTracer::collectRays(const TracedPicture& picture)
{
  this->rays_.resize(picture.tiles() * TracedTile::pixels);
  std::vector<std::size_t> counts(picture.tiles(), 0);
  picture.visitTiles(
    [&](const TracedTile& tile)
    {
      TracedRay* const to = &this->rays_[tile.number * TracedTile::pixels];
      return counts[tile.number] = writeRays(tile, picture.rayFar(), to);
    });
  std::size_t count = 0;
  for (std::size_t tile = 0; tile < counts.size(); ++tile)
  {
    const std::size_t first = tile * TracedTile::pixels;
    if (first != count)
    {
      std::copy_n(&this->rays_[first], counts[tile], &this->rays_[count]);
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
    return picture.visitTiles([](const TracedTile&) { return std::size_t(0); });
  }
  const std::size_t count = this->collectRays(picture);
  this->tracer_.trace(this->rays_.data(), count, this->shaders_, this->blocked_);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (this->blocked_[i] != 0)
    {
      picture.darken(this->rays_[i].pixel);
    }
  }
  return count;
}

//------------------------------------------------------------------------------
std::size_t GpuShadowTracer::bytes() const
{
  return this->tracer_.bytes() + this->tracer_.bytesOnGpu();
}

//------------------------------------------------------------------------------
std::size_t GpuShadowTracer::bytesOfRays() const
{
  return bytesOf(this->rays_) + bytesOf(this->blocked_);
}

} // namespace gnomon
