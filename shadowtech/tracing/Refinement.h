#pragma once

#include "lights/LightSamples.h"
#include "lights/ShadowLight.h"

#include <algorithm>
#include <string>

namespace gnomon
{

/// Return how many of an area light's samples a frame traces.
/// @param first samples of the first frame after a change; 0: all
/// @param before samples of the previous frame; 0 if it showed something else
/// @param all the light's samples
inline int samplesOfStep(int first, int before, int all)
{
  constexpr int growth = 4; // keeps square numbers square
  return first > 0 ? std::min(before > 0 ? growth * before : first, all) : all;
}

/// Return why the light's number of samples while it moves is refused; empty if it is not.
inline std::string refusedMovingSamples(const ShadowLight& light)
{
  const int samples = light.refinement.movingSamples;
  return light.area && light.lightSampling == LightSampling::Jittered && !isSquare(samples)
    ? "'moving_samples' " + std::to_string(samples) +
      " is no square, which 'light_sampling' jittered needs"
    : "";
}

} // namespace gnomon
