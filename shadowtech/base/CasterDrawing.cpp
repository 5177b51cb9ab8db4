#include "shadowtech/base/CasterDrawing.h"

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// Depths are compared with this slack, too, as a share of the distance to the camera, which positions
/// are rounded in proportion to: eight roundings. So is the receiver's plane, in proportion to how far
/// it is followed.
constexpr double distanceSlack = 1.0 / (1 << 21);

/// The texture unit of a hole's mask; those behind it are the shader's.
constexpr int cutoutUnit = 0;

/// Whether casters may lie before the light's beginning.
bool begins(const LightView& view)
{
  return std::isfinite(view.beginsAt);
}

void useProgram(std::size_t number, const MapInput& input, const CasterShader& shader)
{
  const LightView& view = input.views.views[number];
  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/casters.vert.glsl") },
      { GL_FRAGMENT_SHADER, shader.fragmentGlsl } },
    shader.defines);
  glUseProgram(program);
  const glm::dvec4 distance = glm::row(view.rays.viewFromCentred, 2);
  glm::dvec4 depth = view.depthScale * distance;
  depth.w += view.depthOffset;
  const glm::dmat3 texels = texelFromAcross(view, input.light.mapSizeTexels);
  std::vector<Uniform> uniforms = { { "clipFromCentred", glm::mat4(view.clipFromCentred()) },
    { "depthFromCentred", glm::vec4(depth) }, { "texelFromAcross", glm::mat3(texels) },
    { "acrossFromTexel", glm::mat3(glm::inverse(texels)) }, { "cutoutMask", cutoutUnit } };
  if (begins(view))
  {
    const glm::dvec4 behind = distance - glm::dvec4(0.0, 0.0, 0.0, view.beginsAt);
    uniforms.push_back({ "beginFromCentred", glm::vec4(behind) });
  }
  if (input.views.awaitFit)
  {
    uniforms.push_back({ "viewFits", input.viewFits });
    uniforms.push_back({ "view", static_cast<int>(number) });
  }
  uniforms.insert(uniforms.end(), shader.uniforms.begin(), shader.uniforms.end());
  ShaderLibrary::setUniforms(program, uniforms, 0, cutoutUnit + 1);
}

} // namespace

//------------------------------------------------------------------------------
void beginCasters(GLuint framebuffer, int sizeTexels)
{
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, sizeTexels, sizeTexels);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  // Rounding may push a caster over the edge of the depths, which bound all of them.
  glEnable(GL_DEPTH_CLAMP);
}

//------------------------------------------------------------------------------
void drawCasters(std::size_t number, const MapInput& input, CasterShader shader)
{
  const LightView& view = input.views.views[number];
  if (view.rays.positional)
  {
    shader.defines.emplace_back("PERSPECTIVE");
  }
  if (view.warped())
  {
    shader.defines.emplace_back("WARPED");
  }
  if (begins(view))
  {
    shader.defines.emplace_back("BEGINS");
  }
  if (input.views.awaitFit)
  {
    shader.defines.emplace_back("FITTED");
  }
  begins(view) ? glEnable(GL_CLIP_DISTANCE0) : glDisable(GL_CLIP_DISTANCE0);
  useProgram(number, input, shader);
  input.buffers.draw(view, shader.backOnly);
  if (input.buffers.hasCutouts())
  {
    shader.defines.emplace_back("CUTOUT");
    useProgram(number, input, shader);
    glActiveTexture(GL_TEXTURE0 + cutoutUnit);
    input.buffers.drawCutouts(view, shader.backOnly);
  }
}

//------------------------------------------------------------------------------
Uniform depthSlacks(double followed)
{
  return { "depthSlacks_LIGHT", glm::vec2(roundingSlack, followed * distanceSlack) };
}

} // namespace gnomon
