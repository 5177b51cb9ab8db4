#pragma once

#include "plugin/frame/FrameWishes.h"
#include "plugin/ranks/Ranks.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace gnomon
{

/// A frame's tracer, and why.
struct TracerChoice
{
  bool gpu = false;   ///< GpuShadowTracer; else EmbreeTracer
  bool asked = false; ///< the user asked for it, so there is no fallback
  std::string reason; ///< as a clause
  /// The processes whose casters block rays, too (SharedTracer); null: this one's alone.
  Ranks* ranks = nullptr;
  std::uint64_t ranksSerial = 0; ///< Ranks::serial(); 0: no ranks
};

/// Return the tracer of a frame.
/// @param gpuLacks GpuTracer::whyUnsupported()
/// @param renderer GL_RENDERER
/// @param ranks the processes that draw the picture; null: this one alone
/// @throws std::runtime_error if the GPU is asked for and lacks a feature
TracerChoice chooseTracer(TracerWish wished, const std::string& gpuLacks,
  const std::string& renderer, Ranks* ranks = nullptr);

/// The tracer of all techniques of a frame. It is made for the first trace and cached while the
/// choice stays the same, so only one has an acceleration structure. All calls, the destructor
/// included, need a current context.
class FrameTracer : public FreeSegments
{
public:
  /// @param buffers of the snapshot
  FrameTracer(OccluderBuffers& buffers, ShaderLibrary& shaders);

  /// Update the chosen tracer to the snapshot. If the GPU was not asked for and fails, Embree is
  /// the fallback until the snapshot's topology changes.
  /// @throws std::exception as ShadowTracer::update(); then no tracer is left
  ShadowTracer::Update update(const TracerChoice& choice, const Occluders& occluders);

  /// Return the tracer of the last update().
  ShadowTracer& tracer() { return *this->tracer_; }
  const TracerChoice& taken() const { return this->taken_; }
  /// Return this if the tracer can test whether segments are free; else null.
  const FreeSegments* freeSegments() const
  {
    return this->tracer_ && this->tracer_->freeSegments() ? this : nullptr;
  }
  /// Return the tracer's; null also if nothing was traced.
  const CasterHits* casterHits() const
  {
    return this->tracer_ ? this->tracer_->casterHits() : nullptr;
  }
  void areFree(std::size_t count, const PointArrays& from, const PointArrays& to,
    std::uint8_t* free) const override;
  /// Return why Embree is the fallback; empty if it is not.
  const std::string& gpuFailure() const { return this->gpuFailure_; }

  ///@{
  /// As the tracer's; 0 if nothing was traced.
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
