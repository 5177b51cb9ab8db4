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
class ShadowTracer;

/// How often a way to visibility was asked, and wrong.
struct WrongProbes
{
  std::size_t asked = 0; ///< points that face the light
  std::size_t wrong = 0; ///< of those, where visibility is off by more than a half

  double share() const
  {
    return static_cast<double>(this->wrong) / static_cast<double>(std::max<std::size_t>(asked, 1));
  }

  /// The most that the share of wrong pixels is, of which these are a sample, but for one case in
  /// forty: the upper bound of Wilson's interval (Wilson 1927) with z = 2. Without points it is 1.
  /// Sampling until the bound is low enough makes it wrong more often.
  double mostShare() const;
};

/// Compares a cheap visibility with traced visibility at some pixels, before the picture is drawn.
/// Camera rays find the receivers. They miss surfaces that do not cast, and solids, and hit the
/// surface behind.
class Probes
{
public:
  static constexpr int across = 64; ///< and as many from bottom to top

  /// Finds the points: one in each part of the picture, at a place that another number moves.
  void look(const CameraView& camera, const glm::ivec2& sizePixels, const Occluders& occluders,
    const CasterHits& hits, std::uint32_t number);

  /// How wrong a map is.
  /// @param technique whose map is baked
  /// @param tracer whose structure is up to date with the occluders
  WrongProbes wrongOf(const PointwiseTechnique& technique, const ShadowLight& light,
    const ReceiverSpace& space, const Occluders& occluders, ShadowTracer& tracer,
    ShaderLibrary& shaders);

  /// The root mean square by which an area light's visibility is off with fewer samples.
  /// @param few how many; fewer than the light has
  double rmsOf(int few, const ShadowLight& light, const Occluders& occluders, ShadowTracer& tracer);

  std::size_t bytes() const;

private:
  ReceiverPixels receivers_;
  ReceiverTarget target_;
  VisibilityLayers layers_;
  std::vector<float> traced_, asked_;
  std::vector<std::uint8_t> classes_;
};

} // namespace gnomon
