#include "plugin/frame/ValueKey.h"

#include "plugin/scene/Hash.h"

#include <algorithm>

namespace gnomon
{

//------------------------------------------------------------------------------
std::size_t ValueKey::hash() const
{
  std::size_t seed = 0;
  for (const Part& part : this->parts_)
  {
    hashCombine(seed, part.hash);
  }
  return seed;
}

//------------------------------------------------------------------------------
std::string ValueKey::changesFrom(const ValueKey& other) const
{
  std::string changes;
  for (const Part& part : this->parts_)
  {
    if (std::find(other.parts_.begin(), other.parts_.end(), part) == other.parts_.end())
    {
      changes += (changes.empty() ? "" : ", ") + part.name;
    }
  }
  return changes;
}

} // namespace gnomon
