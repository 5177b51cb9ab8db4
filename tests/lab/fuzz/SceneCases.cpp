#include "Cases.h"
#include "FuzzScene.h"

#include "shadowtech/Registry.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace gnomon::fuzz
{
namespace
{

using test::Picture;

/// The lights whose visibility must equal that of rays, by their places in the renderer.
struct ExactLights
{
  std::set<int> all;
  std::set<int> hard; ///< those whose technique takes area lights as points
};

ExactLights exactLightsOf(const FrameReport& report)
{
  ExactLights lights;
  for (const LightReport& light : report.lights)
  {
    const EstimatorEntry* const estimator = findEstimator(light.estimator);
    if (estimator && estimator->info.exact && light.estimator != "raytraced")
    {
      lights.all.insert(light.sceneIndex);
      if (!has(estimator->info, "light_samples"))
      {
        lights.hard.insert(light.sceneIndex);
      }
    }
  }
  return lights;
}

/// A light's images of visibility, one after the other.
std::vector<float> imagesOf(const VisibilityImages& kept, int light)
{
  std::vector<float> images;
  for (std::size_t i = 0; i < kept.sceneIndices.size(); ++i)
  {
    if (kept.sceneIndices[i] == light)
    {
      images.insert(images.end(), kept.visibility[i].begin(), kept.visibility[i].end());
    }
  }
  return images;
}

/// Compare exact lights with rays.
void compareWithRays(const FuzzScene& scene, FuzzScene& truth)
{
  const ExactLights lights = exactLightsOf(scene.report());
  if (lights.all.empty())
  {
    return;
  }
  truth.traceInstead(lights.hard);
  truth.render();
  for (const int light : lights.all)
  {
    const LightReport& traced = truth.report().lights.at(static_cast<std::size_t>(light));
    if (traced.estimator != "raytraced")
    {
      continue; // The light's settings contradict ray tracing.
    }
    const VisibilityImages& kept = scene.pass()->GetVisibility();
    const auto image = std::find(kept.sceneIndices.begin(), kept.sceneIndices.end(), light);
    const auto channel =
      kept.channels.at(static_cast<std::size_t>(image - kept.sceneIndices.begin()));
    if (lights.hard.count(light) > 0 && channel != LightChannel::All)
    {
      continue; // Lit has the mean of the light's texture.
    }
    const std::vector<float> shown = imagesOf(kept, light);
    const std::vector<float> rays = imagesOf(truth.pass()->GetVisibility(), light);
    const int different = shown.size() != rays.size()
      ? static_cast<int>(shown.size())
      : std::inner_product(
          shown.begin(), shown.end(), rays.begin(), 0, std::plus<>(), std::not_equal_to<>());
    if (different > 0)
    {
      throw Find(std::to_string(different) + " of " + std::to_string(shown.size()) +
        " values of light " + std::to_string(light) + " are not the " +
        std::to_string(rays.size()) + " of rays");
    }
  }
}

/// Visibility only removes light: no pixel is brighter than VTK's own. A pixel that all lights
/// reach is as bright.
void compareWithVtk(const FuzzScene& scene, const Picture& shadowed, const Picture& plain)
{
  const VisibilityImages& kept = scene.pass()->GetVisibility();
  const bool isKept = !kept.coverage.empty() && !scene.showsTranslucent();
  for (std::size_t value = 0; value < plain.rgb.size(); ++value)
  {
    const std::size_t pixel = value / 3;
    const auto width = static_cast<std::size_t>(plain.width);
    const std::size_t row = static_cast<std::size_t>(plain.height) - 1 - pixel / width;
    const std::size_t place = row * width + pixel % width;
    const bool isLit = isKept &&
      std::all_of(kept.visibility.begin(), kept.visibility.end(),
        [place](const std::vector<float>& visibility) { return visibility[place] == 1.0f; });
    const int brighter = shadowed.rgb[value] - plain.rgb[value];
    if (brighter > 1 || (isLit && brighter < -1))
    {
      throw Find("pixel (" + std::to_string(pixel % width) + ", " + std::to_string(row) + ") is " +
        std::to_string(shadowed.rgb[value]) + (isLit ? ", lit" : "") + ", of VTK alone " +
        std::to_string(plain.rgb[value]));
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
void runScene(Random random, std::string& description)
{
  const Random start(random());
  FuzzScene scene(start, Purpose::Picture);
  description = scene.description();
  const Picture picture = scene.render();
  if (scene.pass()->GetKeepVisibility())
  {
    FuzzScene truth(start, Purpose::Picture);
    compareWithRays(scene, truth);
  }
  if (chance(random, 0.3)) // a frame with its own shaders
  {
    FuzzScene plain(start, Purpose::Picture);
    plain.removePass();
    compareWithVtk(scene, picture, plain.render());
  }
}

} // namespace gnomon::fuzz
