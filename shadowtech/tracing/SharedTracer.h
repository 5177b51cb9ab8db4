#pragma once

#include "shadowtech/base/Bytes.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon
{

/// Traces the casters of this process, or of several processes, each of which holds its own part of
/// them. Then a ray is blocked if any process's casters block it: processes exchange a bit for each
/// ray, and no geometry. All processes must trace the same pictures from the same receivers in the
/// same order.
class SharedTracer : public EmbreeTracer
{
public:
  /// Replaces bits by those that are set in any process; collective.
  using UniteBits = std::function<void(std::vector<std::uint64_t>& bits)>;

  /// Set the exchange between the processes; null: this process traces alone.
  /// @param names of the casters' patches; must outlive the tracer
  void share(UniteBits unite, const PatchNames& names)
  {
    this->unite_ = std::move(unite);
    this->names_ = &names;
  }

  /// Return the bytes cached for the rays of a picture.
  std::size_t bytesOfRays() const { return bytesOf(this->blocked_); }

private:
  static constexpr std::size_t bitsOfWord = 64;

  static constexpr std::size_t wordsOfTile = TracedTile::pixels / bitsOfWord;

  /// The most samples whose bits are sent at once: at 1920 x 1080 pixels, 8 MB.
  static constexpr int samplesAtOnce = 32;

  std::size_t tracePicture(const TracedPicture& picture) override
  {
    if (!this->unite_)
    {
      this->blocked_ = {};
      return EmbreeTracer::tracePicture(picture);
    }
    if (picture.channels() > 1)
    {
      throw std::runtime_error("processes that share a picture have no lights with textures");
    }
    const std::size_t across = tilesAcross(picture.columns(), TracedTile::columns);
    std::size_t rays = 0;
    for (int first = 0; first < picture.samples(); first += samplesAtOnce)
    {
      const TracedPicture::SampleRange range{ first,
        std::min(first + samplesAtOnce, picture.samples()) };
      rays += this->traceOwn(picture, range);
      this->unite_(this->blocked_);
      const auto words = wordsOfTile * static_cast<std::size_t>(range.end - range.first);
      tbb::parallel_for(std::size_t(0), picture.tiles(),
        [&](std::size_t tile)
        {
          const std::size_t firstRow = tile / across * TracedTile::rows;
          const std::size_t firstColumn = tile % across * TracedTile::columns;
          for (std::size_t word = 0; word < words; ++word)
          {
            const std::size_t firstPixel = word % wordsOfTile * bitsOfWord;
            for (std::uint64_t bits = this->blocked_[tile * words + word]; bits != 0;
                 bits &= bits - 1)
            {
              const std::size_t pixel =
                firstPixel + static_cast<std::size_t>(__builtin_ctzll(bits));
              const std::size_t row = firstRow + pixel / TracedTile::columns;
              picture.darken(row * picture.columns() + firstColumn + pixel % TracedTile::columns);
            }
          }
        });
    }
    return rays;
  }

  /// Fill the picture without its rays, and find which of these this process's casters block.
  /// @return the number of rays
  std::size_t traceOwn(const TracedPicture& picture, const TracedPicture::SampleRange& samples)
  {
    const std::size_t wordsOfTileSamples =
      wordsOfTile * static_cast<std::size_t>(samples.end - samples.first);
    this->blocked_.assign(picture.tiles() * wordsOfTileSamples, 0);
    std::vector<std::size_t> asked(picture.tiles(), 0); // samples, by tile
    const float rayFar = picture.rayFar();
    return picture.visitTiles(samples,
      [&](TracedTile& tile)
      {
        std::uint64_t* const bits =
          &this->blocked_[tile.number * wordsOfTileSamples + wordsOfTile * asked[tile.number]++];
        const auto take = [bits](std::size_t pixel, bool isBlocked)
        { bits[pixel / bitsOfWord] |= std::uint64_t(isBlocked) << pixel % bitsOfWord; };
        const std::size_t turned = this->traceTurned(picture, tile, this->names_, take);
        TracedTile::Plane<float> rays[6]; // the needed ones, closed up
        TracedTile::Plane<std::uint16_t> pixels;
        TracedTile::Plane<std::uint8_t> isBlocked;
        std::size_t count = 0;
        for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
        {
          if (tile.needed[pixel] != 0)
          {
            pixels[count] = static_cast<std::uint16_t>(pixel);
            rays[0][count] = tile.originX[pixel];
            rays[1][count] = tile.originY[pixel];
            rays[2][count] = tile.originZ[pixel];
            rays[3][count] = tile.directionX[pixel];
            rays[4][count] = tile.directionY[pixel];
            rays[5][count] = tile.directionZ[pixel];
            ++count;
          }
        }
        this->areBlocked(count, { rays[0].data(), rays[1].data(), rays[2].data() },
          { rays[3].data(), rays[4].data(), rays[5].data() }, rayFar, isBlocked.data());
        for (std::size_t i = 0; i < count; ++i)
        {
          take(pixels[i], isBlocked[i] != 0);
        }
        return turned + count;
      });
  }

  UniteBits unite_;
  const PatchNames* names_ = nullptr;
  std::vector<std::uint64_t> blocked_; ///< by tile, sample and pixel, a bit each
};

} // namespace gnomon
