#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// Runs a fragment shader once for every pixel of an image. The caller holds a GlStateGuard.
class ScreenPass
{
public:
  /// Use and return the program of a fragment shader's source.
  static GLuint use(ShaderLibrary& shaders, const std::string& fragmentGlsl,
    const std::vector<std::string>& defines = {});
  /// Use and return a program with its own vertex shader, which places quads (fillQuads()).
  static GLuint use(ShaderLibrary& shaders, const std::string& vertexGlsl,
    const std::string& fragmentGlsl, const std::vector<std::string>& defines);

  struct Image
  {
    GLuint texture;
    int layer = -1; ///< of an array; negative: the texture is no array
    int level = 0;  ///< of an array with several
  };
  /// Draw the outputs of the program in use into images; image i gets output i.
  void fill(const std::vector<Image>& images, int width, int height);

  /// Draw into parts of images. The vertex shader of the program in use places four corners of each
  /// quad, in rows (gl_VertexID, gl_InstanceID).
  void fillQuads(const std::vector<Image>& images, int width, int height, int quads);

  /// Draw colours and depths (gl_FragDepth) of the program in use into a part of the bound
  /// framebuffer.
  void fillBound(const glm::ivec2& origin, const glm::ivec2& size);

  /// Disable all state that drops or changes fragments of outputs from 0 on, except the depth test.
  static void openState(GLuint outputs);

private:
  void attach(const std::vector<Image>& images, int width, int height);
  void draw(GLuint outputs);

  GlFramebuffer framebuffer_;
  GLuint attached_ = 0; ///< number of images
  GlVertexArray noAttributes_;
};

} // namespace gnomon
