#include "shadowtech/base/VisibilityLayers.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace gnomon
{
namespace
{

constexpr int bitsOfByte = 8;

/// Return the byte of a pixel that holds a bit. Shaders read a pixel's bytes as one or two numbers,
/// the lowest byte first.
std::size_t byteOf(int bit)
{
  return static_cast<std::size_t>(bit / bitsOfByte);
}

std::uint8_t maskOf(int bit)
{
  return static_cast<std::uint8_t>(1 << bit % bitsOfByte);
}

struct BitsFormat
{
  std::size_t bytesOfPixel;
  TexelFormat texel;
};

/// Return the smallest format that has room for so many bits.
const BitsFormat& formatOfBits(int bits)
{
  static const std::array<BitsFormat, 4> formats{ {
    { 1, { GL_R8UI, GL_RED_INTEGER, 1, GL_UNSIGNED_BYTE } },
    { 2, { GL_R16UI, GL_RED_INTEGER, 1, GL_UNSIGNED_SHORT } },
    { 4, { GL_R32UI, GL_RED_INTEGER, 1, GL_UNSIGNED_INT } },
    { 8, { GL_RG32UI, GL_RG_INTEGER, 2, GL_UNSIGNED_INT } },
  } };
  return *std::find_if(formats.begin(), formats.end() - 1,
    [bits](const BitsFormat& format) { return byteOf(bits - 1) < format.bytesOfPixel; });
}

/// Call `visit(pixel, place)` for all pixels, `place` being that of a byte among all bytes.
/// @param stride bytes from pixel to pixel
template <typename Visit>
void visitBytes(std::size_t pixels, std::size_t stride, const Visit& visit)
{
  constexpr std::size_t pixelsOfTask = 65536;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, pixelsOfTask),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      const auto visitBy = [&](auto step)
      {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          visit(i, step * i);
        }
      };
      // Compilers vectorize a stride that they know.
      stride == 1 ? visitBy(std::integral_constant<std::size_t, 1>()) : visitBy(stride);
    });
}

} // namespace

void VisibilityLayers::resize(int width, int height, int layers, int bits)
{
  if (this->have(width, height, layers, bits))
  {
    return;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  this->width_ = 0; // in case the allocation fails
  this->texture_.reset();
  if (layers > 0)
  {
    allocateTexture(
      this->texture_, { GL_R32F, GL_RED, 1 }, width, height, layers, "the lights' visibility");
  }
  this->textureOfBits_.reset();
  this->bytesOfPixel_ = 0;
  if (bits > 0)
  {
    const BitsFormat& format = formatOfBits(bits);
    this->bytesOfPixel_ = format.bytesOfPixel;
    allocateTexture(this->textureOfBits_, format.texel, width, height, 0, "the lights' visibility");
  }
  this->width_ = width;
  this->height_ = height;
  this->layers_ = layers;
  this->bits_ = bits;
  this->bitsOfPixels_.assign(this->bytesOfPixel_ * this->pixels(), 0);
}

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
  classes->resize(this->pixels());
  readTexture(ofPixels.name(), GL_RED_INTEGER, GL_UNSIGNED_BYTE, classes->data());
}

void VisibilityLayers::fill(int layer)
{
  this->screenPass_.fill({ { this->texture_.name(), layer } }, this->width_, this->height_);
}

void VisibilityLayers::upload(int firstLayer, const std::vector<float>& visibility)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->texture_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, firstLayer, this->width_, this->height_,
    static_cast<GLsizei>(visibility.size() / this->pixels()), GL_RED, GL_FLOAT, visibility.data());
}

void VisibilityLayers::fillBit(int bit, const std::vector<float>& visibility)
{
  const std::uint8_t lit = maskOf(bit);
  const float* const from = visibility.data();
  std::uint8_t* const to = this->bitsOfPixels_.data() + byteOf(bit);
  visitBytes(visibility.size(), this->bytesOfPixel_,
    [=](std::size_t pixel, std::size_t place) {
      to[place] = static_cast<std::uint8_t>((to[place] & ~lit) | (from[pixel] != 0.0f ? lit : 0));
    });
  this->bitsChanged_ = true;
}

void VisibilityLayers::darkenBits(
  const std::vector<int>& bits, const std::vector<std::uint8_t>& receives)
{
  for (std::size_t byte = 0; byte < this->bytesOfPixel_; ++byte)
  {
    int mask = 0;
    for (const int bit : bits)
    {
      mask |= byteOf(bit) == byte ? maskOf(bit) : 0;
    }
    if (mask == 0)
    {
      continue;
    }
    std::uint8_t* const to = this->bitsOfPixels_.data() + byte;
    visitBytes(receives.size(), this->bytesOfPixel_,
      [to, mask, from = receives.data()](std::size_t pixel, std::size_t place) {
        to[place] = static_cast<std::uint8_t>((to[place] & ~mask) | (from[pixel] != 0 ? 0 : mask));
      });
    this->bitsChanged_ = true;
  }
}

void VisibilityLayers::markBit(int bit, const std::vector<std::uint32_t>& pixels)
{
  const std::uint8_t mark = maskOf(bit);
  std::uint8_t* const to = this->bitsOfPixels_.data() + byteOf(bit);
  visitBytes(this->bitsOfPixels_.size() / this->bytesOfPixel_, this->bytesOfPixel_,
    [=](std::size_t, std::size_t place) { to[place] &= static_cast<std::uint8_t>(~mark); });
  for (const std::uint32_t pixel : pixels)
  {
    to[pixel * this->bytesOfPixel_] |= mark;
  }
  this->bitsChanged_ = true;
}

bool VisibilityLayers::uploadBits()
{
  if (!std::exchange(this->bitsChanged_, false))
  {
    return false;
  }
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, this->textureOfBits_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const TexelFormat& format = formatOfBits(this->bits_).texel;
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, this->width_, this->height_, format.format, format.type,
    this->bitsOfPixels_.data());
  return true;
}

void VisibilityLayers::readBit(int bit, std::vector<float>& visibility) const
{
  const std::uint8_t lit = maskOf(bit);
  const std::uint8_t* const from = this->bitsOfPixels_.data() + byteOf(bit);
  visibility.resize(this->bitsOfPixels_.size() / this->bytesOfPixel_);
  visitBytes(visibility.size(), this->bytesOfPixel_,
    [from, lit, to = visibility.data()](std::size_t pixel, std::size_t place)
    { to[pixel] = (from[place] & lit) != 0 ? 1.0f : 0.0f; });
}

void VisibilityLayers::read(int layer, std::vector<float>& visibility) const
{
  const GlStateGuard guard;
  visibility.resize(this->pixels());
  GlFramebuffer framebuffer;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.create());
  glFramebufferTextureLayer(
    GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->texture_.name(), 0, layer);
  readFramebuffer(
    framebuffer.name(), glm::ivec2(0), { this->width_, this->height_ }, GL_RED, visibility.data());
}

std::size_t VisibilityLayers::bytes() const
{
  return this->pixels() *
    (static_cast<std::size_t>(this->layers_) * sizeof(float) + 2 * this->bytesOfPixel_);
}

} // namespace gnomon
