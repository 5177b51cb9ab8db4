#include "lights/LightSamples.h"

#include "lights/LightSpace.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace gnomon
{
namespace
{

/// The golden angle, 2 pi (1 - 1 / phi): no two turns of the spiral line up.
const double goldenAngle = glm::pi<double>() * (3.0 - std::sqrt(5.0));

/// Point i of n, evenly spread over the unit disc.
glm::dvec2 discPoint(int i, int n)
{
  const double radius = std::sqrt((i + 0.5) / n);
  return radius * glm::dvec2(std::cos(i * goldenAngle), std::sin(i * goldenAngle));
}

/// The bits of i behind the point instead of before it: in [0, 1), evenly spread for every run of i.
double radicalInverse(int i)
{
  double value = 0.0;
  for (double digit = 0.5; i > 0; i /= 2, digit *= 0.5)
  {
    value += i % 2 ? digit : 0.0;
  }
  return value;
}

/// The radius within which a share of the ball's light lies. With r = sin(a), that share is
/// (2 a - sin 2a) / pi.
double ballRadius(double share)
{
  double low = 0.0;
  double high = glm::half_pi<double>();
  for (int step = 0; step < 50; ++step)
  {
    const double middle = 0.5 * (low + high);
    (2.0 * middle - std::sin(2.0 * middle) < glm::pi<double>() * share ? low : high) = middle;
  }
  return std::sin(low);
}

/// Point i of n of the unit ball.
glm::dvec3 ballPoint(int i, int n)
{
  const double z = 1.0 - (2.0 * i + 1.0) / n;
  const double across = std::sqrt(1.0 - z * z);
  const glm::dvec3 direction(
    across * std::cos(i * goldenAngle), across * std::sin(i * goldenAngle), z);
  return ballRadius(radicalInverse(i) + 0.5 / n) * direction;
}

} // namespace

//------------------------------------------------------------------------------
glm::dvec4 lightPoint(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  return light.kind == LightKind::Directional
    ? glm::dvec4(-glm::normalize(light.directionWorld), 0.0)
    : glm::dvec4(light.positionWorld - centreWorld, 1.0);
}

//------------------------------------------------------------------------------
std::vector<glm::dvec4> lightSamples(const ShadowLight& light, const glm::dvec3& centreWorld)
{
  const glm::dvec4 centre = lightPoint(light, centreWorld);
  if (light.lightRadius == 0.0)
  {
    return { centre };
  }
  const int n = light.lightSamples;
  const glm::dmat3 centredFromLight =
    glm::transpose(glm::dmat3(lightFromCentred(light, centreWorld)));
  std::vector<glm::dvec4> samples;
  samples.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
  {
    const glm::dvec3 offset = light.lightRadius *
      (light.kind == LightKind::Point ? ballPoint(i, n)
                                      : centredFromLight * glm::dvec3(discPoint(i, n), 0.0));
    const glm::dvec3 moved = glm::dvec3(centre) + offset;
    samples.push_back(light.kind == LightKind::Directional ? glm::dvec4(glm::normalize(moved), 0.0)
                                                           : glm::dvec4(moved, 1.0));
  }
  return samples;
}

} // namespace gnomon
