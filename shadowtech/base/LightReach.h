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

/// Return the defines that select a light's bounds: SPOT or BOX.
std::vector<std::string> lightReachDefines(const ShadowLight& light);

/// Return the uniforms, for points in the camera's view coordinates.
/// @param viewFromCentred of the camera, rigid
std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred);

} // namespace gnomon
