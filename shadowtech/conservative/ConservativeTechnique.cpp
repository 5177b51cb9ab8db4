#include "shadowtech/conservative/ConservativeTechnique.h"

#include "shadowtech/base/RayTracer.h"

namespace gnomon
{

//------------------------------------------------------------------------------
ConservativeTechnique::ConservativeTechnique(Covering covering)
  : maps_(covering)
{
}

//------------------------------------------------------------------------------
TechniqueInfo ConservativeTechnique::infoOf(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.evaluation = Evaluation::ScreenCpu;
  info.exact = true;
  info.classes = classesOfTracing();
  info.needsMap = true;
  return info;
}

//------------------------------------------------------------------------------
void ConservativeTechnique::bake(const MapInput& input)
{
  this->maps_.bake(input.views, input.light.mapSizeTexels, input.occluders);
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
  const std::vector<std::uint8_t> onCaster = ConservativeMaps::onCaster(input.occluders);
  report.tracedPixels = static_cast<std::int64_t>(input.tracer.trace(
    input.light, input.occluders, input.receivers, visibility,
    [&](const ReceiverTile& tile, std::vector<Certainty>& certain)
    { this->maps_.ask(tile.receivers, onCaster, certain); },
    input.classes));
}

} // namespace gnomon
