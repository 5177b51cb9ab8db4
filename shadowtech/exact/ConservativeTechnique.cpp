#include "shadowtech/exact/ConservativeTechnique.h"

#include "shadowtech/tracing/ShadowTracer.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo ConservativeTechnique::infoOf(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.evaluation = Evaluation::ScreenCpu;
  info.exact = true;
  info.classes = classesOfTracing();
  info.needsMap = true;
  info.mapIsOptional = true;
  info.conservativeMap = true;
  return info;
}

//------------------------------------------------------------------------------
void ConservativeTechnique::bake(const MapInput& input)
{
  this->maps_.bake(
    input.light, input.views, input.occluders, this->rule(input.light, input.cellsOnGpu));
}

//------------------------------------------------------------------------------
void ConservativeTechnique::dropMaps()
{
  this->maps_.clear();
}

//------------------------------------------------------------------------------
std::size_t ConservativeTechnique::bytesOfMaps() const
{
  return this->maps_.bytes();
}

//------------------------------------------------------------------------------
void ConservativeTechnique::computeVisibility(
  const ScreenInput& input, std::vector<float>& visibility, LightReport& report)
{
  report.tracedPixels = static_cast<std::int64_t>(input.tracer.trace(input.light, input.occluders,
    input.receivers, visibility, input.usesMap ? &this->maps_ : nullptr, input.classes));
  report.rays = report.tracedPixels;
}

} // namespace gnomon
