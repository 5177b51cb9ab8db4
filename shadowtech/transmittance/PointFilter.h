#pragma once

#include "shadowtech/base/Technique.h"

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
  std::string visibilityGlsl(const ShadowLight& light) const override;
  std::vector<Uniform> uniforms(const ReceiverSpace& space) const override;

private:
  const PointwiseTechnique& surfaces_;
  std::vector<const PointFilter*> filters_;
};

} // namespace gnomon
