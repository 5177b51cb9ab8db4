#pragma once

#include "lights/LightViews.h"
#include "shadowtech/base/Technique.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// The definitions that light_views.glsl, included by a technique's source, needs in front of it.
/// @param asksPixels whether the source asks how many texels a pixel covers
std::string lightViewsDefines(const ShadowLight& light, bool asksPixels = false);

/// The uniforms of light_views.glsl, also those that only other kinds of light use.
/// @param sizeTexels the side of the map's layers
/// @param viewFits the last fits of views that await them (MapInput::viewFits)
std::vector<Uniform> lightViewsUniforms(const LightViews& views, int sizeTexels,
  const ReceiverSpace& space, const TextureBinding& viewFits = {});

} // namespace gnomon
