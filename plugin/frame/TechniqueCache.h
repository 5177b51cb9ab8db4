#pragma once

#include "plugin/frame/LightTechnique.h"

#include <cstddef>
#include <functional>
#include <map>
#include <utility>

namespace gnomon
{

/// Lights' techniques with their maps, cached from frame to frame by light and estimator.
class TechniqueCache
{
public:
  /// Return a light's technique; a new one unless it is cached. It lasts until dropUnused().
  LightTechnique& of(int sceneIndex, const EstimatorEntry& estimator);
  /// Drop techniques for which a predicate does not hold, before others take their memory.
  void dropUnless(const std::function<bool(int sceneIndex, const EstimatorEntry&)>& isWanted);
  /// Keep a technique that this frame does not use, if it is cached.
  void keep(int sceneIndex, const EstimatorEntry& estimator);
  /// End a frame: drop techniques that it neither used nor kept.
  void dropUnused();

  std::size_t bytesOfMaps() const;

private:
  struct Cached
  {
    LightTechnique technique;
    bool isUsed = true;
  };
  std::map<std::pair<int, const EstimatorEntry*>, Cached> techniques_;
};

} // namespace gnomon
