#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/DepthMapTechnique.h"
#include "shadowtech/depth_map/PcssPoints.h"

namespace gnomon
{

/// `pcss`: percentage closer soft shadows of area lights from one map, as seen by the light's
/// centre (Fernando 2005; Apelles, section 3.4.1).
///
/// All widths are metric, by similar triangles. Let L be a point of the light, relative to its
/// centre and in its plane. Let r be the receiver's distance from the light, and z that of a caster
/// that hides L from the receiver. The caster lies away from the receiver, across the light, by
///     L s,   s = 1 / z - 1 / r   in slopes of a positional light's rays,
///            s = r - z           of a directional light, where L are tangents of angles.
/// s is the caster's *separation*. So one kernel, the light's own shape, serves both steps and all
/// projections. The map's Jacobian at the receiver converts it to texels.
///
/// In a cube the light is seen in three dimensions from its middle. Separations there are r times
/// those above. They are separations of directions
///     P + L s,   s = r / z - 1,
/// from the receiver P at s = 0 towards L, each on the face that sees it (light_around.glsl).
///
/// 1. Blocker search: tests `pcss_samples` points of the light at the largest separation S of a
///    caster around, and the receiver's own texel. S comes from the map's pyramid of depths
///    (DepthBounds.h). Blockers are texels in front of the receiver's plane, between it and some
///    point of the light: L S = L' s for an L' of the light.
/// 2. Penumbra: the least of the blockers' separations, and their mean over the map. If no blocker
///    is found, the filter's points search, too.
/// 3. Filter: the share of the light whose points find texels that hide the receiver. Points are
///    looked up at the least separation, and at the mean if that differs. A caster found at another
///    separation hides another point. So the point is looked up again at that separation, a few
///    times at most.
///
/// docs/techniques/pcss.md gives the reasons. Lights without area get the hard shadow of `compare`.
class Pcss : public DepthMapTechnique
{
public:
  static TechniqueInfo info()
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

  /// Return a light whose cube has all faces, none fitted to receivers. Rays around an area light
  /// cross to other faces.
  ShadowLight lightOfMap(const ShadowLight& light) const override
  {
    ShadowLight seen = light;
    if (light.area && viewLayout(light) == ViewLayout::Cube)
    {
      seen.fit = ViewFit::Off;
    }
    return seen;
  }

  MapReach mapReach(const ShadowLight& light) const override
  {
    MapReach reach;
    reach.area = light.area.value_or(LightArea());
    return reach;
  }

  void bake(const MapInput& input) override
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

  std::size_t bytesOfMaps() const override
  {
    return this->DepthMapTechnique::bytesOfMaps() + this->bounds_.bytes() + this->points_.bytes();
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
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

protected:
  std::string estimatorGlsl(const ShadowLight& light) const override
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

private:
  static std::string refusedByPcss(const ShadowLight& light)
  {
    return light.earlyOut == EarlyOut::Ring
      ? "'pcss' has no ring of points, as its points cover the whole light; its 'early_out' is "
        "exact or none"
      : "";
  }

  DepthBounds bounds_; ///< empty for lights without area
  PcssPoints points_;  ///< points of the light's shape
};

} // namespace gnomon
