#pragma once

#include <vector>

namespace gnomon
{

constexpr int mostSplits = 8;

/// Distances from the camera, nearest <= farthest.
struct DistanceInterval
{
  double nearest;
  double farthest;
};

/// The distances that split what is visible into `count` parts: count + 1 of them, strictly growing
/// (unless the interval has no length), the first and last exactly the interval's ends.
///
/// Zhang, Sun, Xu, Lun: Parallel-Split Shadow Maps for Large-scale Virtual Environments, 2006,
/// section 4: lambda n (f/n)^(i/m) + (1 - lambda) (n + (f - n) i/m). lambda 1: logarithmic, 0:
/// uniform, between: the practical scheme.
///
/// @param visible a nearest distance of 0 or less is taken as a thousandth of the farthest one by
/// the logarithmic part, which has no split there; the first distance stays what it is
/// @param count 1 to mostSplits
/// @param lambda in [0, 1]
std::vector<double> splitDistances(const DistanceInterval& visible, int count, double lambda);

/// What is to be split, from the receivers' own distances (Lauritzen, Salvi, Lefohn: Sample
/// Distribution Shadow Maps, 2011, section 3.1): their least and greatest one, within what the
/// camera and the scene leave; that alone where there are no receivers (least > greatest, or not
/// finite).
DistanceInterval splitInterval(
  const DistanceInterval& possible, double leastReceiver, double greatestReceiver);

} // namespace gnomon
