#include "shadowtech/base/CasterDrawing.h"

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>
#include <utility>

namespace gnomon
{
namespace
{

/// A second slack of depth comparisons, as a share of the distance to the camera, because positions
/// are rounded in proportion to it: eight roundings. It also covers the receiver's plane, in
/// proportion to how far it is followed.
constexpr double distanceSlack = 1.0 / (1 << 21);

/// The texture unit of the mask of holes; the shader's textures use the units after it.
constexpr int cutoutUnit = 0;

/// The most planes that clip casters (GlStateGuard).
constexpr GLenum mostClips = 2;

void useProgram(const CasterPicture& picture, ShaderLibrary& shaders, const CasterShader& shader)
{
  const GLuint program = shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/base/casters.vert.glsl") },
      { GL_FRAGMENT_SHADER, shader.fragmentGlsl } },
    shader.defines);
  glUseProgram(program);
  std::vector<Uniform> uniforms = { { "clipFromCentred", glm::mat4(picture.clipFromCentred) },
    { "cutoutMask", cutoutUnit } };
  for (std::size_t i = 0; i < picture.keptFromCentred.size(); ++i)
  {
    uniforms.push_back(
      { "keptFromCentred[" + std::to_string(i) + "]", glm::vec4(picture.keptFromCentred[i]) });
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
  ScreenPass::openState(1);
  glDisable(GL_MULTISAMPLE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  // Rounding may push a caster over the edge of the depths, which bound all of them.
  glEnable(GL_DEPTH_CLAMP);
}

//------------------------------------------------------------------------------
void drawCasters(const CasterPicture& picture, const OccluderBuffers& buffers,
  ShaderLibrary& shaders, CasterShader shader)
{
  const auto clips = static_cast<GLenum>(picture.keptFromCentred.size());
  for (GLenum i = 0; i < mostClips; ++i)
  {
    i < clips ? glEnable(GL_CLIP_DISTANCE0 + i) : glDisable(GL_CLIP_DISTANCE0 + i);
  }
  if (clips > 0)
  {
    shader.defines.emplace_back("CLIPS " + std::to_string(clips));
  }
  useProgram(picture, shaders, shader);
  buffers.draw(picture.selection);
  if (buffers.hasCutouts())
  {
    shader.defines.emplace_back("CUTOUT");
    useProgram(picture, shaders, shader);
    glActiveTexture(GL_TEXTURE0 + cutoutUnit);
    buffers.drawCutouts(picture.selection);
  }
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
  const glm::dvec4 distance = glm::row(view.rays.viewFromCentred, 2);
  CasterPicture picture;
  picture.clipFromCentred = view.clipFromCentred();
  picture.selection.maySee = [&view](const Bounds& centred) { return view.maySee(centred); };
  picture.selection.backOnly = shader.backOnly;
  if (std::isfinite(view.beginsAt)) // clip casters in front of the light's start
  {
    picture.keptFromCentred.push_back(distance - glm::dvec4(0.0, 0.0, 0.0, view.beginsAt));
  }
  if (input.keptFromCentred)
  {
    picture.keptFromCentred.push_back(*input.keptFromCentred);
  }
  if (input.views.awaitFit)
  {
    shader.defines.emplace_back("FITTED");
    shader.uniforms.push_back({ "viewFits", input.viewFits });
    shader.uniforms.push_back({ "view", static_cast<int>(number) });
  }
  if (!view.warps.empty())
  {
    shader.defines.emplace_back("CHOSEN");
  }
  glm::dvec4 depth = view.depthScale * distance;
  depth.w += view.depthOffset;
  const glm::dmat3 texels = texelFromAcross(view, input.light.mapSizeTexels);
  shader.uniforms.push_back({ "depthFromCentred", glm::vec4(depth) });
  shader.uniforms.push_back({ "texelFromAcross", glm::mat3(texels) });
  shader.uniforms.push_back({ "acrossFromTexel", glm::mat3(glm::inverse(texels)) });
  drawCasters(picture, input.buffers, input.shaders, std::move(shader));
}

//------------------------------------------------------------------------------
Uniform depthSlacks(double followed)
{
  return { "depthSlacks_LIGHT", glm::vec2(roundingSlack, followed * distanceSlack) };
}

} // namespace gnomon
