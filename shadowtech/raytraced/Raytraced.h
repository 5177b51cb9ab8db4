#pragma once

#include "shadowtech/base/Technique.h"
#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/Refinement.h"
#include "shadowtech/tracing/TraceAll.h"

namespace gnomon
{

/// `raytraced`: one shadow ray per pixel, or for area lights one to each of `light_samples` points.
/// It is the reference for all other techniques.
class Raytraced : public CpuScreenTechnique
{
public:
  static TechniqueInfo info()
  {
    TechniqueInfo info;
    info.name = "raytraced";
    info.exact = true;
    info.settings = { &edgeSettings(), &lightSampleSettings(), &lightSeedSettings(),
      &refinementSettings() };
    info.refused = { refusedSamples, refusedMovingSamples };
    info.seesTextures = true;
    info.marchesVolumes = true;
    info.classes = classesOfTracing();
    return info;
  }

  void computeVisibility(
    const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts) override
  {
    traceAllReceivers(input, visibility, counts);
  }
};

} // namespace gnomon
