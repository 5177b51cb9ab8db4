#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"

#include <cstddef>

namespace gnomon
{

/// The solid parts of casters in a light's map: up to four slabs per texel, between depths of ray
/// space (RaySpace.h).
///
/// RayLayers chooses the slabs (settings.json): between the nearest and the farthest
/// surface, or between peeled surfaces. The whole texel counts as what its centre sees.
class DepthLayers
{
public:
  /// Bake all views of a light.
  /// @param nearest the z at which p is -1, for positional lights
  void draw(const MapInput& input, double nearest);

  /// Return an array of RGBA textures. A page holds two slabs (slabs.glsl); the pages of all views
  /// follow each other.
  GLuint slabs() const { return this->slabs_.name(); }
  int pages() const { return this->pages_; }
  std::size_t bytes() const;
  static double bytesPerTexel(const ShadowLight& light); ///< of the map, for slabs and layers

private:
  void allocate(const ShadowLight& light, int views);
  void drawHull(const MapInput& input, std::size_t view, double nearest);
  void drawPeeled(const MapInput& input, std::size_t view, double nearest);

  SizedTexture slabs_;
  ///@{
  /// Of the view being peeled.
  SizedTexture layers_;
  SizedTexture depth_;
  ///@}
  GlFramebuffer framebuffer_;
  ScreenPass screenPass_;
  int pages_ = 0;
};

} // namespace gnomon
