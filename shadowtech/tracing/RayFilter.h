#pragma once

#include <glm/glm.hpp>

namespace gnomon
{

/// Casters that let a part of the light through, beside those that block it.
class RayFilter
{
public:
  virtual ~RayFilter() = default;

  /// True if the channels of transmittanceOf() may differ.
  virtual bool isColoured() const = 0;

  /// Return the share of light, by channel, that such casters leave of a ray. Called from several
  /// threads at once.
  /// @param origin, direction centred; the origin in the box around the snapshot
  /// (Occluders::allCentred), the direction of any length but 0
  /// @param rayFar far end of the ray, in lengths of its direction (ShadowRay.h)
  virtual glm::dvec3 transmittanceOf(
    const glm::vec3& origin, const glm::vec3& direction, float rayFar) const = 0;
};

} // namespace gnomon
