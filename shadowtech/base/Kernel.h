#pragma once

#include "lights/MapReach.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <string>

namespace gnomon
{

/// How wide a filter averages, of every technique that does.
struct KernelSettings
{
  int sizeTexels = 3; ///< the side of a kernel's square, the diameter of its disc
  /// The width across the light, in world units, of a positional light at distance 1; 0:
  /// sizeTexels.
  double widthAcross = 0.0;
};
const SettingsTable& kernelSettings();

/// What a filter's kernel is measured in (kernel_units.glsl). One of `kernel_size` units is
/// - a texel of a uniform projection;
/// - of a warped one, whose texels are longer across the light one way than the other, as large as
///   a texel, but of a shape that is even across the light (KernelShape.h);
/// - the share of `kernel_width` across the light, if that is asked for.
enum class KernelUnits
{
  Texels,
  Even,
  Across
};

KernelUnits kernelUnits(const ShadowLight& light);

/// How far a kernel reaches: the texels around its points, and a square and a disc of its units.
struct KernelExtent
{
  double squareTexels; ///< half the side
  double square;       ///< half the side, in units
  double disc;         ///< the radius, in units
};
MapReach kernelReach(const ShadowLight& light, const KernelExtent& extent);

///@{
/// What kernel_units.glsl needs: in front of it, and as a uniform.
std::string kernelDefines(const ShadowLight& light);
Uniform kernelUnit(const MapReach& reach);
///@}

} // namespace gnomon
