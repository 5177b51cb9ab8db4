#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <cstddef>

namespace gnomon
{

/// A layer of a map with several samples per texel, before they are averaged.
class SampledLayer
{
public:
  /// Allocate the layer.
  /// @param format of the map, the same in all calls
  /// @param sizeTexels side of the map
  /// @throws TextureMemoryError without enough memory
  void allocate(const TexelFormat& format, int sizeTexels, int samplesPerTexel);
  /// Return the framebuffer, which has its own depth buffer.
  GLuint framebuffer() const { return this->framebuffer_.name(); }
  /// Write the means of the samples to the colour attachment of another framebuffer. This layer's
  /// framebuffer is bound afterwards.
  void average(GLuint framebuffer) const;
  void release();
  std::size_t bytes() const;

private:
  GlRenderbuffer moments_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
  int sizeTexels_ = 0;
  int samples_ = 0;
  int channels_ = 0;
};

} // namespace gnomon
