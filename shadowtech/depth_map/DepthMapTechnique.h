#pragma once

#include "lights/CasterViews.h"
#include "lights/KernelShape.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/TextureMemory.h"
#include "shadowtech/depth_map/DepthBounds.h"

#include <algorithm>

namespace gnomon
{

class DepthBounds;

/// True if a light's depth maps hold distances along the ray, which are not linear across the
/// light.
inline bool measuresAlongRay(const ShadowLight& light)
{
  return light.kind != LightKind::Directional && light.depthMap.metric == DepthMetric::Euclidean;
}

/// The base of techniques with a plain shadow map: one layer of linear depth per view of the light.
/// A technique adds an estimator: GLSL that defines
///     float estimate_LIGHT(ViewPoint point, float slack)
/// for a point that the light reaches and a view sees (map_visibility.glsl). It also states how far
/// around the point it reads the map (mapReach()).
///
/// No bias is tuned. Let p be the receiver and c the centre of a texel that is read, both on the
/// map, with |c - p| within the reach. Depths are compared at c (depth_map.glsl). The receiver's
/// depth there is the nearer of its plane's depth at c and the point's own depth. So the surface
/// baked at c shadows the receiver unless it lies behind one of the two.
///
/// So no plane shadows itself, nor does a convex surface. In a concave corner c may lie on a
/// neighbour that rises towards the light. So the map is pushed back by the most that a caster's
/// depth changes over the reach. docs/theory/depth_maps.md derives that, also for perspective and
/// warps.
///
/// - Neighbours that end within the reach are not accounted for: the flat top of a step is not
///   pushed back, and darkens what lies below it within the reach.
/// - For the same reason a shadow begins at most the reach away from the contact with its caster,
///   if the receiver does not rise towards the light on the shadow's side.
/// - Pushed depths end behind all casters, but before the depth of texels without any: a caster
///   along the rays has an infinite slope, and a plane in perspective may extend past the light's
///   axis.
class DepthMapTechnique : public PointwiseTechnique
{
public:
  void bake(const MapInput& input) override
  {
    const GlStateGuard guard;
    const std::vector<LightView>& views = input.views.views;
    // A light without a view still needs a texture to bind.
    allocateDepths(
      this->map_, input.light.mapSizeTexels, std::max(static_cast<int>(views.size()), 1));
    glBindFramebuffer(GL_FRAMEBUFFER, this->framebuffer_.create());
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    this->views_ = input.views;
    this->viewFits_ = input.viewFits;
    this->reach_ = this->mapReach(input.light);

    beginCasters(this->framebuffer_.name(), this->map_.width());
    if (input.light.depthMap.surface == DepthSurface::Midpoint)
    {
      this->bakeMidpoints(input);
      return;
    }
    Layer layer;
    if (input.light.depthMap.surface == DepthSurface::Second)
    {
      layer.push = 0.0; // faces away from the light, so it cannot shadow itself
      layer.backOnly = true;
    }
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      drawInto(this->map_, i);
      drawView(i, this->reach_, layer, input);
    }
  }

  std::size_t bytesOfMaps() const override { return this->map_.bytes(); }

  ///@{
  /// For TechniqueInfo::bytesPerTexel: return the bytes of depths, alone and with their bounds
  /// (DepthBounds.h).
  static double bytesPerTexel(const ShadowLight& light)
  {
    return static_cast<double>(sizeof(float)) * mostViews(light);
  }

  static double bytesPerTexelWithBounds(const ShadowLight& light)
  {
    constexpr double levels = 4.0 / 3.0; // each has a quarter as many texels
    return bytesPerTexel(light) + levels * sizeof(glm::vec2) * mostViews(light);
  }

  ///@}
  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    return lightViewsDefines(light) + glslDefine("MAP_EUCLIDEAN_LIGHT", measuresAlongRay(light)) +
      this->estimatorGlsl(light);
  }

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms =
      lightViewsUniforms(this->views_, this->map_.width(), space, this->viewFits_);
    uniforms.push_back(
      { "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, this->map_.name() } });
    const double followed =
      this->reach_.largestTexels(mostTexelsAcross(this->views_, this->map_.width())) /
      MapReach{}.largestTexels();
    uniforms.push_back(depthSlacks(followed));
    for (std::size_t i = 0; i < this->views_.views.size(); ++i)
    {
      const double scale = 1.0 / longestRay(this->views_.views[i]);
      uniforms.push_back(
        { "rayScale_LIGHT[" + std::to_string(i) + "]", static_cast<float>(scale) });
    }
    uniforms.push_back(kernelUnit(this->reach_));
    return uniforms;
  }

protected:
  const SizedTexture& map() const { return this->map_; }
  const LightViews& views() const { return this->views_; }
  const MapReach& reach() const { return this->reach_; }
  void bakeBounds(DepthBounds& bounds, ShaderLibrary& shaders) const
  {
    bounds.bake(this->map_.name(), this->map_.width(), this->map_.layers(), shaders);
  }

  /// Return the estimator's source. It includes depth_map.glsl.
  virtual std::string estimatorGlsl(const ShadowLight& light) const = 0;

private:
  /// The deepest pushed depth: the middle of the room behind the casters.
  static constexpr double deepestPushed = 1.0 / (1.0 + 0.5 * roomBehindCasters);

  /// How one layer of depth is baked.
  struct Layer
  {
    double push = 1.0; ///< in units of the reach's span
    bool backOnly = false;
    GLuint frontDepths = 0; ///< draw only what lies behind this map; 0: draw all
  };

  /// True if polygon offset can push the map. It pushes by the larger one of a caster's slopes, and
  /// half their sum is never more than that. So it pushes by up to twice what is needed, at no
  /// cost.
  static bool polygonOffsetServes(const LightView& view, const MapReach& reach)
  {
    return view.depthIsAffine() && reach.squareTexels == MapReach().squareTexels &&
      reach.discTexels == 0.0 && !reach.hasKernel();
  }

  static std::string define(const char* name, double value)
  {
    return std::string(name) + " " + glslNumber(value);
  }

  /// Return the defines of the fragment shader for a layer whose depth the shader writes.
  static std::vector<std::string> writingDefines(
    const MapReach& reach, const Layer& layer, const ShadowLight& light)
  {
    std::vector<std::string> defines = { "DEPTH_LINEAR", "WRITES_DEPTH",
      define("PUSH", layer.push + light.depthMap.biasSlope), define("DEEPEST", deepestPushed),
      define("REACH_SQUARE", reach.squareTexels), define("REACH_DISC", reach.discTexels) };
    if (measuresAlongRay(light))
    {
      defines.emplace_back("EUCLIDEAN");
    }
    if (reach.hasKernel())
    {
      const bool across = reach.unitAcross > 0.0;
      defines.emplace_back("KERNEL");
      defines.emplace_back(across ? "KERNEL_ACROSS" : "KERNEL_EVEN");
      defines.push_back(define("KERNEL_UNIT", across ? reach.unitAcross : reach.largestStretch));
      defines.push_back(define("KERNEL_SQUARE", reach.kernelSquare));
      defines.push_back(define("KERNEL_DISC", reach.kernelDisc));
    }
    if (layer.frontDepths)
    {
      defines.push_back(define("BEHIND", static_cast<double>(roundingSlack)));
    }
    return defines;
  }

  /// Bake the casters into the bound framebuffer's depth, as one view sees them.
  static void drawView(
    std::size_t number, const MapReach& reach, const Layer& layer, const MapInput& input)
  {
    const LightView& view = input.views.views[number];
    const ShadowLight& light = input.light;
    const float farthest = 1.0f;
    glClearBufferfv(GL_DEPTH, 0, &farthest);

    const bool biased = light.depthMap.biasConstant > 0.0 || light.depthMap.biasSlope > 0.0;
    std::vector<std::string> defines;
    glDisable(GL_POLYGON_OFFSET_FILL);
    if (layer.push == 1.0 && !biased && polygonOffsetServes(view, reach))
    {
      glEnable(GL_POLYGON_OFFSET_FILL);
      glPolygonOffset(1.0f, 0.0f);
    }
    else
    {
      defines = writingDefines(reach, layer, light);
    }
    constexpr double deepest = 2.0; // pushes all out of the map
    const double bias = light.depthMap.biasConstant / light.unitWorld * view.depthScale;
    std::vector<Uniform> uniforms = { { "bias", static_cast<float>(std::min(bias, deepest)) },
      { "rayScale", static_cast<float>(1.0 / longestRay(view)) },
      { "frontLayer", static_cast<int>(number) } };
    if (layer.frontDepths)
    {
      uniforms.push_back(
        { "frontDepths", TextureBinding{ GL_TEXTURE_2D_ARRAY, layer.frontDepths } });
    }
    drawCasters(number, input,
      { ShaderLibrary::source("shadowtech/depth_map/depth_map_bake.frag.glsl"), defines, uniforms,
        layer.backOnly });
  }

  static void allocateDepths(SizedTexture& texture, int sizeTexels, int layers)
  {
    if (texture.allocateMap({ GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1 }, sizeTexels, layers))
    {
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    }
  }

  static void drawInto(const GlTexture& depths, std::size_t layer)
  {
    glFramebufferTextureLayer(
      GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths.name(), 0, static_cast<GLint>(layer));
  }

  /// Bake the first surface, the surface behind it, and the pushed first one. Where there are two
  /// surfaces, draw their midpoint over the pushed first one.
  void bakeMidpoints(const MapInput& input)
  {
    SizedTexture front;
    SizedTexture back;
    const int layers = static_cast<int>(input.views.views.size());
    if (layers == 0)
    {
      return;
    }
    allocateDepths(front, this->map_.width(), layers);
    allocateDepths(back, this->map_.width(), layers);
    for (std::size_t i = 0; i < input.views.views.size(); ++i)
    {
      Layer unpushed;
      unpushed.push = 0.0;
      drawInto(front, i);
      drawView(i, this->reach_, unpushed, input);
      unpushed.frontDepths = front.name();
      drawInto(back, i);
      drawView(i, this->reach_, unpushed, input);
      drawInto(this->map_, i);
      drawView(i, this->reach_, {}, input);

      const GLuint program = ScreenPass::use(
        input.shaders, ShaderLibrary::source("shadowtech/depth_map/depth_map_between.frag.glsl"));
      ShaderLibrary::setUniforms(program,
        { { "frontDepths", TextureBinding{ GL_TEXTURE_2D_ARRAY, front.name() } },
          { "backDepths", TextureBinding{ GL_TEXTURE_2D_ARRAY, back.name() } },
          { "layer", static_cast<int>(i) } },
        0, 0);
      glDisable(GL_POLYGON_OFFSET_FILL);
      glDisable(GL_CLIP_DISTANCE0);
      glDepthFunc(GL_ALWAYS);
      glDrawArrays(GL_TRIANGLES, 0, 3);
      glDepthFunc(GL_LESS);
    }
  }

  SizedTexture map_;
  GlFramebuffer framebuffer_;
  LightViews views_;        ///< as baked
  MapReach reach_;          ///< as baked
  TextureBinding viewFits_; ///< as baked
};

} // namespace gnomon
