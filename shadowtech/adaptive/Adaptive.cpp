#include "shadowtech/adaptive/Adaptive.h"

#include "shadowtech/adaptive/JitteredDiscs.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/TextureMemory.h"

namespace gnomon
{
namespace
{

bool readsBounds(const ShadowLight& light)
{
  return light.earlyOut == EarlyOut::Exact && !measuresAlongRay(light);
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Adaptive::info()
{
  TechniqueInfo info;
  info.name = "adaptive";
  info.bytesPerTexel = bytesPerTexelWithBounds;
  info.settings = { &viewSettings(), &kernelSettings(), &adaptiveSettings(), &earlyOutSettings(),
    &depthMapSettings() };
  info.kernel = "disc";
  return info;
}

//------------------------------------------------------------------------------
MapReach Adaptive::mapReach(const ShadowLight& light) const
{
  return kernelReach(light, { 0.5, 0.0, 0.5 * light.kernel.sizeTexels });
}

//------------------------------------------------------------------------------
void Adaptive::bake(const MapInput& input)
{
  this->DepthMapTechnique::bake(input);
  const GlStateGuard guard;
  this->bakeDiscs(input.light);
  this->bounds_.release();
  if (readsBounds(input.light))
  {
    this->bakeBounds(this->bounds_, input.shaders);
  }
}

//------------------------------------------------------------------------------
void Adaptive::bakeDiscs(const ShadowLight& light)
{
  if (this->discs_ && this->discGrid_ == light.adaptive.discGrid &&
    this->discSets_ == light.adaptive.discSets)
  {
    return;
  }
  const int points = light.adaptive.discGrid * light.adaptive.discGrid;
  const int discs = light.adaptive.discSets * light.adaptive.discSets;
  const std::vector<glm::vec2> byDisc = jitteredDiscs(light.adaptive.discGrid, discs);
  std::vector<glm::vec2> byPoint;
  byPoint.reserve(byDisc.size());
  for (int point = 0; point < points; ++point)
  {
    for (int disc = 0; disc < discs; ++disc)
    {
      byPoint.push_back(byDisc[static_cast<std::size_t>(disc * points + point)]);
    }
  }
  allocateTexture(this->discs_, { GL_RG32F, GL_RG, 2 }, light.adaptive.discSets,
    light.adaptive.discSets, points, "a table of discs");
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, light.adaptive.discSets, light.adaptive.discSets,
    points, GL_RG, GL_FLOAT, byPoint.data());
  this->discGrid_ = light.adaptive.discGrid;
  this->discSets_ = light.adaptive.discSets;
}

//------------------------------------------------------------------------------
std::size_t Adaptive::bytesOfMaps() const
{
  const auto points = static_cast<std::size_t>(this->discGrid_ * this->discGrid_);
  const auto discs = static_cast<std::size_t>(this->discSets_ * this->discSets_);
  return this->DepthMapTechnique::bytesOfMaps() + this->bounds_.bytes() +
    points * discs * sizeof(glm::vec2);
}

//------------------------------------------------------------------------------
std::vector<Uniform> Adaptive::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
  uniforms.push_back({ "discs_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->discs_.name() } });
  if (this->bounds_)
  {
    uniforms.push_back(this->bounds_.uniform());
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string Adaptive::estimatorGlsl(const ShadowLight& light) const
{
  return kernelDefines(light) + glslDefine("DISC_TEXELS_LIGHT", light.kernel.sizeTexels) +
    glslDefine("DISC_RING_LIGHT", light.adaptive.discGrid) +
    glslDefine("DISC_POINTS_LIGHT", light.adaptive.discGrid * light.adaptive.discGrid) +
    glslDefine("DISC_SETS_LIGHT", light.adaptive.discSets) +
    glslDefine("DISC_ASKS_RING_LIGHT", light.earlyOut == EarlyOut::Ring) +
    glslDefine("DISC_ASKS_BOUNDS_LIGHT", readsBounds(light)) +
    ShaderLibrary::source("shadowtech/adaptive/adaptive_estimator.glsl");
}

} // namespace gnomon
