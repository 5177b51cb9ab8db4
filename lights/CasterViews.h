#pragma once

#include "lights/Bounds.h"
#include "lights/LightSpace.h"
#include "lights/LightView.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace gnomon
{

/// The far plane lies this share of the depth range behind the last caster. So a caster's depth,
/// even pushed back by a technique, stays below 1, the depth of empty texels.
constexpr double roomBehindCasters = 0.125;

///@{
/// Uniform views around a light's casters, without a border. All projections start from them
/// (LightViews.h). Bounds without extent along an axis are widened relative to their own size.

/// Return the view of parallel rays.
/// @param castersView bounds to cover, in view space; not empty
/// @param radius of all casters; their positions round in proportion to it
LightView parallelCasterView(
  const Bounds& castersView, double radius, const glm::dmat4& viewFromCentred);

/// Return the view of a spot light.
/// @param slopeLimit largest |x/z| and |y/z| that the light reaches
/// @return nothing if the light sees no caster
std::optional<LightView> spotCasterView(
  const Bounds& castersView, const glm::dmat4& viewFromCentred, double slopeLimit);

/// Return a view for each face of a cube; nothing for a face that sees no casters. A face also sees
/// casters beyond its edge, up to the width of its border.
///
/// A technique's kernel scales with texels, so texels on both sides of a face's edge should have
/// similar sizes. Faces with casters near an edge therefore have texels at least half as large as
/// the cube's largest texels.
/// @param inside share of a map's side between its borders
std::array<std::optional<LightView>, cubeFaces> cubeCasterViews(
  const Bounds& castersLight, const glm::dmat4& lightFromCentred, double inside);
///@}

} // namespace gnomon
