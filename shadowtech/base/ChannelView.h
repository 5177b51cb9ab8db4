#pragma once

#include "shadowtech/base/Gl.h"

namespace gnomon
{

/// Swizzle a texture, so that shaders find two chosen channels in red and green. A shader for
/// images of one channel thus reads any channel. The destructor restores red and green. The caller
/// holds a GlStateGuard.
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
  ChannelView& operator=(ChannelView&&) = delete; ///< nor copied

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
