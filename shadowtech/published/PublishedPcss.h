#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

/// `pcss` exactly as in Apelles' listings (4.8 to 4.11; sections 3.4.1 and 4.1.3), to reproduce its
/// figures; `as_published` selects it. Let w be the light's width, z_r the receiver's distance from
/// the light's centre, and K x K the points of a step.
///
/// 1. Blocker search within w (1 + 1 / K). That is (z_r - z_n) / z_r w for a near plane z_n at the
///    light, where these maps' linear depths begin. Blockers are texels nearer than the receiver;
///    without any it is lit.
/// 2. Penumbra: w_p = (z_r - z_b) / z_b w, with z_b the blockers' mean distance.
/// 3. Filter within w_p (1 + 1 / K): the share of texels that are not nearer than the receiver.
///
/// docs/techniques/published.md shows the effects. The technique supports spot lights whose map is
/// a single view. Rectangles count as disks of their longer side. Lights without area get the hard
/// shadow of `compare`.
class PublishedPcss : public DepthMapTechnique
{
public:
  static TechniqueInfo info()
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

  MapReach mapReach(const ShadowLight& light) const override
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

  void bake(const MapInput& input) override
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

  std::size_t bytesOfMaps() const override
  {
    return this->DepthMapTechnique::bytesOfMaps() + this->points_.bytes();
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms = this->DepthMapTechnique::uniforms(space);
    if (this->widthLight_ > 0.0)
    {
      uniforms.push_back(this->points_.uniform());
      uniforms.push_back({ "widthLight_LIGHT", static_cast<float>(this->widthLight_) });
    }
    return uniforms;
  }

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override
  {
    if (!light.area)
    {
      return ShaderLibrary::source("shadowtech/depth_map/compare_estimator.glsl");
    }
    return pcssCountsDefines(light.pcss.samples) +
      ShaderLibrary::source("shadowtech/published/published_pcss_estimator.glsl");
  }

private:
  static std::string refusedByPublishedPcss(const ShadowLight& light)
  {
    const bool isMeasured =
      !light.area || (light.kind == LightKind::Spot && viewLayout(light) == ViewLayout::Single);
    return isMeasured ? ""
                      : "'pcss' as published measures in shares of a spot light's map, and this "
                        "light has none: its "
                        "'as_published' is for spot lights with a single view";
  }

  /// Return w; for rectangles the longer side.
  static double widthOf(const LightArea& area)
  {
    return 2.0 * std::max(glm::length(area.worldFromUnit[0]), glm::length(area.worldFromUnit[1]));
  }

  PcssPoints points_; ///< points of a disk
  double widthLight_ = 0.0;
};

} // namespace gnomon
