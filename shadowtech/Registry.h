#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon
{

/// An estimator's line in the registry: what decides the visibility of a point, with the map that
/// it reads.
struct EstimatorEntry
{
  TechniqueInfo info;
  std::function<AnyTechnique()> create;
};

/// All estimators.
const std::vector<EstimatorEntry>& estimators();

/// The estimator of that name; nullptr when there is none.
const EstimatorEntry* findEstimator(const std::string& name);

/// "compare, pcf, ...": for error messages.
std::string estimatorNames();

/// A technique's line: a name for an estimator and a projection.
struct TechniqueEntry
{
  std::string name;
  std::string summary; ///< one line for people
  const EstimatorEntry* estimator;
  Projection projection; ///< of no meaning where the estimator reads no map
};

/// All techniques, in the order in which they are listed to people.
const std::vector<TechniqueEntry>& registry();

/// The technique of that name; nullptr when there is none.
const TechniqueEntry* findTechnique(const std::string& name);

/// "auto, nsm, pcf, ...": for error messages.
std::string techniqueNames();

/// The name by which lights leave their technique to the pass: exact while the picture rests, and
/// what is fast enough while it moves (plugin/frame/TechniqueChoice.h).
inline constexpr const char* automaticTechnique = "auto";
inline constexpr const char* automaticSummary =
  "any: exact while the picture rests, as fast as an error allows while it moves";

/// The technique of lights and passes that name none. Stated here and nowhere else.
inline constexpr const char* defaultTechnique = automaticTechnique;

/// What shades translucent surfaces where a light's own technique works on the screen, which shows
/// only the opaque ones: a pointwise technique.
inline constexpr const char* plainTechnique = "nsm";

/// Whether an estimator has a setting. All have those that choose it, and the light's area.
bool has(const TechniqueInfo& info, const std::string& settingName);

/// The values of an estimator's settings: of all of them, or of those that its map is baked with.
enum class SettingsOf
{
  Estimator,
  Map
};
std::vector<std::string> valuesOf(
  const TechniqueInfo& info, SettingsOf of, const ShadowSettings& settings);

/// Whether a setting describes the light itself, so that all techniques have it.
bool isOfLight(const Setting& setting);

/// "pcf, vsm": the techniques with a table's settings; empty where all have them.
std::string techniquesWith(const SettingsTable& table);

/// "the setting 'contour' is for: selective", for settings that a technique does not have.
std::string whoHas(const std::string& settingName);

/// A light's settings ask for what there is not, or for what makes no sense.
class CompositionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Whether they leave the technique to the pass. Settings that name an estimator do not: what makes
/// up for the technique is the plain one then.
bool isAutomatic(const ShadowSettings& settings);

/// The estimator that settings lead to, for lights of any kind; where they leave it to the pass,
/// that of hard shadows at rest.
/// @throws CompositionError for names that do not exist
const EstimatorEntry& estimatorOf(const ShadowSettings& settings);

/// The same of a light as it is, whose shadows may be soft.
/// @throws CompositionError for names that do not exist
const EstimatorEntry& estimatorOfLight(const ShadowLight& light);

/// The same for a light, whose settings must make sense together, of a resting picture. Completes
/// the light: its technique, its estimator and its projection say what they are.
/// @throws CompositionError with the reason
const EstimatorEntry& compose(ShadowLight& light);

} // namespace gnomon
