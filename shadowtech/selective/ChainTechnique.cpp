#include "shadowtech/selective/ChainTechnique.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
TechniqueInfo ChainTechnique::infoOf(const std::string& name)
{
  TechniqueInfo info;
  info.name = name;
  info.evaluation = Evaluation::ScreenCpu;
  info.needsMap = true;
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
  const std::vector<PixelClass> classes =
    Chain(stages, this->maps_, this->fans_, input.light, input.occluders, input.receivers)
      .classes();
  std::vector<Certainty> certain(classes.size());
  std::transform(classes.begin(), classes.end(), certain.begin(), certaintyOf);
  report.tracedPixels = static_cast<std::int64_t>(
    input.tracer.trace(input.light, input.occluders, input.receivers, visibility, certain));
}

} // namespace gnomon
