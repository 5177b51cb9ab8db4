#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"

#include <cstddef>

namespace gnomon
{

/// What of the casters a light's map holds as solid: slabs between depths of ray space
/// (RaySpace.h), up to four in a texel.
///
/// Which slabs these are, RayLayers says (MonteCarloSettings.h): between the nearest and the
/// farthest surface, or between peeled surfaces. All of a texel counts as what its centre sees.
class DepthLayers
{
public:
  /// Draws all views of a light.
  /// @param nearest the z at which p is -1, of a positional light
  void draw(const MapInput& input, double nearest);

  /// An array of RGBA textures: two slabs (begin, end, begin, end) to a page, the views' pages one
  /// after the other.
  GLuint slabs() const { return this->slabs_.name(); }
  int pages() const { return this->pages_; }
  std::size_t bytes() const;
  static double bytesPerTexel(const ShadowLight& light); ///< of the map's, for all of that

private:
  void allocate(const ShadowLight& light, int views);
  void drawHull(const MapInput& input, std::size_t view, double nearest);
  void drawPeeled(const MapInput& input, std::size_t view, double nearest);
  void makeSlabs(const MapInput& input, std::size_t view);

  GlTexture slabs_;
  GlTexture layers_; ///< of one view, while it is drawn
  GlTexture depth_;
  GlFramebuffer framebuffer_;
  ScreenPass screenPass_;
  int sizeTexels_ = 0;
  int views_ = 0;
  int pages_ = 0;
};

} // namespace gnomon
