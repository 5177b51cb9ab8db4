#pragma once

#include "shadowtech/tracing/CasterHits.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Shadow rays against the casting surfaces: the truth, and the one entry point for whoever traces.
/// All techniques of a frame get the same one, so that what they trace is the same to the last bit.
class ShadowTracer
{
public:
  virtual ~ShadowTracer() = default;

  /// What an update did.
  struct Update
  {
    int builds = 0; ///< structures that were built
    int refits = 0; ///< structures that were refitted to moved vertices or instances
  };

  /// Brings the acceleration structure up to date with the snapshot, and takes the GPU's memory for
  /// rays: no frame is traced half by one tracer and half by another. Does nothing when neither
  /// topologyVersion nor positionsVersion changed. The snapshot's vertex and index arrays and
  /// texture coordinates may be shared, not copied: they must stay where they are until the next
  /// update.
  /// @throws std::runtime_error where there is no structure to be had, TextureMemoryError included
  virtual Update update(const Occluders& occluders) = 0;

  /// Visibility of the light from every receiver, by the shadow ray of ShadowRay.h: 1 lit, 0
  /// shadowed, turned away from the light (facesLight()) or outside its cone or box. Pixels that
  /// are not covered, or whose surface does not receive, get 1.
  ///
  /// @param occluders the snapshot of the last update
  /// @param visibility resized to one for each pixel of the picture
  /// @param decider decides receivers without rays; null: all are traced
  /// @param classes where not null, resized likewise, each pixel's TracedClass
  /// @param tiles which of them keep what visibility and classes hold, and what becomes known of
  /// the others; null: all are traced. Not with a decider, which leaves receivers out
  /// @param verdicts what is known of tiles without rays; null: nothing
  /// @return the number of rays traced
  std::size_t trace(const ShadowLight& light, const Occluders& occluders,
    const Receivers& receivers, std::vector<float>& visibility,
    const ReceiverDecider* decider = nullptr, std::vector<std::uint8_t>* classes = nullptr,
    TracedTiles* tiles = nullptr, const TileVerdicts* verdicts = nullptr)
  {
    return this->tracePicture(
      { light, occluders, receivers, decider, visibility, classes, tiles, verdicts, nullptr });
  }

  /// The same of an area light, whose centre decides what it reaches: the share of its samples that
  /// the receiver sees, each pixel with its own (sideOfSample()). Of a light with a texture it has
  /// three channels, one image after the other: the share of its samples' colours that the receiver
  /// sees, times the texture's mean; where there is nothing to trace and it is lit, the texture's
  /// mean.
  /// @param light with an area
  /// @param chooser who knows which of a pixel's rays decide the others; null: nobody. There is
  /// none for textures
  /// @param verdicts not for textures either
  std::size_t traceArea(const ShadowLight& light, const Occluders& occluders,
    const Receivers& receivers, std::vector<float>& visibility,
    const ReceiverDecider* decider = nullptr, std::vector<std::uint8_t>* classes = nullptr,
    const SampleChooser* chooser = nullptr, TracedTiles* tiles = nullptr,
    const TileVerdicts* verdicts = nullptr)
  {
    const LightSamples samples(light);
    const TracedPicture picture(light, occluders, receivers, decider, visibility, classes, tiles,
      verdicts, &samples, chooser);
    const std::size_t rays = this->tracePicture(picture);
    picture.finish();
    return rays;
  }

  /// Who says whether segments of the last update's snapshot are free; null: this tracer does not.
  virtual const FreeSegments* freeSegments() const { return nullptr; }
  /// The finder of casting triangles of that snapshot; null if this tracer has none.
  virtual const CasterHits* casterHits() const { return nullptr; }

  /// Memory of the acceleration structure, on the CPU and the GPU.
  virtual std::size_t bytes() const = 0;
  /// Memory that is kept to find each surface's structure again.
  virtual std::size_t bytesOfTable() const { return 0; }
  /// Memory that is kept for the rays of a picture.
  virtual std::size_t bytesOfRays() const { return 0; }

private:
  /// @return the number of rays traced
  virtual std::size_t tracePicture(const TracedPicture& picture) = 0;
};

} // namespace gnomon
