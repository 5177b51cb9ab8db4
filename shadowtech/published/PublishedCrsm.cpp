#include "shadowtech/published/PublishedCrsm.h"

#include "shadowtech/published/PublishedMap.h"

namespace gnomon
{
namespace
{

TechniqueInfo infoOfPublished(const std::string& name)
{
  TechniqueInfo info = infoOfExact(name);
  info.settings = { &viewSettings(), &publishedSettings() };
  info.asPublished = name;
  info.exact = false;
  info.mapIsOptional = false;
  return info;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<ConservativeEntry>& publishedCrsm()
{
  static const std::vector<ConservativeEntry> entries = {
    { infoOfPublished("crsm_as_published"),
      [](const ShadowSettings&) { return publishedRule(PublishedLayers::Crsm); } },
    { infoOfPublished("crsma_as_published"),
      [](const ShadowSettings&) { return publishedRule(PublishedLayers::Crsma); } },
  };
  return entries;
}

} // namespace gnomon
