#include "Cases.h"

#include "FuzzScene.h"

#include "shadowtech/Registry.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

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

/// @throws Find if two frames' visibility or receivers differ by a bit
void compare(const VisibilityImages& kept, const VisibilityImages& fresh)
{
  if (kept.width != fresh.width || kept.height != fresh.height ||
    kept.sceneIndices != fresh.sceneIndices || kept.origin != fresh.origin)
  {
    throw Find("other lights or another size than a fresh pass's");
  }
  std::string text;
  const auto compareImages = [&text](const std::string& name, const auto& a, const auto& b)
  {
    std::size_t count = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
      count += a[i] == b[i] ? 0 : 1;
    }
    text += count ? "; " + std::to_string(count) + " values of " + name : "";
  };
  for (std::size_t i = 0; i < kept.visibility.size(); ++i)
  {
    compareImages("the visibility of light " + std::to_string(kept.sceneIndices[i]),
      kept.visibility[i], fresh.visibility[i]);
  }
  compareImages("the coverage", kept.coverage, fresh.coverage);
  compareImages("positions' x", kept.positionX, fresh.positionX);
  compareImages("positions' y", kept.positionY, fresh.positionY);
  compareImages("positions' z", kept.positionZ, fresh.positionZ);
  compareImages("normals' x", kept.normalX, fresh.normalX);
  compareImages("normals' y", kept.normalY, fresh.normalY);
  compareImages("normals' z", kept.normalZ, fresh.normalZ);
  if (!text.empty())
  {
    throw Find("differ from a fresh pass's" + text);
  }
}

/// Compare a scene with an equal one whose pass is new.
void compare(FuzzScene& kept, FuzzScene& fresh)
{
  const test::Picture keptPicture = kept.render();
  const test::Picture freshPicture = fresh.render();
  compare(kept.pass()->GetVisibility(), fresh.pass()->GetVisibility());
  if (const std::size_t pixels = test::differingPixels(keptPicture, freshPicture))
  {
    throw Find(std::to_string(pixels) + " pixels differ from a fresh pass's");
  }
}

/// True if VTK alone, too, shows another picture after frames between the changes.
bool vtkRemembers(const Random& start, const std::vector<Change>& changes)
{
  FuzzScene kept(start, Purpose::Changes);
  FuzzScene fresh(start, Purpose::Changes);
  kept.removePass();
  fresh.removePass();
  kept.render();
  for (const Change& change : changes)
  {
    kept.apply(change);
    kept.removePass();
    kept.render();
    fresh.apply(change);
    fresh.removePass();
  }
  return test::differingPixels(kept.render(), fresh.render()) > 0;
}

} // namespace

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

void runSequence(Random random, std::string& description)
{
  const Random start(random());
  FuzzScene kept(start, Purpose::Changes);
  FuzzScene renewed(start, Purpose::Changes);
  description = kept.description();
  compare(kept, renewed);
  std::vector<Change> changes;
  for (unsigned left = 3 + random() % (chance(random, 0.1) ? 18 : 6); left > 0; --left)
  {
    changes.push_back(drawChange(random));
    kept.apply(changes.back());
    description = kept.description();
    renewed.apply(changes.back());
    renewed.renewPass();
    compare(kept, renewed);
  }
  FuzzScene fresh(start, Purpose::Changes);
  for (const Change& change : changes)
  {
    fresh.apply(change);
  }
  try
  {
    compare(kept, fresh);
  }
  catch (const Find& find)
  {
    if (!vtkRemembers(start, changes))
    {
      throw Find(std::string("in a fresh window: ") + find.what());
    }
  }
}

} // namespace gnomon::fuzz
