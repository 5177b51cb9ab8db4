#include "shadowtech/moment_map/SingleExponential.h"

#include "shadowtech/base/ShaderLibrary.h"

#include <cmath>

namespace gnomon
{
namespace
{

std::string refusedBySingleExponential(const ShadowLight& light)
{
  return light.of<MomentMapSettings>().blur == MapBlur::Sat
    ? "'single_exponential' has a moment beyond the range of the 32-bit integers that a "
      "summed-area "
      "table holds; it takes 'blur' box"
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo SingleExponential::info()
{
  TechniqueInfo info = infoOf("single_exponential");
  info.refused = refusedBySingleExponential;
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
