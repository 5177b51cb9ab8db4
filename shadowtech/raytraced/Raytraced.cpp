#include "shadowtech/raytraced/Raytraced.h"

#include "shadowtech/tracing/EmbreeTracer.h"
#include "shadowtech/tracing/Refinement.h"
#include "shadowtech/tracing/TraceAll.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Raytraced::info()
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

//------------------------------------------------------------------------------
void Raytraced::computeVisibility(
  const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts)
{
  traceAllReceivers(input, visibility, counts);
}

} // namespace gnomon
