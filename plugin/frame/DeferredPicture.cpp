#include "plugin/frame/DeferredPicture.h"

#include "plugin/frame/FrameShaders.h"
#include "plugin/frame/ShadowedTiles.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>

namespace gnomon
{
namespace
{

constexpr std::array<GLenum, 3> outputs = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
  GL_COLOR_ATTACHMENT2 };

GLint ofAttachment(GLenum attachment, GLenum parameter)
{
  GLint value = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, parameter, &value);
  return value;
}

/// True if the picture's colours are plain 8-bit fixed-point numbers.
bool isEightBit()
{
  return ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE) == 8 &&
    ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE) == 8 &&
    ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_UNSIGNED_NORMALIZED &&
    ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_LINEAR;
}

void attachTo(GLenum target, GLenum attachment, GLuint texture)
{
  glFramebufferTexture2D(target, attachment, GL_TEXTURE_2D, texture, 0);
}

} // namespace

std::string DeferredPicture::whyUnsupported()
{
  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  GLint first = GL_NONE;
  GLint second = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER0, &first);
  glGetIntegerv(GL_DRAW_BUFFER1, &second);
  if (framebuffer == 0 || static_cast<GLenum>(first) != outputs[0])
  {
    return "the picture is not drawn into a framebuffer's first image";
  }
  if (second != GL_NONE || ofAttachment(outputs[1], GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) ||
    ofAttachment(outputs[2], GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE))
  {
    return "the framebuffer has more images than the picture";
  }
  return "";
}

void DeferredPicture::attach(bool withFragments, const std::optional<glm::vec4>& cleared)
{
  GLint viewport[4];
  glGetIntegerv(GL_VIEWPORT, viewport);
  this->origin_ = { viewport[0], viewport[1] };
  this->size_ = { viewport[2], viewport[3] };
  this->allocate(this->origin_ + this->size_, isEightBit());
  // Fragments may blend with the picture so far. To copy it waits until software OpenGL has drawn.
  const bool clears = cleared && this->eightBit_;
  if (!clears)
  {
    this->copyPicture();
  }

  attachTo(GL_DRAW_FRAMEBUFFER, outputs[1], withFragments ? this->fragments_.name() : 0);
  attachTo(GL_DRAW_FRAMEBUFFER, outputs[2], this->inShadow_.name());
  std::array<GLenum, 3> buffers = outputs;
  buffers[1] = withFragments ? outputs[1] : GL_NONE;
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  this->blending_ = glIsEnabledi(GL_BLEND, 1) == GL_TRUE;
  glDisablei(GL_BLEND, 1); // numbers, not colours
  const GlStateGuard guard;
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (withFragments)
  {
    const float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
    glClearBufferfv(GL_COLOR, 1, nothing);
  }
  if (clears)
  {
    glClearBufferfv(GL_COLOR, 2, &cleared->x);
  }
}

void DeferredPicture::allocate(const glm::ivec2& extent, bool eightBit)
{
  const bool isSameExtent = this->extent_ == extent;
  if (isSameExtent && this->eightBit_ == eightBit)
  {
    return;
  }
  const GlStateGuard guard;
  this->extent_ = glm::ivec2(0); // in case the allocation fails
  if (!isSameExtent)
  {
    allocateTexture(this->fragments_, { GL_RG32F, GL_RG, 2 }, extent.x, extent.y, 0,
      "the image of what pixels show");
  }
  const TexelFormat colours = eightBit ? TexelFormat{ GL_RGBA8, GL_RGBA, 4, GL_UNSIGNED_BYTE }
                                       : TexelFormat{ GL_RGBA32F, GL_RGBA, 4 };
  allocateTexture(this->inShadow_, colours, extent.x, extent.y, 0, "the colours in shadow");
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  attachTo(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->fragments_.name());
  attachTo(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, this->inShadow_.name());
  this->extent_ = extent;
  this->eightBit_ = eightBit;
}

/// Copy the picture so far into the colours in shadow.
void DeferredPicture::copyPicture() const
{
  const glm::ivec2& from = this->origin_;
  const glm::ivec2& to = this->extent_;
  if (this->eightBit_ && GNOMON_HAS_GL(VERSION_4_3))
  {
    // This copies bytes; software OpenGL would draw a blit.
    const bool isTexture =
      ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) == GL_TEXTURE;
    const auto picture =
      static_cast<GLuint>(ofAttachment(outputs[0], GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
    glCopyImageSubData(picture, isTexture ? GL_TEXTURE_2D : GL_RENDERBUFFER, 0, from.x, from.y, 0,
      this->inShadow_.name(), GL_TEXTURE_2D, 0, from.x, from.y, 0, this->size_.x, this->size_.y, 1);
    return;
  }
  const GlStateGuard guard;
  GLint picture = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &picture);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(picture));
  glReadBuffer(outputs[0]);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->framebuffer_.name());
  glDisable(GL_SCISSOR_TEST);
  const GLenum inShadow[] = { GL_NONE, GL_COLOR_ATTACHMENT1 };
  glDrawBuffers(2, inShadow);
  glBlitFramebuffer(
    from.x, from.y, to.x, to.y, from.x, from.y, to.x, to.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void DeferredPicture::detach()
{
  if (this->blending_)
  {
    glEnablei(GL_BLEND, 1);
  }
  attachTo(GL_DRAW_FRAMEBUFFER, outputs[1], 0);
  attachTo(GL_DRAW_FRAMEBUFFER, outputs[2], 0);
  glDrawBuffers(1, outputs.data());
}

void DeferredPicture::read(ReceiverImages& images) const
{
  images.width = this->size_.x;
  images.height = this->size_.y;
  images.fragments.resize(
    static_cast<std::size_t>(this->size_.x) * static_cast<std::size_t>(this->size_.y));
  readFramebuffer(
    this->framebuffer_.name(), this->origin_, this->size_, GL_RG, images.fragments.data());
}

void DeferredPicture::readDepths(std::vector<float>& depths) const
{
  GLint picture = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &picture);
  gnomon::readDepths(static_cast<GLuint>(picture), this->origin_, this->size_, depths);
}

void DeferredPicture::keepShadows(const std::vector<float>& visibility)
{
  const ShadowedTiles tiles = findShadowedTiles(visibility, this->size_);
  std::vector<glm::vec2> corners;
  for (const auto* kind : { &tiles.inPart, &tiles.whole })
  {
    for (const auto& [lower, upper] : *kind)
    {
      const glm::vec2 low(lower);
      const glm::vec2 high(upper);
      corners.insert(corners.end(), { low, { high.x, low.y }, high, low, high, { low.x, high.y } });
    }
  }
  this->cornersInPart_ = static_cast<GLsizei>(6 * tiles.inPart.size());
  this->cornersWhole_ = static_cast<GLsizei>(6 * tiles.whole.size());
  this->mixes_ = tiles.mixes;

  const GlStateGuard guard;
  if (this->mixes_)
  {
    this->uploadMixed(visibility);
  }
  glBindVertexArray(this->tiles_.create());
  glBindBuffer(GL_ARRAY_BUFFER, this->corners_.create());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec2)),
    corners.data(), GL_STREAM_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
}

/// Upload visibility for the mixture of colours. The caller holds a GlStateGuard.
void DeferredPicture::uploadMixed(const std::vector<float>& visibility)
{
  constexpr float fullLight = 65535.0f;
  std::vector<std::uint16_t> texels(visibility.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels.size(), 65536),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        texels[i] = static_cast<std::uint16_t>(visibility[i] * fullLight + 0.5f);
      }
    });
  glActiveTexture(GL_TEXTURE0);
  this->mixed_.allocate({ GL_R16, GL_RED, 1, GL_UNSIGNED_SHORT }, this->size_.x, this->size_.y, 0,
    "the visibility of pixels between light and shadow");
  glBindTexture(GL_TEXTURE_2D, this->mixed_.name());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(
    GL_TEXTURE_2D, 0, 0, 0, this->size_.x, this->size_.y, GL_RED, GL_UNSIGNED_SHORT, texels.data());
}

void DeferredPicture::darken(const TextureBinding& visibility, ShaderLibrary& shaders)
{
  const GlStateGuard guard;
  ScreenPass::openState(1);
  glViewport(this->origin_.x, this->origin_.y, this->size_.x, this->size_.y);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(this->tiles_.name());
  const auto draw = [&](std::vector<std::string> defines, GLint first, GLsizei count)
  {
    if (!this->mixes_ && visibility.target == GL_TEXTURE_2D)
    {
      defines.emplace_back("BIT");
    }
    const GLuint program = shaders.program(
      { { GL_VERTEX_SHADER, frameShaders().at("plugin/frame/shadowed_tiles.vert.glsl") },
        { GL_FRAGMENT_SHADER, frameShaders().at("plugin/frame/colour_in_shadow.frag.glsl") } },
      defines);
    glUseProgram(program);
    ShaderLibrary::setUniforms(program,
      { { "size", this->size_ }, { "origin", this->origin_ },
        { "visibility",
          this->mixes_ ? TextureBinding{ GL_TEXTURE_2D, this->mixed_.name() } : visibility },
        { "inShadow", TextureBinding{ GL_TEXTURE_2D, this->inShadow_.name() } } },
      0, 0);
    glDrawArrays(GL_TRIANGLES, first, count);
  };
  draw({}, this->cornersInPart_, this->cornersWhole_);
  if (!this->mixes_)
  {
    draw({ "SOME_ARE_LIT" }, 0, this->cornersInPart_);
    return;
  }
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  draw({ "SOME_ARE_LIT", "MIXES" }, 0, this->cornersInPart_);
}

std::size_t DeferredPicture::bytes() const
{
  // Fragments of two floats, and a colour.
  const std::size_t bytesOfPixel = 2 * sizeof(float) + 4 * (this->eightBit_ ? 1 : sizeof(float));
  return static_cast<std::size_t>(this->extent_.x) * static_cast<std::size_t>(this->extent_.y) *
    bytesOfPixel +
    this->mixed_.bytes();
}

} // namespace gnomon
