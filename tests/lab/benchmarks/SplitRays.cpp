#include "SplitRays.h"

#include "RandomScenes.h"

#include "lights/LightSamples.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

namespace gnomon::test
{
namespace
{

/// A receiver's triangle in pixels, for shadowRayOffsetInside().
constexpr double pixelsAlong = 1024.0;

bool happens(std::mt19937& random, double probability)
{
  return uniform(random, 0.0, 1.0) < probability;
}

glm::dvec3 randomAxis(std::mt19937& random)
{
  glm::dvec3 axis(0.0);
  axis[std::uniform_int_distribution<int>(0, 2)(random)] = happens(random, 0.5) ? 1.0 : -1.0;
  return axis;
}

ShadowLight randomLight(const Occluders& occluders, std::mt19937& random)
{
  ShadowLight light;
  const bool isSun = happens(random, 0.5);
  const bool hasArea = happens(random, 0.5);
  if (isSun)
  {
    light.directionWorld = happens(random, 0.25) ? randomAxis(random) : unitVector(random);
    if (hasArea)
    {
      light.area = diskArea(light.directionWorld, std::pow(10.0, uniform(random, -3.0, -1.0)));
    }
    return light;
  }
  const Bounds& bounds = occluders.allCentred;
  light.kind = LightKind::Point;
  light.positionWorld = occluders.frame.centre + bounds.centre() +
    0.5 * (bounds.upper - bounds.lower) *
      glm::dvec3(
        uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
  if (hasArea)
  {
    light.area = ballArea(bounds.radius() * std::pow(10.0, uniform(random, -3.0, -1.0)));
  }
  return light;
}

/// A start of shadow rays on a triangle.
struct Start
{
  glm::vec3 position;
  glm::vec3 normal;
  float offset;
};

/// Return a random point of a random triangle.
Start randomStart(const Occluders& occluders, std::mt19937& random)
{
  const auto triangle = std::uniform_int_distribution<std::uint32_t>(
    0, static_cast<std::uint32_t>(occluders.triangles.size()) - 1)(random);
  const Surface& surface =
    *std::prev(std::upper_bound(occluders.surfaces.begin(), occluders.surfaces.end(), triangle,
      [](std::uint32_t of, const Surface& next) { return of < next.firstTriangle; }));
  const auto corners = centredCorners(occluders, surface, 0, triangle);
  const auto& [a, b, c] = corners;
  const glm::dvec3 areaVector = glm::cross(b - a, c - a);
  const double doubleArea = glm::length(areaVector); // > 0 in snapshots
  const glm::vec3 normal(areaVector / doubleArea);
  const double root = std::sqrt(uniform(random, 0.0, 1.0));
  const double along = uniform(random, 0.0, 1.0);
  const glm::dvec3 place = (1.0 - root) * a + root * (1.0 - along) * b + root * along * c;
  const double longest = std::max({ glm::length(b - a), glm::length(c - a), glm::length(c - b) });
  return { glm::vec3(place), happens(random, 0.5) ? normal : -normal,
    shadowRayOffsetInside(noiseOf(occluders, surface, 0, triangle, corners, normal, doubleArea),
      static_cast<float>(longest / pixelsAlong)) };
}

} // namespace

//------------------------------------------------------------------------------
void RayList::add(const glm::vec3& origin, const glm::vec3& direction)
{
  this->originX_.push_back(origin.x);
  this->originY_.push_back(origin.y);
  this->originZ_.push_back(origin.z);
  this->directionX_.push_back(direction.x);
  this->directionY_.push_back(direction.y);
  this->directionZ_.push_back(direction.z);
}

//------------------------------------------------------------------------------
TestedRay RayList::operator[](std::size_t i) const
{
  return { { this->originX_[i], this->originY_[i], this->originZ_[i] },
    { this->directionX_[i], this->directionY_[i], this->directionZ_[i] }, this->rayFar_ };
}

//------------------------------------------------------------------------------
std::vector<std::uint8_t> RayList::blockedBy(const EmbreeTracer& tracer) const
{
  std::vector<std::uint8_t> blocked(this->size());
  tracer.areBlocked(this->size(),
    { this->originX_.data(), this->originY_.data(), this->originZ_.data() },
    { this->directionX_.data(), this->directionY_.data(), this->directionZ_.data() }, this->rayFar_,
    blocked.data());
  return blocked;
}

//------------------------------------------------------------------------------
RayList randomShadowRays(const Occluders& occluders, std::size_t count, std::mt19937& random)
{
  const ShadowLight light = randomLight(occluders, random);
  const ShadowRayLight rayLight(light, occluders.frame.centre);
  const std::optional<LightSamples> samples =
    light.area ? std::optional<LightSamples>(light) : std::nullopt;
  return visitShadowRays(rayLight,
    [&](const auto& makeRay, float rayFar)
    {
      RayList rays(rayFar);
      while (rays.size() < count)
      {
        const Start start = randomStart(occluders, random);
        const ShadowRay ray = makeRay(start.position, start.normal, start.offset);
        if (!ray.traced)
        {
          continue;
        }
        glm::vec3 direction = ray.direction;
        if (samples)
        {
          const SamplePixel pixel = samples->pixel(random() & 1023u, random() & 1023u);
          const int sample = std::uniform_int_distribution<int>(0, samples->count() - 1)(random);
          direction =
            directionToSample(areaRays(rayLight, start.position, start.normal, ray.direction),
              samples->offset(sample, pixel));
        }
        rays.add(ray.origin, direction);
      }
      return rays;
    });
}

//------------------------------------------------------------------------------
RayList raysAtEdges(const Occluders& occluders, std::size_t count, std::mt19937& random)
{
  RayList rays(shadowRayFarAtLight);
  std::uniform_int_distribution<std::size_t> triangle(0, occluders.triangles.size() - 1);
  std::uniform_int_distribution<int> corner(0, 2);
  const double radius = occluders.allCentred.radius();
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::uvec3& corners = occluders.triangles[triangle(random)];
    const int first = corner(random);
    const std::array<double, 3> places = { 0.0, 0.5, uniform(random, 0.0, 1.0) };
    const glm::dvec3 target = glm::mix(glm::dvec3(occluders.positionsCentred[corners[first]]),
      glm::dvec3(occluders.positionsCentred[corners[(first + 1) % 3]]),
      places[static_cast<std::size_t>(corner(random))]);
    const double distance = radius * std::pow(10.0, uniform(random, -3.0, 0.3));
    const glm::dvec3 from = happens(random, 0.25) ? randomAxis(random) : unitVector(random);
    const glm::vec3 origin(target + distance * from);
    constexpr double past = 1.0 + 1.0 / 256.0;
    rays.add(origin, past * (target - glm::dvec3(origin)));
  }
  return rays;
}

} // namespace gnomon::test
