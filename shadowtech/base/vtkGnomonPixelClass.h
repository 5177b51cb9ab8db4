#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon
{

/// One way in which a technique decides a pixel's visibility.
struct PixelClass
{
  std::string name;                   ///< a few words for users
  std::array<std::uint8_t, 3> colour; ///< red, green, blue in pictures of classes
  bool traced = false;                ///< a ray decided
};

/// Return the classes that all pointwise techniques with classes share. A technique's own classes
/// follow them (map_visibility.glsl).
inline std::vector<PixelClass> classesOfMaps()
{
  return { { "no receiver", { 0, 0, 0 } }, { "turned away from the light", { 0, 140, 60 } },
    { "where the map has no caster", { 250, 250, 250 } },
    { "by the map's texels", { 60, 60, 220 } } };
}

} // namespace gnomon
