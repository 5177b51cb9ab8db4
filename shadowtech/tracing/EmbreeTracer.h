#pragma once

#include "shadowtech/tracing/ShadowTracer.h"

#include <memory>
#include <optional>

namespace gnomon
{

/// Shadow rays on the CPU, by Embree in robust mode. It has a structure for each surface.
class EmbreeTracer
  : public ShadowTracer
  , public FreeSegments
  , public CasterHits
{
public:
  /// @throws std::runtime_error where Embree cannot be started
  EmbreeTracer();
  ~EmbreeTracer() override;
  EmbreeTracer(const EmbreeTracer&) = delete;
  EmbreeTracer& operator=(const EmbreeTracer&) = delete;

  Update update(const Occluders& occluders) override;

  const FreeSegments* freeSegments() const override { return this; }
  void areFree(std::size_t count, const PointArrays& from, const PointArrays& to,
    std::uint8_t* free) const override;

  const CasterHits* casterHits() const override { return this; }
  std::optional<Hit> nearest(
    const glm::vec3& origin, const glm::vec3& direction, float after, float until) const override;

  /// As Embree reports it.
  std::size_t bytes() const override;
  std::size_t bytesOfTable() const override;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
