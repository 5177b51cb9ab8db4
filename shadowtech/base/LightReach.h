#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// @file
/// Defines and uniforms of light_reach.glsl for a light.

std::vector<std::string> lightReachDefines(const ShadowLight& light);

/// @param viewFromCentred of the camera, rigid
std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred);

} // namespace gnomon
