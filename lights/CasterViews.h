#pragma once

#include "lights/Bounds.h"
#include "lights/LightSpace.h"
#include "lights/LightView.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace gnomon
{

/// The far plane lies this share of the depth range behind the last caster: what a technique writes
/// for it, pushed back as that may be, stays apart from the depth 1 of texels without a caster.
constexpr double roomBehindCasters = 0.125;

///@{
/// Views around a light's casters, uniform, without a border: what all projections start from
/// (LightViews.h). Bounds without extent along an axis are widened relative to their own size.

/// @param castersView what to cover; not empty
/// @param radius of all casters: what their positions are rounded in proportion to
LightView parallelCasterView(
  const Bounds& castersView, double radius, const glm::dmat4& viewFromCentred);

/// @param slopeLimit the largest |x/z| and |y/z| of what the light reaches
/// @return nothing where no caster can be seen
std::optional<LightView> spotCasterView(
  const Bounds& castersView, const glm::dmat4& viewFromCentred, double slopeLimit);

/// The faces of a cube: nothing for those that see no casters. A face whose only casters lie beyond
/// its edge, but no farther than the border, sees them, too.
///
/// A technique's kernel is as wide as the texels make it, and so should they be on both sides of a
/// face's edge: the maps of faces with casters near an edge have texels no smaller than half of the
/// cube's largest ones.
/// @param inside the share of a map's side between its borders
std::array<std::optional<LightView>, cubeFaces> cubeCasterViews(
  const Bounds& castersLight, const glm::dmat4& lightFromCentred, double inside);
///@}

} // namespace gnomon
