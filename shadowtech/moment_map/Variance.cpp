#include "shadowtech/moment_map/Variance.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Variance::info()
{
  TechniqueInfo info = infoOf("variance");
  info.settings.push_back(&varianceSettings());
  return info;
}

//------------------------------------------------------------------------------
MomentMapTechnique::Moments Variance::moments() const
{
  return { 2, ShaderLibrary::source("shadowtech/moment_map/variance_moments.glsl"), glm::vec4(1.0f),
    { 1.0f, 2.0f, 1.0f, 1.0f } };
}

//------------------------------------------------------------------------------
std::string Variance::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/moment_map/variance_estimator.glsl");
}

} // namespace gnomon
