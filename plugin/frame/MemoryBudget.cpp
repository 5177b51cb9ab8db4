#include "plugin/frame/MemoryBudget.h"

#include "lights/LightViews.h"
#include "plugin/frame/Route.h"
#include "shadowtech/tracing/EdgeSettings.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gnomon
{
namespace
{

/// Maps are not made coarser than that.
constexpr int fewestTexels = 256;
/// The setting `map_size` is at most that.
constexpr int largestMap = 16384;

double bytesOfMap(const LightNeed& light, int sizeTexels)
{
  return light.bytesPerTexel == 0.0
    ? 0.0
    : light.bytesPerTexel * static_cast<double>(sizeTexels) * static_cast<double>(sizeTexels);
}

/// The largest map that fits; 0: none does.
int fittingSize(const LightNeed& light, double left)
{
  int size = light.mapSizeTexels;
  while (bytesOfMap(light, size) > left && size / 2 >= fewestTexels)
  {
    size /= 2;
  }
  return bytesOfMap(light, size) > left ? 0 : size;
}

/// The lights' places, those first that give the most light.
std::vector<std::size_t> brightestFirst(const std::vector<LightNeed>& lights)
{
  std::vector<std::size_t> order(lights.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return lights[a].mostLight > lights[b].mostLight; });
  return order;
}

/// Shares what is left of a budget among the maps of lights that show shadows.
void shareAmongMaps(const std::vector<LightNeed>& lights, const std::vector<std::size_t>& order,
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
}

bool haveMaps(const std::vector<LightShare>& shares)
{
  return std::all_of(shares.begin(), shares.end(),
    [](const LightShare& share) { return share.way == LightShare::Way::Map; });
}

/// The most light per unit of intensity that a light gives a point of a box.
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

//------------------------------------------------------------------------------
std::vector<LightShare> shareMemory(
  const std::vector<LightNeed>& lights, double budget, std::size_t pixels, bool mayBeInline)
{
  const std::vector<std::size_t> order = brightestFirst(lights);
  std::vector<LightShare> shares(lights.size());
  const bool arePointwise = lights.size() <= mostInlineLights &&
    std::all_of(lights.begin(), lights.end(), [](const LightNeed& of) { return of.isPointwise; });
  if (mayBeInline && arePointwise)
  {
    shareAmongMaps(lights, order, budget, shares);
    if (haveMaps(shares))
    {
      return shares;
    }
  }
  // Bits of all hard lights take one image of two numbers, other lights an image a channel.
  const double ofImage = static_cast<double>(pixels) * sizeof(float);
  double left = budget - 2.0 * ofImage;
  for (const std::size_t i : order)
  {
    const double bytes = lights[i].isHard ? 0.0 : lights[i].channels * ofImage;
    shares[i].way = bytes <= left ? LightShare::Way::Map : LightShare::Way::None;
    left -= bytes <= left ? bytes : 0.0;
  }
  shareAmongMaps(lights, order, left, shares);
  return shares;
}

//------------------------------------------------------------------------------
int mostTexelsOfEach(
  double budget, std::size_t pixels, std::size_t lights, const ShadowLight& light)
{
  const double ofImage = static_cast<double>(pixels) * sizeof(float);
  const double bytes = budget / static_cast<double>(lights) - ofImage;
  int size = 1;
  while (size < largestMap && 4.0 * size * size * mostViews(light) * sizeof(float) <= bytes)
  {
    size *= 2;
  }
  return size;
}

//------------------------------------------------------------------------------
LightNeed needOf(const ShadowLight& light, const TechniqueInfo& info, const Bounds& seen)
{
  LightNeed need;
  need.mostLight = light.intensity * mostOfUnit(light, seen);
  need.mapSizeTexels = light.mapSizeTexels;
  need.bytesPerTexel = !info.bakesMap() ? 0.0
    : info.bytesPerTexel                ? info.bytesPerTexel(light)
                                        : std::numeric_limits<double>::infinity();
  need.channels = channelsOf(info, light);
  need.isPointwise = info.isPointwise();
  need.isHard =
    info.exact && !light.area && !light.texture && light.of<EdgeSettings>().samples == 1;
  return need;
}

} // namespace gnomon
