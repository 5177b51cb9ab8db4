#pragma once

#include "lights/CameraView.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/ReceiverTarget.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/Technique.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/tracing/CasterHits.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Occluders;
class ShaderLibrary;
class EmbreeTracer;

/// A count of wrong answers of a cheap visibility.
struct WrongProbes
{
  std::size_t asked = 0; ///< points that face the light
  std::size_t wrong = 0; ///< those where visibility is off by more than 0.5

  double share() const
  {
    return static_cast<double>(this->wrong) / static_cast<double>(std::max<std::size_t>(asked, 1));
  }

  ///@{
  /// Return a bound of the share of wrong pixels in the population of which these are a sample.
  /// The share is beyond it in one case of forty: Wilson's interval (Wilson 1927) with z = 2.
  /// Without points the bounds are 0 and 1. Sampling until one is clear makes it wrong more often.
  double leastShare() const;
  double mostShare() const;
  ///@}
};

/// A sum of the squared errors of an area light's visibility.
struct SquaredErrors
{
  std::size_t points = 0;    ///< that face the light
  double sum = 0.0;          ///< of the squares, means over the visibility's channels
  double sumOfSquares = 0.0; ///< of these again
  double expected = 0.0;     ///< what a square in a penumbra may be; rare ones may be missed

  void add(const SquaredErrors& others);
  ///@{
  /// Return a bound of the root mean square error of the population of which these are a sample:
  /// Wilson's, as if all squares but zeros were of one size, at least the expected one. Without
  /// points both are 0. The upper one has z = 3, as each of many looks may pass it by chance.
  double leastRms() const { return this->rms(-2.0); }
  double mostRms() const { return this->rms(3.0); }
  ///@}

private:
  double rms(double z) const;
};

/// Compares a cheap visibility with traced visibility at some pixels, before the picture is drawn.
/// Camera rays find the receivers. They miss surfaces that do not cast, and hit the surface behind.
class Probes
{
public:
  static constexpr int across = 64; ///< parts along each side of the picture
  static constexpr std::size_t count = std::size_t(across) * across; ///< of the points of a look

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
