#pragma once

#include "shadowtech/base/Gl.h"

namespace gnomon
{

/// Has shaders find other channels of a texture in its first two, for as long as it lives: what
/// reads an image of one channel reads one of several channels, too. A GlStateGuard is the caller's
/// business.
class ChannelView
{
public:
  /// @param texture a GL_TEXTURE_2D
  /// @param first GL_RED, GL_GREEN, GL_BLUE or GL_ALPHA, as is `second`
  ChannelView(GLuint texture, GLenum first, GLenum second)
    : texture_(texture)
  {
    this->show(first, second);
  }
  ~ChannelView() { this->show(GL_RED, GL_GREEN); }
  ChannelView(const ChannelView&) = delete;
  ChannelView& operator=(const ChannelView&) = delete;

private:
  void show(GLenum first, GLenum second) const
  {
    glBindTexture(GL_TEXTURE_2D, this->texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, static_cast<GLint>(first));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, static_cast<GLint>(second));
  }

  GLuint texture_;
};

} // namespace gnomon
