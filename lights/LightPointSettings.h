#pragma once

namespace gnomon
{

struct SettingsTable;

/// Which points of an area light are taken, by each pixel for itself or by all alike.
enum class LightSampling
{
  Sobol,    ///< evenly spread ones, whose errors cancel between neighbouring pixels
  Jittered, ///< a random one in each cell of a square grid, as Curtis published it
  Random    ///< random ones
};

/// What a light shines from, and the points that stand for it (LightSamples.h).
struct LightPointSettings
{
  /// Above 0: replaces the light's own area (vtkGnomonAreaLight), in the units of OSPRay's key
  /// RADIUS: world units; of a directional light the degrees of the whole angle that it fills.
  double lightRadius = 0.0;
  int lightSamples = 64;
  int lightSeed = 0;
  LightSampling lightSampling = LightSampling::Sobol;
};

/// Whether a number of samples fills a square grid, as jittered ones do.
bool isSquare(int samples);

/// How large lights are: of every technique, since it says what the light is.
const SettingsTable& lightAreaSettings();
/// Which points these are: of techniques that take random ones.
const SettingsTable& lightSeedSettings();
/// How many there are, and how they lie: of techniques that take those of LightSamples.h.
const SettingsTable& lightSampleSettings();

} // namespace gnomon
