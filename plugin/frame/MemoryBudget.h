#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <vector>

namespace gnomon
{

/// What a light asks of a memory budget.
struct LightNeed
{
  double mostLight = 0.0; ///< the most that it gives any point of the scene
  int mapSizeTexels = 0;  ///< the side of the map that it asks for
  /// Of its maps; 0: it has none. Infinite: unknown until they are baked.
  double bytesPerTexel = 0.0;
  double bytesPerPixel = 0.0; ///< of what its technique keeps of the picture
  int channels = 1;           ///< of its visibility
  bool isPointwise = false;   ///< whether shaders may ask its map, so that it needs no image
  bool isHard = false;        ///< whether rays give it a bit a pixel, not a number
};

/// Maps are not made coarser than that for a budget's sake.
inline constexpr int fewestTexels = 256;

/// What a light gets of a memory budget.
struct LightShare
{
  enum class Way
  {
    Map,  ///< its own technique, with a map that may be coarser than asked for, or none
    Rays, ///< rays in place of a map
    None  ///< no shadow
  };
  Way way = Way::Map;
  int mapSizeTexels = 0;
};

/// What all of them get.
struct MemoryShares
{
  std::vector<LightShare> lights;
  double left = 0.0; ///< unused bytes
};

/// Shares a budget among lights: first images of visibility where they are needed, then maps, in
/// the order of the light that they give at most. A map that does not fit is halved, down to 256
/// texels a side. A light whose map still does not fit takes rays. One without room for its image
/// shows no shadow.
/// @param budget bytes for all maps and images of visibility
/// @param pixels of the picture
/// @param mayBeInline whether shaders may ask maps, so that no image is needed
MemoryShares shareMemory(
  const std::vector<LightNeed>& lights, double budget, std::size_t pixels, bool mayBeInline);

/// The largest map of depths, of 1, 2, 4, ... texels a side, that a light may have in so many bytes.
int largestMapIn(double bytes, const ShadowLight& light);

/// What a light needs.
/// @param seen what is visible, in world coordinates
LightNeed needOf(const ShadowLight& light, const TechniqueInfo& info, const Bounds& seen);

} // namespace gnomon
