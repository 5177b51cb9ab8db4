#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/TextureMemory.h"

#include <cstddef>

namespace gnomon
{

/// What a layer of a map is drawn into with several samples of each texel, before they are
/// averaged.
class SampledLayer
{
public:
  /// @param format of the map
  /// @throws TextureMemoryError
  void allocate(const TexelFormat& format, int sizeTexels, int samplesPerTexel);
  /// With a depth buffer of its own.
  GLuint framebuffer() const { return this->framebuffer_.name(); }
  /// Writes the means of the samples to the colour attachment of another framebuffer; this one is
  /// bound afterwards.
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
