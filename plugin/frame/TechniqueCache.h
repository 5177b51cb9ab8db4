#pragma once

#include "plugin/frame/LightTechnique.h"

#include <cstddef>
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
