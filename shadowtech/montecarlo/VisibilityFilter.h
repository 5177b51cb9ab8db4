#ifndef gnomon_shadowtech_montecarlo_VisibilityFilter_h
#define gnomon_shadowtech_montecarlo_VisibilityFilter_h

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

/// Takes the noise off a visibility image: a Gaussian in two passes, over pixels of the same surface
/// (visibility_filter.frag.glsl).
class VisibilityFilter
{
public:
  /// Fills a layer of the light.
  /// @param unfiltered visibility and class (classes.glsl), two floats per pixel
  /// @param rays as the light's samples are a grid of rays x rays, which says how large the noise is
  /// @param radiusPixels the Gaussian's deviation is half of it; 0: nothing is changed
  /// @param lit the visibility of what nothing hides the light from, which the noise is a share of; > 0
  void apply(
    const LayerInput& input, int layer, GLuint unfiltered, int rays, int radiusPixels, float lit);

  std::size_t bytes() const;

private:
  GlTexture rows_;
  ScreenPass screenPass_;
  int width_ = 0;
  int height_ = 0;
};

} // namespace gnomon

#endif
