#include "shadowtech/base/CasterDrawing.h"

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// Depths are compared with this slack, as a share of the map's depth range: four roundings of a
/// float (2^-24) in the transformations on either side, and as much again for the rasteriser.
constexpr float roundingSlack = 1.0f / (1 << 20);

/// And with this, as a share of the distance to the camera, which positions are rounded in proportion
/// to: eight roundings. So is the receiver's plane, in proportion to how far it is followed.
constexpr double distanceSlack = 1.0 / (1 << 21);

/// Whether casters may lie before the light's beginning.
bool begins(const LightView& view)
{
  return std::isfinite(view.beginsAt);
}

void useProgram(const LightView& view, const MapInput& input, const std::string& fragmentGlsl,
  const std::vector<std::string>& defines)
{
  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/casters.vert.glsl") },
      { GL_FRAGMENT_SHADER, fragmentGlsl } },
    defines);
  glUseProgram(program);
  ShaderLibrary::setUniform(program, { "clipFromCentred", glm::mat4(view.clipFromCentred()) });
  const glm::dvec4 distance = glm::row(view.rays.viewFromCentred, 2);
  glm::dvec4 depth = view.depthScale * distance;
  depth.w += view.depthOffset;
  ShaderLibrary::setUniform(program, { "depthFromCentred", glm::vec4(depth) });
  if (begins(view))
  {
    const glm::dvec4 behind = distance - glm::dvec4(0.0, 0.0, 0.0, view.beginsAt);
    ShaderLibrary::setUniform(program, { "beginFromCentred", glm::vec4(behind) });
  }
  if (view.warped())
  {
    const glm::dmat3 acrossFromTexel =
      glm::inverse(texelFromAcross(view, input.light.mapSizeTexels));
    ShaderLibrary::setUniform(program, { "texelScale", glm::vec3(glm::row(acrossFromTexel, 2)) });
  }
  ShaderLibrary::setUniform(program, { "cutoutMask", 0 });
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
void drawCasters(const LightView& view, const MapInput& input, const std::string& fragmentGlsl,
  std::vector<std::string> defines)
{
  if (view.rays.positional)
  {
    defines.emplace_back("PERSPECTIVE");
  }
  if (view.warped())
  {
    defines.emplace_back("WARPED");
  }
  if (begins(view))
  {
    defines.emplace_back("BEGINS");
  }
  begins(view) ? glEnable(GL_CLIP_DISTANCE0) : glDisable(GL_CLIP_DISTANCE0);
  useProgram(view, input, fragmentGlsl, defines);
  input.buffers.draw(view);
  if (input.buffers.hasCutouts())
  {
    defines.emplace_back("CUTOUT");
    useProgram(view, input, fragmentGlsl, defines);
    glActiveTexture(GL_TEXTURE0);
    input.buffers.drawCutouts(view);
  }
}

//------------------------------------------------------------------------------
Uniform depthSlacks(double followed)
{
  return { "depthSlacks_LIGHT", glm::vec2(roundingSlack, followed * distanceSlack) };
}

} // namespace gnomon
