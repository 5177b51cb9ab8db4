#pragma once

#include "shadowtech/base/vtkGnomonPixelClass.h"
#include "shadowtech/penumbra/EdgeTree.h"
#include "shadowtech/penumbra/LightShaft.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// The class of pixels whose edges are counted, beyond TracedClass: an index into
/// classesOfPenumbra(). Pixels that one ray decides are Lit until that ray is blocked.
constexpr std::uint8_t penumbraClass = static_cast<std::uint8_t>(TracedClass::NoReceiver) + 1;
std::vector<PixelClass> classesOfPenumbra();

/// Chooses the rays that decide the visibility of an area light. It uses the edges at which casters
/// seem to end from where rays start (docs/theory/exact_penumbrae.md).
class PenumbraChooser : public SampleChooser
{
public:
  /// @param tree of the casters
  /// @param light must have an area
  PenumbraChooser(const EdgeTree& tree, const ShadowLight& light, const glm::dvec3& centreWorld)
    : tree_(tree)
    , light_(light, centreWorld)
    , samples_(static_cast<std::size_t>(light.lightSamples))
  {
  }

  void choose(TracedTile& tile, const DirectionsOf& directionsOf, SampleRays& rays,
    bool again) const override;

  /// Return the number of pixels so far whose rays were all traced.
  std::int64_t tracedPixels() const { return this->tracedPixels_; }

private:
  const EdgeTree& tree_;
  ShaftLight light_;
  std::size_t samples_;
  mutable std::atomic<std::int64_t> tracedPixels_{ 0 };
};

} // namespace gnomon
