#include "shadowtech/base/GlState.h"

#include <cstddef>

namespace gnomon
{
namespace
{

void setEnabled(GLenum name, GLboolean enabled)
{
  enabled ? glEnable(name) : glDisable(name);
}

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

//------------------------------------------------------------------------------
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
  glGetIntegerv(GL_CURRENT_PROGRAM, &this->program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &this->vertexArray_);
  glGetIntegerv(GL_ARRAY_BUFFER_BINDING, &this->arrayBuffer_);
  glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &this->packBuffer_);
  glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &this->unpackBuffer_);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->drawFramebuffer_);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &this->readFramebuffer_);
  glGetIntegerv(GL_RENDERBUFFER_BINDING, &this->renderbuffer_);
  glGetIntegerv(GL_VIEWPORT, this->viewport_);
  glGetIntegerv(GL_SCISSOR_BOX, this->scissor_);
  glGetIntegerv(GL_BLEND_EQUATION_RGB, &this->blendEquationRgb_);
  glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &this->blendEquationAlpha_);
  glGetIntegerv(GL_BLEND_SRC_RGB, &this->blendSourceRgb_);
  glGetIntegerv(GL_BLEND_DST_RGB, &this->blendDestinationRgb_);
  glGetIntegerv(GL_BLEND_SRC_ALPHA, &this->blendSourceAlpha_);
  glGetIntegerv(GL_BLEND_DST_ALPHA, &this->blendDestinationAlpha_);
  glGetIntegerv(GL_DEPTH_FUNC, &this->depthFunction_);
  glGetIntegerv(GL_LOGIC_OP_MODE, &this->logicOperation_);
  glGetIntegerv(GL_CULL_FACE_MODE, &this->cullFace_);
  glGetIntegerv(GL_FRONT_FACE, &this->frontFace_);
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
  glGetIntegerv(GL_ACTIVE_TEXTURE, &this->activeTexture_);
  for (int unit = 0; unit < textureUnits; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &this->texture2D_[static_cast<std::size_t>(unit)]);
    glGetIntegerv(
      GL_TEXTURE_BINDING_2D_ARRAY, &this->texture2DArray_[static_cast<std::size_t>(unit)]);
  }
}

//------------------------------------------------------------------------------
GlStateGuard::~GlStateGuard()
{
  for (int unit = 0; unit < textureUnits; ++unit)
  {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    bindAgain(GL_TEXTURE_2D, this->texture2D_[static_cast<std::size_t>(unit)]);
    bindAgain(GL_TEXTURE_2D_ARRAY, this->texture2DArray_[static_cast<std::size_t>(unit)]);
  }
  glActiveTexture(static_cast<GLenum>(this->activeTexture_));
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
  glFrontFace(static_cast<GLenum>(this->frontFace_));
  glCullFace(static_cast<GLenum>(this->cullFace_));
  glLogicOp(static_cast<GLenum>(this->logicOperation_));
  glDepthFunc(static_cast<GLenum>(this->depthFunction_));
  glBlendEquationSeparate(
    static_cast<GLenum>(this->blendEquationRgb_), static_cast<GLenum>(this->blendEquationAlpha_));
  glBlendFuncSeparate(static_cast<GLenum>(this->blendSourceRgb_),
    static_cast<GLenum>(this->blendDestinationRgb_), static_cast<GLenum>(this->blendSourceAlpha_),
    static_cast<GLenum>(this->blendDestinationAlpha_));
  glScissor(this->scissor_[0], this->scissor_[1], this->scissor_[2], this->scissor_[3]);
  glViewport(this->viewport_[0], this->viewport_[1], this->viewport_[2], this->viewport_[3]);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(this->readFramebuffer_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(this->drawFramebuffer_));
  glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(this->renderbuffer_));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(this->unpackBuffer_));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(this->packBuffer_));
  glBindVertexArray(static_cast<GLuint>(this->vertexArray_));
  glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(this->arrayBuffer_));
  glUseProgram(static_cast<GLuint>(this->program_));
  for (std::size_t i = 0; i < this->blend_.size(); ++i)
  {
    this->blend_[i] ? glEnablei(GL_BLEND, static_cast<GLuint>(i))
                    : glDisablei(GL_BLEND, static_cast<GLuint>(i));
  }
  for (std::size_t i = 0; i < switches_.size(); ++i)
  {
    setEnabled(switches_[i], this->enabled_[i]);
  }
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
void readDepths(
  GLuint framebuffer, const glm::ivec2& origin, const glm::ivec2& size, std::vector<float>& depths)
{
  depths.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  readFramebuffer(framebuffer, origin, size, GL_DEPTH_COMPONENT, depths.data());
}

//------------------------------------------------------------------------------
void readTexture(GLuint texture, GLenum format, GLenum type, void* texels)
{
  const GlStateGuard guard;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  beginReading();
  glGetTexImage(GL_TEXTURE_2D, 0, format, type, texels);
}

//------------------------------------------------------------------------------
StorageBindingsGuard::StorageBindingsGuard()
{
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &this->general_);
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &this->indexed_);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 0, &this->start_);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 0, &this->size_);
}

//------------------------------------------------------------------------------
StorageBindingsGuard::~StorageBindingsGuard()
{
  const auto indexed = static_cast<GLuint>(this->indexed_);
  this->size_ > 0 ? glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, indexed,
                      static_cast<GLintptr>(this->start_), static_cast<GLsizeiptr>(this->size_))
                  : glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, indexed);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(this->general_));
}

} // namespace gnomon
