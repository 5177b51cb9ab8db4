#include "shadowtech/depth_map/DepthMapTechnique.h"

#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
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

/// Where depths end that are pushed back: in the middle of the room behind the casters.
constexpr double deepestPushed = 1.0 / (1.0 + 0.5 * roomBehindCasters);

/// Half the sum of a caster's slopes is never more than the larger one, which is what polygon offset
/// pushes by. That is twice what is asked for in the worst case, and costs nothing.
bool polygonOffsetServes(const LightView& view, const MapReach& reach)
{
  return view.depthIsAffine() && reach == MapReach{};
}

std::string define(const char* name, double value)
{
  return std::string(name) + " " + std::to_string(value);
}

/// Draws the casters into the bound framebuffer's depth, as one view sees them.
void drawView(std::size_t index, const MapReach& reach, const MapInput& input)
{
  const LightView& view = input.views.views[index];
  const float farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);

  std::vector<std::string> defines;
  if (polygonOffsetServes(view, reach))
  {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 0.0f);
  }
  else
  {
    defines = { "PUSH", define("REACH_SQUARE", reach.squareTexels),
      define("REACH_DISC", reach.discTexels), define("DEEPEST", deepestPushed) };
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
  if (view.rays.positional)
  {
    defines.emplace_back("PERSPECTIVE");
  }
  if (view.warped())
  {
    defines.emplace_back("WARPED");
  }
  const bool begins = std::isfinite(view.beginsAt);
  if (begins)
  {
    defines.emplace_back("BEGINS");
  }
  if (input.views.awaitFit)
  {
    defines.emplace_back("FITTED");
  }
  begins ? glEnable(GL_CLIP_DISTANCE0) : glDisable(GL_CLIP_DISTANCE0);
  // Rounding may push a caster over the edge of the depths, which bound all of them.
  glEnable(GL_DEPTH_CLAMP);
  const GLuint program = input.shaders.program(
    { { GL_VERTEX_SHADER, ShaderLibrary::source("shadowtech/depth_map/depth_map_bake.vert.glsl") },
      { GL_FRAGMENT_SHADER,
        ShaderLibrary::source("shadowtech/depth_map/depth_map_bake.frag.glsl") } },
    defines);
  glUseProgram(program);
  ShaderLibrary::setUniform(program, { "clipFromCentred", glm::mat4(view.clipFromCentred()) });
  const glm::dvec4 distance = glm::row(view.rays.viewFromCentred, 2);
  glm::dvec4 depth = view.depthScale * distance;
  depth.w += view.depthOffset;
  ShaderLibrary::setUniform(program, { "depthFromCentred", glm::vec4(depth) });
  if (begins)
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
  if (input.views.awaitFit)
  {
    ShaderLibrary::setUniforms(
      program, { { "viewFits", input.viewFits }, { "view", static_cast<int>(index) } }, 0, 0);
  }
  input.buffers.draw(view);
}

} // namespace

//------------------------------------------------------------------------------
void DepthMapTechnique::allocate(int sizeTexels, int layers)
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
void DepthMapTechnique::bake(const MapInput& input)
{
  const GlStateGuard guard;
  const std::vector<LightView>& views = input.views.views;
  // A light without a view still needs a texture to bind.
  this->allocate(input.light.mapSizeTexels, std::max(static_cast<int>(views.size()), 1));
  this->views_ = input.views;
  this->reach_ = this->mapReach(input.light);
  this->viewFits_ = input.viewFits;

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
    drawView(i, this->reach_, input);
  }
}

//------------------------------------------------------------------------------
std::size_t DepthMapTechnique::bytesOfMaps() const
{
  return static_cast<std::size_t>(this->layers_) * static_cast<std::size_t>(this->sizeTexels_) *
    static_cast<std::size_t>(this->sizeTexels_) * sizeof(float);
}

//------------------------------------------------------------------------------
std::string DepthMapTechnique::visibilityGlsl(const ShadowLight& light) const
{
  return lightViewsDefines(light) + this->estimatorGlsl(light);
}

//------------------------------------------------------------------------------
std::vector<Uniform> DepthMapTechnique::uniforms(const glm::dmat4& centredFromView) const
{
  std::vector<Uniform> uniforms =
    lightViewsUniforms(this->views_, this->sizeTexels_, centredFromView);
  uniforms.push_back(
    { "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->map_.name() } });
  if (this->views_.awaitFit)
  {
    uniforms.push_back({ "viewFits_LIGHT", this->viewFits_ });
  }
  const double followed = this->reach_.largestTexels() / MapReach{}.largestTexels();
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(roundingSlack, followed * distanceSlack) });
  return uniforms;
}

} // namespace gnomon
