#include "shadowtech/Registry.h"

#include "lights/LightViews.h"
#include "shadowtech/adaptive/Adaptive.h"
#include "shadowtech/depth_map/Compare.h"
#include "shadowtech/depth_map/Pcf.h"
#include "shadowtech/exact/Crsm.h"
#include "shadowtech/exact/Crsma.h"
#include "shadowtech/exact/Silhouette.h"
#include "shadowtech/moment_map/Exponential.h"
#include "shadowtech/moment_map/FourMoments.h"
#include "shadowtech/moment_map/Variance.h"
#include "shadowtech/montecarlo/MonteCarlo.h"
#include "shadowtech/pcss/Pcss.h"
#include "shadowtech/penumbra/Penumbra.h"
#include "shadowtech/planar/Planar.h"
#include "shadowtech/published/PublishedCrsm.h"
#include "shadowtech/published/PublishedPcss.h"
#include "shadowtech/raytraced/Raytraced.h"
#include "shadowtech/sampled/Sampled.h"
#include "shadowtech/selective/Coherence.h"
#include "shadowtech/selective/Selective.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon
{
namespace
{

template <typename Estimator>
EstimatorEntry entry()
{
  return { Estimator::info(), [] { return std::unique_ptr<Technique>(new Estimator); } };
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
std::string namesOf(const std::vector<Entry>& entries)
{
  std::string names;
  for (const Entry& entry : entries)
  {
    names += (names.empty() ? "" : ", ") + nameOf(entry);
  }
  return names;
}

} // namespace

//------------------------------------------------------------------------------
const std::vector<EstimatorEntry>& estimators()
{
  static const std::vector<EstimatorEntry> entries = {
    entry<Adaptive>(),
    entry<Compare>(),
    entry<Pcf>(),
    entry<Pcss>(),
    entry<PublishedPcss>(),
    entry<Variance>(),
    entry<Exponential>(),
    entry<FourMoments>(),
    entry<MonteCarlo>(),
    entry<Planar>(),
    entry<Raytraced>(),
    entry<Sampled>(),
    entry<Coherence>(),
    entry<Selective>(),
    entry<Crsm>(),
    entry<CrsmAsPublished>(),
    entry<Crsma>(),
    entry<CrsmaAsPublished>(),
    entry<Silhouette>(),
    entry<Penumbra>(),
  };
  return entries;
}

//------------------------------------------------------------------------------
const std::vector<TechniqueEntry>& registry()
{
  static const std::vector<TechniqueEntry> entries = {
    { "nsm", "hard: the plain shadow map, free of acne without a bias to tune",
      findEstimator("compare"), Projection::Uniform },
    { "pcf", "hard, smoothed: the plain shadow map with percentage closer filtering",
      findEstimator("pcf"), Projection::Uniform },
    { "pcss", "soft: percentage closer soft shadows, penumbrae as wide as an area light makes them",
      findEstimator("pcss"), Projection::Uniform },
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
    { "raytraced", "hard, exact: a shadow ray for every pixel; the truth",
      findEstimator("raytraced"), Projection::Uniform },
  };
  return entries;
}

//------------------------------------------------------------------------------
const EstimatorEntry* findEstimator(const std::string& name)
{
  return find(estimators(), name);
}

//------------------------------------------------------------------------------
std::string estimatorNames()
{
  return namesOf(estimators());
}

//------------------------------------------------------------------------------
const TechniqueEntry* findTechnique(const std::string& name)
{
  return find(registry(), name);
}

//------------------------------------------------------------------------------
std::string techniqueNames()
{
  return namesOf(registry());
}

//------------------------------------------------------------------------------
bool takes(const Setting& setting, const std::string& text)
{
  ShadowSettings scratch;
  return setting.set(scratch, text) && (setting.name != "technique" || findTechnique(text)) &&
    (setting.name != "estimator" || text.empty() || findEstimator(text));
}

//------------------------------------------------------------------------------
std::string expectedBy(const Setting& setting)
{
  return setting.name == "technique" ? "one of: " + techniqueNames()
    : setting.name == "estimator"    ? "one of: " + estimatorNames()
                                     : setting.expected();
}

//------------------------------------------------------------------------------
bool concerns(const Setting& setting, const TechniqueInfo& info)
{
  switch (setting.about)
  {
    case SettingSubject::Map:
      return info.needsMap;
    case SettingSubject::LightSamples:
      return info.lightPoints == LightPoints::Sampled;
    case SettingSubject::LightSeed:
      return info.lightPoints != LightPoints::Fixed;
    case SettingSubject::Planes:
      return info.servesPlanes;
    case SettingSubject::Light:
      return true;
  }
  return false;
}

namespace
{

/// The estimator that `as_published` selects in place of one.
/// @throws CompositionError where there is none
const EstimatorEntry& publishedOf(const TechniqueInfo& info)
{
  if (!info.asPublished.empty())
  {
    return *findEstimator(info.asPublished);
  }
  std::vector<EstimatorEntry> withPublished;
  std::copy_if(estimators().begin(), estimators().end(), std::back_inserter(withPublished),
    [](const EstimatorEntry& entry)
    { return !entry.info.asPublished.empty() && entry.info.asPublished != entry.info.name; });
  throw CompositionError("'" + info.name +
    "' has no variant by the letter of a publication; 'as_published' is for: " +
    namesOf(withPublished));
}

} // namespace

//------------------------------------------------------------------------------
const EstimatorEntry& estimatorOf(const ShadowSettings& settings)
{
  const std::string name = settings.technique.empty() ? defaultTechnique : settings.technique;
  const TechniqueEntry* technique = findTechnique(name);
  if (!technique)
  {
    throw CompositionError(
      "the technique '" + name + "' is asked for; there are: " + techniqueNames());
  }
  const EstimatorEntry* estimator =
    settings.estimator.empty() ? technique->estimator : findEstimator(settings.estimator);
  if (!estimator)
  {
    throw CompositionError(
      "the estimator '" + settings.estimator + "' is asked for; there are: " + estimatorNames());
  }
  return settings.asPublished ? publishedOf(estimator->info) : *estimator;
}

namespace
{

/// Why a light's map cannot be averaged as its settings say; empty if it can.
std::string refusedAverage(const ShadowLight& light, const TechniqueInfo& info)
{
  const bool sums = light.blur == MapBlur::Sat;
  if (!info.needsMap)
  {
    return {};
  }
  if (!info.averagesMap)
  {
    const std::string asked = light.mapSamples > 1 ? "map_samples"
      : sums                                       ? "blur"
      : light.mipMaps                              ? "mip_maps"
                                                   : "";
    return asked.empty() ? ""
                         : "'" + info.name + "' reads depths, which may not be averaged; '" +
        asked + "' is for maps of moments";
  }
  if (sums && !info.sumsMap)
  {
    return "'" + info.name +
      "' has moments beyond the range of the 32-bit integers that a summed-area table holds; it "
      "takes 'blur' box";
  }
  if (sums && light.mipMaps)
  {
    return "a summed-area table has no levels; 'mip_maps' is for 'blur' box";
  }
  return {};
}

/// Why an area light cannot have samples as its settings say; empty if it can.
std::string refusedSamples(const ShadowLight& light, const TechniqueInfo& info)
{
  const int side =
    static_cast<int>(std::lround(std::sqrt(static_cast<double>(light.lightSamples))));
  return info.lightPoints == LightPoints::Sampled && light.area &&
      light.lightSampling == LightSampling::Jittered && side * side != light.lightSamples
    ? "'light_sampling' jittered has one sample in each cell of a square grid, of which there are "
      "no " +
      std::to_string(light.lightSamples) + "; 'light_samples' takes squares then: 4, 9, 16, ..."
    : "";
}

} // namespace

//------------------------------------------------------------------------------
const EstimatorEntry& compose(ShadowLight& light)
{
  const EstimatorEntry& estimator = estimatorOf(light);
  const TechniqueInfo& info = estimator.info;
  light.technique = light.technique.empty() ? defaultTechnique : light.technique;
  light.estimator = info.name;
  if (light.projection == Projection::OfTechnique)
  {
    light.projection =
      info.needsMap ? findTechnique(light.technique)->projection : Projection::Uniform;
  }
  else if (!info.needsMap)
  {
    throw CompositionError(
      "'" + light.estimator + "' reads no map that a projection could lay out");
  }
  if (info.filters && info.ownKernel.empty() && light.kernel == FilterKernel::Castano &&
    light.kernelTexels != 3 && light.kernelTexels != 5 && light.kernelTexels != 7)
  {
    throw CompositionError(
      "the kernel 'castano' has the sizes 3, 5 and 7, not " + std::to_string(light.kernelTexels));
  }
  // What an estimator never can comes before what it cannot with these numbers.
  for (const std::string& refused :
    { refusedAverage(light, info), info.refused ? info.refused(light) : std::string(),
      refusedSamples(light, info), refusedProjection(light) })
  {
    if (!refused.empty())
    {
      throw CompositionError(refused);
    }
  }
  return estimator;
}

} // namespace gnomon
