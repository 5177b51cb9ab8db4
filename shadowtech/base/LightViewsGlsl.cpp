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

/// texel = (clip / w * 0.5 + 0.5) * size; all projections scale x and y apart. The offset stands in
/// the last column of an affine projection and in the third, over w = z, of a perspective one.
glm::dvec4 texelsOf(const LightView& view, int sizeTexels)
{
  const double half = 0.5 * sizeTexels;
  const glm::dmat4& clip = view.clipFromView;
  const glm::dvec2 offset = view.perspective ? glm::dvec2(clip[2]) : glm::dvec2(clip[3]);
  return { half * clip[0][0], half * clip[1][1], half * (offset.x + 1.0), half * (offset.y + 1.0) };
}

} // namespace

//------------------------------------------------------------------------------
std::string lightViewsDefines(const ShadowLight& light)
{
  const bool cube = viewLayout(light) == ViewLayout::Cube;
  return define("VIEWS_SPOT_LIGHT", light.kind == LightKind::Spot) +
    define("VIEWS_BOX_LIGHT", light.box.has_value()) +
    define("VIEWS_PERSPECTIVE_LIGHT", light.kind != LightKind::Directional) +
    define("VIEWS_CUBE_LIGHT", cube) + define("VIEWS_LIGHT", cube ? cubeFaces : 1);
}

//------------------------------------------------------------------------------
std::vector<Uniform> lightViewsUniforms(
  const LightViews& views, int sizeTexels, const glm::dmat4& centredFromView)
{
  std::vector<Uniform> uniforms = { { "lightFromView_LIGHT",
                                      glm::mat4(views.lightFromCentred * centredFromView) },
    { "viewSize_LIGHT", static_cast<float>(views.views.empty() ? 0 : sizeTexels) },
    { "lightCone_LIGHT", static_cast<float>(views.coneTangentSquared) },
    { "lightBox_LIGHT", glm::vec3(views.box) } };
  for (std::size_t i = 0; i < views.views.size(); ++i)
  {
    const LightView& view = views.views[i];
    uniforms.push_back({ element("viewTexels_LIGHT", i), glm::vec4(texelsOf(view, sizeTexels)) });
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
