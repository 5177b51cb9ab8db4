#include "plugin/frame/TechniqueCache.h"

#include <iterator>

namespace gnomon
{

LightTechnique& TechniqueCache::of(int sceneIndex, const EstimatorEntry& estimator)
{
  const std::pair key(sceneIndex, &estimator);
  auto found = this->techniques_.find(key);
  if (found == this->techniques_.end())
  {
    found = this->techniques_.emplace(key, Cached{ LightTechnique(estimator) }).first;
  }
  found->second.isUsed = true;
  return found->second.technique;
}

void TechniqueCache::dropUnless(
  const std::function<bool(int sceneIndex, const EstimatorEntry&)>& isWanted)
{
  for (auto cached = this->techniques_.begin(); cached != this->techniques_.end();)
  {
    const auto& [sceneIndex, estimator] = cached->first;
    cached = isWanted(sceneIndex, *estimator) ? std::next(cached) : this->techniques_.erase(cached);
  }
}

void TechniqueCache::keep(int sceneIndex, const EstimatorEntry& estimator)
{
  const auto found = this->techniques_.find({ sceneIndex, &estimator });
  if (found != this->techniques_.end())
  {
    found->second.isUsed = true;
  }
}

void TechniqueCache::dropUnused()
{
  for (auto cached = this->techniques_.begin(); cached != this->techniques_.end();)
  {
    const bool isUsed = std::exchange(cached->second.isUsed, false);
    cached = isUsed ? std::next(cached) : this->techniques_.erase(cached);
  }
}

std::size_t TechniqueCache::bytesOfMaps() const
{
  std::size_t bytes = 0;
  for (const auto& [key, cached] : this->techniques_)
  {
    bytes += cached.technique.technique().bytesOfMaps();
  }
  return bytes;
}

} // namespace gnomon
