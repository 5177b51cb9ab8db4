#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/montecarlo/UndecidedTiles.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

class UndecidedTiles;

/// Removes noise from a visibility image: a Gaussian in two passes, over pixels of one surface
/// (visibility_filter.frag.glsl).
class VisibilityFilter
{
public:
  /// The images to filter.
  struct Noisy
  {
    GLuint visibility; ///< and class (classes.glsl), two floats per pixel
    GLuint slopes;     ///< gradients of visibility in view coordinates, where rays tell them
    int rays;          ///< side of the grid of samples on the light, which tells the noise
    float lit;         ///< the visibility of unhidden receivers, > 0
  };

  /// Filter into a layer of the light, which must hold the unfiltered visibility. Only pixels that
  /// the filter may change are written.
  /// @param undecided tiles of the picture
  /// @param radiusPixels twice the Gaussian's largest deviation; > 0
  void apply(const LayerInput& input, int layer, const Noisy& noisy, UndecidedTiles& undecided,
    int radiusPixels)
  {
    const int width = input.receivers.width();
    const int height = input.receivers.height();
    this->rows_.allocate({ GL_RG32F, GL_RG, 2 }, width, height, 0, "filtered rows");
    this->slopesOfRows_.allocate(
      { GL_RGBA32F, GL_RGBA, 4 }, width, height, 0, "slopes of filtered rows");
    const GLuint program = UndecidedTiles::use(input.shaders,
      ShaderLibrary::source("shadowtech/montecarlo/visibility_filter.frag.glsl"),
      { "FILTER_PIXELS " + std::to_string(radiusPixels), "RAYS " + std::to_string(noisy.rays),
        "MIXED" });
    const auto set =
      [&](GLuint source, GLuint slopes, const glm::ivec2& axis, const glm::ivec2& reach)
    {
      const int freeUnit = ShaderLibrary::setUniforms(program,
        { { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, input.receivers.fragments() } },
          { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, input.receivers.points() } },
          { "unfiltered", TextureBinding{ GL_TEXTURE_2D, noisy.visibility } },
          { "source", TextureBinding{ GL_TEXTURE_2D, source } },
          { "slopes", TextureBinding{ GL_TEXTURE_2D, slopes } }, { "axis", axis },
          { "lit", noisy.lit },
          { "pixelSide", glm::vec2(input.camera.pixelSide({ width, height })) } },
        0, 0);
      ShaderLibrary::setUniforms(program, undecided.uniforms(reach), 0, freeUnit);
    };
    // The pass along columns reads rows above and below.
    const int reach = UndecidedTiles::tilesOf(radiusPixels);
    set(noisy.visibility, noisy.slopes, { 1, 0 }, { reach, 2 * reach });
    undecided.fill({ { this->rows_.name() }, { this->slopesOfRows_.name() } });
    set(this->rows_.name(), this->slopesOfRows_.name(), { 0, 1 }, { reach, reach });
    undecided.fill({ { input.layers.texture(), layer } });
  }

  std::size_t bytes() const { return this->rows_.bytes() + this->slopesOfRows_.bytes(); }

private:
  SizedTexture rows_;
  SizedTexture slopesOfRows_;
};

} // namespace gnomon
