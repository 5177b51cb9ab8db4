#include "shadowtech/nsm/Nsm.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// How far the map is pushed back, in the larger of a caster's two depth slopes per texel. Nsm.h
/// asks for half of their sum, which this is never less than.
constexpr float slopePush = 1.0f;

/// Depths are compared with this slack, as a share of the map's depth range: four roundings of a
/// float (2^-24) in the transformations on either side, and as much again for the rasteriser.
constexpr float roundingSlack = 1.0f / (1 << 20);

/// What the estimator needs to know of the light's view (nsm_visibility.glsl).
std::vector<Uniform> describe(const ShadowLight& light, const LightView& view, int sizeTexels,
  const TextureBinding& map, const glm::dmat4& centredFromView)
{
  // texel = (clip / w * 0.5 + 0.5) * size; both projections scale x and y apart. The offset stands
  // in the last column of an affine projection and in the third, over w = z, of a perspective one.
  const double half = 0.5 * sizeTexels;
  const glm::dmat4& clip = view.clipFromLight;
  const glm::dvec2 offset = view.perspective ? glm::dvec2(clip[2]) : glm::dvec2(clip[3]);
  const glm::dvec4 texels(
    half * clip[0][0], half * clip[1][1], half * (offset.x + 1.0), half * (offset.y + 1.0));
  std::vector<Uniform> uniforms = { { "nsmMap_LIGHT", map },
    { "nsmLightFromView_LIGHT", glm::mat4(view.lightFromCentred * centredFromView) },
    { "nsmTexels_LIGHT", glm::vec4(texels) },
    { "nsmDepth_LIGHT",
      glm::vec4(view.depthScale, view.depthOffset, roundingSlack, view.valid ? sizeTexels : 0) } };
  if (light.kind == LightKind::Spot)
  {
    const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
    uniforms.push_back({ "nsmCone_LIGHT", static_cast<float>(tangent * tangent) });
  }
  return uniforms;
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Nsm::info()
{
  TechniqueInfo info;
  info.name = "nsm";
  info.summary = "hard: the plain shadow map, free of acne without a bias to tune";
  info.pointwise = true;
  info.needsMap = true;
  return info;
}

//------------------------------------------------------------------------------
void Nsm::allocate(int sizeTexels)
{
  if (this->sizeTexels_ == sizeTexels)
  {
    return;
  }
  glBindTexture(GL_TEXTURE_2D, this->map_.create());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, sizeTexels, sizeTexels, 0,
    GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->map_.name(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  this->sizeTexels_ = sizeTexels;
}

//------------------------------------------------------------------------------
void Nsm::bake(const MapInput& input)
{
  const GlStateGuard guard;
  const LightView& view = input.view;
  this->allocate(input.light.mapSizeTexels);
  this->light_ = input.light;
  this->view_ = view;
  if (!view.valid)
  {
    return;
  }

  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
  glViewport(0, 0, this->sizeTexels_, this->sizeTexels_);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  const float farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);

  std::vector<std::string> defines;
  if (view.perspective)
  {
    defines = { "PERSPECTIVE", "SLOPE_PUSH " + std::to_string(slopePush) };
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
  else
  {
    // Casters nearer than the bounds cannot be, but rounding may push one over the edge.
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(slopePush, 0.0f);
  }
  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/nsm/nsm_bake.vert.glsl") },
      { GL_FRAGMENT_SHADER, ShaderLibrary::source("shadowtech/nsm/nsm_bake.frag.glsl") } },
    defines);
  glUseProgram(program);
  ShaderLibrary::setUniform(program, { "clipFromCentred", glm::mat4(view.clipFromCentred()) });
  if (view.perspective)
  {
    glm::dvec4 depth = view.depthScale * glm::row(view.lightFromCentred, 2);
    depth.w += view.depthOffset;
    ShaderLibrary::setUniform(program, { "depthFromCentred", glm::vec4(depth) });
  }
  input.buffers.draw();
}

//------------------------------------------------------------------------------
std::size_t Nsm::bytesOfMaps() const
{
  return static_cast<std::size_t>(this->sizeTexels_) * static_cast<std::size_t>(this->sizeTexels_) *
    sizeof(float);
}

//------------------------------------------------------------------------------
std::string Nsm::visibilityGlsl(const ShadowLight& light) const
{
  const std::string define =
    light.kind == LightKind::Spot ? "#define NSM_SPOT_LIGHT 1\n" : "#define NSM_SPOT_LIGHT 0\n";
  return define + ShaderLibrary::source("shadowtech/nsm/nsm_visibility.glsl");
}

//------------------------------------------------------------------------------
std::vector<Uniform> Nsm::uniforms(const glm::dmat4& centredFromView) const
{
  return describe(this->light_, this->view_, this->sizeTexels_,
    { GL_TEXTURE_2D, this->map_.name() }, centredFromView);
}

} // namespace gnomon
