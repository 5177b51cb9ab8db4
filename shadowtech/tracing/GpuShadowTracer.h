#pragma once

#include "shadowtech/tracing/GpuTracer.h"
#include "shadowtech/tracing/ShadowTracer.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

/// Traces shadow rays on the GPU (GpuTracer). It first collects the rays of a picture, then traces
/// them all together; for an area light, some samples at a time. One structure holds all surfaces.
/// All calls, the destructor included, need the context to be current.
class GpuShadowTracer : public ShadowTracer
{
public:
  /// @param buffers of the snapshot; update() updates them
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
  /// Room for the rays of some samples of all pixels. Rays are written to a range per tile, then
  /// packed.
  std::vector<TracedRay> rays_;
  std::vector<float> samplesOfRays_; ///< how many samples each ray stands for, by channel
  std::vector<std::uint8_t> blocked_;
};

} // namespace gnomon
