#include "shadowtech/moment_map/Exponential.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <cmath>

namespace gnomon
{
namespace
{

std::string refusedByExponential(const ShadowLight& light)
{
  return light.of<MomentMapSettings>().blur == MapBlur::Sat
    ? "'exponential' has moments beyond the range of the 32-bit integers that a summed-area table "
      "holds; it takes 'blur' box"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Exponential::info()
{
  TechniqueInfo info = infoOf("exponential");
  info.settings.push_back(&varianceSettings());
  info.refused = refusedByExponential;
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
