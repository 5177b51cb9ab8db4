#include "shadowtech/variance/Variance.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Variance::info()
{
  return infoOf("variance");
}

//------------------------------------------------------------------------------
MomentMapTechnique::Moments Variance::moments() const
{
  return { 2, ShaderLibrary::source("shadowtech/variance/variance_moments.glsl"), glm::vec4(1.0f) };
}

//------------------------------------------------------------------------------
std::string Variance::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/variance/variance_estimator.glsl");
}

} // namespace gnomon
