#pragma once

#include "lights/ShadowLight.h"

#include <cstddef>

namespace gnomon
{

/// All that a light's shadow rays depend on beside its settings and the scene, as a hash: its kind,
/// its place, its reach, its area and texture.
struct RayIdentity
{
  std::size_t hash = 0;

  bool operator==(const RayIdentity& other) const { return this->hash == other.hash; }
  bool operator!=(const RayIdentity& other) const { return !(*this == other); }
};

/// Return a light's identity in its present units: entering the scene's frame changes it.
RayIdentity identityOf(const ShadowLight& light);

} // namespace gnomon
