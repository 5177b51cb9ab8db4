#include "plugin/data/AddedLights.h"

#include "lights/LightManager.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gnomon
{
namespace
{

/// Return two unit vectors across a unit vector (Duff et al., JCGT 6(1), 2017).
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& n)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return { { 1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x },
    { b, sign + n.y * n.y * a, -n.y } };
}

} // namespace

bool isDirection(const glm::dvec3& vector)
{
  const double length = glm::length(vector);
  return length > 0.0 && std::isfinite(length);
}

bool areHours(double hours)
{
  return hours >= 0.0 && std::isfinite(hours);
}

const AddedLight* findLight(const std::vector<AddedLight>& lights, int number)
{
  return number >= 0 && number < static_cast<int>(lights.size())
    ? &lights[static_cast<std::size_t>(number)]
    : nullptr;
}

vtkMTimeType changeTime(const std::vector<AddedLight>& lights)
{
  vtkMTimeType time = 0;
  for (const AddedLight& added : lights)
  {
    time = std::max(time, added.light ? changeTime(added.light) : 0);
  }
  return time;
}

std::vector<WeightedLight> weightedLights(const std::vector<AddedLight>& added,
  const SceneFrame& frame, double diameterDegrees, std::string& reason)
{
  const double radius = std::tan(glm::radians(0.5 * diameterDegrees));
  std::vector<WeightedLight> lights;
  lights.reserve(added.size());
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    ShadowLight light;
    light.directionWorld = -added[i].towards;
    if (added[i].light)
    {
      std::string why;
      std::optional<ShadowLight> place = readPlace(added[i].light, why);
      why = place ? enterFrame(*place, frame) : why;
      if (!why.empty())
      {
        reason = "light " + std::to_string(i) + ": " + why;
        return {};
      }
      light = *place;
    }
    WeightedLight weighted{ { light, frame.centre }, added[i].hours };
    if (light.kind == LightKind::Directional && !light.box)
    {
      const auto [x, y] = across(-light.directionWorld);
      weighted.discX = radius * x;
      weighted.discY = radius * y;
    }
    lights.push_back(weighted);
  }
  return lights;
}

} // namespace gnomon
