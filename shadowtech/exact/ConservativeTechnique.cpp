#include "shadowtech/exact/ConservativeTechnique.h"

#include "shadowtech/tracing/EmbreeTracer.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo infoOfExact(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.exact = true;
  info.settings = { &viewSettings(), &bakeSettings(), &edgeSettings() };
  info.classes = classesOfTracing();
  info.mapIsOptional = true;
  info.conservativeMap = true;
  return info;
}

//------------------------------------------------------------------------------
void ConservativeTechnique::bake(const MapInput& input)
{
  this->maps_.bake(input.light, input.views, input.occluders, this->rule_(input.light));
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
  const ScreenInput& input, std::vector<float>& visibility, LightCounts& counts)
{
  counts.tracedPixels = static_cast<std::int64_t>(
    input.tracer.trace(input.light, input.occluders, input.receivers, visibility,
      input.usesMap ? &this->maps_ : nullptr, input.classes, input.tiles, input.verdicts));
  counts.rays = counts.tracedPixels;
}

} // namespace gnomon
