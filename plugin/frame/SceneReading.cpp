#include "plugin/frame/SceneReading.h"

#include "lights/LightViews.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/moment_map/MomentMapTechnique.h"

#include <vtkLightCollection.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace gnomon
{
namespace
{

/// True if an estimator needs no newer OpenGL than 3.2: it draws on the CPU, its maps included.
bool servesOldOpenGl(const TechniqueInfo& info)
{
  const bool drawsMaps = info.bakesMap() && !info.conservativeMap;
  return info.evaluation == Evaluation::ScreenCpu && !drawsMaps;
}

/// Return the names of the techniques for which that holds: "'a', 'b'".
std::string techniquesOfOldOpenGl()
{
  std::string names;
  for (const TechniqueEntry& technique : registry())
  {
    if (servesOldOpenGl(technique.estimator->info))
    {
      names += (names.empty() ? "'" : ", '") + technique.name + "'";
    }
  }
  return names;
}

/// Complete a light. If its technique traces no samples of an area, it shows the hard shadows of
/// the area's centre.
/// @param drawsMaps true if OpenGL is new enough for techniques on the GPU
Composition composeHere(ShadowLight light, bool drawsMaps)
{
  const EstimatorEntry* estimator = nullptr;
  try
  {
    estimator = &compose(light);
  }
  catch (const CompositionError& error)
  {
    return { std::move(light), nullptr, error.what() };
  }
  const TechniqueInfo& info = estimator->info;
  if (!drawsMaps && !servesOldOpenGl(info))
  {
    std::string refusal = "'" + light.technique +
      "' needs OpenGL 4.3, and this context has less; it suffices for " + techniquesOfOldOpenGl();
    return { std::move(light), nullptr, std::move(refusal) };
  }
  if (info.evaluation == Evaluation::ScreenCpu && !info.has(lightSampleSettings()))
  {
    light.area.reset();
  }
  return { std::move(light), estimator, {} };
}

/// Return the named settings, by name.
std::vector<const Setting*> namedSettings(const ShadowSettings& settings)
{
  std::vector<const Setting*> named;
  if (settings.named.any())
  {
    std::copy_if(shadowSettings().begin(), shadowSettings().end(), std::back_inserter(named),
      [&](const Setting* setting) { return settings.named[setting->index]; });
    std::sort(named.begin(), named.end(),
      [](const Setting* a, const Setting* b) { return a->name < b->name; });
  }
  return named;
}

/// True if a light's technique has a setting. A light that leaves its technique to the pass has the
/// settings of all techniques that the pass may choose, in this frame or another.
bool mayHave(const ShadowLight& light, const Setting& setting)
{
  const auto hasIt = [&](const char* technique)
  { return has(findTechnique(technique)->estimator->info, setting); };
  return has(estimatorOfLight(light).info, setting) ||
    (isAutomatic(light) && (hasIt(plainTechnique) || hasIt(restingHard) || hasIt(restingSoft)));
}

Bounds visibleBounds(vtkRenderer* renderer)
{
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  return { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
}

/// Return what is to be noted of a renderer's lights, each a sentence.
std::vector<std::string> notesOn(vtkRenderer* renderer, const LightSet& lights)
{
  std::vector<std::string> notes;
  if (lights.headlightIsAlone)
  {
    notes.push_back("no shadow can be seen: all light comes from the camera. Add a light from the "
                    "side");
  }
  if (renderer->GetLights()->GetNumberOfItems() == 0)
  {
    notes.push_back("no light: VTK shades nothing, and nothing casts");
  }
  return notes;
}

/// Return the errors of named settings that are without effect: a light's own that its technique
/// lacks, and those of the pass that every light's technique lacks.
std::vector<std::string> findMisfits(
  const std::vector<ShadowLight>& lights, const ShadowSettings& defaults)
{
  std::vector<std::string> misfits;
  for (const ShadowLight& light : lights)
  {
    for (const Setting* setting : namedSettings(light))
    {
      if (!mayHave(light, *setting))
      {
        misfits.push_back(
          nameOf(light) + " has the technique '" + light.technique + "', and " + whoHas(*setting));
      }
    }
  }
  for (const Setting* setting : namedSettings(defaults))
  {
    const auto isHad = [&](const ShadowLight& light) { return mayHave(light, *setting); };
    if (!lights.empty() && std::none_of(lights.begin(), lights.end(), isHad))
    {
      misfits.push_back("No light's technique has it: " + whoHas(*setting));
    }
  }
  return misfits;
}

/// True if a surface shows shadows where no probing camera ray finds it: these meet casters, where
/// the snapshot has them.
bool isUnseenReceiver(const Surface& surface)
{
  return surface.receives && (!surface.casts || surface.isMoved) && surface.triangleCount > 0;
}

} // namespace

bool canDrawMaps()
{
  return GNOMON_HAS_GL(VERSION_4_3);
}

SceneLights LightReading::read(
  vtkRenderer* renderer, const ShadowSettings& defaults, const FrameWishes& wishes)
{
  const bool drawsMaps = canDrawMaps();
  SceneLights lights;
  lights.set = this->manager_.collect(renderer, defaults, wishes.casting);
  for (const ShadowLight& light : lights.set.lights)
  {
    lights.identities.push_back(identityOf(light));
  }
  lights.misfits = findMisfits(lights.set.lights, defaults);
  lights.notes = notesOn(renderer, lights.set);
  lights.compose = [drawsMaps](ShadowLight light)
  { return composeHere(std::move(light), drawsMaps); };
  lights.traitsOf = [this](const EstimatorEntry& estimator, const ShadowLight& light)
  { return this->traitsOf(estimator, light); };
  if (drawsMaps &&
    std::any_of(lights.set.lights.begin(), lights.set.lights.end(),
      [](const ShadowLight& light) { return light.momentMap.samples > 1; }))
  {
    lights.mostMapSamples = mostMapSamples();
  }
  if (wishes.memoryBudget > 0.0)
  {
    lights.seenWorld = visibleBounds(renderer);
  }
  return lights;
}

MapTraits LightReading::traitsOf(const EstimatorEntry& estimator, const ShadowLight& light)
{
  auto known = this->techniques_.find(&estimator);
  if (known == this->techniques_.end())
  {
    known = this->techniques_.emplace(&estimator, estimator.create()).first;
  }
  const Technique& technique = baseOf(known->second);
  return { isFittedToCamera(technique.lightOfMap(light)),
    technique.mapReach(light).dependsOnViews() };
}

SceneProps readProps(const Occluders& occluders)
{
  SceneProps props;
  props.frame = occluders.frame;
  props.casters = occluders.versions();
  props.sheets = occluders.hasSheets();
  props.transmits = props.sheets || !occluders.volumes.empty();
  for (const Surface& surface : occluders.surfaces)
  {
    const std::size_t instances = std::max<std::size_t>(surface.centredFromSource.size(), 1);
    props.triangles += surface.triangleCount * instances;
    props.drawn += surface.drawnCount() * instances;
    props.colours =
      props.colours || (surface.sheet && surface.triangleCount > 0 && surface.sheet->isColoured);
    props.unseenReceiver = props.unseenReceiver || isUnseenReceiver(surface);
  }
  return props;
}

} // namespace gnomon
