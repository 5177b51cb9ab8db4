#pragma once

#include "lights/Bounds.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>
#include <vector>

namespace gnomon
{

/// A light's needs from a memory budget.
struct LightNeed
{
  double mostLight = 0.0; ///< most light that it gives any point of the scene
  int mapSizeTexels = 0;  ///< the side of the requested map
  /// Of its maps; 0 if it has none. Infinite: unknown until they are baked.
  double bytesPerTexel = 0.0;
  double bytesPerPixel = 0.0; ///< of its technique's other images
  int channels = 1;           ///< of its visibility
  bool isPointwise = false;   ///< true if shaders can read its map, so it needs no image
  bool isHard = false;        ///< true if rays give it one bit per pixel, not a number
};

/// The smallest side to which a budget reduces maps.
inline constexpr int fewestTexels = 256;

/// A light's share of a memory budget.
struct LightShare
{
  enum class Way
  {
    Map,  ///< its own technique, with a map that may be coarser than requested, or none
    Rays, ///< rays instead of a map
    None  ///< no shadow
  };
  Way way = Way::Map;
  int mapSizeTexels = 0;
};

/// The shares of all lights.
struct MemoryShares
{
  std::vector<LightShare> lights;
  double left = 0.0; ///< unused bytes
};

/// Share a budget among lights. Images of visibility come first, if they are needed, then maps, in
/// descending order of the lights' most light. A map that does not fit is halved, down to 256
/// texels a side. If it still does not fit, the light is traced. A light without room for its image
/// shows no shadow.
/// @param budget bytes for all maps and images of visibility
/// @param pixels of the picture
/// @param mayBeInline true if shaders may read maps, so that no image is needed
MemoryShares shareMemory(
  const std::vector<LightNeed>& lights, double budget, std::size_t pixels, bool mayBeInline);

/// Return the side of the largest depth map for a light in so many bytes: 1, 2, 4, ... texels.
int largestMapIn(double bytes, const ShadowLight& light);

/// Return a light's needs.
/// @param seen visible bounds, in world coordinates
LightNeed needOf(const ShadowLight& light, const TechniqueInfo& info, const Bounds& seen);

} // namespace gnomon
