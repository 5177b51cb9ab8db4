#pragma once

#include "Comparison.h"
#include "Panels.h"
#include "Scene.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// What to compare.
struct ComparisonPlan
{
  /// Names of the registry, with settings if wished: "nsm", "pcf:kernel=box:projection=lispsm". The
  /// truth is added when missing.
  std::vector<std::string> techniques;
  /// Settings of all lights and of all techniques that they concern and that do not say them
  /// themselves; empty ones are none.
  std::map<std::string, std::string> settings;
  std::vector<int> mapSizesTexels; ///< for every variant that has a map
  /// Pointwise techniques take the one route that they usually take: inline, or image if they are
  /// slow. Else those below.
  bool usualRoute = false;
  bool inlineRoute = true; ///< for pointwise techniques
  bool imageRoute = true;  ///< for pointwise techniques
  int tracer = 0;          ///< a vtkGnomonShadowPass::TracerType, for all that trace
  int rasterizer = 0;      ///< a vtkGnomonShadowPass::RasterizerType, for conservative maps
  int width = 1024;
  int height = 1024;
  int frames = 21;         ///< timed frames per variant and motion; 0: only errors are asked for
  int truthSamples = 4096; ///< of each area light for every pixel, by which errors are told
};

/// The technique whose visibility is the truth. The truth of area lights takes
/// ComparisonPlan::truthSamples, while its times are of the plan's samples.
inline constexpr const char* truthTechnique = "raytraced";
/// What the truth of area lights is set to.
/// @param seed that no technique has which is compared with it
std::map<std::string, std::string> truthSettings(int samples, const std::string& seed);

/// What a comparison tells while it runs; each function may be empty.
struct ComparisonEvents
{
  /// Gets the share of the work that is done, in [0, 1], and the present step, for people.
  std::function<void(double share, const std::string& step)> progress;
  /// Gets plain VTK, vtkShadowMapPass and the truth, before the rows are set up. A panel's longer
  /// side has at most firstPanelPixels.
  std::function<void(const std::vector<Panel>&)> firstPanels;
};
inline constexpr int firstPanelPixels = 640;

/// All techniques of the registry.
std::vector<std::string> allTechniques();

/// Whether a casting light of the scene has an area, of the size that the plan gives it.
bool castsSoftShadows(const ComparisonPlan& plan, const Scene& scene);

/// The techniques to choose among. By one route and with one map size, they and the peers are at
/// most ten rows.
/// @param soft whether lights have an area
std::vector<std::string> usualTechniques(bool soft);

/// Draws the scene with every variant of the plan and with the peers (plain VTK, vtkShadowMapPass)
/// and measures errors, times and memory. Frames of all variants are interleaved. What the scene's
/// lights ask for themselves (technique, map size) is set aside: the plan decides. What they say of
/// their size stays, unless the plan has a `light_radius`. A technique whose settings make no sense
/// for one of the lights is left out, which a note says.
/// @throws BadInput when no light of the scene casts a shadow, Failure when drawing fails
ComparisonResults runComparison(
  const Scene& scene, const ComparisonPlan& plan, const ComparisonEvents& events);

} // namespace gnomon::tool
