#pragma once

#include "plugin/frame/FrameWishes.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace gnomon
{

/// Which tracer a frame takes, and why.
struct TracerChoice
{
  bool gpu = false;   ///< GpuShadowTracer; else EmbreeTracer
  bool asked = false; ///< and no other will do
  std::string reason; ///< as a clause
};

/// @param gpuLacks GpuTracer::whyUnsupported()
/// @param renderer GL_RENDERER
/// @throws std::runtime_error where the GPU is asked for and lacks something
TracerChoice chooseTracer(
  TracerWish wished, const std::string& gpuLacks, const std::string& renderer);

/// The tracer of all techniques of a frame. It is made when somebody traces and kept while the
/// choice stays the same, so that no more than one has an acceleration structure. All calls, the
/// destructor included, want the context to be current.
class FrameTracer : public FreeSegments
{
public:
  /// @param buffers of the snapshot
  FrameTracer(OccluderBuffers& buffers, ShaderLibrary& shaders);

  /// Brings the chosen tracer up to date with the snapshot. Where the GPU was not asked for and
  /// fails, Embree takes over until the snapshot's topology changes.
  /// @throws std::exception as ShadowTracer::update(); nothing is kept then
  ShadowTracer::Update update(const TracerChoice& choice, const Occluders& occluders);

  /// What update() took.
  ShadowTracer& tracer() { return *this->tracer_; }
  const TracerChoice& taken() const { return this->taken_; }
  /// Itself, where update() took a tracer that says whether segments are free; else null.
  const FreeSegments* freeSegments() const
  {
    return this->tracer_ && this->tracer_->freeSegments() ? this : nullptr;
  }
  /// The tracer's; null also where nobody has traced.
  const CasterHits* casterHits() const
  {
    return this->tracer_ ? this->tracer_->casterHits() : nullptr;
  }
  void areFree(std::size_t count, const PointArrays& from, const PointArrays& to,
    std::uint8_t* free) const override;
  /// Why Embree has taken over; empty where it has not.
  const std::string& gpuFailure() const { return this->gpuFailure_; }

  ///@{
  /// As the tracer's; 0 where nobody has traced.
  std::size_t bytes() const { return this->tracer_ ? this->tracer_->bytes() : 0; }
  std::size_t bytesOfTable() const { return this->tracer_ ? this->tracer_->bytesOfTable() : 0; }
  std::size_t bytesOfRays() const { return this->tracer_ ? this->tracer_->bytesOfRays() : 0; }
  ///@}

private:
  ShadowTracer::Update updateTaken(const TracerChoice& choice, const Occluders& occluders);

  OccluderBuffers& buffers_;
  ShaderLibrary& shaders_;
  std::unique_ptr<ShadowTracer> tracer_;
  TracerChoice taken_;
  std::string gpuFailure_;
  std::uint64_t topologyOfFailure_ = 0;
};

} // namespace gnomon
