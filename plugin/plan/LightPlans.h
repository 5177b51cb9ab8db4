#pragma once

#include "lights/Bounds.h"
#include "lights/LightManager.h"
#include "plugin/plan/FrameWishes.h"
#include "shadowtech/Registry.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gnomon
{

/// A light whose settings are completed for an estimator.
struct Composition
{
  ShadowLight light;
  const EstimatorEntry* estimator = nullptr; ///< null: refused
  std::string refusal;                       ///< why, as a clause
};
/// Completes a light on this machine. The same light gives the same composition.
using Compose = std::function<Composition(ShadowLight)>;

/// What is known of a renderer's lights.
struct SceneLights
{
  LightSet set;
  Compose compose;
  bool drawsMaps = true;  ///< OpenGL is new enough for techniques on the GPU
  int mostMapSamples = 1; ///< that OpenGL supports for maps of moments, if any light has several
  std::size_t pixels = 0; ///< of the renderer
  Bounds seenWorld;       ///< of its visible props; needed under a memory budget alone
};

/// A light's technique in a frame. A light that leaves its technique to the pass has its resting
/// one here.
struct LightPlan
{
  ShadowLight light;
  const EstimatorEntry* estimator = nullptr;
  /// The request of a light that leaves its technique to the pass; none for others.
  std::optional<ShadowLight> asked;
  /// The largest map that a memory budget allows such a light.
  int mostMapTexels = std::numeric_limits<int>::max();
  std::string budgetReason; ///< LightReport::budgetReason
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
/// Return the number of shadow rays for a pixel at an edge. Area lights have no edges: 1.
std::size_t edgeSamplesOf(const TechniqueInfo& info, const ShadowLight& light);
/// True if one bit a pixel holds a light's visibility.
bool isBit(const TechniqueInfo& info, const ShadowLight& light);

/// Plan the techniques of a renderer's lights. Lights with contradicting settings, or with settings
/// beyond OpenGL's version, take the fallback technique with default settings. Over several
/// processes all lights take rays, as maps of one process know its own casters alone.
LightPlans planLights(SceneLights scene, const FrameWishes& wishes);

/// Plan a light that leaves its technique to the pass as another light, for one frame.
/// @return no estimator if it is refused
Composition planAsMap(const ShadowLight& asked, int mapSizeTexels, const Compose& compose);
Composition planAsCentre(const ShadowLight& asked, const Compose& compose);

} // namespace gnomon
