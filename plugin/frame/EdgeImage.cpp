#include "plugin/frame/EdgeImage.h"

#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/GlState.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

constexpr std::uint32_t asCentres = 0xffffffffu; ///< of both lights of a texel
constexpr float fullLight = 65534.0f;

/// Set a light's half of a texel.
void put(std::uint32_t& texel, std::size_t light, float visibility)
{
  const std::size_t shift = light % EdgeImage::lightsOfTexel * 16;
  const auto of = static_cast<std::uint32_t>(std::lround(visibility * fullLight));
  texel = (texel & ~(0xffffu << shift)) | of << shift;
}

} // namespace

void EdgeImage::update(
  const glm::ivec2& size, const std::vector<const std::vector<EdgePixel>*>& ofLights)
{
  const std::size_t perPixel = (ofLights.size() + lightsOfTexel - 1) / lightsOfTexel;
  const auto columns = static_cast<std::size_t>(size.x);
  const auto rows = static_cast<std::size_t>(size.y);
  const std::size_t width = std::max(columns, perPixel);
  const std::size_t placesInRow = width / perPixel;
  std::size_t places = 0;
  this->texels_.assign(width * rows, 0);
  for (std::size_t light = 0; light < ofLights.size(); ++light)
  {
    for (const EdgePixel& edge : *ofLights[light])
    {
      const std::size_t pixel = edge.pixel / columns * width + edge.pixel % columns;
      std::uint32_t place = this->texels_[pixel];
      if (place == 0) // which is no place: the picture is there
      {
        const std::size_t row = rows + places / placesInRow;
        place = static_cast<std::uint32_t>(row << 16 | places % placesInRow * perPixel);
        this->texels_[pixel] = place;
        this->texels_.resize((row + 1) * width, asCentres);
        ++places;
      }
      const std::size_t first = (place >> 16) * width + (place & 0xffffu);
      put(this->texels_[first + light / lightsOfTexel], light, edge.visibility.x);
    }
  }
  this->upload(width);
}

void EdgeImage::upload(std::size_t width)
{
  constexpr std::size_t rowsAtOnce = 64; // so that a few edges more fit into the same texture
  const std::size_t texelsAtOnce = rowsAtOnce * width;
  const std::size_t steps = (this->texels_.size() + texelsAtOnce - 1) / texelsAtOnce;
  this->texels_.resize(steps * texelsAtOnce);
  const auto columns = static_cast<int>(width);
  const auto rows = static_cast<int>(steps * rowsAtOnce);
  const TexelFormat format{ GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT };
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  this->texture_.allocate(format, columns, rows, 0, "the edges of shadows");
  glBindTexture(GL_TEXTURE_2D, this->texture_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(
    GL_TEXTURE_2D, 0, 0, 0, columns, rows, format.format, format.type, this->texels_.data());
}

std::size_t EdgeImage::bytes() const
{
  return bytesOf(this->texels_) + this->texture_.bytes();
}

} // namespace gnomon
