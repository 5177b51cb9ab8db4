#pragma once

#include "plugin/plan/FrameWishes.h"
#include "plugin/plan/RayIdentity.h"
#include "plugin/plan/Route.h"
#include "plugin/plan/Scene.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace gnomon
{

/// The technique that VTK's shaders call for a light.
enum class ShadedBy
{
  Fetch,   ///< nothing: they fetch its visibility
  Own,     ///< its own technique
  AtPoints ///< pointTechnique at points in no layer; opaque surfaces fetch
};

/// The points that the views of a light's map are fitted to.
enum class FitTarget
{
  None, ///< it has no map
  Casters,
  Frustum,  ///< all that the camera can see
  Receivers ///< all that it does see
};

/// A light's technique in a frame. At first a light that leaves its technique to the pass has its
/// resting one.
struct LightPlan
{
  ShadowLight light;
  const EstimatorEntry* estimator = nullptr;
  const EstimatorEntry* resting = nullptr; ///< its estimator while the picture rests
  /// The request of a light that leaves its technique to the pass: the scene's light, in world
  /// coordinates, which lasts as long as the frame's scene. Null for others.
  const ShadowLight* asked = nullptr;
  /// The largest map that a memory budget allows such a light.
  int mostMapTexels = std::numeric_limits<int>::max();
  std::string budgetReason; ///< LightReport::budgetReason
  RayIdentity identity;     ///< as its technique sees the light
  bool marches = false; ///< true if its rays march through volumes, where a VolumeStack would do
  ///@{
  /// Planned last, like all members below.
  int firstSamples = 0; ///< of the first frame, if the light's image refines; 0: all
  int channels = 1;     ///< of its visibility, a layer each
  int layer = 0;        ///< its first layer
  int bit = noBit;      ///< or its bit in the image of bits
  /// The shadow rays of the picture's pixels at edges, of a light with a bit, or whose casters let
  /// light through. Kept visibility stays that of the pixels' centres.
  int edgeSamples = 1;
  bool edgesFollow = false; ///< true if a frame smooths no edges of visibility that it computes
  ShadedBy shadedBy = ShadedBy::Fetch;
  bool surfacesFetch = true; ///< true if shaders of surfaces call nothing
  FitTarget fit = FitTarget::None;
  std::string fitReason; ///< LightReport::fitReason
  ///@}

  const TechniqueInfo& info() const { return this->estimator->info; }
  bool isSoft() const { return this->light.area || this->light.texture; }
};

struct LightPlans
{
  std::vector<LightPlan> lights; ///< that cast
  std::vector<SkippedLight> skipped;
  std::vector<std::string> misfits; ///< FrameReport::misfits
  std::vector<std::string> notes;   ///< FrameReport::notes
};

/// True if a light's visibility is exact and of one ray a point: 0 or full light.
bool isHard(const TechniqueInfo& info, const ShadowLight& light);
/// Return the number of shadow rays for a pixel's visibility at an edge. Area lights have no edges:
/// 1. So have pictures that are smoothed by themselves (LightPlan::edgeSamples).
std::size_t edgeSamplesOf(const TechniqueInfo& info, const ShadowLight& light);
/// True if a light's edges are smooth in pictures at rest, and its visibility is 0 or 1.
bool smoothsPictures(const TechniqueInfo& info, const ShadowLight& light);
/// True if one bit a pixel holds a light's visibility.
bool isBit(const TechniqueInfo& info, const ShadowLight& light);

/// Plan the techniques of a renderer's lights, and bring the lights into the scene's frame. Lights
/// with contradicting settings, or with settings beyond OpenGL's version, take the fallback
/// technique with default settings. Over several processes all lights take rays, as maps of one
/// process know its own casters alone.
LightPlans planLights(const Scene& scene, const FrameWishes& wishes);

/// Have a light's visibility computed from another light, with the same centre.
void takeLight(LightPlan& plan, Composition other);

/// Plan a light that leaves its technique to the pass as another light, for one frame.
/// @return no estimator if it is refused
Composition planAsMap(const ShadowLight& asked, int mapSizeTexels, const Scene& scene);
Composition planAsCentre(const ShadowLight& asked, const Scene& scene);

/// Return what VTK's shaders call for a light.
/// @param points true if points in no layer show shadows
ShadedBy planShading(const LightPlan& plan, Route route, bool points);

/// Return a light as pointTechnique shades it (ShadedBy::AtPoints). The light's own technique lacks
/// the settings of its filter, so these are the defaults.
ShadowLight lightAtPoints(const ShadowLight& light);

/// Plan how the picture smooths the edges of a light's shadows.
/// @param transmits FramePlan::transmits
/// @param mayFollow true if more frames at rest follow
void planEdges(LightPlan& plan, bool transmits, bool moves, bool mayFollow);

/// Plan what a light's views are fitted to: the receivers that are drawn, as they give the tightest
/// fit, unless there is a reason against it.
void planFit(LightPlan& plan, Route route, bool points, const SceneLights& scene);

} // namespace gnomon
