#pragma once

#include "plugin/frame/TechniqueCache.h"
#include "plugin/plan/FramePlan.h"
#include "shadowtech/base/vtkGnomonFrameCounts.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon
{

/// A light that casts in this frame, with the techniques that shade it.
struct CastingLight
{
  const LightPlan& plan;
  LightTechnique* own;                           ///< lasts as long as the frame, as the next
  LightTechnique* atPoints = nullptr;            ///< of ShadedBy::AtPoints; else null
  std::optional<ShadowLight> lightOfPoints = {}; ///< of `atPoints`; none without
  LightCounts counts = {};
  bool isStale = true;       ///< true if this frame computes its visibility for all pixels
  bool mayKeepTiles = false; ///< and true if the changes may leave some tiles valid
  bool smooths = false;      ///< and true if it also smooths edges of the picture
  std::optional<double> tracedShare = {}; ///< VisibilityValue::tracedShare
  double milliseconds = 0.0;              ///< that this frame took for its visibility
  /// The technique of `own` or `atPoints` that shaders call, where casters let a part of the light
  /// through; else null.
  std::shared_ptr<const PointwiseTechnique> filtered = {};

  const ShadowLight& light() const { return this->plan.light; }
  /// Return the light of pointwise().
  const ShadowLight& lightInShaders() const
  {
    return this->lightOfPoints ? *this->lightOfPoints : this->light();
  }
  const TechniqueInfo& info() const { return this->plan.info(); }
  /// True if its technique traces from receivers on the CPU.
  bool isOnCpu() const { return this->info().evaluation == Evaluation::ScreenCpu; }
  /// Return edgeSamplesOf().
  std::size_t edgeSamples() const { return edgeSamplesOf(this->info(), this->light()); }
  /// Return the technique that VTK's shaders call; null if they call none.
  const PointwiseTechnique* pointwise() const;
  /// Return the one that shaders of surfaces call.
  const PointwiseTechnique* pointwiseOfSurfaces() const
  {
    return this->plan.surfacesFetch ? nullptr : this->pointwise();
  }
};

/// The lights of a frame's plan. Each keeps its techniques from frame to frame while it asks for
/// the same estimators.
class CastingLights
{
public:
  /// Drop the techniques that a plan leaves, before others take their memory.
  /// @param ofView the view's cached techniques of lights whose maps are fitted to a camera
  void begin(const std::vector<LightPlan>& lights, TechniqueCache& ofView);
  /// Take a plan's lights, which last as long as the frame.
  void take(const std::vector<LightPlan>& lights);
  /// Return a light's technique of an estimator; a new one unless it is cached.
  LightTechnique& techniqueOf(const ShadowLight& light, const EstimatorEntry& estimator);
  /// End a frame: drop cached techniques that a later frame will not use.
  void endFrame();

  bool empty() const { return this->lights_.empty(); }
  std::size_t size() const { return this->lights_.size(); }
  std::vector<CastingLight>::iterator begin() { return this->lights_.begin(); }
  std::vector<CastingLight>::iterator end() { return this->lights_.end(); }
  std::vector<CastingLight>::const_iterator begin() const { return this->lights_.begin(); }
  std::vector<CastingLight>::const_iterator end() const { return this->lights_.end(); }

  /// Return the bytes of the maps that serve all views.
  std::size_t bytesOfMaps() const { return this->ofAllViews_.bytesOfMaps(); }

private:
  TechniqueCache& cacheOf(const ShadowLight& light);

  TechniqueCache ofAllViews_;        ///< of lights whose maps serve all views
  TechniqueCache* ofView_ = nullptr; ///< of lights whose maps are fitted to the frame's camera
  std::vector<CastingLight> lights_;
};

/// True if any light has several shadow rays for pixels at edges, of visibility or picture.
bool smoothsEdges(const CastingLights& lights);

} // namespace gnomon
