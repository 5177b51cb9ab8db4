#include "shadowtech/base/VisibilityLayers.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>
#include <utility>

namespace gnomon
{
namespace
{

constexpr int bitsOfWord = 32;

/// Return the word of a pixel that holds a bit.
std::size_t wordOf(int bit)
{
  return static_cast<std::size_t>(bit / bitsOfWord);
}

std::uint32_t maskOf(int bit)
{
  return std::uint32_t(1) << bit % bitsOfWord;
}

} // namespace

//------------------------------------------------------------------------------
void VisibilityLayers::resize(int width, int height, int layers, int bits)
{
  if (this->have(width, height, layers, bits))
  {
    return;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  this->width_ = 0; // in case the allocation fails
  if (layers == 0)
  {
    this->texture_ = GlTexture();
  }
  else
  {
    allocateTexture(
      this->texture_, { GL_R32F, GL_RED, 1 }, width, height, layers, "the lights' visibility");
  }
  this->wordsOfPixel_ = static_cast<std::size_t>((bits + bitsOfWord - 1) / bitsOfWord);
  if (bits == 0)
  {
    this->textureOfBits_ = GlTexture();
  }
  else
  {
    allocateTexture(this->textureOfBits_,
      this->wordsOfPixel_ == 1 ? TexelFormat{ GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT }
                               : TexelFormat{ GL_RG32UI, GL_RG_INTEGER, 2, GL_UNSIGNED_INT },
      width, height, 0, "the lights' visibility");
  }
  this->bitsOfPixels_.assign(
    this->wordsOfPixel_ * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
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
  const std::uint32_t lit = maskOf(bit);
  const std::size_t words = this->wordsOfPixel_;
  std::uint32_t* const bits = this->bitsOfPixels_.data() + wordOf(bit);
  for (std::size_t i = 0; i < visibility.size(); ++i)
  {
    bits[words * i] = (bits[words * i] & ~lit) | (visibility[i] != 0.0f ? lit : 0);
  }
  this->bitsChanged_ = true;
}

//------------------------------------------------------------------------------
void VisibilityLayers::darkenBits(
  const std::vector<int>& bits, const std::vector<std::uint8_t>& receives)
{
  for (std::size_t word = 0; word < this->wordsOfPixel_; ++word)
  {
    std::uint32_t dark = 0;
    for (const int bit : bits)
    {
      dark |= wordOf(bit) == word ? maskOf(bit) : 0;
    }
    if (dark == 0)
    {
      continue;
    }
    const std::size_t words = this->wordsOfPixel_;
    std::uint32_t* const ofPixels = this->bitsOfPixels_.data() + word;
    for (std::size_t i = 0; i < receives.size(); ++i)
    {
      ofPixels[words * i] = (ofPixels[words * i] & ~dark) | (receives[i] != 0 ? 0 : dark);
    }
    this->bitsChanged_ = true;
  }
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
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, this->width_, this->height_,
    this->wordsOfPixel_ == 1 ? GL_RED_INTEGER : GL_RG_INTEGER, GL_UNSIGNED_INT,
    this->bitsOfPixels_.data());
}

//------------------------------------------------------------------------------
void VisibilityLayers::readBit(int bit, std::vector<float>& visibility) const
{
  const std::size_t words = this->wordsOfPixel_;
  const std::uint32_t* const bits = this->bitsOfPixels_.data() + wordOf(bit);
  visibility.resize(this->bitsOfPixels_.size() / words);
  for (std::size_t i = 0; i < visibility.size(); ++i)
  {
    visibility[i] = (bits[words * i] & maskOf(bit)) != 0 ? 1.0f : 0.0f;
  }
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
  const std::size_t images = static_cast<std::size_t>(this->layers_) + 2 * this->wordsOfPixel_;
  return static_cast<std::size_t>(this->width_) * static_cast<std::size_t>(this->height_) * images *
    sizeof(float);
}

} // namespace gnomon
