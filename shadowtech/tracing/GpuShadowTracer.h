#pragma once

#include "shadowtech/tracing/GpuTracer.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Shadow rays on the GPU (GpuTracer): those that a picture needs are collected first, and traced
/// all together; of an area light some samples at a time. It has one structure for all surfaces.
/// All calls, the destructor included, want the context to be current.
class GpuShadowTracer : public ShadowTracer
{
public:
  /// @param buffers of the snapshot, which update() brings up to date
  GpuShadowTracer(OccluderBuffers& buffers, ShaderLibrary& shaders);

  Update update(const Occluders& occluders) override;

  std::size_t bytes() const override;
  std::size_t bytesOfRays() const override;

private:
  std::size_t tracePicture(const TracedPicture& picture) override;
  std::size_t collectRays(const TracedPicture& picture, const TracedPicture::SampleRange& samples);

  OccluderBuffers& buffers_;
  ShaderLibrary& shaders_;
  GpuTracer tracer_;
  /// Room for some samples' rays of all pixels. They begin tile by tile where all of a tile's
  /// would, and then side by side.
  std::vector<TracedRay> rays_;
  std::vector<float> samplesOfRays_; ///< how many samples each of them stands for, by channel
  std::vector<std::uint8_t> blocked_;
};

} // namespace gnomon
