#pragma once

#include "lights/LightArea.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

/// How far around a receiver's place on the map its technique reads: texels whose centres lie
/// within a square, a disc and a kernel, one after the other (their Minkowski sum). What a view
/// keeps around its casters and how far a map is pushed back follow from it. The default is one
/// look-up at the nearest texel.
///
/// The kernel is again a square and a disc, in units that lie on the map as its projection has it
/// at the point (KernelShape.h).
///
/// A technique with soft shadows also reads the casters between the point and the light's area. How
/// far that is follows from where the casters are (reachOfArea, KernelShape.h). Maps are not pushed
/// back for it.
struct MapReach
{
  double squareTexels = 0.5; ///< half the square's side
  double discTexels = 0.0;   ///< the disc's radius

  double kernelSquare = 0.0;   ///< half the side, in kernel units
  double kernelDisc = 0.0;     ///< the radius, in kernel units
  double largestStretch = 1.0; ///< of kernel units that keep a texel's area
  double unitAcross = 0.0; ///< a kernel unit's length across the light; 0: it keeps a texel's area

  LightArea area = {}; ///< of radius 0: the light is a point to the technique

  /// How much farther it reads, across the light, though maps are not pushed back for it.
  double unbiasedAcross = 0.0;

  /// Whether only views tell how many texels it is.
  bool dependsOnViews() const
  {
    return this->unitAcross > 0.0 || this->area.radius() > 0.0 || this->unbiasedAcross > 0.0;
  }
  bool hasKernel() const { return this->kernelSquare > 0.0 || this->kernelDisc > 0.0; }

  /// The farthest along either axis, but for the light's area.
  /// @param texelsAcross the most texels to a unit across the light, which kernels of a width
  /// across the light are measured by
  double largestTexels(double texelsAcross = 0.0) const
  {
    const double unitTexels =
      this->unitAcross > 0.0 ? this->unitAcross * texelsAcross : this->largestStretch;
    return this->squareTexels + this->discTexels +
      unitTexels * (std::sqrt(2.0) * this->kernelSquare + this->kernelDisc);
  }

  /// Texels to keep free around a view, so that all that is read lies on its own layer.
  /// @param areaAcross how far the light's area reaches across the light
  int borderTexels(double texelsAcross = 0.0, double areaAcross = 0.0) const
  {
    constexpr double most = 1 << 20; // more than any map has
    const double texels =
      this->largestTexels(texelsAcross) + (areaAcross + this->unbiasedAcross) * texelsAcross;
    return static_cast<int>(std::ceil(std::min(texels, most)));
  }

  bool operator==(const MapReach& other) const
  {
    return this->squareTexels == other.squareTexels && this->discTexels == other.discTexels &&
      this->kernelSquare == other.kernelSquare && this->kernelDisc == other.kernelDisc &&
      this->largestStretch == other.largestStretch && this->unitAcross == other.unitAcross &&
      this->area == other.area && this->unbiasedAcross == other.unbiasedAcross;
  }
};

} // namespace gnomon
