#include "shadowtech/pcf/Pcf.h"

#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/pcf/PoissonDisc.h"

namespace gnomon
{
namespace
{

std::string define(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + "\n";
}

std::string poissonDiscGlsl()
{
  std::string points;
  for (const glm::dvec2& point : poissonDisc())
  {
    points += points.empty() ? "" : ", ";
    points += "vec2(" + std::to_string(point.x) + ", " + std::to_string(point.y) + ")";
  }
  return "const vec2 poissonDisc_LIGHT[" + std::to_string(poissonPoints) + "] = vec2[](" + points +
    ");\n";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Pcf::info()
{
  TechniqueInfo info;
  info.name = "pcf";
  info.pointwise = true;
  info.needsMap = true;
  info.filters = true;
  return info;
}

//------------------------------------------------------------------------------
MapReach Pcf::mapReach(const ShadowLight& light) const
{
  const double width = light.kernelTexels;
  switch (light.kernel)
  {
    case FilterKernel::Bilinear:
      return { 0.5 * (width + 1.0), 0.0 };
    case FilterKernel::Box:
      return { 0.5 * width, 0.0 };
    case FilterKernel::Poisson:
      return { 0.5, 0.5 * width };
  }
  return {};
}

//------------------------------------------------------------------------------
std::string Pcf::estimatorGlsl(const ShadowLight& light) const
{
  const bool poisson = light.kernel == FilterKernel::Poisson;
  return define("PCF_TEXELS_LIGHT", light.kernelTexels) +
    define("PCF_BILINEAR_LIGHT", light.kernel == FilterKernel::Bilinear) +
    define("PCF_POISSON_LIGHT", poisson) + define("PCF_POINTS_LIGHT", poissonPoints) +
    (poisson ? poissonDiscGlsl() : "") + ShaderLibrary::source("shadowtech/pcf/pcf_estimator.glsl");
}

} // namespace gnomon
