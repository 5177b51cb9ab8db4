#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{

/// A pyramid of the least and the largest depth of a map's blocks of 2, 4, 8, ... texels, up to the
/// whole layer. It bounds all texels of a region without reading them (depth_bounds.glsl).
///
/// A surface's linear depth is monotonic along every line of the map, so the corners of a block
/// bound the depths of planes, too. They do not bound depths along the ray.
class DepthBounds
{
public:
  /// Build the pyramid of a map.
  /// @param map a texture array of depths
  /// @param layers at least 1
  /// @throws TextureMemoryError
  void bake(GLuint map, int sizeTexels, int layers, ShaderLibrary& shaders)
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
    const GLuint program = ScreenPass::use(
      shaders, ShaderLibrary::source("shadowtech/depth_map/depth_bounds.frag.glsl"));
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

  void release() { this->bounds_.reset(); }

  /// True if the pyramid is built.
  explicit operator bool() const { return static_cast<bool>(this->bounds_); }
  std::size_t bytes() const { return this->bounds_.bytes(); }
  Uniform uniform() const
  {
    return { "depthBounds_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.name() } };
  }

private:
  SizedTexture bounds_;
  ScreenPass screenPass_;
};

} // namespace gnomon
