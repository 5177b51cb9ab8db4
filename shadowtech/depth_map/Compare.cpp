#include "shadowtech/depth_map/Compare.h"

#include "shadowtech/base/ShaderLibrary.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Compare::info()
{
  TechniqueInfo info;
  info.name = "compare";
  info.bytesPerTexel = bytesPerTexel;
  info.settings = { &viewSettings(), &depthMapSettings() };
  return info;
}

//------------------------------------------------------------------------------
std::string Compare::estimatorGlsl(const ShadowLight&) const
{
  return ShaderLibrary::source("shadowtech/depth_map/compare_estimator.glsl");
}

} // namespace gnomon
