#pragma once

#include "shadowtech/base/Technique.h"

#include <vector>

namespace gnomon
{

/// Traces every receiver's shadow rays: one, or as many as an area light has samples.
void traceAllReceivers(
  const ScreenInput& input, std::vector<float>& visibility, LightReport& report);

} // namespace gnomon
