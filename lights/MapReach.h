#pragma once

#include "lights/LightArea.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{

/// How far around a receiver's place on the map its technique reads. The texels' centres lie within
/// the Minkowski sum of a square, a disc and a kernel. A view's border and a map's push back follow
/// from it. The default is one look-up of the nearest texel.
///
/// The kernel is also a square and a disc, in units that the map's projection scales and stretches
/// at the point (KernelShape.h).
///
/// A technique with soft shadows also reads casters between the point and the light's area. That
/// distance follows from the casters' places (reachOfArea, KernelShape.h). Maps are not pushed back
/// for it.
struct MapReach
{
  double squareTexels = 0.5; ///< half the square's side
  double discTexels = 0.0;   ///< the disc's radius

  double kernelSquare = 0.0;   ///< half the side, in kernel units
  double kernelDisc = 0.0;     ///< the radius, in kernel units
  double largestStretch = 1.0; ///< limit, for kernel units that keep a texel's area
  double unitAcross = 0.0; ///< a kernel unit's length across the light; 0: it keeps a texel's area

  LightArea area = {}; ///< of radius 0: the light is a point to the technique

  /// An additional reach across the light, for which maps are not pushed back.
  double unbiasedAcross = 0.0;

  /// True if the reach in texels depends on the views.
  bool dependsOnViews() const
  {
    return this->unitAcross > 0.0 || this->area.radius() > 0.0 || this->unbiasedAcross > 0.0;
  }
  bool hasKernel() const { return this->kernelSquare > 0.0 || this->kernelDisc > 0.0; }

  /// Return the largest reach along either axis in texels, without the light's area.
  /// @param texelsAcross most texels per unit across the light, for kernels of a width across the
  /// light
  double largestTexels(double texelsAcross = 0.0) const
  {
    const double unitTexels =
      this->unitAcross > 0.0 ? this->unitAcross * texelsAcross : this->largestStretch;
    return this->squareTexels + this->discTexels +
      unitTexels * (std::sqrt(2.0) * this->kernelSquare + this->kernelDisc);
  }

  /// Return the border of a view in texels, which keeps all reads in one layer.
  /// @param texelsAcross most texels per unit across the light
  /// @param areaAcross reach of the light's area across the light
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
