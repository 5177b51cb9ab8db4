#pragma once

#include "lights/LightManager.h"
#include "lights/SceneFrame.h"
#include "lights/vtkGnomonVersions.h"
#include "plugin/frame/TechniqueCache.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/RayIdentity.h"
#include "shadowtech/base/VisibilityLayers.h"
#include "shadowtech/base/vtkGnomonFrameReport.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// A light that casts in this frame, with the techniques that shade it.
struct CastingLight
{
  LightTechnique* own = nullptr; ///< never null; lasts as long as the frame
  /// Shades translucent surfaces if the light's own technique works on the screen. Else null.
  LightTechnique* plain = nullptr;
  ShadowLight light;
  RayIdentity identity;        ///< of `light`
  int channels = 1;            ///< of its visibility, a layer each
  int layer = 0;               ///< its first visibility layer
  int bit = noBit;             ///< or its bit in the image of bits
  bool shadesAtPoints = false; ///< true if shaders call a technique for it
  bool isStale = true;         ///< image route: true if this frame computes its visibility
  bool mayKeepTiles = false;   ///< and true if the changes may leave some tiles valid
  std::optional<double> tracedShare = std::nullopt; ///< VisibilityValue::tracedShare
  /// Samples of the first frame of an area light that may refine at rest; 0: all.
  int firstSamples = 0;
  /// The largest map that a memory budget allows a light that leaves its technique to the pass.
  int mostMapTexels = std::numeric_limits<int>::max();
  /// The request of a light that leaves its technique to the pass; none for others.
  std::optional<ShadowLight> asked = std::nullopt;
};

/// True if a light's technique traces from receivers on the CPU.
bool isOnCpu(const CastingLight& casting);
/// Return the number of shadow rays for a pixel at an edge. Area lights have no edges: 1.
std::size_t edgeSamplesOf(const CastingLight& casting);

/// True if OpenGL is new enough (4.3) for techniques that work on the GPU. Needs a current context.
bool canDrawMaps();

/// The lights stage: the lights of a renderer that cast, in the scene's order. Each keeps its
/// technique while it asks for the same estimator.
class CastingLights
{
public:
  /// Read the present lights, and report the outcome for each.
  /// @param ofView the view's cached techniques of lights whose maps are fitted to a camera
  void collect(vtkRenderer* renderer, const ShadowSettings& defaults, const FrameWishes& wishes,
    TechniqueCache& ofView, FrameReport& report);

  /// Bring the lights into the scene's frame. Those that cannot shine there are skipped.
  void enter(const SceneFrame& frame, FrameReport& report);

  /// Shade a light by another composition in this frame.
  void take(CastingLight& casting, Composition other, FrameReport& report);

  /// Return the technique by which the shader computes a light's visibility on a route; null if it
  /// only fetches.
  /// @param translucentReceivers true if translucent surfaces receive
  const PointwiseTechnique* pointwiseOn(
    CastingLight& casting, Route route, bool translucentReceivers);

  /// Return a light as a map or its area's centre shows it (planAsMap(), planAsCentre()).
  Composition asMap(const CastingLight& casting, int mapSizeTexels) const
  {
    return planAsMap(*casting.asked, mapSizeTexels, this->compose_);
  }
  Composition asCentre(const CastingLight& casting) const
  {
    return planAsCentre(*casting.asked, this->compose_);
  }
  /// Return a light's cached technique of an estimator.
  LightTechnique& techniqueOf(const Composition& composition)
  {
    return this->cacheOf(composition.light)
      .of(composition.light.sceneIndex, *composition.estimator);
  }
  const Compose& compose() const { return this->compose_; }

  /// End a frame: drop cached techniques that a later frame will not use.
  void endFrame();

  bool empty() const { return this->lights_.empty(); }
  std::size_t size() const { return this->lights_.size(); }
  std::vector<CastingLight>::iterator begin() { return this->lights_.begin(); }
  std::vector<CastingLight>::iterator end() { return this->lights_.end(); }
  std::vector<CastingLight>::const_iterator begin() const { return this->lights_.begin(); }
  std::vector<CastingLight>::const_iterator end() const { return this->lights_.end(); }

  /// True if a predicate holds for any of their techniques.
  template <typename IsSuch>
  bool anyTechnique(const IsSuch& isSuch) const
  {
    return std::any_of(this->lights_.begin(), this->lights_.end(),
      [&](const CastingLight& casting) { return isSuch(casting.own->info()); });
  }

  /// Return the bytes of the maps that serve all views.
  std::size_t bytesOfMaps() const { return this->ofAllViews_.bytesOfMaps(); }

  ///@{
  /// Return the number of their visibility layers, and of their bits.
  int layers() const { return this->layers_; }
  int bits() const { return this->bits_; }
  ///@}

private:
  void placeVisibility();
  TechniqueCache& cacheOf(const ShadowLight& light);

  LightManager manager_;
  Compose compose_;                  ///< of this frame's context
  TechniqueCache ofAllViews_;        ///< of lights whose maps serve all views
  TechniqueCache* ofView_ = nullptr; ///< of lights whose maps are fitted to the frame's camera
  std::vector<CastingLight> lights_; ///< by their index in the scene
  int layers_ = 0;
  int bits_ = 0;
};

/// True if any light has several shadow rays for pixels at edges.
bool smoothsEdges(const CastingLights& lights);

/// Return a light's entry in the report.
LightReport& reportOf(FrameReport& report, const ShadowLight& light);

} // namespace gnomon
