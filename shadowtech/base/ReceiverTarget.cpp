#include "shadowtech/base/ReceiverTarget.h"

#include "shadowtech/base/GlState.h"

namespace gnomon
{
namespace
{

void allocate(GlTexture& texture, GLenum internalFormat, GLenum format, int width, int height)
{
  glBindTexture(GL_TEXTURE_2D, texture.create());
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(internalFormat), width, height, 0, format,
    GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

} // namespace

//------------------------------------------------------------------------------
void ReceiverTarget::begin(int width, int height, bool withNormals)
{
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->outerDrawFramebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &this->outerReadFramebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  if (width != this->width_ || height != this->height_ || withNormals != this->withNormals_)
  {
    const GlStateGuard guard;
    allocate(this->positions_, GL_RGBA32F, GL_RGBA, width, height);
    allocate(this->surfaces_, withNormals ? GL_RGBA32F : GL_R32F, withNormals ? GL_RGBA : GL_RED,
      width, height);
    allocate(this->depth_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height);
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->positions_.name(), 0);
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, this->surfaces_.name(), 0);
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->depth_.name(), 0);
    const GLenum outputs[3] = { GL_NONE, GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
    glDrawBuffers(3, outputs);
    this->width_ = width;
    this->height_ = height;
    this->withNormals_ = withNormals;
  }
  // Numbers, not colours: they must not be blended.
  glDisablei(GL_BLEND, 1);
  glDisablei(GL_BLEND, 2);
  const float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 2, nothing); // says that the positions, left as they are, mean nothing
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

//------------------------------------------------------------------------------
void ReceiverTarget::end(bool blending)
{
  if (blending)
  {
    glEnablei(GL_BLEND, 1);
    glEnablei(GL_BLEND, 2);
  }
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(this->outerDrawFramebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(this->outerReadFramebuffer_));
}

//------------------------------------------------------------------------------
void ReceiverTarget::read(ReceiverImages& images) const
{
  images.width = this->width_;
  images.height = this->height_;
  const std::size_t pixels =
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  images.positionView.resize(pixels);
  images.drawn.resize(pixels);
  const GlStateGuard guard;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, this->framebuffer_.name());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, this->width_, this->height_, GL_RGBA, GL_FLOAT, images.positionView.data());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, this->width_, this->height_, GL_RED, GL_FLOAT, images.drawn.data());
}

//------------------------------------------------------------------------------
std::size_t ReceiverTarget::bytes() const
{
  // Positions of four floats, surfaces of four or one, and a depth.
  const std::size_t floats = this->withNormals_ ? 9 : 6;
  return static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_) * floats *
    sizeof(float);
}

} // namespace gnomon
