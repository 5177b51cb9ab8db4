#include "shadowtech/nsm/Nsm.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>

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

/// Draws the casters into the bound framebuffer's depth, as one view sees them.
void drawView(const LightView& view, const MapInput& input)
{
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
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(slopePush, 0.0f);
    // Where no caster can be nearer than the bounds, rounding may still push one over the edge.
    view.beginsAtNear ? glDisable(GL_DEPTH_CLAMP) : glEnable(GL_DEPTH_CLAMP);
  }
  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/nsm/nsm_bake.vert.glsl") },
      { GL_FRAGMENT_SHADER, ShaderLibrary::source("shadowtech/nsm/nsm_bake.frag.glsl") } },
    defines);
  glUseProgram(program);
  ShaderLibrary::setUniform(program, { "clipFromCentred", glm::mat4(view.clipFromCentred()) });
  if (view.perspective)
  {
    glm::dvec4 depth = view.depthScale * glm::row(view.viewFromCentred, 2);
    depth.w += view.depthOffset;
    ShaderLibrary::setUniform(program, { "depthFromCentred", glm::vec4(depth) });
  }
  input.buffers.draw(view);
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
void Nsm::allocate(int sizeTexels, int layers)
{
  if (this->sizeTexels_ == sizeTexels && this->layers_ == layers)
  {
    return;
  }
  this->sizeTexels_ = 0; // in case that there is no memory
  this->layers_ = 0;
  allocateMap(this->map_, { GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 }, sizeTexels, layers);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  this->sizeTexels_ = sizeTexels;
  this->layers_ = layers;
}

//------------------------------------------------------------------------------
void Nsm::bake(const MapInput& input)
{
  const GlStateGuard guard;
  const std::vector<LightView>& views = input.views.views;
  // A light without a view still needs a texture to bind.
  this->allocate(input.light.mapSizeTexels, std::max(static_cast<int>(views.size()), 1));
  this->views_ = input.views;

  glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.name());
  glViewport(0, 0, this->sizeTexels_, this->sizeTexels_);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    glFramebufferTextureLayer(
      GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->map_.name(), 0, static_cast<GLint>(i));
    drawView(views[i], input);
  }
}

//------------------------------------------------------------------------------
std::size_t Nsm::bytesOfMaps() const
{
  return static_cast<std::size_t>(this->layers_) * static_cast<std::size_t>(this->sizeTexels_) *
    static_cast<std::size_t>(this->sizeTexels_) * sizeof(float);
}

//------------------------------------------------------------------------------
std::string Nsm::visibilityGlsl(const ShadowLight& light) const
{
  return lightViewsDefines(light) + ShaderLibrary::source("shadowtech/nsm/nsm_visibility.glsl");
}

//------------------------------------------------------------------------------
std::vector<Uniform> Nsm::uniforms(const glm::dmat4& centredFromView) const
{
  std::vector<Uniform> uniforms =
    lightViewsUniforms(this->views_, this->sizeTexels_, centredFromView);
  uniforms.push_back({ "nsmMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->map_.name() } });
  uniforms.push_back({ "nsmSlack_LIGHT", roundingSlack });
  return uniforms;
}

} // namespace gnomon
