#include "lights/SceneFrame.h"

#include "lights/ShadowLight.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// The largest distance of a lamp, or size of a box, in units. Squares of larger ones overflow
/// floats. From such a lamp, rays to any two points of a scene differ by less than floats can hold.
constexpr double farthest = 1e18;

/// The largest distance of a lamp's area from its centre, in units.
constexpr double largestArea = 1e12;

/// The tangent of the smallest angle that an area fills.
constexpr double smallestAngle = 1e-12;

/// Return a vector's direction, of any length: its square may overflow.
glm::dvec3 directionOf(const glm::dvec3& vector)
{
  return glm::normalize(
    vector / std::max({ std::abs(vector.x), std::abs(vector.y), std::abs(vector.z) }));
}

/// Let a far lamp shine in parallel rays.
/// @param toScene from the lamp
void makeParallel(ShadowLight& light, const glm::dvec3& toScene)
{
  const glm::dvec3 travel = directionOf(toScene);
  const double distance = glm::dot(toScene, travel);
  light.kind = LightKind::Directional;
  light.directionWorld = travel;
  light.coneAngleDegrees = 0.0;
  if (light.texture)
  {
    light.texture->pictureFromWorld *= static_cast<float>(distance);
  }
  if (light.area)
  {
    light.area->worldFromUnit /= distance;
    const double radius = light.area->radius();
    if (light.area->shape == LightArea::Shape::Ball)
    {
      light.area = diskArea(travel, radius);
    }
    if (radius < smallestAngle)
    {
      light.area.reset(); // a point, of the texture's mean
    }
  }
}

} // namespace

double SceneFrame::unitWorld() const
{
  return std::ldexp(1.0, this->exponent);
}

double SceneFrame::unitsPerWorld() const
{
  return std::ldexp(1.0, -this->exponent);
}

glm::dmat4 SceneFrame::centredFrom(const glm::dmat4& worldFromSpace) const
{
  glm::dmat4 matrix = worldFromSpace;
  for (int column = 0; column < 4; ++column)
  {
    matrix[column] *= glm::dvec4(glm::dvec3(this->unitsPerWorld()), 1.0);
    matrix[column] -= matrix[column].w * glm::dvec4(this->centre, 0.0);
  }
  return matrix;
}

SceneFrame sceneFrameOf(const Bounds& boundsWorld)
{
  const double radius = boundsWorld.radius();
  SceneFrame frame;
  if (boundsWorld.empty() || !std::isfinite(radius)) // beyond 1e154, its square overflows
  {
    return frame;
  }
  if (radius > 0.0)
  {
    frame.exponent = 30 * static_cast<int>(std::floor((std::ilogb(radius) + 10) / 30.0));
  }
  int exponent = 0; // radius < 2^exponent <= 2 radius
  std::frexp(radius, &exponent);
  const double step = std::ldexp(2.0, exponent);
  frame.centre = glm::round(boundsWorld.centre() / step) * (step * frame.unitsPerWorld());
  return frame;
}

std::string enterFrame(ShadowLight& light, const SceneFrame& frame)
{
  const double units = frame.unitsPerWorld();
  light.unitWorld = frame.unitWorld();
  light.positionWorld *= units;
  const bool isLamp = light.kind != LightKind::Directional;
  if (light.box)
  {
    light.box->width = std::min(light.box->width * units, farthest);
    light.box->height = std::min(light.box->height * units, farthest);
    light.box->depth = std::min(light.box->depth * units, farthest);
  }
  if (light.area && isLamp)
  {
    light.area->worldFromUnit *= units;
  }
  if (light.texture && isLamp)
  {
    light.texture->pictureFromWorld *= static_cast<float>(light.unitWorld);
  }

  const glm::dvec3 toScene = frame.centre - light.positionWorld;
  const bool isFar = (isLamp || light.box) && !isWithin(toScene, farthest);
  if (isFar && light.box)
  {
    return "its box begins too far away";
  }
  if (isFar && light.kind == LightKind::Spot &&
    !(glm::dot(directionOf(toScene), light.directionWorld) >
      std::cos(glm::radians(light.coneAngleDegrees))))
  {
    return "it is far away, and its cone passes the scene by";
  }
  if (isFar && light.texture && !isWithin(toScene, largestOfWorld))
  {
    return "it is too far away for its texture";
  }
  if (isFar)
  {
    makeParallel(light, toScene);
  }
  if (light.area && !(light.area->radius() <= largestArea))
  {
    return "its area is too large";
  }
  return {};
}

} // namespace gnomon
