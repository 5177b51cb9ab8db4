#pragma once

#include "lights/LightViews.h"
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

} // namespace gnomon
