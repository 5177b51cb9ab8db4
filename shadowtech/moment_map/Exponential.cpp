#include "shadowtech/moment_map/Exponential.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <cmath>

namespace gnomon
{
//------------------------------------------------------------------------------
TechniqueInfo Exponential::info()
{
  TechniqueInfo info = infoOf("exponential");
  info.settings.push_back(&varianceSettings());
  info.refused = refusedSums;
  return info;
}

//------------------------------------------------------------------------------
MomentMapTechnique::Moments Exponential::moments() const
{
  const double positive = std::exp(exponentPositive);
  const double negative = -std::exp(-exponentNegative);
  return { 4, ShaderLibrary::source("shadowtech/moment_map/exponential_moments.glsl"),
    glm::vec4(positive, positive * positive, negative, negative * negative), glm::vec4(0.0f) };
}

//------------------------------------------------------------------------------
std::string Exponential::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/moment_map/exponential_estimator.glsl");
}

} // namespace gnomon
