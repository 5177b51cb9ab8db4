#pragma once

#include "shadowtech/tracing/ShadowTracer.h"

#include <memory>
#include <optional>

namespace gnomon
{

/// Traces shadow rays on the CPU, by Embree in robust mode, with one acceleration structure per
/// surface.
class EmbreeTracer
  : public ShadowTracer
  , public FreeSegments
  , public CasterHits
{
public:
  /// @throws std::runtime_error if Embree cannot be started
  EmbreeTracer();
  ~EmbreeTracer() override;
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  Update update(const Occluders& occluders) override;

  const FreeSegments* freeSegments() const override { return this; }
  void areFree(std::size_t count, const PointArrays& from, const PointArrays& to,
    std::uint8_t* free) const override;

  /// Test which rays are blocked; each ray has the same answer as in a picture (trace()). Called
  /// from several threads at once.
  /// @param origins, directions centred; directions of any length
  /// @param rayFar far end of the rays, in lengths of their directions (ShadowRay.h)
  /// @param blocked set to 1 for each ray that a caster blocks, else 0
  void areBlocked(std::size_t count, const PointArrays& origins, const PointArrays& directions,
    float rayFar, std::uint8_t* blocked) const;

  const CasterHits* casterHits() const override { return this; }
  std::optional<Hit> nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const override;

  /// Return the bytes that Embree reports.
  std::size_t bytes() const override;
  std::size_t bytesOfTable() const override;

protected:
  bool hasCasters() const;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
