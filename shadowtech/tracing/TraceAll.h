#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <vector>

namespace gnomon
{

/// Trace every receiver's shadow rays: one, or one per sample of an area light.
inline void traceAllReceivers(
  const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts)
{
  const bool soft = input.light.area.has_value();
  counts.lightSamples = soft ? input.light.lightSamples : 1;
  const std::size_t rays = soft
    ? input.tracer.traceArea(input.light, input.occluders, input.receivers, visibility, nullptr,
        input.classes, nullptr, input.tiles, input.verdicts)
    : input.tracer.trace(input.light, input.occluders, input.receivers, visibility, nullptr,
        input.classes, input.tiles, input.verdicts);
  counts.rays = static_cast<std::int64_t>(rays);
  counts.tracedPixels = counts.rays / counts.lightSamples;
}

} // namespace gnomon
