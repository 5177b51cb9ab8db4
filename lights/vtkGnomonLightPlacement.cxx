#include "vtkGnomonLightPlacement.h"

#include "lights/Bounds.h"
#include "lights/LightManager.h"

#include "vtkCamera.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

vtkStandardNewMacro(vtkGnomonLightPlacement);

namespace
{

gnomon::Bounds toBounds(const double bounds[6])
{
  return { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
}

bool isFinite(const glm::dvec3& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Return the unit vector along which a light shines; nothing, with an error, if it has no
/// direction.
std::optional<glm::dvec3> travelOf(vtkLight* light)
{
  if (!light)
  {
    vtkErrorWithObjectMacro(light, "vtkGnomonLightPlacement needs a light, not null.");
    return std::nullopt;
  }
  const glm::dvec3 arm =
    glm::make_vec3(light->GetFocalPoint()) - glm::make_vec3(light->GetPosition());
  const double length = glm::length(arm);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    vtkErrorWithObjectMacro(
      light, "The light cannot be placed: its position and focal point give no direction.");
    return std::nullopt;
  }
  return arm / length;
}

void place(vtkLight* light, const glm::dvec3& position, const glm::dvec3& focalPoint)
{
  light->SetPosition(position.x, position.y, position.z);
  light->SetFocalPoint(focalPoint.x, focalPoint.y, focalPoint.z);
}

/// True if a sphere is finite and has a positive radius. Else report an error.
/// @param from the arguments that it follows from
bool isThere(vtkLight* light, const char* from, const glm::dvec3& centre, double radius)
{
  const bool isThere = isFinite(centre) && radius > 0.0 && std::isfinite(radius);
  if (!isThere)
  {
    vtkErrorWithObjectMacro(light,
      "The light cannot be placed: " << from << " give a sphere of radius " << radius << " around "
                                     << centre.x << ", " << centre.y << ", " << centre.z
                                     << ", expected finite numbers and a positive radius.");
  }
  return isThere;
}

void shineOnSphere(vtkLight* light, const char* from, const glm::dvec3& centre, double radius)
{
  if (!isThere(light, from, centre, radius))
  {
    return;
  }
  const std::optional<glm::dvec3> travel = travelOf(light);
  if (!travel)
  {
    return;
  }
  const double cone = light->GetConeAngle();
  const bool spot = light->GetPositional() && cone > 0.0 && cone < 90.0;
  const double distance = spot ? radius / std::sin(glm::radians(cone)) : radius;
  place(light, centre - distance * *travel, centre);
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::ShineOnSphere(vtkLight* light, const double center[3], double radius)
{
  shineOnSphere(light, "center and radius", glm::make_vec3(center), radius);
}

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::ShineOnBox(vtkLight* light, const double bounds[6])
{
  const gnomon::Bounds box = toBounds(bounds);
  shineOnSphere(light, "bounds", box.centre(), box.radius()); // an empty box has radius 0: an error
}

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::ShineOnPoints(vtkLight* light, vtkPoints* points)
{
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  gnomon::Bounds box;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const glm::dvec3 point = glm::make_vec3(points->GetPoint(i));
    if (!isFinite(point))
    {
      vtkErrorWithObjectMacro(
        light, "The light cannot be placed: point " << i << " is not finite.");
      return;
    }
    box.add(point);
  }
  const glm::dvec3 centre = box.centre();
  double radius = 0.0; // without points it stays 0: an error
  for (vtkIdType i = 0; i < count; ++i)
  {
    radius = std::max(radius, glm::length(glm::make_vec3(points->GetPoint(i)) - centre));
  }
  shineOnSphere(light, "points", centre, radius);
}

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::MakeKeyLight(
  vtkLight* light, vtkCamera* camera, const double bounds[6])
{
  if (!light || !camera)
  {
    vtkErrorWithObjectMacro(light, "A key light needs a light and a camera, not null.");
    return;
  }
  constexpr double left = glm::radians(35.0);
  constexpr double above = glm::radians(40.0);
  const glm::dvec3 fromView(
    -std::cos(above) * std::sin(left), std::sin(above), std::cos(above) * std::cos(left));
  const auto& rows = camera->GetViewTransformMatrix()->Element; // right, up and back
  glm::dvec3 from(0.0);
  for (int row = 0; row < 3; ++row)
  {
    from += fromView[row] * glm::make_vec3(rows[row]);
  }
  if (!isFinite(from))
  {
    vtkErrorWithObjectMacro(light, "The light cannot be placed: the camera looks nowhere.");
    return;
  }
  const gnomon::Bounds box = toBounds(bounds);
  if (!isThere(light, "bounds", box.centre(), box.radius()))
  {
    return;
  }
  light->SetLightTypeToSceneLight();
  light->SetTransformMatrix(nullptr);
  light->PositionalOff();
  place(light, box.centre() + box.radius() * from, box.centre());
}

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::SetPitchAndYaw(
  vtkLight* light, double pitchDegrees, double yawDegrees)
{
  if (!std::isfinite(pitchDegrees) || !std::isfinite(yawDegrees))
  {
    vtkErrorWithObjectMacro(light,
      "The light cannot be turned to pitchDegrees " << pitchDegrees << " and yawDegrees "
                                                    << yawDegrees << ", expected finite numbers.");
    return;
  }
  if (!travelOf(light))
  {
    return;
  }
  const double pitch = glm::radians(pitchDegrees);
  const double yaw = glm::radians(yawDegrees);
  const glm::dvec3 travel(
    -std::cos(pitch) * std::sin(yaw), std::sin(pitch), -std::cos(pitch) * std::cos(yaw));
  const glm::dvec3 position = glm::make_vec3(light->GetPosition());
  const glm::dvec3 focalPoint = glm::make_vec3(light->GetFocalPoint());
  const glm::dvec3 arm = glm::length(focalPoint - position) * travel;
  light->GetPositional() ? place(light, position, position + arm)
                         : place(light, focalPoint - arm, focalPoint);
}

//------------------------------------------------------------------------------
void vtkGnomonLightPlacement::GetPitchAndYaw(vtkLight* light, double degrees[2])
{
  const glm::dvec3 travel = travelOf(light).value_or(glm::dvec3(0.0));
  const double level = std::hypot(travel.x, travel.z);
  degrees[0] = glm::degrees(std::atan2(travel.y, level));
  // Straight up and down, what rounding leaves of the level direction turns anywhere.
  degrees[1] = level > 1e-12 ? glm::degrees(std::atan2(-travel.x, -travel.z)) : 0.0;
}

//------------------------------------------------------------------------------
bool vtkGnomonLightPlacement::IsHeadlight(vtkLight* light)
{
  if (!light)
  {
    vtkErrorWithObjectMacro(light, "vtkGnomonLightPlacement needs a light, not null.");
  }
  return light && gnomon::isHeadlight(light);
}
