#pragma once

#include "lights/ShadowLight.h"
#include "shadowtech/base/Technique.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon
{

/// An estimator's entry in the registry. An estimator decides the visibility of a point, with the
/// map that it reads.
struct EstimatorEntry
{
  TechniqueInfo info;
  std::function<AnyTechnique()> create;
};

const std::vector<EstimatorEntry>& estimators();

const EstimatorEntry* findEstimator(const std::string& name);

/// Return the estimators' names for error messages: "compare, pcf, ...".
std::string estimatorNames();

/// A technique's entry: a name for an estimator and a projection.
struct TechniqueEntry
{
  std::string name;
  std::string summary; ///< for users, one line
  const EstimatorEntry* estimator;
  Projection projection; ///< unused if the estimator reads no map
};

/// Return all techniques, in the order in which users see them listed.
const std::vector<TechniqueEntry>& registry();

const TechniqueEntry* findTechnique(const std::string& name);

/// Return the techniques' names for error messages: "auto, nsm, pcf, ...".
std::string techniqueNames();

/// The name by which a light leaves its technique to the pass. The pass chooses an exact technique
/// while the picture rests, and a fast enough one while it moves (plugin/plan/AutoPlan.h).
inline constexpr const char* automaticTechnique = "auto";

/// Its choices while the picture rests, for lights with hard and with soft shadows.
inline constexpr const char* restingHard = "silhouette";
inline constexpr const char* restingSoft = "penumbra";
inline constexpr const char* automaticSummary =
  "any: exact while the picture rests, as fast as an error allows while it moves";

/// The technique of lights and passes that name none. No other file states this default.
inline constexpr const char* defaultTechnique = automaticTechnique;

/// The plain shadow map: the technique of lights that cannot have theirs.
inline constexpr const char* plainTechnique = "nsm";

/// The pointwise technique that shades points in no layer, such as those of translucent surfaces,
/// where the light's own technique works on the screen: screen techniques cover opaque surfaces.
inline constexpr const char* pointTechnique = "pcf";

///@{
/// True if an estimator has a setting. All estimators have the settings that choose a technique,
/// and those of the light's area.
bool has(const TechniqueInfo& info, const Setting& setting);
bool has(const TechniqueInfo& info, const std::string& settingName);
///@}

/// Which settings settingsOf() returns: all of the estimator, or those that its map is baked with.
enum class SettingsOf
{
  Estimator,
  Map
};
/// Return an estimator's settings, for keys. All others have their defaults.
ShadowSettings settingsOf(const TechniqueInfo& info, SettingsOf of, const ShadowSettings& settings);

/// Return a setting's default value as text; empty without one.
std::string defaultOf(const Setting& setting);

/// True if a setting describes the light itself, so that all techniques have it.
bool isOfLight(const Setting& setting);

/// Return the techniques that have a table's settings ("pcf, vsm"); empty if all have them.
std::string techniquesWith(const SettingsTable& table);

/// Return the error for a setting that a technique lacks: "the setting 'contour' is for:
/// selective".
std::string whoHas(const Setting& setting);

/// A light's settings name something that does not exist, or contradict each other.
class CompositionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// True if the settings leave the technique to the pass. Settings that name an estimator do not:
/// plainTechnique then supplies everything else.
inline bool isAutomatic(const ShadowSettings& settings)
{
  const std::string name = settings.technique.empty() ? defaultTechnique : settings.technique;
  return name == automaticTechnique && settings.estimator.empty();
}

/// Return the estimator that settings select, for lights of any kind. If the settings leave the
/// technique to the pass, it is that of hard shadows at rest.
/// @throws CompositionError for names that do not exist
const EstimatorEntry& estimatorOf(const ShadowSettings& settings);

/// Return the estimator that a light's settings select. If they leave the technique to the pass,
/// the light's shadows at rest may be soft.
/// @throws CompositionError for names that do not exist
const EstimatorEntry& estimatorOfLight(const ShadowLight& light);

/// Return the estimator of a light whose picture rests, after checking that its settings agree with
/// each other. Fills in the light's technique, estimator and projection.
/// @throws CompositionError with the reason
const EstimatorEntry& compose(ShadowLight& light);

} // namespace gnomon
