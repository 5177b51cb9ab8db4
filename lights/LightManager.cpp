#include "lights/LightManager.h"

#include "vtkGnomonLightKeys.h"

#include <vtkCollection.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// The largest coordinate of a lamp: of those beyond, floats do not hold the squares.
constexpr double farthestPosition = 1e18;

/// VTK takes the cone of a positional light for a spot's below 90 degrees only.
LightKind kindOf(vtkLight* light)
{
  if (!light->GetPositional())
  {
    return LightKind::Directional;
  }
  return light->GetConeAngle() < 90.0 ? LightKind::Spot : LightKind::Point;
}

bool isFinite(const glm::dvec3& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// The box of a directional light, if it has one. Its up direction turns with the light.
std::optional<LightBox> readBox(vtkLight* light)
{
  vtkInformation* keys = light->GetInformation();
  vtkInformationDoubleVectorKey* key = vtkGnomonLightKeys::BOX();
  if (light->GetPositional() || keys->Length(key) != 6)
  {
    return std::nullopt;
  }
  const double* numbers = keys->Get(key);
  LightBox box{ numbers[0], numbers[1], numbers[2], { numbers[3], numbers[4], numbers[5] } };
  glm::dvec3 up = box.upWorld;
  light->TransformVector(&up.x, &box.upWorld.x);
  return box;
}

/// What is asked of a light's shadows.
/// @param reason to skip the light; filled, if it is empty, where a setting does not take its value,
/// which SetSetting would have refused
ShadowSettings readSettings(vtkLight* light, const ShadowSettings& defaults, std::string& reason)
{
  ShadowSettings settings = defaults;
  for (const Setting& setting : shadowSettings())
  {
    const char* const text = vtkGnomonLightKeys::GetSetting(light, setting.name.c_str());
    if (text && !setting.set(settings, text) && reason.empty())
    {
      reason =
        "its setting '" + setting.name + "' is '" + text + "', expected " + setting.expected();
    }
  }
  return settings;
}

/// Why this light can show no shadow; empty when it can.
std::string reasonToSkip(vtkLight* light)
{
  if (!light->GetSwitch())
  {
    return "switched off";
  }
  const double* colour = light->GetDiffuseColor();
  const double* highlight = light->GetSpecularColor();
  if (light->GetIntensity() == 0.0 ||
    (colour[0] == 0.0 && colour[1] == 0.0 && colour[2] == 0.0 && highlight[0] == 0.0 &&
      highlight[1] == 0.0 && highlight[2] == 0.0))
  {
    return "gives no light";
  }
  vtkInformation* keys = light->GetInformation();
  if (keys->Has(vtkGnomonLightKeys::CASTS()) && !keys->Get(vtkGnomonLightKeys::CASTS()))
  {
    return "marked as not casting";
  }
  if (std::isnan(light->GetShadowAttenuation()))
  {
    return "its shadow attenuation is not a number";
  }
  if (light->GetShadowAttenuation() <= 0.0f)
  {
    return "its shadow attenuation is 0";
  }
  if (light->GetPositional() && !(light->GetConeAngle() > 0.0))
  {
    return "its cone is empty";
  }
  glm::dvec3 position;
  glm::dvec3 focalPoint;
  light->GetTransformedPosition(&position.x);
  light->GetTransformedFocalPoint(&focalPoint.x);
  if (kindOf(light) == LightKind::Point)
  {
    return !isFinite(position) ? "its position is not finite"
      : glm::any(glm::greaterThan(glm::abs(position), glm::dvec3(farthestPosition)))
      ? "its position is too far away"
      : "";
  }
  const glm::dvec3 travel = focalPoint - position;
  const double distance2 = glm::dot(travel, travel);
  if (!(distance2 > 0.0) || !std::isfinite(distance2))
  {
    return "its position and focal point give no direction";
  }
  const int boxNumbers = keys->Length(vtkGnomonLightKeys::BOX());
  if (boxNumbers != 0 && boxNumbers != 6 && !light->GetPositional())
  {
    return "its box has " + std::to_string(boxNumbers) + " numbers instead of 6";
  }
  if (const std::optional<LightBox> box = readBox(light))
  {
    const glm::dvec3 size(box->width, box->height, box->depth);
    if (!isFinite(size) || !isFinite(box->upWorld))
    {
      return "its box is not finite";
    }
    if (!glm::all(glm::greaterThan(size, glm::dvec3(0.0))))
    {
      return "its box is empty";
    }
    // A millionth of the right angle is where rounding begins to turn the box.
    const glm::dvec3 across = glm::cross(box->upWorld, travel);
    if (!(glm::length(across) > 1e-6 * glm::length(box->upWorld) * std::sqrt(distance2)))
    {
      return "its box has its up direction along the light";
    }
  }
  return {};
}

ShadowLight readLight(vtkLight* light, const ShadowSettings& settings)
{
  ShadowLight result;
  static_cast<ShadowSettings&>(result) = settings;
  result.kind = kindOf(light);
  glm::dvec3 position;
  glm::dvec3 focalPoint;
  light->GetTransformedPosition(&position.x);
  light->GetTransformedFocalPoint(&focalPoint.x);
  result.positionWorld = position;
  if (result.kind != LightKind::Point) // which need not have one
  {
    result.directionWorld = glm::normalize(focalPoint - position);
  }
  result.coneAngleDegrees = result.kind == LightKind::Spot ? light->GetConeAngle() : 0.0;
  result.box = readBox(light);
  result.strength = glm::clamp(static_cast<double>(light->GetShadowAttenuation()), 0.0, 1.0);

  return result;
}

} // namespace

//------------------------------------------------------------------------------
LightSet LightManager::collect(vtkRenderer* renderer, const ShadowSettings& defaults)
{
  LightSet set;
  int sceneIndex = 0;
  int shaderIndex = 0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    std::string reason = reasonToSkip(light);
    const ShadowSettings settings = readSettings(light, defaults, reason);
    if (reason.empty())
    {
      set.casting.push_back(readLight(light, settings));
      set.casting.back().sceneIndex = sceneIndex;
      set.casting.back().shaderIndex = shaderIndex;
    }
    else
    {
      set.skipped.push_back({ sceneIndex, reason });
    }
    ++sceneIndex;
    // VTK numbers lightColorN over the lights that are switched on, whether or not they cast.
    shaderIndex += light->GetSwitch() ? 1 : 0;
  }
  return set;
}

} // namespace gnomon
