#include "lights/LightArea.h"

#include "lights/LightSpace.h"

namespace gnomon
{

//------------------------------------------------------------------------------
double LightArea::radius() const
{
  const double longest = glm::length(this->worldFromUnit[0]);
  return this->shape == Shape::Rectangle
    ? glm::length(glm::dvec2(longest, glm::length(this->worldFromUnit[1])))
    : longest;
}

//------------------------------------------------------------------------------
LightArea rectangleArea(const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize)
{
  const glm::dvec3 along = glm::normalize(glm::cross(travel, up));
  return { LightArea::Shape::Rectangle,
    { halfSize.x * along, halfSize.y * glm::cross(along, travel), glm::dvec3(0.0) } };
}

//------------------------------------------------------------------------------
LightArea diskArea(const glm::dvec3& travel, double radius)
{
  // Any axes do.
  const LightArea square = rectangleArea(travel, axisAcross(travel), glm::dvec2(radius));
  return { LightArea::Shape::Disk, square.worldFromUnit };
}

//------------------------------------------------------------------------------
LightArea ballArea(double radius)
{
  return { LightArea::Shape::Ball, glm::dmat3(radius) };
}

} // namespace gnomon
