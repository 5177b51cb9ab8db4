#include "shadowtech/depth_map/DepthMapTechnique.h"

#include "lights/CasterViews.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

#include <algorithm>

namespace gnomon
{
namespace
{

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
void drawView(const LightView& view, const MapReach& reach, const MapInput& input)
{
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
    defines = { "DEPTH_LINEAR", "PUSH", define("REACH_SQUARE", reach.squareTexels),
      define("REACH_DISC", reach.discTexels), define("DEEPEST", deepestPushed) };
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
  drawCasters(
    view, input, ShaderLibrary::source("shadowtech/depth_map/depth_map_bake.frag.glsl"), defines);
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

  beginCasters(this->framebuffer_.name(), this->sizeTexels_);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    glFramebufferTextureLayer(
      GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->map_.name(), 0, static_cast<GLint>(i));
    drawView(views[i], this->reach_, input);
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
  const double followed = this->reach_.largestTexels() / MapReach{}.largestTexels();
  uniforms.push_back(depthSlacks(followed));
  return uniforms;
}

} // namespace gnomon
