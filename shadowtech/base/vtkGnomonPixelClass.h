#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// One of the ways in which a technique may come to a pixel's visibility.
struct PixelClass
{
  std::string name;                   ///< a few words for people
  std::array<std::uint8_t, 3> colour; ///< red, green, blue in pictures of classes
  bool traced = false;                ///< whether a ray decided
};

/// The classes of pointwise techniques that tell them, behind which they have their own
/// (map_visibility.glsl).
inline std::vector<PixelClass> classesOfMaps()
{
  return { { "no receiver", { 0, 0, 0 } }, { "turned away from the light", { 0, 140, 60 } },
    { "where the map has no caster", { 250, 250, 250 } },
    { "by the map's texels", { 60, 60, 220 } } };
}

} // namespace gnomon
