#ifndef gnomon_tests_unit_plugin_HalfPlane_h
#define gnomon_tests_unit_plugin_HalfPlane_h

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::test
{

/// The share of a disk, or of what looks like one, on one side of a line at this distance from its middle, in radii.
inline double diskShare(double distance)
{
  const double t = std::clamp(distance, -1.0, 1.0);
  return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / glm::pi<double>();
}

} // namespace gnomon::test

#endif
