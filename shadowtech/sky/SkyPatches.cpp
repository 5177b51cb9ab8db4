#include "shadowtech/sky/SkyPatches.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>

namespace gnomon
{

//------------------------------------------------------------------------------
std::vector<SkyPatch> skyPatches(const glm::dvec3& up, const glm::dvec3& north)
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
