#pragma once

namespace gnomon
{

struct SettingsTable;

/// How points of an area light are chosen, per pixel or for all pixels alike.
enum class LightSampling
{
  Sobol,    ///< evenly spread points, whose errors cancel between neighbouring pixels
  Jittered, ///< a random point in each cell of a square grid (Curtis 2009)
  Random    ///< independent random points
};

/// A light's area, and the points that sample it (LightSamples.h).
struct LightPointSettings
{
  /// Above 0: replaces the light's own area (vtkGnomonAreaLight), in the units of OSPRay's key
  /// RADIUS. These are world units, or for a directional light the whole angle in degrees.
  double lightRadius = 0.0;
  int lightSamples = 64;
  int lightSeed = 0;
  LightSampling lightSampling = LightSampling::Sobol;
};

/// True if a number of samples is a square, as jittered samples require.
bool isSquare(int samples);

/// Settings of a light's size. Every technique has them, because they define the light.
const SettingsTable& lightAreaSettings();
/// Settings that choose the random points, for techniques that use random points.
const SettingsTable& lightSeedSettings();
/// Settings of the number and distribution of points, for techniques that use LightSamples.h.
const SettingsTable& lightSampleSettings();

} // namespace gnomon
