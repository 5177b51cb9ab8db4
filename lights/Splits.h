#pragma once

#include "lights/ShadowSettings.h"

#include <vector>

namespace gnomon
{

constexpr int mostSplits = ShadowSettings::mostSplits;

/// Distances from the camera, nearest <= farthest.
struct DistanceInterval
{
  double nearest;
  double farthest;
};

/// Return the count + 1 distances that split the visible interval into `count` parts. They grow
/// strictly unless the interval has no length. The first and last are exactly the interval's ends.
///
/// Split i is at lambda n (f/n)^(i/m) + (1 - lambda) (n + (f - n) i/m) (Zhang, Sun, Xu, Lun:
/// Parallel-Split Shadow Maps for Large-scale Virtual Environments, 2006, section 4). Lambda 1 is
/// the logarithmic scheme, 0 the uniform one; between is the practical scheme.
///
/// @param visible distances; the logarithmic part replaces a nearest distance <= 0 by a thousandth
/// of the farthest, and the first distance returned stays as given
/// @param count 1 to mostSplits
/// @param lambda in [0, 1]
std::vector<double> splitDistances(const DistanceInterval& visible, int count, double lambda);

} // namespace gnomon
