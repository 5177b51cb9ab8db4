#include "plugin/plan/MemoryBudget.h"

#include "lights/LightViews.h"
#include "plugin/plan/LightPlans.h"
#include "plugin/plan/Route.h"
#include "shadowtech/base/VisibilityLayers.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gnomon
{
namespace
{

/// Upper bound of the setting `map_size`.
constexpr int largestMap = 16384;

double bytesOfMap(const LightNeed& light, int sizeTexels)
{
  return light.bytesPerTexel * static_cast<double>(sizeTexels) * static_cast<double>(sizeTexels);
}

/// Return the side of the largest map that fits; 0 if none does.
int fittingSize(const LightNeed& light, double left)
{
  int size = light.mapSizeTexels;
  while (bytesOfMap(light, size) > left && size / 2 >= fewestTexels)
  {
    size /= 2;
  }
  return bytesOfMap(light, size) > left ? 0 : size;
}

/// Return the lights' indices in descending order of their most light.
std::vector<std::size_t> brightestFirst(const std::vector<LightNeed>& lights)
{
  std::vector<std::size_t> order(lights.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return lights[a].mostLight > lights[b].mostLight; });
  return order;
}

/// Share the rest of a budget among the maps of lights that show shadows.
/// @return the remaining bytes
double shareAmongMaps(const std::vector<LightNeed>& lights, const std::vector<std::size_t>& order,
  double left, std::vector<LightShare>& shares)
{
  for (const std::size_t i : order)
  {
    if (shares[i].way == LightShare::Way::None)
    {
      continue;
    }
    const int size = fittingSize(lights[i], left);
    shares[i].way = size > 0 ? LightShare::Way::Map : LightShare::Way::Rays;
    shares[i].mapSizeTexels = size;
    left -= size > 0 ? bytesOfMap(lights[i], size) : 0.0;
  }
  return left;
}

bool haveMaps(const std::vector<LightShare>& shares)
{
  return std::all_of(shares.begin(), shares.end(),
    [](const LightShare& share) { return share.way == LightShare::Way::Map; });
}

/// Return the most light per unit of intensity that a light gives a point of a box.
double mostOfUnit(const ShadowLight& light, const Bounds& seen)
{
  if (light.kind == LightKind::Directional || seen.empty())
  {
    return 1.0;
  }
  const double distance =
    glm::distance(light.positionWorld, glm::clamp(light.positionWorld, seen.lower, seen.upper));
  const double divisor =
    glm::dot(light.attenuation, glm::dvec3(1.0, distance, distance * distance));
  return divisor > 0.0 ? 1.0 / divisor : std::numeric_limits<double>::infinity();
}

} // namespace

MemoryShares shareMemory(
  const std::vector<LightNeed>& lights, double budget, std::size_t pixels, bool mayBeInline)
{
  const std::vector<std::size_t> order = brightestFirst(lights);
  MemoryShares shares;
  shares.lights.resize(lights.size());
  const bool arePointwise = lights.size() <= mostInlineLights &&
    std::all_of(lights.begin(), lights.end(), [](const LightNeed& of) { return of.isPointwise; });
  if (mayBeInline && arePointwise)
  {
    shares.left = shareAmongMaps(lights, order, budget, shares.lights);
    if (haveMaps(shares.lights))
    {
      return shares;
    }
  }
  // Bits of hard lights share one image of at most two numbers. Other lights need an image for each
  // channel.
  const auto ofPixels = [&](double bytes) { return bytes * static_cast<double>(pixels); };
  double left = budget - ofPixels(2.0 * sizeof(float));
  int bits = 0;
  for (const std::size_t i : order)
  {
    const bool takesBit = lights[i].isHard && bits < VisibilityLayers::mostBits;
    const double ofImages = takesBit ? 0.0 : ofPixels(lights[i].channels * sizeof(float));
    const double bytes = ofImages + ofPixels(lights[i].bytesPerPixel);
    const bool fits = left >= 0.0 && bytes <= left;
    shares.lights[i].way = fits ? LightShare::Way::Map : LightShare::Way::None;
    left -= fits ? bytes : 0.0;
    bits += takesBit ? 1 : 0;
  }
  shares.left = shareAmongMaps(lights, order, left, shares.lights);
  return shares;
}

int largestMapIn(double bytes, const ShadowLight& light)
{
  int size = 1;
  while (size < largestMap && 4.0 * size * size * mostViews(light) * sizeof(float) <= bytes)
  {
    size *= 2;
  }
  return size;
}

LightNeed needOf(const ShadowLight& light, const TechniqueInfo& info, const Bounds& seen)
{
  LightNeed need;
  need.mostLight = light.intensity * mostOfUnit(light, seen);
  need.mapSizeTexels = light.mapSizeTexels;
  need.bytesPerTexel = !info.bakesMap() ? 0.0
    : info.bytesPerTexel                ? info.bytesPerTexel(light)
                                        : std::numeric_limits<double>::infinity();
  need.bytesPerPixel = info.bytesPerPixel;
  need.channels = light.texture ? 3 : 1;                                       // rays see textures
  need.isPointwise = info.isPointwise() && !info.isSlow && !light.isHeadlight; // others need images
  need.isHard = isBit(info, light);
  return need;
}

} // namespace gnomon
