#ifndef gnomon_lights_LightView_h
#define gnomon_lights_LightView_h

#include "lights/Bounds.h"
#include "lights/ShadowLight.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// What a light sees: the map's projection, as plain double-precision mathematics.
///
/// Two spaces, both relative to a *centre* that the caller chooses (positions less the centre stay
/// small, so that they survive as floats):
/// - light space: x and y across the light, z the distance along the light's axis, growing away
///   from the light. For a directional light z = 0 lies at the nearest bound; for a spot light at
///   the light itself.
/// - clip space: OpenGL's, which the map is drawn with. Directional: affine. Spot: perspective.
///
/// The map stores linear depth z, scaled to [0, 1] by depthScale and depthOffset:
/// depth = z * depthScale + depthOffset. Casters end well before 1, the depth of empty texels.
struct LightView
{
  glm::dmat4 lightFromCentred{ 1.0 }; ///< rigid: centred world to light space
  glm::dmat4 clipFromLight{ 1.0 };    ///< light space to clip space
  bool perspective = false;
  double depthScale = 1.0;
  double depthOffset = 0.0;
  /// False where there is nothing to see (no casters, or all of them behind a spot light): every
  /// receiver is lit, and no map is needed.
  bool valid = false;

  glm::dmat4 clipFromCentred() const { return this->clipFromLight * this->lightFromCentred; }

  bool operator==(const LightView& other) const
  {
    return this->lightFromCentred == other.lightFromCentred &&
      this->clipFromLight == other.clipFromLight && this->perspective == other.perspective &&
      this->depthScale == other.depthScale && this->depthOffset == other.depthOffset &&
      this->valid == other.valid;
  }
  bool operator!=(const LightView& other) const { return !(*this == other); }
};

/// The uniform projection fitted to the casters' bounds as the light sees them.
///
/// @param light a directional or spot light, in world coordinates
/// @param centreWorld the origin of centred coordinates, in world coordinates
/// @param castersCentred the box around all casters, in centred coordinates
/// @param mapSizeTexels the map's side; a border of one texel is kept free on every side
///
/// Degenerate cases: no casters, or all of them behind a spot light, give valid == false; bounds
/// without extent along an axis are widened relative to the box's own size.
LightView fitUniform(const ShadowLight& light, const glm::dvec3& centreWorld,
  const Bounds& castersCentred, int mapSizeTexels);

} // namespace gnomon

#endif
