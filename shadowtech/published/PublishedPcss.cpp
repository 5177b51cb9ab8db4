#include "shadowtech/published/PublishedPcss.h"

#include "lights/LightViews.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

std::string refusedByPublishedPcss(const ShadowLight& light)
{
  const bool isMeasured =
    !light.area || (light.kind == LightKind::Spot && viewLayout(light) == ViewLayout::Single);
  return isMeasured
    ? ""
    : "'pcss' as published measures in shares of a spot light's map, and this light has none: its "
      "'as_published' is for spot lights with a single view";
}

/// Return w; for rectangles the longer side.
double widthOf(const LightArea& area)
{
  return 2.0 * std::max(glm::length(area.worldFromUnit[0]), glm::length(area.worldFromUnit[1]));
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo PublishedPcss::info()
{
  TechniqueInfo info;
  info.name = "pcss_as_published";
  info.bytesPerTexel = bytesPerTexel;
  info.asPublished = info.name;
  info.settings = { &viewSettings(), &pcssSettings(), &depthMapSettings(), &publishedSettings() };
  info.refused = { refusedByPublishedPcss };
  info.isSlow = true;
  return info;
}

//------------------------------------------------------------------------------
MapReach PublishedPcss::mapReach(const ShadowLight& light) const
{
  MapReach reach;
  if (light.area)
  {
    // The search's largest radius, plus half of its step.
    const double step = 1.0 / std::sqrt(pcssCounts(light.pcss.samples).search);
    const double map = 2.0 * std::tan(glm::radians(light.coneAngleDegrees));
    reach.unbiasedAcross = widthOf(*light.area) * (1.0 + step) * map;
  }
  return reach;
}

//------------------------------------------------------------------------------
void PublishedPcss::bake(const MapInput& input)
{
  this->DepthMapTechnique::bake(input);
  this->points_.release();
  this->widthLight_ = 0.0;
  if (input.light.area)
  {
    this->points_.upload(input.light.pcss.samples, LightArea::Shape::Disk);
    this->widthLight_ = widthOf(*input.light.area);
  }
}

//------------------------------------------------------------------------------
std::size_t PublishedPcss::bytesOfMaps() const
{
  return this->DepthMapTechnique::bytesOfMaps() + this->points_.bytes();
}

//------------------------------------------------------------------------------
std::vector<Uniform> PublishedPcss::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
  if (this->widthLight_ > 0.0)
  {
    uniforms.push_back(this->points_.uniform());
    uniforms.push_back({ "widthLight_LIGHT", static_cast<float>(this->widthLight_) });
  }
  return uniforms;
}

//------------------------------------------------------------------------------
std::string PublishedPcss::estimatorGlsl(const ShadowLight& light) const
{
  if (!light.area)
  {
    return ShaderLibrary::source("shadowtech/depth_map/compare_estimator.glsl");
  }
  return pcssCountsDefines(light.pcss.samples) +
    ShaderLibrary::source("shadowtech/published/published_pcss_estimator.glsl");
}

} // namespace gnomon
