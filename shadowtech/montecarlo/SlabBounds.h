#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/montecarlo/MonteCarloSettings.h"

#include <cstddef>

namespace gnomon
{

class ShaderLibrary;

/// A hierarchy over the slabs of a light's map (DepthLayers.h): for squares of 2^level texels, the
/// least depth at which a slab begins, the greatest at which one ends, and the greatest begin and
/// least end of the thickest slab of every texel.
///
/// As a mip pyramid, whose squares lie on a grid; or as an N-buffer (Décoret 2005), in which they
/// lie around every texel: level 1 is made of texels i and i + 1 of level 0, level j of those
/// 2^(j-2) to either side of i in level j - 1. Then texel i of level j holds the texels from i - o
/// to i + 2^j - 1 - o with o = 2^(j-1) - 1, as far as there are any (Curtis 2009, section 3.5).
class SlabBounds
{
public:
  /// @param slabs as DepthLayers::slabs() has them, so many pages of each view
  /// @param sizeTexels the side of the map; the hierarchy's is the next power of two, beyond the
  /// map with no slab
  void build(
    GLuint slabs, int pages, int sizeTexels, int views, SlabHierarchy kind, ShaderLibrary& shaders);

  /// An array of RGBA textures: with levels for each view, or each view's levels one after the
  /// other.
  GLuint texture() const { return this->texture_.name(); }
  int topLevel() const { return this->topLevel_; }
  std::size_t bytes() const;
  /// The most for a texel of a light's map: its side may be rounded up to twice as many texels.
  static double bytesPerTexel(const ShadowLight& light);

private:
  void allocate(int sizeTexels, int views, SlabHierarchy kind);

  GlTexture texture_;
  int topLevel_ = 0;
  int sizeTexels_ = 0;
  int views_ = 0;
  SlabHierarchy kind_ = SlabHierarchy::Mips;
};

} // namespace gnomon
