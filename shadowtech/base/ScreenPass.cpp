#include "shadowtech/base/ScreenPass.h"

namespace gnomon
{

GLuint ScreenPass::use(
  ShaderLibrary& shaders, const std::string& fragmentGlsl, const std::vector<std::string>& defines)
{
  return use(shaders, ShaderLibrary::source("shadowtech/base/screen_visibility.vert.glsl"),
    fragmentGlsl, defines);
}

GLuint ScreenPass::use(ShaderLibrary& shaders, const std::string& vertexGlsl,
  const std::string& fragmentGlsl, const std::vector<std::string>& defines)
{
  const GLuint program = shaders.program(
    { { GL_VERTEX_SHADER, vertexGlsl }, { GL_FRAGMENT_SHADER, fragmentGlsl } }, defines);
  glUseProgram(program);
  return program;
}

void ScreenPass::attach(const std::vector<Image>& images, int width, int height)
{
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->framebuffer_.create());
  std::vector<GLenum> buffers;
  for (const Image& image : images)
  {
    buffers.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size()));
    if (image.layer < 0)
    {
      glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, buffers.back(), GL_TEXTURE_2D, image.texture, 0);
    }
    else
    {
      glFramebufferTextureLayer(
        GL_DRAW_FRAMEBUFFER, buffers.back(), image.texture, image.level, image.layer);
    }
  }
  // Detach the surplus images of earlier calls.
  const auto outputs = static_cast<GLuint>(buffers.size());
  for (GLuint i = outputs; i < this->attached_; ++i)
  {
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + i, GL_TEXTURE_2D, 0, 0);
  }
  this->attached_ = outputs;
  glDrawBuffers(static_cast<GLsizei>(outputs), buffers.data());
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
}

void ScreenPass::fill(const std::vector<Image>& images, int width, int height)
{
  this->attach(images, width, height);
  this->draw(static_cast<GLuint>(images.size()));
}

void ScreenPass::fillQuads(const std::vector<Image>& images, int width, int height, int quads)
{
  this->attach(images, width, height);
  openState(static_cast<GLuint>(images.size()));
  glBindVertexArray(this->noAttributes_.create());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, quads);
}

void ScreenPass::fillBound(const glm::ivec2& origin, const glm::ivec2& size)
{
  glViewport(origin.x, origin.y, size.x, size.y);
  glEnable(GL_DEPTH_TEST); // without the test OpenGL writes no depths
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  this->draw(1);
}

void ScreenPass::openState(GLuint outputs)
{
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_COLOR_LOGIC_OP);
  for (GLenum i = 0; i < 2; ++i) // the planes that may clip casters
  {
    glDisable(GL_CLIP_DISTANCE0 + i);
  }
  for (GLuint i = 0; i < outputs; ++i)
  {
    glDisablei(GL_BLEND, i);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void ScreenPass::draw(GLuint outputs)
{
  openState(outputs);
  glBindVertexArray(this->noAttributes_.create());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace gnomon
