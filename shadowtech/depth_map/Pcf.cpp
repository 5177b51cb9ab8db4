#include "shadowtech/depth_map/Pcf.h"

#include "shadowtech/base/GlslText.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/PoissonDisc.h"

namespace gnomon
{
namespace
{

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

/// Return the kernel's weights at 0, 1, 2, ... texels from the point, linear in between, and 0 at
/// the end. Castano 2013 gives them as places and weights of bilinear look-ups.
std::string castanoGlsl(int texels)
{
  const std::string weights = texels == 3 ? "2.0, 1.0, 0.0"
    : texels == 5                         ? "4.0, 3.0, 1.0, 0.0"
                                          : "16.0, 12.0, 5.0, 1.0, 0.0";
  return "const float castano_LIGHT[] = float[](" + weights + ");\n";
}

std::string refusedKernel(const ShadowLight& light)
{
  const int texels = light.kernel.sizeTexels;
  return light.pcf.kernel == FilterKernel::Castano && texels != 3 && texels != 5 && texels != 7
    ? "the kernel 'castano' has the sizes 3, 5 and 7, not " + std::to_string(texels)
    : "";
}

} // namespace

//------------------------------------------------------------------------------
TechniqueInfo Pcf::info()
{
  TechniqueInfo info;
  info.name = "pcf";
  info.bytesPerTexel = bytesPerTexel;
  info.settings = { &viewSettings(), &kernelSettings(), &pcfSettings(), &depthMapSettings() };
  info.refused = { refusedKernel };
  return info;
}

//------------------------------------------------------------------------------
MapReach Pcf::mapReach(const ShadowLight& light) const
{
  const KernelUnits units = kernelUnits(light);
  const double width = light.kernel.sizeTexels;
  switch (light.pcf.kernel)
  {
    case FilterKernel::Bilinear:
    case FilterKernel::Castano:
      return units == KernelUnits::Across ? kernelReach(light, { 1.0, 0.5 * (width - 1.0), 0.0 })
                                          : kernelReach(light, { 0.0, 0.5 * (width + 1.0), 0.0 });
    case FilterKernel::Box:
      return kernelReach(light, { 0.5, 0.5 * (width - 1.0), 0.0 });
    case FilterKernel::Poisson:
      return kernelReach(light, { 0.5, 0.0, 0.5 * width });
  }
  return {};
}

//------------------------------------------------------------------------------
std::string Pcf::estimatorGlsl(const ShadowLight& light) const
{
  const KernelUnits units = kernelUnits(light);
  const bool poisson = light.pcf.kernel == FilterKernel::Poisson;
  const bool castano = light.pcf.kernel == FilterKernel::Castano;
  const bool smooth = castano || light.pcf.kernel == FilterKernel::Bilinear;
  const bool rows = light.pcf.kernel == FilterKernel::Bilinear && units == KernelUnits::Texels;
  const bool weighted = smooth && !rows && units != KernelUnits::Across;
  return kernelDefines(light) + glslDefine("PCF_TEXELS_LIGHT", light.kernel.sizeTexels) +
    glslDefine("PCF_ROWS_LIGHT", rows) + glslDefine("PCF_WEIGHTED_LIGHT", weighted) +
    glslDefine("PCF_POISSON_LIGHT", poisson) + glslDefine("PCF_POINTS_LIGHT", poissonPoints) +
    glslDefine("PCF_BOX_LIGHT", light.pcf.kernel == FilterKernel::Box) +
    glslDefine("PCF_CASTANO_LIGHT", castano) + (poisson ? poissonDiscGlsl() : "") +
    (castano ? castanoGlsl(light.kernel.sizeTexels) : "") +
    ShaderLibrary::source("shadowtech/depth_map/pcf_estimator.glsl");
}

} // namespace gnomon
