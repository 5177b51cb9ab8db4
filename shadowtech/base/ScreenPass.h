#pragma once

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// Calls a fragment shader once for every pixel of an image. A GlStateGuard is the caller's
/// business.
class ScreenPass
{
public:
  /// The program of a fragment shader's source, made the one in use.
  static GLuint use(ShaderLibrary& shaders, const std::string& fragmentGlsl,
    const std::vector<std::string>& defines = {});
  /// The same with a vertex shader that places quads (fillQuads()).
  static GLuint use(ShaderLibrary& shaders, const std::string& vertexGlsl,
    const std::string& fragmentGlsl, const std::vector<std::string>& defines);

  struct Image
  {
    GLuint texture;
    int layer = -1; ///< of an array; negative for a texture that is none
    int level = 0;  ///< of an array with several
  };
  /// Fills images with the outputs of the program in use, each with the one at its place.
  void fill(const std::vector<Image>& images, int width, int height);

  /// Fills parts of images: the vertex shader of the program in use places four corners of each
  /// quad, in rows (gl_VertexID, gl_InstanceID).
  void fillQuads(const std::vector<Image>& images, int width, int height, int quads);

  /// Fills a part of the framebuffer that is bound with the colours and depths (gl_FragDepth) that
  /// the program in use gives.
  void fillBound(const glm::ivec2& origin, const glm::ivec2& size);

  /// Has every fragment reach its pixels as it is, of outputs from 0 on; the depth test is apart.
  static void openState(GLuint outputs);

private:
  void attach(const std::vector<Image>& images, int width, int height);
  void draw(GLuint outputs);

  GlFramebuffer framebuffer_;
  GLuint attached_ = 0; ///< images of the framebuffer
  GlVertexArray noAttributes_;
};

} // namespace gnomon
