#pragma once

#include "lights/CameraView.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/probing/ProbeCounts.h"
#include "shadowtech/tracing/CasterHits.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Occluders;
class ShaderLibrary;
class EmbreeTracer;

/// Compares a cheap visibility with traced visibility at some pixels, before the picture is drawn.
/// Camera rays find the receivers. They miss surfaces that do not cast, and hit the surface behind.
class Probes
{
public:
  static constexpr int across = 64; ///< parts along each side of the picture
  static constexpr std::size_t count = probesOfALook;
  static_assert(count == std::size_t(across) * across);

  /// Find the points, as many in each part of the picture that is aimed at.
  /// @param number another number moves the points within their parts
  void look(const CameraView& camera, const glm::ivec2& sizePixels, const Occluders& occluders,
    const CasterHits& hits, std::uint32_t number);

  /// Count the points where a map is wrong.
  /// @param technique its map is baked
  /// @param tracer its structure is up to date with the occluders
  WrongProbes wrongOf(const PointwiseTechnique& technique, const ShadowLight& light,
    const ReceiverSpace& space, const Occluders& occluders, EmbreeTracer& tracer,
    ShaderLibrary& shaders);

  /// Aim further looks at all 64 x 64 parts of the picture, one point in each.
  void aimEverywhere() { this->parts_.clear(); }

  /// Aim further looks at the parts where wrongOf() found a point that faces the light (at least
  /// one), and at their neighbours. More points then face the light. They miss what is small and
  /// apart from all points found.
  void aimAtFacing();

  /// Sum up the errors of an area light's visibility if it is traced from another light.
  /// @param other the light with fewer samples, compared at every fourth point; or without its
  /// area, compared at all points by 16 samples
  SquaredErrors errorsOf(const ShadowLight& other, const ShadowLight& light,
    const Occluders& occluders, EmbreeTracer& tracer);

  std::size_t bytes() const;

private:
  /// Return the number of the part that a point is in.
  std::size_t partOf(std::size_t point) const
  {
    return this->parts_.empty() ? point : this->parts_[point % this->parts_.size()];
  }

  std::vector<std::size_t> parts_; ///< aimed at; empty: all
  ReceiverPixels receivers_;
  ReceiverTarget target_;
  VisibilityLayers layers_;
  std::vector<float> traced_, asked_;
  std::vector<std::uint8_t> classes_;
};

} // namespace gnomon
