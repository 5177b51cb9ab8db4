#pragma once

#include "shadowtech/tracing/CasterHits.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Traces shadow rays against the casting surfaces: the truth, and the one entry point of all
/// tracing. All techniques of a frame share one tracer, so their answers agree to the last bit.
class ShadowTracer
{
public:
  virtual ~ShadowTracer() = default;

  /// The effect of an update.
  struct Update
  {
    int builds = 0; ///< structures that were built
    int refits = 0; ///< structures that were refitted to moved vertices or instances
  };

  /// Update the acceleration structure for the snapshot, and reserve the GPU's memory for rays, so
  /// that one tracer traces a whole frame. Does nothing if neither topologyVersion nor
  /// positionsVersion changed. The snapshot's vertex and index arrays and texture coordinates may
  /// be shared, not copied: they must stay in place until the next update.
  /// @throws std::runtime_error if there is no structure, TextureMemoryError included
  virtual Update update(const Occluders& occluders) = 0;

  /// Trace the visibility of the light from every receiver, by the shadow ray of ShadowRay.h: 1
  /// lit; 0 in shadow, facing away from the light (facesLight()), or outside its cone or box.
  /// Pixels that are not covered, or whose surface does not receive, get 1.
  ///
  /// @param occluders the snapshot of the last update
  /// @param visibility resized to one value per pixel of the picture
  /// @param decider decides receivers without rays; null: all are traced
  /// @param classes if not null, resized likewise and set to each pixel's TracedClass
  /// @param tiles which tiles reuse visibility and classes, and the record of the others; null: all
  /// are traced. Not with a decider, which leaves receivers out
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

  /// Trace the share of an area light's samples that each receiver sees; each pixel has its own
  /// samples (sideOfSample()). The light's centre decides what the light reaches.
  ///
  /// A light with a texture has three channels, one image after the other: the share of the
  /// samples' colours that the receiver sees, times the texture's mean. Lit pixels without rays get
  /// the texture's mean.
  /// @param light with an area
  /// @param chooser chooses the rays that decide the others; null: all are traced. Must be null for
  /// textures
  /// @param verdicts must be null for textures
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

  /// Return the tester of segments of the last update's snapshot; null if this tracer has none.
  virtual const FreeSegments* freeSegments() const { return nullptr; }
  /// Return the finder of casting triangles of that snapshot; null if this tracer has none.
  virtual const CasterHits* casterHits() const { return nullptr; }

  /// Return the bytes of the acceleration structure, on the CPU and the GPU.
  virtual std::size_t bytes() const = 0;
  /// Return the bytes of the table that finds each surface's structure.
  virtual std::size_t bytesOfTable() const { return 0; }
  /// Return the bytes cached for the rays of a picture.
  virtual std::size_t bytesOfRays() const { return 0; }

private:
  /// @return the number of rays traced
  virtual std::size_t tracePicture(const TracedPicture& picture) = 0;
};

} // namespace gnomon
