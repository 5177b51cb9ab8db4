#include "plugin/frame/ValueKey.h"

namespace gnomon
{

std::set<std::string> ValueKey::changedParts(const ValueKey& other) const
{
  std::set<std::string> changed;
  for (const auto& [name, part] : this->parts_)
  {
    const auto before = other.parts_.find(name);
    if (before == other.parts_.end() || !part.areEqual(part.value, before->second.value))
    {
      changed.insert(name);
    }
  }
  for (const auto& [name, part] : other.parts_)
  {
    if (this->parts_.count(name) == 0)
    {
      changed.insert(name);
    }
  }
  return changed;
}

std::string ValueKey::changesFrom(const ValueKey& other) const
{
  std::string changes;
  for (const std::string& name : this->changedParts(other))
  {
    changes += (changes.empty() ? "" : ", ") + name;
  }
  return changes;
}

} // namespace gnomon
