#include "shadowtech/base/GlState.h"

#include <cstddef>

namespace gnomon
{
namespace
{

/// Rebind a texture, unless it was deleted meanwhile, which unbinds it for good.
void bindAgain(GLenum target, GLint texture)
{
  const auto name = static_cast<GLuint>(texture);
  glBindTexture(target, glIsTexture(name) ? name : 0);
}

/// Prepare to read an image to the processor's memory.
void beginReading()
{
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  // Reading should wait for what draws the image. But llvmpipe (Mesa 22.3) at times returns what
  // the image held before.
  glFinish();
}

} // namespace

GLuint GlStateGuard::stateOf(GLenum name)
{
  GLint value = 0;
  glGetIntegerv(name, &value);
  return static_cast<GLuint>(value);
}

GlStateGuard::GlStateGuard()
{
  for (std::size_t i = 0; i < switches_.size(); ++i)
  {
    this->enabled_[i] = glIsEnabled(switches_[i]);
  }
  for (std::size_t i = 0; i < this->blend_.size(); ++i)
  {
    this->blend_[i] = glIsEnabledi(GL_BLEND, static_cast<GLuint>(i));
  }
  glGetIntegerv(GL_VIEWPORT, this->viewport_);
  glGetIntegerv(GL_SCISSOR_BOX, this->scissor_);
  glGetIntegerv(GL_POLYGON_MODE, this->polygonMode_);
  glGetIntegerv(GL_PACK_ALIGNMENT, &this->packAlignment_);
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &this->unpackAlignment_);
  for (std::size_t i = 0; i < pixelStores_.size(); ++i)
  {
    glGetIntegerv(pixelStores_[i], &this->pixelStore_[i]);
    glPixelStorei(pixelStores_[i], 0);
  }
  glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &this->offsetFactor_);
  glGetFloatv(GL_POLYGON_OFFSET_UNITS, &this->offsetUnits_);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &this->depthMask_);
  glGetBooleanv(GL_COLOR_WRITEMASK, this->colorMask_);
  for (int unit = 0; unit < textureUnits; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &this->texture2D_[static_cast<std::size_t>(unit)]);
    glGetIntegerv(
      GL_TEXTURE_BINDING_2D_ARRAY, &this->texture2DArray_[static_cast<std::size_t>(unit)]);
  }
}

GlStateGuard::~GlStateGuard()
{
  for (int unit = 0; unit < textureUnits; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    bindAgain(GL_TEXTURE_2D, this->texture2D_[static_cast<std::size_t>(unit)]);
    bindAgain(GL_TEXTURE_2D_ARRAY, this->texture2DArray_[static_cast<std::size_t>(unit)]);
  }
  glActiveTexture(this->activeTexture_);
  glColorMask(this->colorMask_[0], this->colorMask_[1], this->colorMask_[2], this->colorMask_[3]);
  glDepthMask(this->depthMask_);
  glPolygonOffset(this->offsetFactor_, this->offsetUnits_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, this->unpackAlignment_);
  glPixelStorei(GL_PACK_ALIGNMENT, this->packAlignment_);
  for (std::size_t i = 0; i < pixelStores_.size(); ++i)
  {
    glPixelStorei(pixelStores_[i], this->pixelStore_[i]);
  }
  glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(this->polygonMode_[0]));
  glFrontFace(this->frontFace_);
  glCullFace(this->cullFace_);
  glLogicOp(this->logicOperation_);
  glDepthFunc(this->depthFunction_);
  glBlendEquationSeparate(this->blendEquationRgb_, this->blendEquationAlpha_);
  glBlendFuncSeparate(this->blendSourceRgb_, this->blendDestinationRgb_, this->blendSourceAlpha_,
    this->blendDestinationAlpha_);
  glScissor(this->scissor_[0], this->scissor_[1], this->scissor_[2], this->scissor_[3]);
  glViewport(this->viewport_[0], this->viewport_[1], this->viewport_[2], this->viewport_[3]);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, this->readFramebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->drawFramebuffer_);
  glBindRenderbuffer(GL_RENDERBUFFER, this->renderbuffer_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, this->unpackBuffer_);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, this->packBuffer_);
  glBindVertexArray(this->vertexArray_);
  glBindBuffer(GL_ARRAY_BUFFER, this->arrayBuffer_);
  glUseProgram(this->program_);
  for (std::size_t i = 0; i < this->blend_.size(); ++i)
  {
    this->blend_[i] ? glEnablei(GL_BLEND, static_cast<GLuint>(i))
                    : glDisablei(GL_BLEND, static_cast<GLuint>(i));
  }
  for (std::size_t i = 0; i < switches_.size(); ++i)
  {
    this->enabled_[i] ? glEnable(switches_[i]) : glDisable(switches_[i]);
  }
}

void readFramebuffer(
  GLuint framebuffer, const glm::ivec2& origin, const glm::ivec2& size, GLenum format, void* floats)
{
  const GlStateGuard guard;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  if (format != GL_DEPTH_COMPONENT)
  {
    glReadBuffer(GL_COLOR_ATTACHMENT0);
  }
  beginReading();
  glReadPixels(origin.x, origin.y, size.x, size.y, format, GL_FLOAT, floats);
}

void readDepths(
  GLuint framebuffer, const glm::ivec2& origin, const glm::ivec2& size, std::vector<float>& depths)
{
  depths.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  readFramebuffer(framebuffer, origin, size, GL_DEPTH_COMPONENT, depths.data());
}

void readTexture(GLuint texture, GLenum format, GLenum type, void* texels)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  beginReading();
  glGetTexImage(GL_TEXTURE_2D, 0, format, type, texels);
}

StorageBindingsGuard::StorageBindingsGuard()
{
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &this->general_);
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &this->indexed_);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 0, &this->start_);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 0, &this->size_);
}

StorageBindingsGuard::~StorageBindingsGuard()
{
  const auto indexed = static_cast<GLuint>(this->indexed_);
  this->size_ > 0 ? glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, indexed,
                      static_cast<GLintptr>(this->start_), static_cast<GLsizeiptr>(this->size_))
                  : glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, indexed);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(this->general_));
}

} // namespace gnomon
