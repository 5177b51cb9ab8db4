#include "lights/LightAt.h"

#include "lights/LightSpace.h"
#include "lights/VisibleBody.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// Return half the angle, in degrees, of a widened cone around a spot light's axis. With its apex
/// anywhere on the light, it holds the scene's part in the light's own cone.
double widenedConeDegrees(const ShadowLight& light, const ViewFitting& fitting)
{
  const double tangent = std::tan(glm::radians(light.coneAngleDegrees));
  const LightRays rays{ lightFromCentred(light, fitting.centreWorld), true };
  const double nearest = nearestOf(fitting.receiversCentred, rays);
  if (nearest == 0.0)
  {
    return light.coneAngleDegrees; // all of the scene lies behind the light
  }
  const ConvexBody lit = ConvexBody(fitting.receiversCentred, rays.viewFromCentred)
                           .clipped(coneHalfSpaces(tangent, nearest));
  const double reach = light.area->radius();
  double widened = tangent;
  // Slopes from a point are largest at a convex body's corners. The area lies across the axis.
  for (const glm::dvec3& corner : lit.vertices())
  {
    widened = std::max(widened, tangent + reach / corner.z); // z >= nearest > 0
  }
  return glm::degrees(std::atan(widened));
}

/// Give a directional light a box around all rays from one point of the light into the centre's
/// box.
/// @param at the light, with its direction already turned to the point's
/// @param towardsPoint vector towards the point
void standBox(ShadowLight& at, const ShadowLight& light, const glm::dvec3& towardsPoint)
{
  const LightBox& box = *light.box;
  const glm::dvec3 origin(0.0); // arbitrary
  const glm::dmat4 worldFromLight = glm::inverse(lightFromCentred(light, origin));
  // It is not along any point's rays, as these are turned by less than a right angle.
  at.box->upWorld = glm::dvec3(worldFromLight[1]);
  const glm::dmat4 pointFromWorld = lightFromCentred(at, origin);
  Bounds rays;
  for (int corner = 0; corner < 4; ++corner)
  {
    const glm::dvec3 near((corner & 1) ? 0.5 * box.width : -0.5 * box.width,
      (corner & 2) ? 0.5 * box.height : -0.5 * box.height, 0.0);
    const glm::dvec3 nearWorld(worldFromLight * glm::dvec4(near, 1.0));
    const glm::dvec3 farWorld = nearWorld + box.depth * light.directionWorld;
    for (const glm::dvec3& end : { nearWorld, farWorld, farWorld + box.depth * towardsPoint })
    {
      rays.add(glm::dvec3(pointFromWorld * glm::dvec4(end, 1.0)));
    }
  }
  const glm::dvec3 middle = 0.5 * (rays.lower + rays.upper);
  const glm::dvec3 size = rays.upper - rays.lower;
  at.positionWorld =
    glm::dvec3(glm::inverse(pointFromWorld) * glm::dvec4(middle.x, middle.y, rays.lower.z, 1.0));
  at.box->width = size.x;
  at.box->height = size.y;
  at.box->depth = size.z;
}

} // namespace

ShadowLight lightAt(const ShadowLight& light, const glm::dvec3& offset, const ViewFitting& fitting)
{
  ShadowLight at = light;
  at.area.reset();
  if (light.kind != LightKind::Directional)
  {
    at.positionWorld += offset;
  }
  if (light.kind == LightKind::Spot)
  {
    at.coneAngleDegrees = widenedConeDegrees(light, fitting);
  }
  if (light.kind == LightKind::Directional)
  {
    const glm::dvec3 towardsPoint = offset - light.directionWorld;
    at.directionWorld = -glm::normalize(towardsPoint); // the area lies at distance 1
    if (light.box)
    {
      standBox(at, light, towardsPoint);
    }
  }
  return at;
}

} // namespace gnomon
