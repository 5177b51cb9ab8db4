#include "shadowtech/nsm/Nsm.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Nsm::info()
{
  TechniqueInfo info;
  info.name = "nsm";
  info.summary = "hard: the plain shadow map, free of acne without a bias to tune";
  info.pointwise = true;
  info.needsMap = true;
  return info;
}

//------------------------------------------------------------------------------
std::string Nsm::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/nsm/nsm_estimator.glsl");
}

} // namespace gnomon
