#include "shadowtech/transmittance/PointFilter.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
std::string FilteredTechnique::visibilityGlsl(const ShadowLight& light) const
{
  const bool isColoured = std::any_of(this->filters_.begin(), this->filters_.end(),
    [](const PointFilter* filter) { return filter->isColoured(); });
  std::string source = "#define visibility_LIGHT gnomonSurfaces_LIGHT\n" +
    this->surfaces_.visibilityGlsl(light) + "#undef visibility_LIGHT\n";
  std::string product = "gnomonSurfaces_LIGHT(positionView, normalView)";
  for (const PointFilter* const filter : this->filters_)
  {
    source += filter->glsl();
    product += " *\n    " + filter->name() + "(positionView, normalView)";
  }
  return source + (isColoured ? "vec3" : "float") +
    " visibility_LIGHT(vec3 positionView, vec3 normalView)\n{\n  return " + product + ";\n}\n";
}

//------------------------------------------------------------------------------
std::vector<Uniform> FilteredTechnique::uniforms(const ReceiverSpace& space) const
{
  std::vector<Uniform> uniforms = this->surfaces_.uniforms(space);
  for (const PointFilter* const filter : this->filters_)
  {
    const std::vector<Uniform> own = filter->uniforms(space);
    uniforms.insert(uniforms.end(), own.begin(), own.end());
  }
  return uniforms;
}

} // namespace gnomon
