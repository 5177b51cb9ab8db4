#include "shadowtech/exact/ExactTechniques.h"

namespace gnomon
{
namespace
{

TechniqueInfo infoOfCrsm()
{
  TechniqueInfo info = infoOfExact("crsm");
  info.asPublished = "crsm_as_published";
  info.settings.push_back(&publishedSettings());
  return info;
}

TechniqueInfo infoOfCrsma()
{
  TechniqueInfo info = infoOfExact("crsma");
  info.asPublished = "crsma_as_published";
  info.settings.push_back(&crsmaSettings());
  info.settings.push_back(&publishedSettings());
  return info;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<ConservativeEntry>& exactTechniques()
{
  static const std::vector<ConservativeEntry> entries = {
    { infoOfCrsm(), [](const ShadowSettings&) { return certainRule(Covering::Triangle); } },
    { infoOfCrsma(),
      [](const ShadowSettings& settings)
      {
        const bool fan = settings.crsma.ring == AdjacencyRing::Vertices;
        return certainRule(fan ? Covering::Fan : Covering::Ring);
      } },
    { infoOfExact("silhouette"),
      [](const ShadowSettings&) { return certainRule(Covering::Silhouette); } },
  };
  return entries;
}

} // namespace gnomon
