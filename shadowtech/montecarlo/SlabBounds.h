#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/TextureMemory.h"

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
  void build(GLuint slabs, int pages, int sizeTexels, int views, ShaderLibrary& shaders);

  /// Return an array of RGBA textures with levels, one for each view.
  GLuint texture() const { return this->texture_.name(); }
  int topLevel() const { return this->topLevel_; }
  std::size_t bytes() const { return this->texture_.bytes(); }
  /// Return an upper bound of the bytes per texel of a light's map, whose side may be rounded up to
  /// the next power of two.
  static double bytesPerTexel(const ShadowLight& light);

private:
  SizedTexture texture_;
  int topLevel_ = 0;
};

} // namespace gnomon
