#include "shadowtech/base/VisibilityLayers.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <utility>

namespace gnomon
{

//------------------------------------------------------------------------------
void VisibilityLayers::resize(int width, int height, int layers, int bits)
{
  if (this->have(width, height, layers, bits))
  {
    return;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  this->width_ = 0; // in case that there is no memory
  if (layers == 0)
  {
    this->texture_ = GlTexture();
  }
  else
  {
    allocateTexture(
      this->texture_, { GL_R32F, GL_RED, 1 }, width, height, layers, "the lights' visibility");
  }
  if (bits == 0)
  {
    this->textureOfBits_ = GlTexture();
  }
  else
  {
    allocateTexture(this->textureOfBits_, { GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT }, width,
      height, 0, "the lights' visibility");
  }
  this->bitsOfPixels_.assign(
    bits > 0 ? static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0, 0);
  this->width_ = width;
  this->height_ = height;
  this->layers_ = layers;
  this->bits_ = bits;
}

//------------------------------------------------------------------------------
void VisibilityLayers::estimate(int layer, const PointwiseTechnique& technique,
  const ShadowLight& light, const ReceiverTarget& receivers, const ReceiverSpace& space,
  ShaderLibrary& shaders, std::vector<std::uint8_t>* classes)
{
  const GlStateGuard guard;
  GlTexture ofPixels;
  std::vector<std::string> defines;
  if (classes)
  {
    glActiveTexture(GL_TEXTURE0);
    allocateTexture(ofPixels, { GL_R8UI, GL_RED_INTEGER, 1, GL_UNSIGNED_BYTE }, this->width_,
      this->height_, 0, "the pixels' classes");
    defines.emplace_back("CLASSES");
  }
  const GLuint program = ScreenPass::use(shaders,
    numberedForLight(technique.visibilityGlsl(light), 0) +
      ShaderLibrary::source("shadowtech/base/screen_visibility.frag.glsl"),
    defines);
  const int freeUnit = ShaderLibrary::setUniforms(program,
    { { "receiverFragments", TextureBinding{ GL_TEXTURE_2D, receivers.fragments() } },
      { "receiverPoints", TextureBinding{ GL_TEXTURE_2D, receivers.points() } } },
    0, 0);
  ShaderLibrary::setUniforms(program, technique.uniforms(space), 0, freeUnit);
  if (!classes)
  {
    this->fill(layer);
    return;
  }
  this->screenPass_.fill(
    { { this->texture_.name(), layer }, { ofPixels.name() } }, this->width_, this->height_);
  classes->resize(static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, ofPixels.name());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE, classes->data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::fill(int layer)
{
  this->screenPass_.fill({ { this->texture_.name(), layer } }, this->width_, this->height_);
}

//------------------------------------------------------------------------------
void VisibilityLayers::upload(int firstLayer, const std::vector<float>& visibility)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->texture_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const std::size_t pixels =
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, firstLayer, this->width_, this->height_,
    static_cast<GLsizei>(visibility.size() / pixels), GL_RED, GL_FLOAT, visibility.data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::fillBit(int bit, const std::vector<float>& visibility)
{
  const std::uint32_t lit = std::uint32_t(1) << bit;
  for (std::size_t i = 0; i < this->bitsOfPixels_.size(); ++i)
  {
    std::uint32_t& bits = this->bitsOfPixels_[i];
    bits = (bits & ~lit) | (visibility[i] != 0.0f ? lit : 0);
  }
  this->bitsChanged_ = true;
}

//------------------------------------------------------------------------------
void VisibilityLayers::uploadBits()
{
  if (!std::exchange(this->bitsChanged_, false))
  {
    return;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->textureOfBits_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, this->width_, this->height_, GL_RED_INTEGER,
    GL_UNSIGNED_INT, this->bitsOfPixels_.data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::readBit(int bit, std::vector<float>& visibility) const
{
  visibility.resize(this->bitsOfPixels_.size());
  std::transform(this->bitsOfPixels_.begin(), this->bitsOfPixels_.end(), visibility.begin(),
    [bit](std::uint32_t bits) { return static_cast<float>(bits >> bit & 1); });
}

//------------------------------------------------------------------------------
void VisibilityLayers::read(int layer, std::vector<float>& visibility) const
{
  const GlStateGuard guard;
  visibility.resize(
    static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_));
  GlFramebuffer framebuffer;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.create());
  glFramebufferTextureLayer(
    GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->texture_.name(), 0, layer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, this->width_, this->height_, GL_RED, GL_FLOAT, visibility.data());
}

//------------------------------------------------------------------------------
std::size_t VisibilityLayers::bytes() const
{
  const std::size_t images = static_cast<std::size_t>(this->layers_) + (this->bits_ > 0 ? 2 : 0);
  return static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_) * images *
    sizeof(float);
}

} // namespace gnomon
