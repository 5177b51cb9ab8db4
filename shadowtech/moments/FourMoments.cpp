#include "shadowtech/moments/FourMoments.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo FourMoments::info()
{
  return infoOf("moments");
}

//------------------------------------------------------------------------------
MomentMapTechnique::Moments FourMoments::moments() const
{
  return { 4, ShaderLibrary::source("shadowtech/moments/four_moments.glsl"), glm::vec4(1.0f) };
}

//------------------------------------------------------------------------------
std::string FourMoments::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/moments/moments_estimator.glsl");
}

} // namespace gnomon
