#include "shadowtech/moment_map/FourMoments.h"

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
  return { 4, ShaderLibrary::source("shadowtech/moment_map/four_moments.glsl"), glm::vec4(1.0f),
    { 1.0f, 2.0f, 4.0f, 8.0f } };
}

//------------------------------------------------------------------------------
std::string FourMoments::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/moment_map/moments_estimator.glsl");
}

} // namespace gnomon
