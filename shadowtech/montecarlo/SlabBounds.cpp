#include "shadowtech/montecarlo/SlabBounds.h"

#include "lights/LightViews.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

constexpr int slabsPerGroup = 8; // as in slab_bounds.comp.glsl

/// Return the offsets from a texel of an N-buffer's level to the first and the last texel below
/// that it joins.
glm::ivec2 stepsTo(int level)
{
  const int half = level > 1 ? 1 << (level - 2) : 0;
  return level > 1 ? glm::ivec2(-half, half) : glm::ivec2(0, 1);
}

} // namespace

//------------------------------------------------------------------------------
void SlabBounds::allocate(int sizeTexels, int views, SlabHierarchy kind)
{
  if (this->sizeTexels_ == sizeTexels && this->views_ == views && this->kind_ == kind)
  {
    return;
  }
  this->sizeTexels_ = 0; // stays 0 if memory runs out
  this->topLevel_ = 0;
  while (1 << this->topLevel_ < sizeTexels)
  {
    ++this->topLevel_;
  }
  const int levels = this->topLevel_ + 1;
  const bool mips = kind == SlabHierarchy::Mips;
  allocateMap(this->texture_, { GL_RGBA32F, GL_RGBA, 4 }, 1 << this->topLevel_,
    mips ? views : views * levels, mips ? levels : 1);
  if (mips)
  {
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
  }
  this->sizeTexels_ = sizeTexels;
  this->views_ = views;
  this->kind_ = kind;
}

//------------------------------------------------------------------------------
void SlabBounds::build(
  GLuint slabs, int pages, int sizeTexels, int views, SlabHierarchy kind, ShaderLibrary& shaders)
{
  this->allocate(sizeTexels, std::max(views, 1), kind);
  const std::string source = ShaderLibrary::source("shadowtech/montecarlo/slab_bounds.comp.glsl");
  const bool mips = kind == SlabHierarchy::Mips;
  const auto program = [&](const std::string& define) {
    return shaders.program({ { GL_COMPUTE_SHADER, source } }, { define });
  };
  const GLuint ofSlabs = shaders.program(
    { { GL_COMPUTE_SHADER, source } }, { "OF_SLABS", "PAGES " + std::to_string(pages) });
  const GLuint ofBounds = program(mips ? "MIPS" : "NBUFFER");
  const int levels = this->topLevel_ + 1;
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  for (int view = 0; view < views; ++view)
  {
    for (int level = 0; level < levels; ++level)
    {
      const GLuint used = level == 0 ? ofSlabs : ofBounds;
      const int firstLayer = mips ? view : view * levels;
      const int below = mips ? firstLayer : firstLayer + level - 1;
      glUseProgram(used);
      ShaderLibrary::setUniforms(used,
        { { "below",
            TextureBinding{ GL_TEXTURE_2D_ARRAY, level == 0 ? slabs : this->texture_.name() } },
          { "layer", level == 0 ? view * pages : below },
          { "level", mips && level > 0 ? level - 1 : 0 }, { "steps", stepsTo(level) } },
        0, 0);
      glBindImageTexture(0, this->texture_.name(), mips ? level : 0, GL_FALSE,
        mips ? view : firstLayer + level, GL_WRITE_ONLY, GL_RGBA32F);
      const int side = 1 << (mips ? this->topLevel_ - level : this->topLevel_);
      const auto groups = static_cast<GLuint>((side + slabsPerGroup - 1) / slabsPerGroup);
      glDispatchCompute(groups, groups, 1);
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }
  glBindImageTexture(0, 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

//------------------------------------------------------------------------------
std::size_t SlabBounds::bytes() const
{
  if (!this->sizeTexels_)
  {
    return 0;
  }
  const std::size_t side = std::size_t(1) << this->topLevel_;
  std::size_t texels = side * side * static_cast<std::size_t>(this->topLevel_ + 1);
  if (this->kind_ == SlabHierarchy::Mips)
  {
    texels = 0;
    for (std::size_t at = side; at > 0; at /= 2)
    {
      texels += at * at;
    }
  }
  return texels * static_cast<std::size_t>(this->views_) * 4 * sizeof(float);
}

//------------------------------------------------------------------------------
double SlabBounds::bytesPerTexel(const ShadowLight& light)
{
  const bool mips = light.monteCarlo.pyramid == SlabHierarchy::Mips;
  const double levels = mips ? 4.0 / 3.0 : 2.0 + std::log2(light.mapSizeTexels);
  constexpr double rounded = 4.0; // texels for one, as the side may be rounded up to twice as many
  return rounded * levels * mostViews(light) * 4 * sizeof(float);
}

} // namespace gnomon
