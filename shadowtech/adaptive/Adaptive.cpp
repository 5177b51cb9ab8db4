#include "shadowtech/adaptive/Adaptive.h"

#include "shadowtech/adaptive/JitteredDiscs.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>

namespace gnomon
{
namespace
{

std::string define(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

bool readsBounds(const ShadowLight& light)
{
  const bool alongRay =
    light.kind != LightKind::Directional && light.metric == DepthMetric::Euclidean;
  return light.earlyOut == EarlyOut::Exact && !alongRay;
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Adaptive::info()
{
  TechniqueInfo info;
  info.name = "adaptive";
  info.evaluation = Evaluation::Pointwise;
  info.needsMap = true;
  info.filters = true;
  info.ownKernel = "disc";
  return info;
}

//------------------------------------------------------------------------------
MapReach Adaptive::mapReach(const ShadowLight& light) const
{
  return kernelReach(light, { 0.5, 0.0, 0.5 * light.kernelTexels });
}

//------------------------------------------------------------------------------
void Adaptive::bake(const MapInput& input)
{
  this->DepthMapTechnique::bake(input);
  const GlStateGuard guard;
  this->bakeDiscs(input.light);
  this->bakeBounds(input);
}

//------------------------------------------------------------------------------
void Adaptive::bakeDiscs(const ShadowLight& light)
{
  if (this->discs_ && this->discGrid_ == light.discGrid && this->discSets_ == light.discSets)
  {
    return;
  }
  const int points = light.discGrid * light.discGrid;
  const int discs = light.discSets * light.discSets;
  const std::vector<glm::vec2> byDisc = jitteredDiscs(light.discGrid, discs);
  std::vector<glm::vec2> byPoint;
  byPoint.reserve(byDisc.size());
  for (int point = 0; point < points; ++point)
  {
    for (int disc = 0; disc < discs; ++disc)
    {
      byPoint.push_back(byDisc[static_cast<std::size_t>(disc * points + point)]);
    }
  }
  allocateTexture(this->discs_, { GL_RG32F, GL_RG, 2 }, light.discSets, light.discSets, points,
    "a table of discs");
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, light.discSets, light.discSets, points, GL_RG,
    GL_FLOAT, byPoint.data());
  this->discGrid_ = light.discGrid;
  this->discSets_ = light.discSets;
}

//------------------------------------------------------------------------------
void Adaptive::bakeBounds(const MapInput& input)
{
  this->bounds_.reset();
  this->bytesOfBounds_ = 0;
  if (!readsBounds(input.light))
  {
    return;
  }
  // As many as the map has: a light without a view still needs a texture to bind.
  const int layers = std::max(static_cast<int>(input.views.views.size()), 1);
  // A power of two, so that a block's texels are those of 2 x 2 smaller blocks.
  int side = 1;
  while (2 * side < input.light.mapSizeTexels)
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
    this->bytesOfBounds_ += static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks) *
      static_cast<std::size_t>(layers) * sizeof(glm::vec2);
  }

  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/screen_visibility.vert.glsl") },
      { GL_FRAGMENT_SHADER,
        ShaderLibrary::source("shadowtech/adaptive/depth_bounds.frag.glsl") } });
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
        { { "depthMap", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->map().name() } },
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
std::size_t Adaptive::bytesOfMaps() const
{
  const auto points = static_cast<std::size_t>(this->discGrid_ * this->discGrid_);
  const auto discs = static_cast<std::size_t>(this->discSets_ * this->discSets_);
  return this->DepthMapTechnique::bytesOfMaps() + this->bytesOfBounds_ +
    points * discs * sizeof(glm::vec2);
}

//------------------------------------------------------------------------------
std::vector<Uniform> Adaptive::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
  uniforms.push_back({ "discs_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->discs_.name() } });
  if (this->bounds_)
  {
    uniforms.push_back(
      { "depthBounds_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->bounds_.name() } });
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string Adaptive::estimatorGlsl(const ShadowLight& light) const
{
  return kernelDefines(light) + define("DISC_TEXELS_LIGHT", light.kernelTexels) +
    define("DISC_RING_LIGHT", light.discGrid) +
    define("DISC_POINTS_LIGHT", light.discGrid * light.discGrid) +
    define("DISC_SETS_LIGHT", light.discSets) +
    define("DISC_ASKS_RING_LIGHT", light.earlyOut == EarlyOut::Ring) +
    define("DISC_ASKS_BOUNDS_LIGHT", readsBounds(light)) +
    ShaderLibrary::source("shadowtech/adaptive/adaptive_estimator.glsl");
}

} // namespace gnomon
