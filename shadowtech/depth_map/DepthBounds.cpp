#include "shadowtech/depth_map/DepthBounds.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
const SettingsTable& earlyOutSettings()
{
  static const SettingsTable table = { "Early out",
    { bakedInto(choice("early_out",
      "what is asked before the whole kernel is read: nothing, its outermost ring (adaptive), or "
      "the depths' bounds",
      &EarlyOutSettings::earlyOut, { "none", "ring", "exact" })) } };
  return table;
}

//------------------------------------------------------------------------------
void DepthBounds::release()
{
  this->bounds_.reset();
  this->bytes_ = 0;
}

//------------------------------------------------------------------------------
void DepthBounds::bake(GLuint map, int sizeTexels, int layers, ShaderLibrary& shaders)
{
  const GlStateGuard guard;
  this->release();
  // A power of two, so that a block's texels are those of 2 x 2 smaller blocks.
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
  allocateTexture(
    this->bounds_, { GL_RG32F, GL_RG, 2 }, side, side, layers, "the depth bounds of a map", levels);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  for (int blocks = side; blocks >= 1; blocks /= 2)
  {
    this->bytes_ += static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks) *
      static_cast<std::size_t>(layers) * sizeof(glm::vec2);
  }

  const GLuint program = shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/screen_visibility.vert.glsl") },
      { GL_FRAGMENT_SHADER,
        ShaderLibrary::source("shadowtech/depth_map/depth_bounds.frag.glsl") } });
  glUseProgram(program);
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  glDrawBuffer(GL_COLOR_ATTACHMENT0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_MULTISAMPLE);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisablei(GL_BLEND, 0);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  GlVertexArray noAttributes;
  glBindVertexArray(noAttributes.create());
  for (int level = 0; level < levels; ++level)
  {
    const int blocks = side >> level;
    glViewport(0, 0, blocks, blocks);
    for (int layer = 0; layer < layers; ++layer)
    {
      glFramebufferTextureLayer(
        GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->bounds_.name(), level, layer);
      // Only what is finished may be read.
      glBindTexture(GL_TEXTURE_2D_ARRAY, this->bounds_.name());
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, std::max(level - 1, 0));
      ShaderLibrary::setUniforms(program,
        { { "depthMap", TextureBinding{ GL_TEXTURE_2D_ARRAY, map } },
          { "bounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.name() } },
          { "level", level }, { "layer", layer } },
        0, 0);
      glDrawArrays(GL_TRIANGLES, 0, 3);
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
