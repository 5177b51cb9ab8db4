#include "shadowtech/base/Kernel.h"

#include "lights/KernelShape.h"
#include "lights/LightViews.h"
#include "shadowtech/base/GlslText.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
const SettingsTable& kernelSettings()
{
  static const SettingsTable table = { "The filter's width",
    { integer(
        "kernel_size", "the kernel's width", "texels", &KernelSettings::sizeTexels, { 1, 32 }),
      real("kernel_width",
        "above 0: the kernel's width across the light (from a position: at distance 1), over which "
        "as many taps are spread as kernel_size says",
        "world units", &KernelSettings::widthAcross, anyLength) } };
  return table;
}

//------------------------------------------------------------------------------
KernelUnits kernelUnits(const ShadowLight& light)
{
  if (light.of<KernelSettings>().widthAcross > 0.0)
  {
    return KernelUnits::Across;
  }
  return isWarped(light) ? KernelUnits::Even : KernelUnits::Texels;
}

//------------------------------------------------------------------------------
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
      reach.largestStretch = largestStretch(light.of<KernelSettings>().sizeTexels);
      break;
    case KernelUnits::Across:
    {
      constexpr double widest = 1e12; // as good as infinite
      // From a position, at distance 1, it is a tangent.
      const double unit = light.kind == LightKind::Directional ? light.unitWorld : 1.0;
      reach.unitAcross = std::min(widest,
        light.of<KernelSettings>().widthAcross / unit / light.of<KernelSettings>().sizeTexels);
    }
    break;
  }
  reach.kernelSquare = extent.square;
  reach.kernelDisc = extent.disc;
  return reach;
}

//------------------------------------------------------------------------------
std::string kernelDefines(const ShadowLight& light)
{
  const KernelUnits units = kernelUnits(light);
  return glslDefine("KERNEL_EVEN_LIGHT", units == KernelUnits::Even) +
    glslDefine("KERNEL_ACROSS_LIGHT", units == KernelUnits::Across);
}

//------------------------------------------------------------------------------
Uniform kernelUnit(const MapReach& reach)
{
  const bool across = reach.unitAcross > 0.0;
  return { "kernelUnit_LIGHT",
    static_cast<float>(across ? reach.unitAcross : reach.largestStretch) };
}

} // namespace gnomon
