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

/// The decisions for whole receiving triangles. Either side of a triangle is turned away from the
/// light, all lit, all in shadow, reached by the light without being decided, or uncertain.
/// Triangles of instances stay uncertain.
///
/// Only the size of pixels depends on the camera. So a frame looks up triangles, and pixels only of
/// triangles that are undecided.
class TriangleDecisions
{
public:
  TriangleDecisions() = default;
  /// @param maps of all views of the light
  TriangleDecisions(
    const ShadowLight& light, const Occluders& occluders, const std::vector<ConservativeMap>& maps);

  Certainty of(const ReceiverTriangle& triangle) const;
  std::size_t bytes() const { return bytesOf(this->ofTriangles_); }

private:
  /// Return how far off a triangle shadow rays may start, in world units.
  double offsetLimit(const std::array<glm::dvec3, 3>& corners) const;

  /// For each triangle of the snapshot, the front's Certainty in the lower four bits, the back's in
  /// the upper.
  std::vector<std::uint8_t> ofTriangles_;
  bool positional_ = false;
  glm::dvec3 positionCentred_{ 0.0 };
  double limitAtUnit_ = 0.0; ///< offsetLimit() of a positional light at distance 1
};

} // namespace gnomon
