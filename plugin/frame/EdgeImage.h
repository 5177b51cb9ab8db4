#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/tracing/EdgeSamples.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The picture's own visibility at edges of hard shadows, for shaders (hook_edges.glsl). The
/// lights' bits stay those of the pixels' centres; one more bit marks the pixels that are here.
///
/// It is one texture of whole numbers, to take one unit. Below is the picture, with the places of
/// edge pixels in a table above: column and row of the first texel, in 16 bits each, as llvmpipe
/// divides slowly. An edge pixel has texels in a row, one for two lights, the first in the lower
/// half, with visibility in 65534ths. 65535 stands for that of the pixel's centre.
class EdgeImage
{
public:
  static constexpr int lightsOfTexel = 2;

  /// @param ofLights by bit, the edge pixels of each light
  void update(const glm::ivec2& size, const std::vector<const std::vector<EdgePixel>*>& ofLights);

  TextureBinding texture() const { return { GL_TEXTURE_2D, this->texture_.name() }; }
  std::size_t bytes() const;

private:
  void upload(std::size_t width);

  std::vector<std::uint32_t> texels_;
  SizedTexture texture_;
};

} // namespace gnomon
