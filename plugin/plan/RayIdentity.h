#pragma once

#include "lights/ShadowLight.h"

#include <cstddef>

namespace gnomon
{

/// All that a light's shadow rays depend on beside its settings and the scene, as hashes.
struct RayIdentity
{
  std::size_t centre = 0; ///< its kind, its place, its reach and texture
  std::size_t area = 0;   ///< 0: all rays go to its centre

  bool operator==(const RayIdentity& other) const
  {
    return this->centre == other.centre && this->area == other.area;
  }
  bool operator!=(const RayIdentity& other) const { return !(*this == other); }
};

/// Return the identity of a light in the world.
RayIdentity identityOf(const ShadowLight& light);

} // namespace gnomon
