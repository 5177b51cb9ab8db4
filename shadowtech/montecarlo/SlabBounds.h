#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Gl.h"

#include <cstddef>

namespace gnomon
{

class ShaderLibrary;

/// A hierarchy over the slabs of a light's map (DepthLayers.h). For squares of 2^level texels it
/// holds:
/// - the least depth at which a slab begins, and the greatest at which one ends;
/// - the greatest begin and the least end of the thickest slab of each texel.
///
/// Squares lie on a grid, as a mip pyramid, or around every texel, as an N-buffer (Décoret 2005).
/// Level 1 of an N-buffer joins texels i and i + 1 of level 0. Level j joins texels i - 2^(j-2) and
/// i + 2^(j-2) of level j - 1. So texel i of level j holds the existing texels from i - o to i +
/// 2^j - 1 - o, with o = 2^(j-1) - 1 (Curtis 2009, section 3.5).
class SlabBounds
{
public:
  /// Build the hierarchy.
  /// @param slabs DepthLayers::slabs()
  /// @param pages of each view
  /// @param sizeTexels side of the map; the hierarchy's is the next power of two, without slabs
  /// beyond the map
  void build(
    GLuint slabs, int pages, int sizeTexels, int views, SlabHierarchy kind, ShaderLibrary& shaders);

  /// Return an array of RGBA textures. Mips have levels for each view; N-buffers have the levels of
  /// each view as consecutive layers.
  GLuint texture() const { return this->texture_.name(); }
  int topLevel() const { return this->topLevel_; }
  std::size_t bytes() const;
  /// Return an upper bound of the bytes per texel of a light's map, whose side may be rounded up to
  /// the next power of two.
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
