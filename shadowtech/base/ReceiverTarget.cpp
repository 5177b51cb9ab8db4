#include "shadowtech/base/ReceiverTarget.h"

#include "shadowtech/base/GlState.h"

namespace gnomon
{
void ReceiverTarget::begin(int width, int height, bool withPoints)
{
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->outerDrawFramebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &this->outerReadFramebuffer_);
  if (width != this->width_ || height != this->height_ || withPoints != this->withPoints_)
  {
    this->allocate(width, height, withPoints);
  }
  this->bind();
  const float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 1, nothing); // marks the points, which are not cleared, as invalid
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void ReceiverTarget::bind()
{
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
  // The outputs are numbers, not colours: they must not be blended.
  glDisablei(GL_BLEND, 1);
  glDisablei(GL_BLEND, 2);
}

void ReceiverTarget::allocate(int width, int height, bool withPoints)
{
  const GlStateGuard guard;
  this->width_ = 0; // in case the allocation fails
  const auto allocate = [&](SizedTexture& texture, const TexelFormat& format)
  { texture.allocate(format, width, height, 0, "the receivers' image"); };
  allocate(this->fragments_,
    withPoints ? TexelFormat{ GL_RGBA32F, GL_RGBA, 4 } : TexelFormat{ GL_RG32F, GL_RG, 2 });
  allocate(this->depth_, { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 });
  this->points_.reset();
  if (withPoints)
  {
    allocate(this->points_, { GL_RGBA32F, GL_RGBA, 4 });
  }

  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  const auto attach = [](GLenum attachment, const GlTexture& texture)
  { glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0); };
  attach(GL_COLOR_ATTACHMENT0, this->fragments_);
  attach(GL_DEPTH_ATTACHMENT, this->depth_);
  attach(GL_COLOR_ATTACHMENT1, this->points_); // detaches without points
  const GLenum outputs[3] = { GL_NONE, GL_COLOR_ATTACHMENT0,
    withPoints ? GLenum(GL_COLOR_ATTACHMENT1) : GLenum(GL_NONE) };
  glDrawBuffers(3, outputs);
  this->width_ = width;
  this->height_ = height;
  this->withPoints_ = withPoints;
}

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

void ReceiverTarget::fill(int width, int height, const std::vector<glm::vec4>& fragments,
  const std::vector<glm::vec4>& points)
{
  if (width != this->width_ || height != this->height_ || !this->withPoints_)
  {
    this->allocate(width, height, true);
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const auto upload = [&](const GlTexture& texture, const std::vector<glm::vec4>& texels)
  {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, texels.data());
  };
  upload(this->fragments_, fragments);
  upload(this->points_, points);
}

void ReceiverTarget::read(ReceiverImages& images) const
{
  images.width = this->width_;
  images.height = this->height_;
  const std::size_t pixels =
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  images.fragments.resize(pixels);
  readFramebuffer(this->framebuffer_.name(), glm::ivec2(0), { this->width_, this->height_ }, GL_RG,
    images.fragments.data());
}

void ReceiverTarget::readDepths(std::vector<float>& depths) const
{
  gnomon::readDepths(
    this->framebuffer_.name(), glm::ivec2(0), { this->width_, this->height_ }, depths);
}

std::size_t ReceiverTarget::bytes() const
{
  return this->fragments_.bytes() + this->points_.bytes() + this->depth_.bytes();
}

} // namespace gnomon
