#pragma once

#include "lights/LightSpace.h"
#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace gnomon
{

/// Return a uniform view's map as scale and offset: texel = xy * across + zw.
inline glm::vec4 scaleAndOffset(const glm::dmat3& texelFromAcross)
{
  return { texelFromAcross[0].x, texelFromAcross[1].y, texelFromAcross[2].x, texelFromAcross[2].y };
}

/// Return the defines that light_views.glsl needs in front of it.
/// @param asksPixels true if the source asks how many texels a pixel covers
inline std::string lightViewsDefines(const ShadowLight& light, bool asksPixels = false)
{
  const ViewLayout layout = viewLayout(light);
  return glslDefine("VIEWS_SPOT_LIGHT", light.kind == LightKind::Spot) +
    glslDefine("VIEWS_BOX_LIGHT", light.box.has_value()) +
    glslDefine("VIEWS_PERSPECTIVE_LIGHT", light.kind != LightKind::Directional) +
    glslDefine("VIEWS_CUBE_LIGHT", layout == ViewLayout::Cube) +
    glslDefine("VIEWS_SPLITS_LIGHT", layout == ViewLayout::Splits) +
    glslDefine("VIEWS_BLENDED_LIGHT", layout == ViewLayout::Splits && light.splitBlend > 0.0) +
    glslDefine("SPLIT_BLEND_LIGHT", light.splitBlend) +
    glslDefine("VIEWS_WARPED_LIGHT", isWarped(light)) +
    glslDefine("VIEWS_FITTED_LIGHT", light.fittedToReceivers) +
    glslDefine("VIEWS_PIXELS_LIGHT", asksPixels) +
    glslDefine("VIEWS_CHOSEN_LIGHT", choosesWarp(light)) +
    glslDefine("VIEWS_LIGHT", mostViews(light));
}

/// Return the uniforms of light_views.glsl, including those that only other kinds of light use.
/// @param sizeTexels the side of the map's layers
/// @param viewFits the fits found on the GPU, if views await them (MapInput::viewFits)
inline std::vector<Uniform> lightViewsUniforms(const LightViews& views, int sizeTexels,
  const ReceiverSpace& space, const TextureBinding& viewFits = {})
{
  std::vector<Uniform> uniforms = { { "lightFromView_LIGHT",
                                      glm::mat4(views.lightFromCentred * space.centredFromView) },
    { "pixelSide_LIGHT", glm::vec2(space.pixelSide) },
    { "viewSize_LIGHT", static_cast<float>(views.views.empty() ? 0 : sizeTexels) },
    { "viewCount_LIGHT", static_cast<int>(views.views.size()) },
    { "viewBorder_LIGHT", static_cast<float>(views.borderTexels) },
    { "lightCone_LIGHT", static_cast<float>(views.coneTangentSquared) },
    { "lightBox_LIGHT", glm::vec3(views.box) } };
  if (views.awaitFit)
  {
    // Set the sampler even without a view and so without a fit. Otherwise it would keep the unit of
    // an earlier frame, which a sampler of another type may use in this one.
    uniforms.push_back({ "viewFits_LIGHT", TextureBinding{ GL_TEXTURE_2D, viewFits.texture } });
  }
  for (std::size_t i = 0; i < views.views.size(); ++i)
  {
    const LightView& view = views.views[i];
    const glm::dmat3 texels = texelFromAcross(view, sizeTexels);
    uniforms.push_back({ glslElement("viewTexels_LIGHT", i), scaleAndOffset(texels) });
    uniforms.push_back({ glslElement("texelFromAcross_LIGHT", i), glm::mat3(texels) });
    uniforms.push_back(
      { glslElement("acrossFromTexel_LIGHT", i), glm::mat3(glm::inverse(texels)) });
    uniforms.push_back(
      { glslElement("viewDepths_LIGHT", i), glm::vec2(view.depthScale, view.depthOffset) });
  }
  for (std::size_t face = 0; face < views.viewOfFace.size(); ++face)
  {
    uniforms.push_back({ glslElement("viewOfFace_LIGHT", face), views.viewOfFace[face] });
  }
  return uniforms;
}

/// Return the defines of light_reach.glsl, which select a light's bounds: SPOT or BOX.
inline std::vector<std::string> lightReachDefines(const ShadowLight& light)
{
  std::vector<std::string> defines;
  if (light.kind == LightKind::Spot)
  {
    defines.emplace_back("SPOT");
  }
  if (light.box)
  {
    defines.emplace_back("BOX");
  }
  return defines;
}

/// Return its uniforms, for points in the camera's view coordinates.
/// @param viewFromCentred of the camera, rigid
inline std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred)
{
  const glm::dmat4 lightFromView =
    lightFromCentred(light, centreWorld) * glm::inverse(viewFromCentred);
  const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
  const LightBox box = light.box.value_or(LightBox());
  return { { "lightFromView", glm::mat4(lightFromView) },
    { "lightCone", static_cast<float>(tangent * tangent) },
    { "lightBox", glm::vec3(0.5 * box.width, 0.5 * box.height, box.depth) } };
}

} // namespace gnomon
