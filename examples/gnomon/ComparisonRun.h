#pragma once

#include "Comparison.h"
#include "Scene.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

struct ComparisonPlan
{
  /// Names of the registry, with optional settings: "nsm", "pcf:kernel=box:projection=lispsm". A
  /// missing truth is added.
  std::vector<std::string> techniques;
  /// Settings of all lights, for techniques that have them and do not set them themselves.
  std::map<std::string, std::string> settings;
  std::vector<int> mapSizesTexels; ///< for each variant with a map
  /// Routes of pointwise techniques; empty: the usual one, inline, or image if they are slow.
  std::vector<int> routes;
  int width = 1024;
  int height = 1024;
  int frames = 21;         ///< timed frames per variant and motion; 0: errors only
  int truthSamples = 4096; ///< samples per area light and pixel of the truth
};

struct VariantPictures
{
  Picture picture;
  Picture errors; ///< see errorPicture()
  /// The classes of the first light that has them, in their colours; without pixels if none has.
  Picture classes;
  std::optional<Place> worst; ///< its most wrong place; none if it is right everywhere
};

/// The interface between measuring and writing.
struct ComparisonResults
{
  /// All numbers, as results.json has them: shares as fractions, times in milliseconds, memory in
  /// bytes.
  nlohmann::ordered_json json;
  bool soft = false; ///< true if a casting light has an area
  std::vector<VariantPictures> pictures;
};

/// The technique whose visibility is the truth. For area lights, the truth has
/// ComparisonPlan::truthSamples; its times are those of the plan's samples.
inline constexpr const char* truthTechnique = "raytraced";
/// Return the settings of the truth of area lights.
/// @param seed differs from those of all compared techniques
std::map<std::string, std::string> truthSettings(int samples, const std::string& seed);

/// The callbacks of a running comparison. Each may be empty.
struct ComparisonEvents
{
  /// Receives the finished share of the work, in [0, 1], and the current step, for users.
  std::function<void(double share, const std::string& step)> progress;
  /// Receives plain VTK, vtkShadowMapPass and the truth, before the rows are set up. A panel's
  /// longer side has at most firstPanelPixels.
  std::function<void(const std::vector<Panel>&)> firstPanels;
};
inline constexpr int firstPanelPixels = 640;

std::vector<std::string> allTechniques();

/// True if a casting light of the scene has an area of the plan's size.
bool castsSoftShadows(const ComparisonPlan& plan, const Scene& scene);

/// Return the recommended techniques. With one route and one map size, they and the peers are at
/// most ten rows.
/// @param soft true if lights have an area
std::vector<std::string> usualTechniques(bool soft);

/// Render the scene with each variant of the plan and with the peers (plain VTK, vtkShadowMapPass),
/// and measure errors, times and memory. Frames of all variants are interleaved. The plan overrides
/// the technique and map size of the scene's lights. Their sizes stay, unless the plan has a
/// `light_radius`. A technique is left out, with a note, if a light refuses its settings.
/// @throws BadInput if no light of the scene casts a shadow, Failure if rendering fails
ComparisonResults runComparison(
  const Scene& scene, const ComparisonPlan& plan, const ComparisonEvents& events);

} // namespace gnomon::tool
