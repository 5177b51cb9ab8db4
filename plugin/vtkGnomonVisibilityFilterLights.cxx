// The lights of vtkGnomonVisibilityFilter.
#include "vtkGnomonVisibilityFilterInternals.h"

#include "lights/vtkGnomonSun.h"
#include "shadowtech/sky/SkyPatches.h"

#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkNew.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace
{

/// The end of errors of directions with hours.
const char* const givesNoLight =
  " hours gives no light, expected a finite vector with a length and hours of at least 0.";

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirection(const double towards[3], double hours)
{
  if (!gnomon::isDirection(glm::make_vec3(towards)) || !gnomon::areHours(hours))
  {
    vtkErrorMacro("Direction " << this->GetNumberOfLights() << " (" << towards[0] << ", "
                               << towards[1] << ", " << towards[2] << ") with " << hours
                               << givesNoLight);
    return;
  }
  this->Internal->lights.push_back({ glm::normalize(glm::make_vec3(towards)), hours, nullptr });
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirection(double x, double y, double z, double hours)
{
  const double towards[3] = { x, y, z };
  this->AddDirection(towards, hours);
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddDirections(vtkDataArray* directions, vtkDataArray* hours)
{
  if (!directions || directions->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("Directions need an array of three components.");
    return;
  }
  const vtkIdType count = directions->GetNumberOfTuples();
  if (hours && (hours->GetNumberOfComponents() != 1 || hours->GetNumberOfTuples() != count))
  {
    vtkErrorMacro("The hours of " << count
                                  << " directions need an array of as many numbers, not of "
                                  << hours->GetNumberOfTuples() << " tuples with "
                                  << hours->GetNumberOfComponents() << " components.");
    return;
  }
  std::vector<gnomon::AddedLight> added;
  for (vtkIdType i = 0; i < count; ++i)
  {
    glm::dvec3 towards;
    directions->GetTuple(i, &towards.x);
    const double time = hours ? hours->GetComponent(i, 0) : 1.0;
    if (!gnomon::isDirection(towards) || !gnomon::areHours(time))
    {
      vtkErrorMacro("Tuple " << i << " of the directions (" << towards.x << ", " << towards.y
                             << ", " << towards.z << ") with " << time << givesNoLight);
      return;
    }
    added.push_back({ glm::normalize(towards), time, nullptr });
  }
  std::vector<gnomon::AddedLight>& lights = this->Internal->lights;
  lights.insert(lights.end(), added.begin(), added.end());
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSunDay(vtkGnomonSun* sun, double stepMinutes)
{
  if (!sun)
  {
    vtkErrorMacro("There is no sun to add a day of.");
    return;
  }
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  if (sun->MakeDayPath(stepMinutes, directions, hours))
  {
    this->SetUp(sun->GetUp());
    this->AddDirections(directions, hours);
  }
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSunYear(vtkGnomonSun* sun, int dayStep, double stepMinutes)
{
  if (!sun)
  {
    vtkErrorMacro("There is no sun to add a year of.");
    return;
  }
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkDoubleArray> hours;
  if (sun->MakeYearPath(dayStep, stepMinutes, directions, hours))
  {
    this->SetUp(sun->GetUp());
    this->AddDirections(directions, hours);
  }
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddLight(vtkLight* light, double hours)
{
  if (!light || !gnomon::areHours(hours))
  {
    vtkErrorMacro("Light " << this->GetNumberOfLights() << (light ? "" : ", which is null,")
                           << " with " << hours
                           << " hours cannot be added, expected a number of at least 0.");
    return;
  }
  this->Internal->lights.push_back({ {}, hours, light });
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSky(int model, int directions)
{
  if (model < UNIFORM || model > OVERCAST)
  {
    vtkErrorMacro(
      "A sky of model " << model << " does not exist: 0 is uniform, 1 a dome, 2 overcast.");
    return;
  }
  if (!gnomon::SkyDirections::isCount(directions))
  {
    vtkErrorMacro(
      "A sky takes a power of two in [16, 65536] as directions, not " << directions << ".");
    return;
  }
  this->Internal->skyModel = static_cast<gnomon::SkyModel>(model);
  this->Internal->skyDirections = directions;
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::AddSkyPatches(const double up[3], const double north[3])
{
  const glm::dvec3 zenith = glm::make_vec3(up);
  const glm::dvec3 ahead = glm::make_vec3(north);
  if (!gnomon::isDirection(zenith) || !gnomon::isDirection(ahead) ||
    !gnomon::isDirection(glm::cross(glm::normalize(zenith), glm::normalize(ahead))))
  {
    vtkErrorMacro("The sky's up (" << up[0] << ", " << up[1] << ", " << up[2] << ") and north ("
                                   << north[0] << ", " << north[1] << ", " << north[2]
                                   << ") are to be two directions.");
    return;
  }
  this->SetUp(up);
  for (const gnomon::SkyPatch& patch :
    gnomon::skyPatches(glm::normalize(zenith), glm::normalize(ahead)))
  {
    this->AddDirection(&patch.towards.x, patch.solidAngle);
  }
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetSkyModel()
{
  return static_cast<int>(this->Internal->skyModel);
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetSkyDirections()
{
  return this->Internal->skyDirections;
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::ClearLights()
{
  this->Internal->lights.clear();
  this->Internal->skyDirections = 0;
  this->Internal->lightsTime.Modified();
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkGnomonVisibilityFilter::GetNumberOfLights()
{
  return static_cast<int>(this->Internal->lights.size());
}

//------------------------------------------------------------------------------
void vtkGnomonVisibilityFilter::GetDirection(int index, double towards[3])
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  const glm::dvec3 direction = added ? added->towards : glm::dvec3(0.0);
  std::copy_n(&direction.x, 3, towards);
}

//------------------------------------------------------------------------------
vtkLight* vtkGnomonVisibilityFilter::GetLight(int index)
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  return added ? added->light : nullptr;
}

//------------------------------------------------------------------------------
double vtkGnomonVisibilityFilter::GetHours(int index)
{
  const gnomon::AddedLight* const added = gnomon::findLight(this->Internal->lights, index);
  return added ? added->hours : 0.0;
}
