#include "shadowtech/tracing/RayFilter.h"

#include "shadowtech/tracing/TracedPicture.h"

#include <algorithm>

namespace gnomon
{

std::size_t scaleByFilter(const RayFilter& filter, const ShadowLight& light,
  const Occluders& occluders, const Receivers& receivers, std::vector<float>& visibility)
{
  const std::size_t pixels = visibility.size();
  const std::size_t channels = filter.isColoured() ? 3 : 1;
  visibility.resize(channels * pixels);
  for (std::size_t channel = 1; channel < channels; ++channel)
  {
    std::copy_n(visibility.begin(), pixels, &visibility[channel * pixels]);
  }
  std::vector<float> unfiltered;
  const TracedPicture picture(
    light, occluders, receivers, nullptr, unfiltered, nullptr, nullptr, nullptr, nullptr);
  const float rayFar = picture.rayFar();
  return picture.visitTiles(picture.allSamples(),
    [&](TracedTile& tile)
    {
      std::size_t count = 0;
      for (std::size_t pixel = 0; pixel < TracedTile::pixels; ++pixel)
      {
        const std::size_t of = tile.needed[pixel] != 0 ? tile.pixelOfPicture(pixel) : pixels;
        if (of == pixels || visibility[of] == 0.0f)
        {
          continue;
        }
        const glm::dvec3 left =
          filter.transmittanceOf(tile.origin(pixel), tile.direction(pixel), rayFar);
        for (std::size_t channel = 0; channel < channels; ++channel)
        {
          visibility[channel * pixels + of] *=
            static_cast<float>(left[static_cast<glm::length_t>(channel)]);
        }
        ++count;
      }
      return count;
    });
}

} // namespace gnomon
