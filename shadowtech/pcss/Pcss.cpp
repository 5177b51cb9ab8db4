#include "shadowtech/pcss/Pcss.h"

#include "lights/LightViews.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{
namespace
{

std::string refusedByPcss(const ShadowLight& light)
{
  return light.earlyOut == EarlyOut::Ring
    ? "'pcss' has no ring of points, as its points cover the whole light; its 'early_out' is "
      "exact or none"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Pcss::info()
{
  TechniqueInfo info;
  info.name = "pcss";
  info.bytesPerTexel = bytesPerTexelWithBounds;
  info.settings = { &viewSettings(), &pcssSettings(), &earlyOutSettings(), &depthMapSettings(),
    &publishedSettings() };
  info.refused = { refusedByPcss };
  info.isSlow = true;
  info.asPublished = "pcss_as_published";
  info.classes = classesOfMaps();
  info.classes.insert(info.classes.end(),
    { { "lit by the map's bounds", { 230, 230, 230 } },
      { "in shadow by the map's bounds", { 90, 90, 90 } },
      { "no blocker found", { 180, 200, 230 } } });
  return info;
}

//------------------------------------------------------------------------------
ShadowLight Pcss::lightOfMap(const ShadowLight& light) const
{
  ShadowLight seen = light;
  if (light.area && viewLayout(light) == ViewLayout::Cube)
  {
    seen.fit = ViewFit::Off;
  }
  return seen;
}

//------------------------------------------------------------------------------
MapReach Pcss::mapReach(const ShadowLight& light) const
{
  MapReach reach;
  reach.area = light.area.value_or(LightArea());
  return reach;
}

//------------------------------------------------------------------------------
void Pcss::bake(const MapInput& input)
{
  this->DepthMapTechnique::bake(input);
  this->bounds_.release();
  this->points_.release();
  if (input.light.area)
  {
    this->bakeBounds(this->bounds_, input.shaders);
    this->points_.upload(input.light.pcss.samples, input.light.area->shape);
  }
}

//------------------------------------------------------------------------------
std::size_t Pcss::bytesOfMaps() const
{
  return this->DepthMapTechnique::bytesOfMaps() + this->bounds_.bytes() + this->points_.bytes();
}

//------------------------------------------------------------------------------
std::vector<Uniform> Pcss::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
  if (this->bounds_)
  {
    uniforms.push_back(this->bounds_.uniform());
    uniforms.push_back(this->points_.uniform());
    const glm::dmat3 lightFromUnit =
      glm::dmat3(this->views().lightFromCentred) * this->reach().area.worldFromUnit;
    uniforms.push_back({ "lightFromUnit_LIGHT", glm::mat3(lightFromUnit) });
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string Pcss::estimatorGlsl(const ShadowLight& light) const
{
  if (!light.area)
  {
    return ShaderLibrary::source("shadowtech/depth_map/compare_estimator.glsl");
  }
  const std::string around =
    viewLayout(light) == ViewLayout::Cube ? "#define LOOKS_AROUND_LIGHT\n" : "";
  const bool asksBounds = light.earlyOut == EarlyOut::Exact && !measuresAlongRay(light);
  return around + glslDefine("PCSS_BALL_LIGHT", light.area->shape == LightArea::Shape::Ball) +
    glslDefine("PCSS_RECTANGLE_LIGHT", light.area->shape == LightArea::Shape::Rectangle) +
    pcssCountsDefines(light.pcss.samples) + glslDefine("PCSS_ASKS_BOUNDS_LIGHT", asksBounds) +
    ShaderLibrary::source("shadowtech/pcss/pcss_estimator.glsl");
}

} // namespace gnomon
