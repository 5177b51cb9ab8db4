#ifndef gnomon_shadowtech_base_PixelClass_h
#define gnomon_shadowtech_base_PixelClass_h

#include <array>
#include <cstdint>
#include <string>

namespace gnomon
{

/// One of the ways in which a screen technique may come to a pixel's visibility.
struct PixelClass
{
  std::string name;                   ///< a few words for people
  std::array<std::uint8_t, 3> colour; ///< red, green, blue in pictures of classes
  bool traced = false;                ///< whether a ray decided
};

} // namespace gnomon

#endif
