#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <cstddef>

namespace gnomon
{

class ShaderLibrary;

/// A pyramid over the slabs of a light's map (DepthLayers.h). For squares of 2^level texels it
/// holds:
/// - the least depth at which a slab begins, and the greatest at which one ends;
/// - the greatest begin and the least end of the thickest slab of each texel.
class SlabBounds
{
public:
  /// Build the pyramid.
  /// @param slabs DepthLayers::slabs()
  /// @param pages of each view
  /// @param sizeTexels side of the map; the pyramid's is the next power of two, without slabs
  /// beyond the map
  void build(GLuint slabs, int pages, int sizeTexels, int views, ShaderLibrary& shaders)
  {
    constexpr int texelsOfGroup = 8; // as in slab_bounds.comp.glsl
    this->topLevel_ = 0;
    while (1 << this->topLevel_ < sizeTexels)
    {
      ++this->topLevel_;
    }
    if (this->texture_.allocateMap({ GL_RGBA32F, GL_RGBA, 4 }, 1 << this->topLevel_,
          std::max(views, 1), this->topLevel_ + 1))
    {
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    }
    const std::string source = ShaderLibrary::source("shadowtech/montecarlo/slab_bounds.comp.glsl");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    for (int level = 0; level <= this->topLevel_; ++level)
    {
      const bool ofSlabs = level == 0;
      const GLuint program = shaders.program({ { GL_COMPUTE_SHADER, source } },
        { ofSlabs ? "PAGES " + std::to_string(pages) : std::string("OF_BOUNDS") });
      glUseProgram(program);
      for (int view = 0; view < views; ++view)
      {
        ShaderLibrary::setUniforms(program,
          { { "below",
              TextureBinding{ GL_TEXTURE_2D_ARRAY, ofSlabs ? slabs : this->texture_.name() } },
            { "layer", ofSlabs ? view * pages : view }, { "level", std::max(level - 1, 0) } },
          0, 0);
        glBindImageTexture(
          0, this->texture_.name(), level, GL_FALSE, view, GL_WRITE_ONLY, GL_RGBA32F);
        const int side = 1 << (this->topLevel_ - level);
        const auto groups = static_cast<GLuint>((side + texelsOfGroup - 1) / texelsOfGroup);
        glDispatchCompute(groups, groups, 1);
      }
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    glBindImageTexture(0, 0, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  }

  /// Return an array of RGBA textures with levels, one for each view.
  GLuint texture() const { return this->texture_.name(); }
  int topLevel() const { return this->topLevel_; }
  std::size_t bytes() const { return this->texture_.bytes(); }
  /// Return an upper bound of the bytes per texel of a light's map, whose side may be rounded up to
  /// the next power of two.
  static double bytesPerTexel(const ShadowLight& light)
  {
    constexpr double levels = 4.0 / 3.0;
    constexpr double rounded =
      4.0; // texels for one, as the side may be rounded up to twice as many
    return rounded * levels * mostViews(light) * 4 * sizeof(float);
  }

private:
  SizedTexture texture_;
  int topLevel_ = 0;
};

} // namespace gnomon
