#include "lights/LightManager.h"

#include "vtkGnomonLightKeys.h"

#include <vtkCollection.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationStringKey.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>
#include <vtkRenderer.h>

#include <algorithm>

namespace gnomon
{
namespace
{

/// Half angles up to which one perspective map serves a spot light.
constexpr double largestMapConeAngleDegrees = 89.0;

///@{
/// The sides that a map can have, in texels: those that vtkGnomonShadowPass::SetMapSize takes.
constexpr int smallestMapSizeTexels = 16;
constexpr int largestMapSizeTexels = 16384;
///@}

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
  if (light->GetShadowAttenuation() <= 0.0f)
  {
    return "its shadow attenuation is 0";
  }
  if (light->GetPositional())
  {
    if (light->GetConeAngle() >= 90.0)
    {
      return "point lights are not supported yet";
    }
    if (light->GetConeAngle() > largestMapConeAngleDegrees)
    {
      return "its cone is wider than 89 degrees";
    }
    if (light->GetConeAngle() <= 0.0)
    {
      return "its cone is empty";
    }
  }
  double position[3];
  double focalPoint[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focalPoint);
  const double distance2 = vtkMath::Distance2BetweenPoints(position, focalPoint);
  if (!(distance2 > 0.0) || !vtkMath::IsFinite(distance2))
  {
    return "its position and focal point give no direction";
  }
  return {};
}

ShadowLight readLight(vtkLight* light, const LightDefaults& defaults)
{
  ShadowLight result;
  result.kind = light->GetPositional() ? LightKind::Spot : LightKind::Directional;
  glm::dvec3 position;
  glm::dvec3 focalPoint;
  light->GetTransformedPosition(&position.x);
  light->GetTransformedFocalPoint(&focalPoint.x);
  result.positionWorld = position;
  result.directionWorld = glm::normalize(focalPoint - position);
  result.coneAngleDegrees = light->GetPositional() ? light->GetConeAngle() : 0.0;
  result.strength = glm::clamp(static_cast<double>(light->GetShadowAttenuation()), 0.0, 1.0);

  vtkInformation* keys = light->GetInformation();
  result.technique = keys->Has(vtkGnomonLightKeys::TECHNIQUE())
    ? keys->Get(vtkGnomonLightKeys::TECHNIQUE())
    : defaults.technique;
  result.mapSizeTexels = keys->Has(vtkGnomonLightKeys::MAP_SIZE())
    ? keys->Get(vtkGnomonLightKeys::MAP_SIZE())
    : defaults.mapSizeTexels;
  result.mapSizeTexels =
    std::clamp(result.mapSizeTexels, smallestMapSizeTexels, largestMapSizeTexels);
  return result;
}

} // namespace

//------------------------------------------------------------------------------
LightSet LightManager::collect(vtkRenderer* renderer, const LightDefaults& defaults)
{
  LightSet set;
  int sceneIndex = 0;
  int shaderIndex = 0;
  vtkLightCollection* lights = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    const std::string reason = reasonToSkip(light);
    if (reason.empty())
    {
      set.casting.push_back(readLight(light, defaults));
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
