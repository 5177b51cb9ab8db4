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
  void allocate(const TexelFormat& format, int sizeTexels, int samplesPerTexel)
  {
    if (this->sizeTexels_ == sizeTexels && this->samples_ == samplesPerTexel)
    {
      return;
    }
    this->release(); // stays empty if memory runs out
    allocateSamples(this->moments_, format, sizeTexels, samplesPerTexel);
    allocateSamples(
      this->depth_, { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 }, sizeTexels, samplesPerTexel);
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
    glFramebufferRenderbuffer(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, this->moments_.name());
    glFramebufferRenderbuffer(
      GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, this->depth_.name());
    this->sizeTexels_ = sizeTexels;
    this->samples_ = samplesPerTexel;
    this->channels_ = format.channels + 1;
  }

  /// Return the framebuffer, which has its own depth buffer.
  GLuint framebuffer() const { return this->framebuffer_.name(); }
  /// Write the means of the samples to the colour attachment of another framebuffer. This layer's
  /// framebuffer is bound afterwards.
  void average(GLuint framebuffer) const
  {
    const GLint size = this->sizeTexels_;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, this->framebuffer_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, size, size, 0, 0, size, size, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
  }

  void release()
  {
    this->moments_.reset();
    this->depth_.reset();
    this->framebuffer_.reset();
    this->samples_ = 0;
  }

  std::size_t bytes() const
  {
    const auto side = static_cast<std::size_t>(this->sizeTexels_);
    return side * side * static_cast<std::size_t>(this->samples_ * this->channels_) * sizeof(float);
  }

private:
  GlRenderbuffer moments_;
  GlRenderbuffer depth_;
  GlFramebuffer framebuffer_;
  int sizeTexels_ = 0;
  int samples_ = 0;
  int channels_ = 0;
};

} // namespace gnomon
