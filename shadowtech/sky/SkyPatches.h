#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
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
inline std::vector<SkyPatch> skyPatches(const glm::dvec3& up, const glm::dvec3& north)
{
  constexpr std::array<int, 8> patchesOfRing = { 30, 30, 24, 24, 18, 12, 6, 1 };
  const double height = glm::radians(12.0);
  const double turn = 2.0 * glm::pi<double>();
  const glm::dvec3 east = glm::normalize(glm::cross(north, up));
  const glm::dvec3 ahead = glm::cross(up, east);
  std::vector<SkyPatch> patches;
  for (std::size_t ring = 0; ring < patchesOfRing.size(); ++ring)
  {
    const int count = patchesOfRing[ring];
    const bool isCap = count == 1;
    const double bottom = static_cast<double>(ring) * height;
    const double top = isCap ? 0.25 * turn : bottom + height;
    const double middle = isCap ? top : 0.5 * (bottom + top);
    for (int i = 0; i < count; ++i)
    {
      const double azimuth = turn * i / count;
      patches.push_back(
        { std::cos(middle) * (std::cos(azimuth) * ahead + std::sin(azimuth) * east) +
            std::sin(middle) * up,
          turn * (std::sin(top) - std::sin(bottom)) / count });
    }
  }
  return patches;
}

} // namespace gnomon
