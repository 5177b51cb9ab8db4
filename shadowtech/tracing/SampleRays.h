#pragma once

#include "lights/LightSamples.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

struct TracedTile;

/// Which rays to an area light's samples a pixel needs, of those of a tile that need any.
struct PixelSamples
{
  /// How many samples arrive unless rays are blocked.
  std::uint32_t lit = 0;
  /// How many of these its first ray stands for: all of them are blocked if it is. The other rays
  /// stand for one each.
  std::uint32_t ofFirstRay = 1;
  ///@{
  /// Its rays' samples, a part of SampleRays::samples.
  std::uint32_t first = 0, count = 0;
  ///@}
};

/// The same of a tile's pixels.
struct SampleRays
{
  std::vector<PixelSamples> pixels; ///< one for each pixel of a whole tile
  std::vector<std::uint32_t> samples;
};

/// Who knows that some of a pixel's rays to an area light decide the others.
class SampleChooser
{
public:
  virtual ~SampleChooser() = default;

  /// A pixel's rays to all samples, in their order: directions as they would be traced.
  using DirectionsOf =
    std::function<void(std::size_t pixel, const LightSamples::Coordinates& directions)>;

  /// Chooses the rays of a tile. Called by several threads at once.
  /// @param tile whose pixels that need a ray may get another class
  /// @param rays with all rays of these pixels
  /// @param again whether it did so before, as where a picture's rays are traced in parts: what it
  /// counts is counted then
  virtual void choose(
    TracedTile& tile, const DirectionsOf& directionsOf, SampleRays& rays, bool again) const = 0;
};

} // namespace gnomon
