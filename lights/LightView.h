#ifndef gnomon_lights_LightView_h
#define gnomon_lights_LightView_h

#include "lights/Bounds.h"

#include <glm/glm.hpp>

namespace gnomon
{

/// One projection of what a light sees, for one layer of its map, as plain double-precision
/// mathematics.
///
/// Two spaces, both relative to a *centre* that the caller chooses (positions less the centre stay
/// small, so that they survive as floats):
/// - the view's space: x and y across the view, z the distance along its axis, growing away from the
///   light. z = 0 lies at the light; for a directional light at the nearest bound, or at the near
///   face of its box.
/// - clip space: OpenGL's, which the map is drawn with. Directional: affine. Else perspective.
///
/// The map stores linear depth z, scaled to [0, 1] by depthScale and depthOffset:
/// depth = z * depthScale + depthOffset. Casters end well before 1, the depth of empty texels.
struct LightView
{
  glm::dmat4 viewFromCentred{ 1.0 }; ///< rigid
  glm::dmat4 clipFromView{ 1.0 };
  bool perspective = false;
  /// Whether casters before the near plane are to be cut off, since the light begins there. Else
  /// there are none, but for rounding.
  bool beginsAtNear = false;
  double depthScale = 1.0;
  double depthOffset = 0.0;

  glm::dmat4 clipFromCentred() const { return this->clipFromView * this->viewFromCentred; }

  /// False only if nothing in the box can be seen.
  bool maySee(const Bounds& centred) const;

  bool operator==(const LightView& other) const
  {
    return this->viewFromCentred == other.viewFromCentred &&
      this->clipFromView == other.clipFromView && this->perspective == other.perspective &&
      this->beginsAtNear == other.beginsAtNear && this->depthScale == other.depthScale &&
      this->depthOffset == other.depthOffset;
  }
  bool operator!=(const LightView& other) const { return !(*this == other); }
};

} // namespace gnomon

#endif
