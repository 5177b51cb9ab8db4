#include "shadowtech/montecarlo/VisibilityFilter.h"

#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/montecarlo/UndecidedTiles.h"

namespace gnomon
{

//------------------------------------------------------------------------------
void VisibilityFilter::apply(const LayerInput& input, int layer, const Noisy& noisy,
  UndecidedTiles& undecided, int radiusPixels)
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
  const auto set = [&](
                     GLuint source, GLuint slopes, const glm::ivec2& axis, const glm::ivec2& reach)
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

} // namespace gnomon
