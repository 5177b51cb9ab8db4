#include "shadowtech/base/Kernel.h"

#include "lights/KernelShape.h"
#include "lights/LightViews.h"
#include "shadowtech/base/GlslText.h"

#include <algorithm>

namespace gnomon
{

KernelUnits kernelUnits(const ShadowLight& light)
{
  if (light.kernel.widthAcross > 0.0)
  {
    return KernelUnits::Across;
  }
  return isWarped(light) ? KernelUnits::Even : KernelUnits::Texels;
}

MapReach kernelReach(const ShadowLight& light, const KernelExtent& extent)
{
  MapReach reach;
  reach.squareTexels = extent.squareTexels;
  switch (kernelUnits(light))
  {
    case KernelUnits::Texels:
      reach.squareTexels += extent.square;
      reach.discTexels = extent.disc;
      return reach;
    case KernelUnits::Even:
      reach.largestStretch = largestStretch(light.kernel.sizeTexels);
      break;
    case KernelUnits::Across:
    {
      constexpr double widest = 1e12; // as good as infinite
      // From a position, at distance 1, it is a tangent.
      const double unit = light.kind == LightKind::Directional ? light.unitWorld : 1.0;
      reach.unitAcross =
        std::min(widest, light.kernel.widthAcross / unit / light.kernel.sizeTexels);
    }
    break;
  }
  reach.kernelSquare = extent.square;
  reach.kernelDisc = extent.disc;
  return reach;
}

std::string kernelDefines(const ShadowLight& light)
{
  const KernelUnits units = kernelUnits(light);
  return glslDefine("KERNEL_EVEN_LIGHT", units == KernelUnits::Even) +
    glslDefine("KERNEL_ACROSS_LIGHT", units == KernelUnits::Across);
}

Uniform kernelUnit(const MapReach& reach)
{
  const bool across = reach.unitAcross > 0.0;
  return { "kernelUnit_LIGHT",
    static_cast<float>(across ? reach.unitAcross : reach.largestStretch) };
}

} // namespace gnomon
