#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// A part of the sky's hemisphere.
struct SkyPatch
{
  glm::dvec3 towards; ///< unit, to its middle
  double solidAngle;  ///< in steradians
};

/// Return the 145 patches by which daylight is measured (Tregenza, Subdivision of the sky
/// hemisphere for luminance measurements, 1987): seven rings of 12 degrees from the horizon up, and
/// a cap.
///
/// @param up unit, towards the zenith
/// @param north where rings begin, not along up; they go on clockwise as seen from above: to the
/// east
std::vector<SkyPatch> skyPatches(const glm::dvec3& up, const glm::dvec3& north);

} // namespace gnomon
