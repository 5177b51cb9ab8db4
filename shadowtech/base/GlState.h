#pragma once

#include "shadowtech/base/Gl.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace gnomon
{

/// Saves the OpenGL state that Gnomon's own drawing changes, and restores it at the end of its
/// scope. So VTK's copy of that state (vtkOpenGLState) stays true and need not be updated.
class GlStateGuard
{
public:
  GlStateGuard();
  ~GlStateGuard();
  GlStateGuard& operator=(GlStateGuard&&) = delete; ///< nor copied

  /// The number of texture units whose 2D and 2D array bindings are restored.
  static constexpr int textureUnits = 12;

private:
  static GLuint stateOf(GLenum name);

  static constexpr std::array<GLenum, 12> switches_ = { GL_DEPTH_TEST, GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE1, GL_COLOR_LOGIC_OP, GL_SCISSOR_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL,
    GL_DEPTH_CLAMP, GL_STENCIL_TEST, GL_MULTISAMPLE, GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_FRAMEBUFFER_SRGB };
  std::array<GLboolean, switches_.size()> enabled_;
  std::array<GLboolean, 5> blend_;
  GLuint program_ = stateOf(GL_CURRENT_PROGRAM);
  GLuint vertexArray_ = stateOf(GL_VERTEX_ARRAY_BINDING);
  GLuint arrayBuffer_ = stateOf(GL_ARRAY_BUFFER_BINDING);
  GLuint packBuffer_ = stateOf(GL_PIXEL_PACK_BUFFER_BINDING);
  GLuint unpackBuffer_ = stateOf(GL_PIXEL_UNPACK_BUFFER_BINDING);
  GLuint drawFramebuffer_ = stateOf(GL_DRAW_FRAMEBUFFER_BINDING);
  GLuint readFramebuffer_ = stateOf(GL_READ_FRAMEBUFFER_BINDING);
  GLuint renderbuffer_ = stateOf(GL_RENDERBUFFER_BINDING);
  GLenum activeTexture_ = stateOf(GL_ACTIVE_TEXTURE);
  GLenum blendEquationRgb_ = stateOf(GL_BLEND_EQUATION_RGB);
  GLenum blendEquationAlpha_ = stateOf(GL_BLEND_EQUATION_ALPHA);
  GLenum blendSourceRgb_ = stateOf(GL_BLEND_SRC_RGB);
  GLenum blendDestinationRgb_ = stateOf(GL_BLEND_DST_RGB);
  GLenum blendSourceAlpha_ = stateOf(GL_BLEND_SRC_ALPHA);
  GLenum blendDestinationAlpha_ = stateOf(GL_BLEND_DST_ALPHA);
  GLenum depthFunction_ = stateOf(GL_DEPTH_FUNC);
  GLenum logicOperation_ = stateOf(GL_LOGIC_OP_MODE);
  GLenum cullFace_ = stateOf(GL_CULL_FACE_MODE);
  GLenum frontFace_ = stateOf(GL_FRONT_FACE);
  GLint viewport_[4], scissor_[4], polygonMode_[2];
  GLint packAlignment_, unpackAlignment_;
  /// Where pixels lie in memory. While the guard lives, they lie side by side.
  static constexpr std::array<GLenum, 6> pixelStores_ = { GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_ROWS, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS };
  std::array<GLint, pixelStores_.size()> pixelStore_;
  GLfloat offsetFactor_, offsetUnits_;
  GLboolean depthMask_, colorMask_[4];
  std::array<GLint, textureUnits> texture2D_, texture2DArray_;
};

/// Read floats of a part of a framebuffer: window depths, or channels of its first attachment.
/// @param format GL_DEPTH_COMPONENT, or the channels' format
/// @param floats as many per pixel as the format has
void readFramebuffer(GLuint framebuffer, const glm::ivec2& origin, const glm::ivec2& size,
  GLenum format, void* floats);

/// Read window depths of a part of a framebuffer, one per pixel.
void readDepths(
  GLuint framebuffer, const glm::ivec2& origin, const glm::ivec2& size, std::vector<float>& depths);

/// Read the texels of a 2D texture's first level, side by side.
/// @param format, type of the values, as glGetTexImage takes them
void readTexture(GLuint texture, GLenum format, GLenum type, void* texels);

/// Saves the first indexed binding of shader storage buffers and the general one, and restores them
/// at the end of its scope.
class StorageBindingsGuard
{
public:
  StorageBindingsGuard();
  ~StorageBindingsGuard();
  StorageBindingsGuard& operator=(StorageBindingsGuard&&) = delete; ///< nor copied

private:
  GLint general_ = 0, indexed_ = 0;
  GLint64 start_ = 0, size_ = 0; ///< of the indexed one; 0: all of it
};

} // namespace gnomon
