#pragma once

#include "lights/SceneFrame.h"
#include "plugin/data/VisibilityRun.h"

#include "vtkLight.h"
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace gnomon
{

/// A light as the user added it.
struct AddedLight
{
  glm::dvec3 towards{ 0.0 }; ///< of a direction: unit
  double hours = 0.0;
  vtkSmartPointer<vtkLight> light; ///< null for a direction
};

/// True if a vector is finite and not 0.
bool isDirection(const glm::dvec3& vector);
/// True if a duration is finite and not negative.
bool areHours(double hours);

/// Return a light by its number; null if there is none.
const AddedLight* findLight(const std::vector<AddedLight>& lights, int number);

/// Return the time of the last change of any vtkLight; 0 if there is none.
vtkMTimeType changeTime(const std::vector<AddedLight>& lights);

/// Return the lights as rays see them.
/// @param diameterDegrees of the disc of directions
/// @param reason receives why one of them cannot shine
std::vector<WeightedLight> weightedLights(const std::vector<AddedLight>& added,
  const SceneFrame& frame, double diameterDegrees, std::string& reason);

} // namespace gnomon
