#pragma once

#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/Embree.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace gnomon
{

/// A packet of shadow rays.
///
/// A ray's answer must not depend on the packet's other rays, so packets are incoherent. Coherent
/// packets enter boxes together: at an edge on its box's side, a ray's answer would depend on the
/// packet. In scenes with instances, Embree 3.13.5 also hangs on coherent packets of 16 that hit
/// some: it keeps numbers in AVX-512 registers that the traversal of an instance overwrites.
/// @tparam Rays RTCRay8 or RTCRay16
template <typename Rays>
struct EmbreePacket
{
  static constexpr std::size_t lanes = std::extent_v<decltype(Rays::tfar)>;

  Rays rays{}; ///< the caller sets origins and directions
  EmbreeContext context;

  EmbreePacket()
  {
    std::fill_n(this->rays.tnear, lanes, shadowRayNear);
    std::fill_n(this->rays.mask, lanes, 0xffffffffu);
  }

  /// Trace the first rays.
  void trace(RTCScene scene, std::size_t count, float rayFar)
  {
    alignas(64) std::array<int, lanes> valid;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      valid[lane] = lane < count ? -1 : 0;
      // If the processor lacks the lanes, Embree uses the interval instead of the mask.
      this->rays.tfar[lane] = lane < count ? rayFar : -std::numeric_limits<float>::infinity();
    }
    occlude(valid.data(), scene, this->context, this->rays);
  }

  /// True if a traced ray is blocked: Embree set its far end to minus infinity.
  bool isBlocked(std::size_t lane) const { return this->rays.tfar[lane] < 0.0f; }
};

/// Subtract what a ray stands for from its pixel's visibility, if it is blocked.
inline void darken(TracedTile& tile, std::size_t pixel, bool blocked)
{
  // Nearly always there is one channel.
  tile.visibility[0][pixel] -= blocked ? tile.samplesOfRay[0][pixel] : 0.0f;
  for (std::size_t channel = 1; channel < tile.channels; ++channel)
  {
    tile.visibility[channel][pixel] -= blocked ? tile.samplesOfRay[channel][pixel] : 0.0f;
  }
}

/// Traces a tile's rays in squares of 4 x 4 pixels, whose rays stay closer together than those of a
/// row. Squares with few rays share a packet.
template <typename Rays>
class TileTracer
{
public:
  TileTracer(RTCScene scene, float rayFar)
    : scene_(scene)
    , rayFar_(rayFar)
  {
  }

  /// Subtract what blocked rays stand for from the visibility of their pixels.
  /// @return the number of rays
  std::size_t trace(TracedTile& tile)
  {
    std::size_t traced = 0;
    for (std::size_t y = 0; y < TracedTile::rows; y += rowsOfPacket)
    {
      for (std::size_t x = 0; x < TracedTile::columns; x += side)
      {
        traced += this->take(tile, y * TracedTile::columns + x);
      }
    }
    this->traceTaken(tile);
    return traced;
  }

private:
  static constexpr std::size_t lanes = EmbreePacket<Rays>::lanes;
  static constexpr std::size_t side = 4;
  static constexpr std::size_t rowsOfPacket = lanes / side;

  /// Add the rays that a square needs to the packet, which is traced whenever it is full.
  /// @return their number
  std::size_t take(TracedTile& tile, std::size_t corner)
  {
    std::array<std::uint16_t, lanes> needed;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const std::size_t pixel = corner + lane / side * TracedTile::columns + lane % side;
      needed[count] = static_cast<std::uint16_t>(pixel);
      count += tile.needed[pixel] != 0 ? 1 : 0;
    }
    // If the square does not fit, trace the packet first, so that no square is split between
    // packets.
    if (this->taken_ > 0 && this->taken_ + count > lanes)
    {
      this->traceTaken(tile);
    }
    const std::size_t first = this->taken_;
    std::copy_n(needed.begin(), count, &this->pixels_[first]);
    const auto load = [&](float* to, const TracedTile::Plane<float>& from)
    {
      if (count == lanes)
      {
        for (std::size_t row = 0; row < rowsOfPacket; ++row)
        {
          std::copy_n(&from[corner + row * TracedTile::columns], side, to + row * side);
        }
        return;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        to[first + i] = from[needed[i]];
      }
    };
    load(this->packet_.rays.org_x, tile.originX);
    load(this->packet_.rays.org_y, tile.originY);
    load(this->packet_.rays.org_z, tile.originZ);
    load(this->packet_.rays.dir_x, tile.directionX);
    load(this->packet_.rays.dir_y, tile.directionY);
    load(this->packet_.rays.dir_z, tile.directionZ);
    this->taken_ += count;
    return count;
  }

  void traceTaken(TracedTile& tile)
  {
    if (this->taken_ == 0)
    {
      return;
    }
    this->packet_.trace(this->scene_, this->taken_, this->rayFar_);
    for (std::size_t lane = 0; lane < this->taken_; ++lane)
    {
      darken(tile, this->pixels_[lane], this->packet_.isBlocked(lane));
    }
    this->taken_ = 0;
  }

  RTCScene scene_;
  EmbreePacket<Rays> packet_;
  float rayFar_;
  std::size_t taken_ = 0;                     ///< rays in the packet
  std::array<std::uint16_t, lanes> pixels_{}; ///< the rays' pixels in the tile
};

/// Trace rays as packets in their order.
/// @param load fills the origins and directions of lanes with rays: load(rays, first, count)
/// @param blocked set to 1 for blocked rays, else 0
template <typename Rays, typename Load>
void traceRays(
  RTCScene scene, std::size_t count, float rayFar, const Load& load, std::uint8_t* blocked)
{
  EmbreePacket<Rays> packet;
  for (std::size_t first = 0; first < count; first += packet.lanes)
  {
    const std::size_t taken = std::min(packet.lanes, count - first);
    load(packet.rays, first, taken);
    packet.trace(scene, taken, rayFar);
    for (std::size_t lane = 0; lane < taken; ++lane)
    {
      blocked[first + lane] = packet.isBlocked(lane) ? 1 : 0;
    }
  }
}

} // namespace gnomon
