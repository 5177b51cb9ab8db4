#pragma once

#include "lights/LightSamples.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon
{

struct TracedTile;

/// The rays to an area light's samples that a pixel needs.
struct PixelSamples
{
  /// The number of lit samples if no ray is blocked.
  std::uint32_t lit = 0;
  /// How many of these its first ray stands for: all of them are dark if it is blocked. Each other
  /// ray stands for one.
  std::uint32_t ofFirstRay = 1;
  ///@{
  /// The samples of its rays, a range of SampleRays::samples.
  std::uint32_t first = 0, count = 0;
  ///@}
};

/// The rays of a tile's pixels to an area light's samples.
struct SampleRays
{
  std::vector<PixelSamples> pixels; ///< one for each pixel of a whole tile
  std::vector<std::uint32_t> samples;
};

/// Chooses, of a pixel's rays to an area light, the few that decide the others.
class SampleChooser
{
public:
  virtual ~SampleChooser() = default;

  /// Computes a pixel's rays to all samples, in their order, as they would be traced.
  using DirectionsOf =
    std::function<void(std::size_t pixel, const LightSamples::Coordinates& directions)>;

  /// Choose the rays of a tile. Called by several threads at once.
  /// @param tile its pixels that need a ray may get another class
  /// @param rays holds all rays of these pixels on entry
  /// @param again true if it has chosen for this tile, because a picture's rays are traced in
  /// parts. It must not count its statistics again
  virtual void choose(
    TracedTile& tile, const DirectionsOf& directionsOf, SampleRays& rays, bool again) const = 0;
};

} // namespace gnomon
