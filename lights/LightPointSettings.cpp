#include "lights/LightPointSettings.h"

#include "lights/SettingsTable.h"
#include "lights/ShadowLight.h"

#include <cmath>

namespace gnomon
{
namespace
{

using S = LightPointSettings;

/// Return why the light's number of samples is refused; empty if it is not. Jittered samples fill a
/// square grid.
std::string refusedSamples(const ShadowLight& light)
{
  return light.area && light.lightSampling == LightSampling::Jittered &&
      !isSquare(light.lightSamples)
    ? "'light_sampling' jittered has one sample in each cell of a square grid, of which there are "
      "no " +
      std::to_string(light.lightSamples) + "; 'light_samples' takes squares then: 4, 9, 16, ..."
    : "";
}

} // namespace

//------------------------------------------------------------------------------
bool isSquare(int samples)
{
  const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(samples))));
  return side * side == samples;
}

//------------------------------------------------------------------------------
const SettingsTable& lightAreaSettings()
{
  static const SettingsTable table = { "The light",
    { real("light_radius",
      "above 0: makes the light a disc of that radius (a point light a ball); a directional one a "
      "disc that fills so many degrees",
      "world units", &S::lightRadius, anyLength) } };
  return table;
}

//------------------------------------------------------------------------------
const SettingsTable& lightSeedSettings()
{
  static const SettingsTable table = { "Random points of area lights",
    { integer(
      "light_seed", "which random points these are", "", &S::lightSeed, { 0, 2147483647 }) } };
  return table;
}

//------------------------------------------------------------------------------
const SettingsTable& lightSampleSettings()
{
  static const SettingsTable table = { "Samples of area lights",
    { integer("light_samples", "how many points of the light cast shadows", "", &S::lightSamples,
        { 1, 65536 }),
      choice("light_sampling",
        "evenly spread points, random ones in the cells of a grid (light_samples is a square "
        "then), or random ones",
        &S::lightSampling, { "sobol", "jittered", "random" }) },
    refusedSamples };
  return table;
}

} // namespace gnomon
