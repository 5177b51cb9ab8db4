#include "shadowtech/selective/ChainTechnique.h"

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo ChainTechnique::infoOf(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.evaluation = Evaluation::ScreenCpu;
  info.needsMap = true;
  info.classes = classesOfChain();
  return info;
}

//------------------------------------------------------------------------------
MapReach ChainTechnique::mapReach(const ShadowLight&) const
{
  MapReach reach;
  reach.squareTexels = 1.5; // nine texels
  return reach;
}

//------------------------------------------------------------------------------
void ChainTechnique::bake(const MapInput& input)
{
  this->maps_.bake(input.views, input.light.mapSizeTexels, input.occluders);
}

//------------------------------------------------------------------------------
std::size_t ChainTechnique::bytesOfMaps() const
{
  return this->maps_.bytes() + this->fans_.bytes();
}

//------------------------------------------------------------------------------
void ChainTechnique::computeVisibility(
  const ScreenInput& input, std::vector<float>& visibility, LightReport& report)
{
  const ChainStages stages = this->stagesOf(input.light);
  if (stages.adjacency != Adjacency::Off)
  {
    this->fans_.update(input.occluders);
  }
  report.tracedPixels =
    static_cast<std::int64_t>(Chain(stages, this->maps_, this->fans_, input).run(visibility));
  report.rays = report.tracedPixels;
}

} // namespace gnomon
