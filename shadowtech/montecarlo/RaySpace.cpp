#include "shadowtech/montecarlo/RaySpace.h"

#include "lights/LightViews.h"

#include <cmath>

namespace gnomon
{
namespace
{

bool stepsBack(const ShadowLight& light)
{
  return light.area && light.kind == LightKind::Spot && viewLayout(light) == ViewLayout::Single;
}

} // namespace

//------------------------------------------------------------------------------
double distanceToProjectionPoint(const ShadowLight& light)
{
  if (!stepsBack(light))
  {
    return 0.0;
  }
  const double angle = glm::radians(light.coneAngleDegrees);
  return light.area->radius() /
    (light.area->shape == LightArea::Shape::Ball ? std::sin(angle) : std::tan(angle));
}

//------------------------------------------------------------------------------
double nearestOfArea(const ShadowLight& light)
{
  const bool ball = light.area && light.area->shape == LightArea::Shape::Ball;
  return distanceToProjectionPoint(light) - (ball && stepsBack(light) ? light.area->radius() : 0.0);
}

//------------------------------------------------------------------------------
ShadowLight lightOfMap(const ShadowLight& light)
{
  ShadowLight seen = light;
  seen.positionWorld -= distanceToProjectionPoint(light) * light.directionWorld;
  seen.box.reset();
  return seen;
}

//------------------------------------------------------------------------------
glm::dmat4 rayFromCentred(const LightView& view, int sizeTexels, double nearest)
{
  const glm::dmat3 texels = texelFromAcross(view, sizeTexels);
  // Each column holds what x, y, z or w of view space adds to (u, v, p, w).
  glm::dmat4 rayFromView(0.0);
  const auto place = [&](int column)
  { return glm::dvec4(texels[column].x, texels[column].y, 0.0, texels[column].z); };
  rayFromView[0] = place(0);
  rayFromView[1] = place(1);
  if (view.rays.positional)
  {
    rayFromView[2] = place(2);
    rayFromView[3].z = -nearest;
  }
  else
  {
    rayFromView[2].z = view.depthScale;
    rayFromView[3] = place(2) + glm::dvec4(0.0, 0.0, view.depthOffset, 0.0);
  }
  return rayFromView * view.rays.viewFromCentred;
}

} // namespace gnomon
