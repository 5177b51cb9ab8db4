#include "shadowtech/Registry.h"

#include "lights/LightViews.h"
#include "shadowtech/depth_map/Pcf.h"
#include "shadowtech/exact/ConservativeTechnique.h"
#include "shadowtech/moment_map/MomentEstimators.h"
#include "shadowtech/montecarlo/MonteCarlo.h"
#include "shadowtech/pcss/Pcss.h"
#include "shadowtech/penumbra/Penumbra.h"
#include "shadowtech/planar/Planar.h"
#include "shadowtech/published/PublishedMap.h"
#include "shadowtech/published/PublishedPcss.h"
#include "shadowtech/raytraced/Raytraced.h"
#include "shadowtech/sampled/Sampled.h"
#include "shadowtech/selective/ChainTechnique.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

namespace gnomon
{
namespace
{

template <typename Estimator>
constexpr Evaluation evaluationOf()
{
  return std::is_base_of_v<PointwiseTechnique, Estimator> ? Evaluation::Pointwise
    : std::is_base_of_v<GpuScreenTechnique, Estimator>    ? Evaluation::ScreenGpu
                                                          : Evaluation::ScreenCpu;
}

/// @param of arguments of the instances' constructor
template <typename Estimator, typename... Of>
EstimatorEntry makeEntry(TechniqueInfo info, const Of&... of)
{
  info.evaluation = evaluationOf<Estimator>();
  return { std::move(info), [of...] { return std::make_unique<Estimator>(of...); } };
}

template <typename Estimator>
EstimatorEntry entry()
{
  return makeEntry<Estimator>(Estimator::info());
}

EstimatorEntry entryOf(Pcf::Kernel kernel)
{
  return makeEntry<Pcf>(Pcf::info(kernel), kernel);
}

EstimatorEntry entryOf(const MomentEstimator& estimator)
{
  return makeEntry<MomentMapTechnique>(estimator.info, estimator);
}

EstimatorEntry entryOf(const ChainEntry& chain)
{
  return makeEntry<ChainTechnique>(chain.info, chain.stagesOf);
}

EstimatorEntry entryOf(const ConservativeEntry& conservative)
{
  return makeEntry<ConservativeTechnique>(conservative.info, conservative.rule);
}

const std::string& nameOf(const EstimatorEntry& entry)
{
  return entry.info.name;
}

const std::string& nameOf(const TechniqueEntry& entry)
{
  return entry.name;
}

template <typename Entry>
const Entry* find(const std::vector<Entry>& entries, const std::string& name)
{
  const auto found = std::find_if(
    entries.begin(), entries.end(), [&](const Entry& entry) { return nameOf(entry) == name; });
  return found == entries.end() ? nullptr : &*found;
}

template <typename Entry>
std::vector<std::string> namesOf(const std::vector<Entry>& entries)
{
  std::vector<std::string> names;
  for (const Entry& entry : entries)
  {
    names.push_back(nameOf(entry));
  }
  return names;
}

std::vector<EstimatorEntry> makeEstimators()
{
  std::vector<EstimatorEntry> entries = {
    entryOf(Pcf::Kernel::JitteredDisc),
    entry<Compare>(),
    entryOf(Pcf::Kernel::Chosen),
    entry<Pcss>(),
    entry<PublishedPcss>(),
    entryOf(singleExponential()),
    entryOf(variance()),
    entryOf(exponential()),
    entryOf(fourMoments()),
    entry<MonteCarlo>(),
    entry<Planar>(),
    entry<Raytraced>(),
    entry<Sampled>(),
    entryOf(coherence()),
    entryOf(selective()),
    entry<Penumbra>(),
  };
  for (const auto& table : { exactTechniques(), publishedCrsm() })
  {
    for (const ConservativeEntry& conservative : table)
    {
      entries.push_back(entryOf(conservative));
    }
  }
  return entries;
}

bool contains(const SettingsTable& table, const Setting& setting)
{
  return std::any_of(table.settings.begin(), table.settings.end(),
    [&](const Setting& each) { return &each == &setting; });
}

std::string nameOfTechnique(const ShadowSettings& settings)
{
  const std::string name = settings.technique.empty() ? defaultTechnique : settings.technique;
  return isAutomatic(settings) ? restingHard : name == automaticTechnique ? plainTechnique : name;
}

/// True if a light leaves its technique to the pass and its shadows may be soft.
bool restsSoftly(const ShadowLight& light)
{
  return isAutomatic(light) && (light.area || light.texture);
}

} // namespace

const std::vector<EstimatorEntry>& estimators()
{
  static const std::vector<EstimatorEntry> entries = makeEstimators();
  return entries;
}

const std::vector<TechniqueEntry>& registry()
{
  static const std::vector<TechniqueEntry> entries = {
    { "nsm", "hard: the plain shadow map, free of acne without a bias to tune",
      findEstimator("compare"), Projection::Uniform },
    { "pcf", "hard, smoothed: the plain shadow map with percentage closer filtering",
      findEstimator("pcf"), Projection::Uniform },
    { "pcss", "soft: percentage closer soft shadows, penumbrae as wide as an area light makes them",
      findEstimator("pcss"), Projection::Uniform },
    { "esm", "smoothed: exponential shadow map with one moment, as VTK's own pass has",
      findEstimator("single_exponential"), Projection::Uniform },
    { "vsm", "smoothed: variance shadow map, filtered at a cost that does not depend on the width",
      findEstimator("variance"), Projection::Uniform },
    { "evsm", "smoothed: exponential variance shadow map, which lets less light bleed through",
      findEstimator("exponential"), Projection::Uniform },
    { "msm", "smoothed: moment shadow map of four moments, which lets the least light through",
      findEstimator("moments"), Projection::Uniform },
    { "adaptive",
      "hard, smoothed: percentage closer filtering over a jittered disc, read where it is needed",
      findEstimator("adaptive"), Projection::Uniform },
    { "lispsm", "hard: light space perspective shadow map, finer near the camera",
      findEstimator("compare"), Projection::Lispsm },
    { "tsm", "hard: trapezoidal shadow map, finer near the camera", findEstimator("compare"),
      Projection::Trapezoid },
    { "pssm", "hard: parallel-split shadow maps, one for each range of distances",
      findEstimator("compare"), Projection::Splits },
    { "planar", "hard, soft: casters projected onto the flat receivers, with no shadows elsewhere",
      findEstimator("planar"), Projection::Uniform },
    { "sampled", "soft: a shadow map from each of many points of the light",
      findEstimator("sampled"), Projection::Uniform },
    { "montecarlo",
      "soft: a few random rays for each pixel through depth layers of the map, and a filter",
      findEstimator("montecarlo"), Projection::Uniform },
    { "coherence",
      "hard, soft, hybrid: pixels whose texels disagree are traced, the others get what those say",
      findEstimator("coherence"), Projection::Uniform },
    { "selective",
      "hard, hybrid: the contour between light and shadow is tested triangle by triangle, and "
      "traced where that decides nothing",
      findEstimator("selective"), Projection::Uniform },
    { "crsm",
      "hard, exact: a conservative map decides pixels under single triangles, rays the rest",
      findEstimator("crsm"), Projection::Uniform },
    { "crsma", "hard, exact: crsm which also decides pixels under a triangle and its neighbours",
      findEstimator("crsma"), Projection::Uniform },
    { "silhouette",
      "hard, exact: a conservative map that knows where casters end decides most pixels, rays the "
      "rest",
      findEstimator("silhouette"), Projection::Uniform },
    { "penumbra",
      "soft, exact: the light is counted between the edges that casters show it, rays the rest",
      findEstimator("penumbra"), Projection::Uniform },
    { "raytraced", "hard, soft, exact: shadow rays wherever no proof replaces them; the truth",
      findEstimator("raytraced"), Projection::Uniform },
  };
  return entries;
}

const EstimatorEntry* findEstimator(const std::string& name)
{
  return find(estimators(), name);
}

std::string estimatorNames()
{
  return listOf(namesOf(estimators()));
}

const TechniqueEntry* findTechnique(const std::string& name)
{
  return find(registry(), name);
}

std::string techniqueNames()
{
  return std::string(automaticTechnique) + ", " + listOf(namesOf(registry()));
}

bool has(const TechniqueInfo& info, const Setting& setting)
{
  return contains(choiceSettings(), setting) || contains(lightAreaSettings(), setting) ||
    std::any_of(info.settings.begin(), info.settings.end(),
      [&](const SettingsTable* table) { return contains(*table, setting); });
}

bool has(const TechniqueInfo& info, const std::string& settingName)
{
  const Setting* const setting = findSetting(settingName);
  return setting && has(info, *setting);
}

std::string defaultOf(const Setting& setting)
{
  return setting.name == "technique" ? defaultTechnique : setting.get(ShadowSettings());
}

ShadowSettings settingsOf(const TechniqueInfo& info, SettingsOf of, const ShadowSettings& settings)
{
  ShadowSettings values;
  for (const SettingsTable* table : info.settings)
  {
    for (const Setting& setting : table->settings)
    {
      if (of == SettingsOf::Estimator || setting.isBaked)
      {
        setting.copy(values, settings);
      }
    }
  }
  return values;
}

bool isOfLight(const Setting& setting)
{
  return contains(lightAreaSettings(), setting);
}

std::string techniquesWith(const SettingsTable& table)
{
  std::vector<std::string> names;
  for (const TechniqueEntry& technique : registry())
  {
    if (has(technique.estimator->info, table.settings.front()))
    {
      names.push_back(technique.name);
    }
  }
  return names.size() == registry().size() ? "" : listOf(names);
}

std::string whoHas(const Setting& setting)
{
  const auto& tables = settingsTables();
  const auto found = std::find_if(tables.begin(), tables.end(),
    [&](const SettingsTable* table) { return contains(*table, setting); });
  return "the setting '" + setting.name + "' is for: " + techniquesWith(**found);
}

const EstimatorEntry& estimatorOf(const ShadowSettings& settings)
{
  const std::string name = nameOfTechnique(settings);
  const TechniqueEntry* technique = findTechnique(name);
  if (!technique)
  {
    throw CompositionError("there is no technique '" + name + "'; available: " + techniqueNames());
  }
  const EstimatorEntry* estimator =
    settings.estimator.empty() ? technique->estimator : findEstimator(settings.estimator);
  if (!estimator)
  {
    throw CompositionError(
      "there is no estimator '" + settings.estimator + "'; available: " + estimatorNames());
  }
  return settings.asPublished && !estimator->info.asPublished.empty()
    ? *findEstimator(estimator->info.asPublished)
    : *estimator;
}

const EstimatorEntry& estimatorOfLight(const ShadowLight& light)
{
  return restsSoftly(light) ? *findTechnique(restingSoft)->estimator : estimatorOf(light);
}

const EstimatorEntry& compose(ShadowLight& light)
{
  const EstimatorEntry& estimator = estimatorOfLight(light);
  light.technique = restsSoftly(light) ? restingSoft : nameOfTechnique(light);
  const TechniqueInfo& info = estimator.info;
  light.estimator = info.name;
  if (!info.bakesMap())
  {
    light.projection = Projection::Uniform;
  }
  else if (light.projection == Projection::OfTechnique)
  {
    light.projection = findTechnique(light.technique)->projection;
  }
  std::vector<std::string (*)(const ShadowLight&)> refusals = info.refused;
  refusals.push_back(refusedProjection);
  for (const auto& refused : refusals)
  {
    if (const std::string why = refused(light); !why.empty())
    {
      throw CompositionError(why);
    }
  }
  return estimator;
}

} // namespace gnomon
