#include "shadowtech/raytraced/Raytraced.h"

#include "shadowtech/tracing/ShadowTracer.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo Raytraced::info()
{
  TechniqueInfo info;
  info.name = "raytraced";
  info.evaluation = Evaluation::ScreenCpu;
  info.exact = true;
  info.classes = classesOfTracing();
  return info;
}

//------------------------------------------------------------------------------
void Raytraced::computeVisibility(
  const ScreenInput& input, std::vector<float>& visibility, LightReport& report)
{
  report.tracedPixels = static_cast<std::int64_t>(input.tracer.trace(
    input.light, input.occluders, input.receivers, visibility, nullptr, input.classes));
}

} // namespace gnomon
