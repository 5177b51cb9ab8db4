#pragma once

#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// The slack of depth comparisons, as a share of the map's depth range. It covers four roundings of
/// a float (2^-24) in the transformations on either side, and as much again for the rasteriser.
constexpr float roundingSlack = 1.0f / (1 << 20);

struct CasterShader
{
  std::string fragmentGlsl; ///< the source
  std::vector<std::string> defines;
  std::vector<Uniform> uniforms = {};
  bool backOnly = false; ///< draw only the far side of two-sided surfaces
};

/// How casters are projected into a picture: into a light's view, or as shadows onto a plane.
struct CasterPicture
{
  glm::dmat4 clipFromCentred{ 1.0 };
  /// Planes (n, d) in centred coordinates that clip away n.p + d < 0. At most two.
  std::vector<glm::dvec4> keptFromCentred;
  CasterSelection selection;
};

/// A second slack of depth comparisons, as a share of the distance to the camera, because positions
/// are rounded in proportion to it: eight roundings. It also covers the receiver's plane, in
/// proportion to how far it is followed.
inline constexpr double distanceSlack = 1.0 / (1 << 21);

/// The texture unit of the mask of holes; the shader's textures use the units after it.
inline constexpr int cutoutUnit = 0;

/// The most planes that clip casters (GlStateGuard).
inline constexpr GLenum mostClips = 2;

inline void useProgram(
  const CasterPicture& picture, ShaderLibrary& shaders, const CasterShader& shader)
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

/// Prepare OpenGL to draw casters into a framebuffer's layers of this size. The caller holds a
/// GlStateGuard.
inline void beginCasters(GLuint framebuffer, int sizeTexels)
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

/// Draw the casters into the attachments of the bound framebuffer. Casters with holes have their
/// own variant of the shader, so main() must end with discardHoles() (cutout.glsl).
inline void drawCasters(const CasterPicture& picture, const OccluderBuffers& buffers,
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

/// Draw the casters as a view sees them into the framebuffer's attachments.
///
/// The fragment shader decides what a texel holds. It is compiled with PERSPECTIVE or WARPED for
/// such views. If its defines have DEPTH_LINEAR, it reads the map's linear depth as `in float
/// depthLinear`; the depth buffer is linear only if LightView::depthIsAffine. caster_map.glsl gives
/// the fragment's place across the light. This function and caster_map.glsl apply the fit that was
/// found on the GPU (MapInput::viewFits), and the chosen warp.
///
/// @param number the view's index in MapInput::views
inline void drawCasters(std::size_t number, const MapInput& input, CasterShader shader)
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

/// Return the uniform of map_visibility.glsl with the rounding of compared depths.
/// @param followed how far a receiver's plane is followed, in units of the distance to its own
/// texel
inline Uniform depthSlacks(double followed = 1.0)
{
  return { "depthSlacks_LIGHT", glm::vec2(roundingSlack, followed * distanceSlack) };
}

} // namespace gnomon
