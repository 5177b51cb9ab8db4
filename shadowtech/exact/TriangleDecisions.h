#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/exact/ConservativeMap.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// What is known of whole triangles that receive: that they are turned away from the light, or that
/// all of their points are lit, or in shadow; or that they have shadow rays, and no more than that.
/// Those of surfaces with instances are left open.
///
/// It does not depend on the camera, but for how large pixels may be: a frame looks each triangle
/// up, and pixels only where a triangle is not decided.
class TriangleDecisions
{
public:
  TriangleDecisions() = default;
  /// @param maps of all of the light's views
  TriangleDecisions(
    const ShadowLight& light, const Occluders& occluders, const std::vector<ConservativeMap>& maps);

  Certainty of(const ReceiverTriangle& triangle) const;
  std::size_t bytes() const { return bytesOf(this->ofTriangles_); }

private:
  /// How far off a triangle shadow rays may start.
  double offsetLimit(const std::array<glm::dvec3, 3>& corners) const;

  /// Of each triangle in the snapshot, the front's Certainty in the lower half, the back's in the
  /// upper.
  std::vector<std::uint8_t> ofTriangles_;
  bool positional_ = false;
  glm::dvec3 positionCentred_{ 0.0 };
  double limitAtUnit_ = 0.0; ///< offsetLimit(), of a positional light at distance 1
};

} // namespace gnomon
