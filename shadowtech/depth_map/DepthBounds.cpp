#include "shadowtech/depth_map/DepthBounds.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
void DepthBounds::bake(GLuint map, int sizeTexels, int layers, ShaderLibrary& shaders)
{
  const GlStateGuard guard;
  this->release(); // frees the old bounds' memory first
  // A power of two, so that each block consists of 2 x 2 smaller blocks.
  int side = 1;
  while (2 * side < sizeTexels)
  {
    side *= 2;
  }
  int levels = 1;
  while (side >> levels > 0)
  {
    ++levels;
  }
  this->bounds_.allocate(
    { GL_RG32F, GL_RG, 2 }, side, side, layers, "the depth bounds of a map", levels);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  const GLuint program =
    ScreenPass::use(shaders, ShaderLibrary::source("shadowtech/depth_map/depth_bounds.frag.glsl"));
  for (int level = 0; level < levels; ++level)
  {
    const int blocks = side >> level;
    for (int layer = 0; layer < layers; ++layer)
    {
      // Only finished levels may be read.
      glBindTexture(GL_TEXTURE_2D_ARRAY, this->bounds_.name());
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, std::max(level - 1, 0));
      ShaderLibrary::setUniforms(program,
        { { "depthMap", TextureBinding{ GL_TEXTURE_2D_ARRAY, map } },
          { "bounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.name() } },
          { "level", level }, { "layer", layer } },
        0, 0);
      this->screenPass_.fill({ { this->bounds_.name(), layer, level } }, blocks, blocks);
    }
  }
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->bounds_.name());
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

//------------------------------------------------------------------------------
Uniform DepthBounds::uniform() const
{
  return { "depthBounds_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.name() } };
}

} // namespace gnomon
