#pragma once

#include "shadowtech/base/Patches.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/tracing/CasterHits.h"
#include "shadowtech/tracing/RayFilter.h"
#include "shadowtech/tracing/TracedPicture.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon
{

/// Traces shadow rays against the casting surfaces: the truth, and the one entry point of all
/// tracing. Embree traces in robust mode, with one acceleration structure per surface. All
/// techniques of a frame share one tracer, so their answers agree to the last bit.
class EmbreeTracer : public CasterHits
{
public:
  /// @throws std::runtime_error if Embree cannot be started
  EmbreeTracer();
  ~EmbreeTracer() override;
  EmbreeTracer& operator=(EmbreeTracer&&) = delete; ///< nor copied

  struct Update
  {
    int builds = 0; ///< structures that were built
    int refits = 0; ///< structures that were refitted to moved vertices or instances
  };

  /// Update the acceleration structure for the snapshot. Does nothing if neither topologyVersion
  /// nor positionsVersion changed. The snapshot's vertex and index arrays and texture coordinates
  /// are shared, not copied: they must stay in place until the next update.
  /// @throws std::runtime_error if there is no structure, or for casters beyond Embree's range
  Update update(const Occluders& occluders);

  /// Have traceArea() multiply each sample's ray by what a filter leaves of it; null: none. One ray
  /// a pixel, as in trace(), can be multiplied afterwards.
  /// @param filter must outlive its use
  void filterSamples(const RayFilter* filter) { this->filter_ = filter; }
  const RayFilter* filter() const { return this->filter_; }

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
  /// With a coloured filter all lights have three channels. With any filter all samples are traced,
  /// since decider, verdicts and chooser know casters that block alone.
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
    const TracedPicture picture = this->filter_
      ? TracedPicture(light, occluders, receivers, nullptr, visibility, classes, tiles, nullptr,
          &samples, nullptr, this->filter_->isColoured())
      : TracedPicture(light, occluders, receivers, decider, visibility, classes, tiles, verdicts,
          &samples, chooser);
    const std::size_t rays = this->tracePicture(picture);
    picture.finish();
    return rays;
  }

  /// Test which rays are blocked; each ray has the same answer as in a picture (trace()). Called
  /// from several threads at once.
  /// @param origins, directions centred; directions of any length
  /// @param rayFar far end of the rays, in lengths of their directions (ShadowRay.h)
  /// @param blocked set to 1 for each ray that a caster blocks, else 0
  void areBlocked(std::size_t count, const PointArrays& origins, const PointArrays& directions,
    float rayFar, std::uint8_t* blocked) const;

  std::optional<Hit> nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const override;

  /// Return the bytes that Embree reports.
  std::size_t bytes() const;
  /// Return the bytes of the table that finds each surface's structure.
  std::size_t bytesOfTable() const;

protected:
  /// Trace the rays of a tile's turned pixels, which are not needed afterwards.
  /// @param names the casters' patches, if several processes share the picture; else null
  /// @param take called with each of these pixels and whether this process's casters block its ray
  /// @return their number; 0 without casters
  std::size_t traceTurned(const TracedPicture& picture, TracedTile& tile, const PatchNames* names,
    const std::function<void(std::size_t pixel, bool isBlocked)>& take) const;
  /// @return the number of rays traced
  virtual std::size_t tracePicture(const TracedPicture& picture);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  const RayFilter* filter_ = nullptr;
};

} // namespace gnomon
