#include "shadowtech/transmittance/PointFilter.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
std::string FilteredTechnique::visibilityGlsl(const ShadowLight& light) const
{
  const bool isColoured = std::any_of(this->filters_.begin(), this->filters_.end(),
    [](const PointFilter* filter) { return filter->isColoured(); });
  std::string source = "#define visibility_LIGHT gnomonSurfaces_LIGHT\n"
                       "#define visibilityAt_LIGHT gnomonSurfacesAt_LIGHT\n" +
    this->surfaces_.visibilityGlsl(light) + "#undef visibility_LIGHT\n#undef visibilityAt_LIGHT\n";
  std::string shares;
  for (const PointFilter* const filter : this->filters_)
  {
    source += filter->glsl();
    shares += " *\n    " + filter->name() + "(positionView, normalView)";
  }
  const std::string type = isColoured ? "vec3 " : "float ";
  return source + type + "visibility_LIGHT(vec3 positionView, vec3 normalView)\n{\n" +
    "  return gnomonSurfaces_LIGHT(positionView, normalView)" + shares + ";\n}\n" + type +
    "visibilityAt_LIGHT(vec3 positionView)\n{\n" +
    "  vec3 normalView = towardsLight_LIGHT(positionView);\n" +
    "  return gnomonSurfacesAt_LIGHT(positionView)" + shares + ";\n}\n";
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
