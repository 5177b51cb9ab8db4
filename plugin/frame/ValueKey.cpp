#include "plugin/frame/ValueKey.h"

namespace gnomon
{

//------------------------------------------------------------------------------
std::string ValueKey::changesFrom(const ValueKey& other) const
{
  std::string changes;
  const auto add = [&](const std::string& name)
  { changes += (changes.empty() ? "" : ", ") + name; };
  for (const auto& [name, part] : this->parts_)
  {
    const auto before = other.parts_.find(name);
    if (before == other.parts_.end() || !part.areEqual(part.value, before->second.value))
    {
      add(name);
    }
  }
  for (const auto& [name, part] : other.parts_)
  {
    if (this->parts_.count(name) == 0)
    {
      add(name);
    }
  }
  return changes;
}

} // namespace gnomon
