#include "shadowtech/base/LightViewsGlsl.h"

namespace gnomon
{
namespace
{

std::string define(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

std::string element(const std::string& name, std::size_t index)
{
  return name + "[" + std::to_string(index) + "]";
}

/// Of uniform views, whose map is a scale and an offset: texel = xy * across + zw.
glm::vec4 scaleAndOffset(const glm::dmat3& texelFromAcross)
{
  return { texelFromAcross[0].x, texelFromAcross[1].y, texelFromAcross[2].x, texelFromAcross[2].y };
}

} // namespace

//------------------------------------------------------------------------------
std::string lightViewsDefines(const ShadowLight& light)
{
  const ViewLayout layout = viewLayout(light);
  return define("VIEWS_SPOT_LIGHT", light.kind == LightKind::Spot) +
    define("VIEWS_BOX_LIGHT", light.box.has_value()) +
    define("VIEWS_PERSPECTIVE_LIGHT", light.kind != LightKind::Directional) +
    define("VIEWS_CUBE_LIGHT", layout == ViewLayout::Cube) +
    define("VIEWS_SPLITS_LIGHT", layout == ViewLayout::Splits) +
    define("VIEWS_BLENDED_LIGHT", layout == ViewLayout::Splits && light.splitBlend > 0.0) +
    "#define SPLIT_BLEND_LIGHT float(" + findSetting("split_blend")->get(light) + ")\n" +
    define("VIEWS_WARPED_LIGHT", isWarped(light)) +
    define("VIEWS_FITTED_LIGHT", light.fittedToReceivers) +
    define("VIEWS_PIXELS_LIGHT", light.mipMaps) + define("VIEWS_CHOSEN_LIGHT", choosesWarp(light)) +
    define("VIEWS_LIGHT", mostViews(light));
}

//------------------------------------------------------------------------------
std::vector<Uniform> lightViewsUniforms(const LightViews& views, int sizeTexels,
  const ReceiverSpace& space, const TextureBinding& viewFits)
{
  std::vector<Uniform> uniforms = { { "lightFromView_LIGHT",
                                      glm::mat4(views.lightFromCentred * space.centredFromView) },
    { "pixelSide_LIGHT", glm::vec2(space.pixelSide) },
    { "viewSize_LIGHT", static_cast<float>(views.views.empty() ? 0 : sizeTexels) },
    { "viewCount_LIGHT", static_cast<int>(views.views.size()) },
    { "viewBorder_LIGHT", static_cast<float>(views.borderTexels) },
    { "lightCone_LIGHT", static_cast<float>(views.coneTangentSquared) },
    { "lightBox_LIGHT", glm::vec3(views.box) } };
  if (viewFits.texture)
  {
    uniforms.push_back({ "viewFits_LIGHT", viewFits });
  }
  for (std::size_t i = 0; i < views.views.size(); ++i)
  {
    const LightView& view = views.views[i];
    const glm::dmat3 texels = texelFromAcross(view, sizeTexels);
    uniforms.push_back({ element("viewTexels_LIGHT", i), scaleAndOffset(texels) });
    uniforms.push_back({ element("texelFromAcross_LIGHT", i), glm::mat3(texels) });
    uniforms.push_back({ element("acrossFromTexel_LIGHT", i), glm::mat3(glm::inverse(texels)) });
    uniforms.push_back(
      { element("viewDepths_LIGHT", i), glm::vec2(view.depthScale, view.depthOffset) });
  }
  for (std::size_t face = 0; face < views.viewOfFace.size(); ++face)
  {
    uniforms.push_back({ element("viewOfFace_LIGHT", face), views.viewOfFace[face] });
  }
  return uniforms;
}

} // namespace gnomon
