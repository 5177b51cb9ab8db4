#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

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
    int radiusPixels);

  std::size_t bytes() const { return this->rows_.bytes() + this->slopesOfRows_.bytes(); }

private:
  SizedTexture rows_;
  SizedTexture slopesOfRows_;
};

} // namespace gnomon
