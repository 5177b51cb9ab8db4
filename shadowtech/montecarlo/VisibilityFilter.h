#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

class UndecidedTiles;

/// Takes the noise off a visibility image: a Gaussian in two passes, over pixels of the same
/// surface (visibility_filter.frag.glsl).
class VisibilityFilter
{
public:
  /// What is filtered.
  struct Noisy
  {
    GLuint visibility; ///< and class (classes.glsl), two floats per pixel
    GLuint slopes;     ///< its gradient in view coordinates, where rays tell it
    int rays;          ///< the light's samples are a grid of rays x rays: how large the noise is
    float lit;         ///< the visibility of what nothing hides the light from, > 0
  };

  /// Fills a layer of the light where it may change: it holds the visibility as it is.
  /// @param undecided tiles of the picture
  /// @param radiusPixels the Gaussian's deviation is half of it at most; > 0
  void apply(const LayerInput& input, int layer, const Noisy& noisy, UndecidedTiles& undecided,
    int radiusPixels);

  std::size_t bytes() const;

private:
  GlTexture rows_;
  GlTexture slopesOfRows_;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon
