#include "shadowtech/Registry.h"

#include "shadowtech/nsm/Nsm.h"
#include "shadowtech/pcf/Pcf.h"
#include "shadowtech/raytraced/Raytraced.h"

namespace gnomon
{

//------------------------------------------------------------------------------
const std::vector<RegistryEntry>& registry()
{
  static const std::vector<RegistryEntry> entries = {
    { Nsm::info(), [] { return std::unique_ptr<Technique>(new Nsm); } },
    { Pcf::info(), [] { return std::unique_ptr<Technique>(new Pcf); } },
    { Raytraced::info(), [] { return std::unique_ptr<Technique>(new Raytraced); } },
  };
  return entries;
}

//------------------------------------------------------------------------------
const RegistryEntry* findTechnique(const std::string& name)
{
  for (const RegistryEntry& entry : registry())
  {
    if (entry.info.name == name)
    {
      return &entry;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
std::string techniqueNames()
{
  std::string names;
  for (const RegistryEntry& entry : registry())
  {
    names += (names.empty() ? "" : ", ") + entry.info.name;
  }
  return names;
}

} // namespace gnomon
