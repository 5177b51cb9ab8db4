#include "lights/LightArea.h"

#include "lights/LightSpace.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// Return a point on the border of the square of half side 1.
/// @param share of the way around the border, in [0, 1)
glm::dvec3 borderOfSquare(double share)
{
  const double sides = 4.0 * share;
  const double along = 2.0 * (sides - std::floor(sides)) - 1.0;
  switch (static_cast<int>(sides))
  {
    case 0:
      return { along, -1.0, 0.0 };
    case 1:
      return { 1.0, along, 0.0 };
    case 2:
      return { -along, 1.0, 0.0 };
    default:
      return { -1.0, -along, 0.0 };
  }
}

/// Return a point of a spiral over the unit sphere whose points represent equal areas.
/// @param share the point's place along the spiral, in (0, 1)
glm::dvec3 pointOfSphere(double share, std::size_t number)
{
  const double angle =
    glm::two_pi<double>() * glm::golden_ratio<double>() * static_cast<double>(number);
  const double height = 1.0 - 2.0 * share;
  const double across = std::sqrt(1.0 - height * height);
  return { across * std::cos(angle), across * std::sin(angle), height };
}

} // namespace

double LightArea::radius() const
{
  const double longest = glm::length(this->worldFromUnit[0]);
  return this->shape == Shape::Rectangle
    ? glm::length(glm::dvec2(longest, glm::length(this->worldFromUnit[1])))
    : longest;
}

double LightArea::extentAlong(const glm::dvec3& direction) const
{
  const glm::dvec3 ofAxes = glm::abs(direction * this->worldFromUnit);
  return this->shape == Shape::Rectangle ? ofAxes.x + ofAxes.y : glm::length(ofAxes);
}

LightArea rectangleArea(const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize)
{
  const glm::dvec3 along = glm::normalize(glm::cross(travel, up));
  return { LightArea::Shape::Rectangle,
    { halfSize.x * along, halfSize.y * glm::cross(along, travel), glm::dvec3(0.0) } };
}

LightArea diskArea(const glm::dvec3& travel, double radius)
{
  // A disk's axes are arbitrary.
  const LightArea square = rectangleArea(travel, axisAcross(travel), glm::dvec2(radius));
  return { LightArea::Shape::Disk, square.worldFromUnit };
}

LightArea ballArea(double radius)
{
  return { LightArea::Shape::Ball, glm::dmat3(radius) };
}

std::vector<glm::dvec3> rimOf(const LightArea& area, std::size_t points)
{
  std::vector<glm::dvec3> rim;
  for (std::size_t i = 0; i < points; ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(points);
    const double angle = glm::two_pi<double>() * share;
    const glm::dvec3 unit = area.shape == LightArea::Shape::Rectangle ? borderOfSquare(share)
      : area.shape == LightArea::Shape::Disk
      ? glm::dvec3(std::cos(angle), std::sin(angle), 0.0)
      : pointOfSphere(share + 0.5 / static_cast<double>(points), i);
    rim.push_back(area.worldFromUnit * unit);
  }
  return rim;
}

} // namespace gnomon
