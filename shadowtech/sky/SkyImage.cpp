#include "shadowtech/sky/SkyImage.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>

namespace gnomon
{
namespace
{

/// In place of openView() where a pixel shows no receiver.
constexpr float noOpenView = -1.0f;

/// Add neighbours' sums to pixels along a line, where they lie near the pixel's plane and face
/// alike.
/// @param step from a pixel to its neighbour in the arrays
#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void addNeighbours(const ReceiverPixels& receivers, std::ptrdiff_t step, std::size_t first,
  std::size_t end, const float* all, const float* seen, float* toAll, float* toSeen)
{
  constexpr float leastCosine = 0.95f;     // between normals
  constexpr float mostSineSquared = 0.03f; // of the way's angle to the pixel's plane
  const float* const px = receivers.positionX.data();
  const float* const py = receivers.positionY.data();
  const float* const pz = receivers.positionZ.data();
  const float* const nx = receivers.normalX.data();
  const float* const ny = receivers.normalY.data();
  const float* const nz = receivers.normalZ.data();
#pragma GCC ivdep
  for (std::size_t i = first; i < end; ++i)
  {
    const std::size_t j = i + static_cast<std::size_t>(step);
    const float x = px[j] - px[i], y = py[j] - py[i], z = pz[j] - pz[i];
    const float off = x * nx[i] + y * ny[i] + z * nz[i];
    const float cosine = nx[j] * nx[i] + ny[j] * ny[i] + nz[j] * nz[i];
    const bool isSame =
      (off * off <= mostSineSquared * (x * x + y * y + z * z)) & (cosine >= leastCosine);
    toAll[i] += isSame ? all[j] : 0.0f;
    toSeen[i] += isSame ? seen[j] : 0.0f;
  }
}

/// The pixels of a part of a tile that look in the same directions, and their rays.
struct SkyPacket
{
  static constexpr std::size_t mostPixels = 16;
  static constexpr std::size_t mostRays = 256;

  std::size_t count = 0;                     ///< of pixels
  std::array<std::size_t, mostPixels> pixel; ///< of the picture
  std::array<glm::vec3, mostPixels> origin, normal;
  std::array<glm::mat3, mostPixels> rotation; ///< from z to the normal of the curve
  std::array<bool, mostPixels> isCurved;

  std::size_t rays = 0;
  std::array<std::array<float, mostRays>, 3> from, towards;
  std::array<float, mostRays> radiance;
  std::array<std::uint8_t, mostRays> blocked;

  void addPixel(const ReceiverPixels& receivers, std::size_t i, std::size_t ofPicture)
  {
    const bool curved = receivers.curved[i] != 0;
    this->pixel[this->count] = ofPicture;
    this->normal[this->count] = receivers.normal(i);
    this->origin[this->count] =
      receivers.position(i) + receivers.offset[i] * this->normal[this->count];
    this->rotation[this->count] =
      rotationFromZ(curved ? receivers.curves[i].normal : this->normal[this->count]);
    this->isCurved[this->count++] = curved;
  }

  /// Return how wide the part of a tile is whose pixels with one place in their blocks share a
  /// packet.
  static std::size_t columnsOfPart(std::size_t side)
  {
    return mostPixels / (ReceiverTile::mostRows / side) * side;
  }
  /// Take the receiving pixels of a part of a tile that have one place in their blocks.
  /// @param side of a block
  void collect(const ReceiverTile& tile, const Occluders& occluders, std::size_t widthOfPicture,
    std::size_t side, std::size_t part, std::size_t place)
  {
    const ReceiverPixels& receivers = tile.receivers;
    this->count = 0;
    for (std::size_t y = place / side; y < tile.rows; y += side)
    {
      for (std::size_t x = part + place % side;
           x < std::min(part + columnsOfPart(side), tile.columns); x += side)
      {
        const std::size_t i = tile.at(x, y);
        const std::uint32_t surface = receivers.surface[i];
        if (surface != ReceiverPixels::notCovered && occluders.surfaces[surface].receives)
        {
          this->addPixel(receivers, i, (tile.firstRow + y) * widthOfPicture + tile.firstColumn + x);
        }
      }
    }
  }

  /// Trace the rays, and add them to the sums of their pixels.
  /// @return their number
  std::size_t trace(
    const EmbreeTracer& tracer, float farthest, std::vector<float>& all, std::vector<float>& seen)
  {
    const auto arrays = [](const auto& of) {
      return PointArrays{ of[0].data(), of[1].data(), of[2].data() };
    };
    const std::size_t traced = std::exchange(this->rays, 0);
    tracer.areBlocked(
      traced, arrays(this->from), arrays(this->towards), farthest, this->blocked.data());
    if (const RayFilter* const filter = tracer.filter())
    {
      this->addFiltered(*filter, traced, farthest, all, seen);
      return traced;
    }
    for (std::size_t ray = 0; ray < traced; ++ray)
    {
      const std::size_t of = this->pixel[ray % this->count];
      all[of] += this->radiance[ray];
      seen[of] += this->blocked[ray] != 0 ? 0.0f : this->radiance[ray];
    }
    return traced;
  }

  /// Add traced rays to the sums of their pixels, less what a filter keeps.
  void addFiltered(const RayFilter& filter, std::size_t traced, float farthest,
    std::vector<float>& all, std::vector<float>& seen) const
  {
    const auto at = [](const auto& of, std::size_t ray)
    { return glm::vec3(of[0][ray], of[1][ray], of[2][ray]); };
    for (std::size_t ray = 0; ray < traced; ++ray)
    {
      const std::size_t of = this->pixel[ray % this->count];
      all[of] += this->radiance[ray];
      if (this->blocked[ray] == 0)
      {
        // The sky's layer has one channel.
        const glm::dvec3 left =
          filter.transmittanceOf(at(this->from, ray), at(this->towards, ray), farthest);
        seen[of] += this->radiance[ray] * static_cast<float>((left.x + left.y + left.z) / 3.0);
      }
    }
  }

  /// Add a ray of each pixel.
  void addRays(const Sky& sky, const glm::vec3& local)
  {
    for (std::size_t i = 0; i < this->count; ++i)
    {
      glm::vec3 direction = this->rotation[i] * local;
      if (this->isCurved[i])
      {
        const float along = glm::dot(direction, this->normal[i]);
        direction -= along < 0.0f ? 2.0f * along * this->normal[i] : glm::vec3(0.0f);
      }
      for (glm::length_t axis = 0; axis < 3; ++axis)
      {
        this->from[static_cast<std::size_t>(axis)][this->rays] = this->origin[i][axis];
        this->towards[static_cast<std::size_t>(axis)][this->rays] = direction[axis];
      }
      this->radiance[this->rays++] = radianceOf(sky, direction);
    }
  }
};

} // namespace

SkyImage::SkyImage(int directions)
  : directions_(directions)
{
  for (std::size_t i = 0; i < this->pattern_.size(); ++i)
  {
    const SamplePixel pixel = this->directions_.points().pixel(
      static_cast<std::uint32_t>(i % side), static_cast<std::uint32_t>(i / side));
    std::vector<std::pair<std::size_t, int>> order; // of the directions
    for (int direction = 0; direction < directions; ++direction)
    {
      order.emplace_back(this->directions_.batchOf(direction), direction);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [batch, direction] : order)
    {
      this->pattern_[i].push_back(this->directions_.local(direction, pixel));
    }
  }
}

void SkyImage::clear()
{
  this->batches_ = 0;
}

std::size_t SkyImage::trace(const Sky& sky, const Receivers& receivers, const Occluders& occluders,
  const EmbreeTracer& tracer, std::size_t batches)
{
  const std::size_t ofBatch = this->pattern_[0].size() / SkyDirections::batches;
  const std::size_t first = this->batches_ * ofBatch;
  const std::size_t end = batches * ofBatch;
  const std::size_t rays = this->traceAll(sky, receivers, occluders, tracer, side,
    [&](std::size_t place)
    {
      const auto begin = this->pattern_[place].begin();
      return std::vector<glm::vec3>(
        begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end));
    });
  this->batches_ = batches;
  return rays;
}

/// Add rays to the sums. Without batches, these begin at 0.
std::size_t SkyImage::traceAll(const Sky& sky, const Receivers& receivers,
  const Occluders& occluders, const EmbreeTracer& tracer, std::size_t sideOfBlock,
  const DirectionsOf& directionsOf)
{
  const bool isFirst = this->batches_ == 0;
  if (isFirst)
  {
    const std::size_t pixels = receivers.width() * receivers.height();
    this->all_.assign(pixels, 0.0f);
    this->seen_.assign(pixels, 0.0f);
    this->open_.assign(pixels, noOpenView);
  }
  std::vector<std::vector<glm::vec3>> directions;
  for (std::size_t place = 0; place < sideOfBlock * sideOfBlock; ++place)
  {
    directions.push_back(directionsOf(place));
  }
  std::atomic<std::size_t> rays{ 0 };
  receivers.visitTiles(
    [&](const ReceiverTile& tile)
    {
      SkyPacket packet; // 9 KB, uninitialised on purpose
      const auto flush = [&]
      { rays += packet.trace(tracer, sky.farthest, this->all_, this->seen_); };
      for (std::size_t part = 0; part < tile.columns; part += SkyPacket::columnsOfPart(sideOfBlock))
      {
        for (std::size_t place = 0; place < directions.size(); ++place)
        {
          packet.collect(tile, occluders, receivers.width(), sideOfBlock, part, place);
          for (std::size_t i = 0; isFirst && i < packet.count; ++i)
          {
            this->open_[packet.pixel[i]] = static_cast<float>(openView(sky, packet.rotation[i][2]));
          }
          for (const glm::vec3& direction : directions[place])
          {
            if (packet.rays + packet.count > SkyPacket::mostRays)
            {
              flush();
            }
            packet.addRays(sky, direction);
          }
          flush();
        }
      }
    });
  return rays;
}

void SkyImage::view(std::vector<float>& view) const
{
  view.resize(this->all_.size());
  for (std::size_t i = 0; i < view.size(); ++i)
  {
    view[i] = this->open_[i] == noOpenView ? 1.0f
      : this->all_[i] > 0.0f               ? this->open_[i] * this->seen_[i] / this->all_[i]
                                           : 0.0f; // it faces no direction that is bright
  }
}

std::size_t SkyImage::traceFew(const Sky& sky, const ReceiverPixels& receivers,
  const Occluders& occluders, const EmbreeTracer& tracer)
{
  this->clear();
  // Four blocks side by side have directions of eight batches, two different ones for each pixel.
  constexpr std::size_t sideOfFour = 2 * side;
  const std::size_t rays = this->traceAll(sky, receivers, occluders, tracer, sideOfFour,
    [this](std::size_t place)
    {
      const std::size_t x = place % sideOfFour;
      const std::size_t y = place / sideOfFour;
      const std::size_t own = y % side * side + x % side;
      const std::size_t block = y / side * 2 + x / side;
      const std::vector<glm::vec3>& all = this->pattern_[own];
      const std::size_t first = block * side * side + own;
      return std::vector<glm::vec3>{ all[first % all.size()],
        all[(first + all.size() / 2) % all.size()] };
    });
  // Any 8 x 8 pixels have all of these directions.
  constexpr std::ptrdiff_t before = -3;
  constexpr std::ptrdiff_t after = 4;
  const auto width = static_cast<std::size_t>(receivers.width);
  const auto height = static_cast<std::size_t>(receivers.height);
  const auto addLines = [&](bool alongRows)
  {
    std::vector<float>& all = this->allOfLines_;
    std::vector<float>& seen = this->seenOfLines_;
    all.assign(this->all_.size(), 0.0f);
    seen.assign(this->seen_.size(), 0.0f);
    tbb::parallel_for(std::size_t(0), height,
      [&](std::size_t y)
      {
        for (std::ptrdiff_t step = before; step <= after; ++step)
        {
          const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y) + (alongRows ? 0 : step);
          if (row < 0 || row >= static_cast<std::ptrdiff_t>(height))
          {
            continue;
          }
          const std::ptrdiff_t column = alongRows ? step : 0;
          const auto left = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -column));
          const auto right = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, column));
          addNeighbours(receivers, alongRows ? step : step * static_cast<std::ptrdiff_t>(width),
            y * width + std::min(left, width), (y + 1) * width - std::min(right, width),
            this->all_.data(), this->seen_.data(), all.data(), seen.data());
        }
      });
    this->all_.swap(all);
    this->seen_.swap(seen);
  };
  addLines(true);
  addLines(false);
  return rays;
}

std::size_t SkyImage::bytes() const
{
  return bytesOf(this->all_) + bytesOf(this->seen_) + bytesOf(this->open_) +
    bytesOf(this->allOfLines_) + bytesOf(this->seenOfLines_) +
    bytesOfAll(this->pattern_, bytesOf<glm::vec3>);
}

} // namespace gnomon
