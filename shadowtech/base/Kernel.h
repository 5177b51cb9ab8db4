#pragma once

#include "lights/MapReach.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <string>

namespace gnomon
{

/// The unit of a filter's kernel (kernel_units.glsl). The kernel is `kernel_size` units wide.
enum class KernelUnits
{
  Texels,
  Even,
  Across
};

KernelUnits kernelUnits(const ShadowLight& light);

/// How far a kernel reaches: the texels read around each of its points, and its square and disc in
/// kernel units.
struct KernelExtent
{
  double squareTexels; ///< half the side
  double square;       ///< half the side, in units
  double disc;         ///< the radius, in units
};
/// Return how far a kernel reads around a point of a light's map.
MapReach kernelReach(const ShadowLight& light, const KernelExtent& extent);

///@{
/// Return what kernel_units.glsl needs: the defines in front of it, and its uniform.
std::string kernelDefines(const ShadowLight& light);
Uniform kernelUnit(const MapReach& reach);
///@}

} // namespace gnomon
