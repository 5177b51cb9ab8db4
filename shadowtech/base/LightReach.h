#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// @file
/// What light_reach.glsl needs to know of a light.

std::vector<std::string> lightReachDefines(const ShadowLight& light);

/// @param viewFromCentred the camera's, rigid
std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred);

} // namespace gnomon
