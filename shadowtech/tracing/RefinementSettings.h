#pragma once

#include "lights/LightPointSettings.h"
#include "lights/SettingsTable.h"
#include "lights/ShadowLight.h"

#include <algorithm>
#include <string>

namespace gnomon
{

/// How soft shadows traced on the CPU refine while nothing moves.
struct RefinementSettings
{
  int movingSamples = 0; ///< of an area light, in the first frame after a change; 0: all
};

/// Return how many of an area light's samples a frame traces.
/// @param first samples of the first frame after a change; 0: all
/// @param before samples of the previous frame; 0 if it showed something else
/// @param all the light's samples
inline int samplesOfStep(int first, int before, int all)
{
  constexpr int growth = 4; // keeps square numbers square
  return first > 0 ? std::min(before > 0 ? growth * before : first, all) : all;
}

/// Return the settings of techniques that work with any number of samples.
inline const SettingsTable& refinementSettings()
{
  constexpr auto refused = [](const ShadowLight& light) -> std::string
  {
    const int samples = light.of<RefinementSettings>().movingSamples;
    return light.area && light.lightSampling == LightSampling::Jittered && !isSquare(samples)
      ? "'moving_samples' " + std::to_string(samples) +
        " is no square, which 'light_sampling' jittered needs"
      : "";
  };
  static const SettingsTable table = { "Refinement of area lights' shadows",
    { integer("moving_samples",
      "above 0: how many points of the light cast shadows in the first frame after a change; "
      "while nothing changes, each frame takes four times as many, until all do",
      "", &RefinementSettings::movingSamples, { 0, 65536 }) },
    refused };
  return table;
}

} // namespace gnomon
