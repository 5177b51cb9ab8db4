#include "shadowtech/base/CutoutMask.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// Wrap a texture coordinate into [0, 1], or [-1, 2] if there is a border.
float reduced(float coordinate, TextureWrap wrap)
{
  float result = 0.0f;
  switch (wrap)
  {
    case TextureWrap::ClampToEdge:
      result = std::clamp(coordinate, 0.0f, 1.0f);
      break;
    case TextureWrap::Repeat:
      result = coordinate - std::floor(coordinate);
      break;
    case TextureWrap::MirroredRepeat:
    {
      const float folded = coordinate - 2.0f * std::floor(0.5f * coordinate);
      result = std::min(folded, 2.0f - folded);
      break;
    }
    case TextureWrap::ClampToBorder:
      result = std::clamp(coordinate, -1.0f, 2.0f);
      break;
  }
  return result >= -1.0f && result <= 2.0f ? result : 0.0f; // not finite
}

constexpr int border = -1;

/// Return the texel at an index that is out of range by no more than the size.
int texelAt(int index, int size, TextureWrap wrap)
{
  if (wrap == TextureWrap::Repeat)
  {
    return (index + size) % size;
  }
  if (wrap == TextureWrap::ClampToBorder)
  {
    return index >= 0 && index < size ? index : border;
  }
  return std::clamp(index, 0, size - 1); // a mirrored texture repeats its edge texel
}

/// Return the texel at indices that are out of range by no more than the size.
std::uint8_t texelOf(const CutoutMask& mask, int x, int y)
{
  const int column = texelAt(x, mask.width, mask.wrap);
  const int row = texelAt(y, mask.height, mask.wrap);
  return column == border || row == border
    ? (mask.borderDrawn ? 255 : 0)
    : mask.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
        static_cast<std::size_t>(column)];
}

glm::vec2 placeInTexels(const CutoutMask& mask, const glm::vec2& coordinates)
{
  return { reduced(coordinates.x, mask.wrap) * static_cast<float>(mask.width),
    reduced(coordinates.y, mask.wrap) * static_cast<float>(mask.height) };
}

} // namespace

bool CutoutMask::isDrawn(const glm::vec2& textureCoordinates) const
{
  const auto texelDrawn = [this](int x, int y) { return texelOf(*this, x, y) > 0; };
  const glm::vec2 place = placeInTexels(*this, textureCoordinates);
  if (!this->interpolated)
  {
    return texelDrawn(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
  }
  const glm::vec2 fromCentre = place - 0.5f;
  const glm::vec2 first = glm::floor(fromCentre);
  const int x = static_cast<int>(first.x);
  const int y = static_cast<int>(first.y);
  // A texel counts if its weight is above 0. The first one always has a weight, the next one only
  // beyond the first one's centre.
  const bool nextColumn = fromCentre.x > first.x;
  const bool nextRow = fromCentre.y > first.y;
  return texelDrawn(x, y) || (nextColumn && texelDrawn(x + 1, y)) ||
    (nextRow && texelDrawn(x, y + 1)) || (nextColumn && nextRow && texelDrawn(x + 1, y + 1));
}

double CutoutMask::alphaAt(const glm::vec2& textureCoordinates) const
{
  constexpr double full = 255.0;
  const glm::vec2 place = placeInTexels(*this, textureCoordinates);
  if (!this->interpolated)
  {
    const glm::ivec2 texel(glm::floor(place));
    return texelOf(*this, texel.x, texel.y) / full;
  }
  const glm::dvec2 fromCentre(place - 0.5f);
  const glm::ivec2 first(glm::floor(fromCentre));
  const glm::dvec2 weight = fromCentre - glm::dvec2(first);
  const auto ofRow = [&](int y) {
    return glm::mix<double>(texelOf(*this, first.x, y), texelOf(*this, first.x + 1, y), weight.x);
  };
  return glm::mix(ofRow(first.y), ofRow(first.y + 1), weight.y) / full;
}

} // namespace gnomon
