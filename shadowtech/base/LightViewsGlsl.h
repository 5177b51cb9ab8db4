#pragma once

#include "lights/LightViews.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// Return the defines that light_views.glsl needs in front of it.
/// @param asksPixels true if the source asks how many texels a pixel covers
std::string lightViewsDefines(const ShadowLight& light, bool asksPixels = false);

/// Return the uniforms of light_views.glsl, including those that only other kinds of light use.
/// @param sizeTexels the side of the map's layers
/// @param viewFits the fits found on the GPU, if views await them (MapInput::viewFits)
std::vector<Uniform> lightViewsUniforms(const LightViews& views, int sizeTexels,
  const ReceiverSpace& space, const TextureBinding& viewFits = {});

/// Return the defines of light_reach.glsl, which select a light's bounds: SPOT or BOX.
std::vector<std::string> lightReachDefines(const ShadowLight& light);

/// Return its uniforms, for points in the camera's view coordinates.
/// @param viewFromCentred of the camera, rigid
std::vector<Uniform> lightReachUniforms(
  const ShadowLight& light, const glm::dvec3& centreWorld, const glm::dmat4& viewFromCentred);

} // namespace gnomon
