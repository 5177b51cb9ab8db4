#pragma once

#include "shadowtech/base/Technique.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{

/// Casters that let a part of a light through, as shaders see them at points (RayFilter.h).
class PointFilter
{
public:
  virtual ~PointFilter() = default;

  /// True if the share has three channels.
  virtual bool isColoured() const = 0;
  /// Return the name of the function that glsl() defines.
  virtual std::string name() const = 0;
  /// Return the source that defines
  ///     float NAME(vec3 positionView, vec3 normalView)
  /// in GLSL 1.50, the share of the light that the casters leave at a point, and its uniforms. The
  /// function of a coloured filter returns a vec3. The normal has any length but 0.
  virtual std::string glsl() const = 0;
  /// Return the uniforms of that source, for points in a camera's view coordinates.
  virtual std::vector<Uniform> uniforms(const ReceiverSpace& space) const = 0;
};

/// A technique whose light filters take their share of. With a coloured filter its visibility is a
/// vec3.
class FilteredTechnique : public PointwiseTechnique
{
public:
  /// @param surfaces, filters must outlive this
  FilteredTechnique(const PointwiseTechnique& surfaces, std::vector<const PointFilter*> filters)
    : surfaces_(surfaces)
    , filters_(std::move(filters))
  {
  }
  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    const bool isColoured = std::any_of(this->filters_.begin(), this->filters_.end(),
      [](const PointFilter* filter) { return filter->isColoured(); });
    std::string source = "#define visibility_LIGHT gnomonSurfaces_LIGHT\n"
                         "#define visibilityAt_LIGHT gnomonSurfacesAt_LIGHT\n" +
      this->surfaces_.visibilityGlsl(light) +
      "#undef visibility_LIGHT\n#undef visibilityAt_LIGHT\n";
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

  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override
  {
    std::vector<Uniform> uniforms = this->surfaces_.uniforms(space);
    for (const PointFilter* const filter : this->filters_)
    {
      const std::vector<Uniform> own = filter->uniforms(space);
      uniforms.insert(uniforms.end(), own.begin(), own.end());
    }
    return uniforms;
  }

private:
  const PointwiseTechnique& surfaces_;
  std::vector<const PointFilter*> filters_;
};

} // namespace gnomon
