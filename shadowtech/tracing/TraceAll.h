#pragma once

#include "shadowtech/base/Technique.h"

#include <vector>

namespace gnomon
{

/// Trace every receiver's shadow rays: one, or one per sample of an area light.
void traceAllReceivers(
  const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts);

} // namespace gnomon
