#include "shadowtech/moment_map/SingleExponential.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <cmath>

namespace gnomon
{
//------------------------------------------------------------------------------
TechniqueInfo SingleExponential::info()
{
  TechniqueInfo info = infoOf("single_exponential");
  info.refused = refusedSums;
  return info;
}

//------------------------------------------------------------------------------
MomentMapTechnique::Moments SingleExponential::moments() const
{
  return { 1, ShaderLibrary::source("shadowtech/moment_map/single_exponential_moments.glsl"),
    glm::vec4(std::exp(exponent), 0.0, 0.0, 0.0), glm::vec4(0.0f) };
}

//------------------------------------------------------------------------------
std::string SingleExponential::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/moment_map/single_exponential_estimator.glsl");
}

} // namespace gnomon
