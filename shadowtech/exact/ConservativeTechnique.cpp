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

//------------------------------------------------------------------------------
const std::vector<ConservativeEntry>& exactTechniques()
{
  static const std::vector<ConservativeEntry> entries = []
  {
    TechniqueInfo crsm = infoOfExact("crsm");
    crsm.asPublished = "crsm_as_published";
    crsm.settings.push_back(&publishedSettings());
    TechniqueInfo crsma = infoOfExact("crsma");
    crsma.asPublished = "crsma_as_published";
    crsma.settings.insert(crsma.settings.end(), { &crsmaSettings(), &publishedSettings() });
    return std::vector<ConservativeEntry>{
      { crsm, [](const ShadowSettings&) { return certainRule(Covering::Triangle); } },
      { crsma,
        [](const ShadowSettings& settings)
        {
          const bool fan = settings.crsma.ring == AdjacencyRing::Vertices;
          return certainRule(fan ? Covering::Fan : Covering::Ring);
        } },
      { infoOfExact("silhouette"),
        [](const ShadowSettings&) { return certainRule(Covering::Silhouette); } },
    };
  }();
  return entries;
}

} // namespace gnomon
