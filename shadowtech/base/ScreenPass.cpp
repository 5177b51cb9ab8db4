#include "shadowtech/base/ScreenPass.h"

namespace gnomon
{

//------------------------------------------------------------------------------
GLuint ScreenPass::use(
  ShaderLibrary& shaders, const std::string& fragmentGlsl, const std::vector<std::string>& defines)
{
  const GLuint program = shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/screen_visibility.vert.glsl") },
      { GL_FRAGMENT_SHADER, fragmentGlsl } },
    defines);
  glUseProgram(program);
  return program;
}

//------------------------------------------------------------------------------
void ScreenPass::fill(GLuint texture, int layer, int width, int height)
{
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->framebuffer_.create());
  if (layer < 0)
  {
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  }
  else
  {
    glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0, layer);
  }
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  this->draw();
}

//------------------------------------------------------------------------------
void ScreenPass::fillBound(const glm::ivec2& origin, const glm::ivec2& size)
{
  glViewport(origin.x, origin.y, size.x, size.y);
  glEnable(GL_DEPTH_TEST); // without which no depth is written
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  this->draw();
}

//------------------------------------------------------------------------------
void ScreenPass::draw()
{
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_COLOR_LOGIC_OP);
  for (GLenum i = 0; i < 2; ++i) // what casters may be clipped by
  {
    glDisable(GL_CLIP_DISTANCE0 + i);
  }
  glDisablei(GL_BLEND, 0);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBindVertexArray(this->noAttributes_.create());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace gnomon
