#pragma once

#include "SplitMargin.h"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace gnomon
{
class EmbreeTracer;
}

namespace gnomon::test
{

/// Rays of one length.
class RayList
{
public:
  explicit RayList(float rayFar)
    : rayFar_(rayFar)
  {
  }
  void add(const glm::vec3& origin, const glm::vec3& direction);
  std::size_t size() const { return this->originX_.size(); }
  TestedRay operator[](std::size_t i) const;
  /// Test which rays are blocked.
  std::vector<std::uint8_t> blockedBy(const EmbreeTracer& tracer) const;

private:
  float rayFar_;
  std::vector<float> originX_, originY_, originZ_;
  std::vector<float> directionX_, directionY_, directionZ_;
};

/// Return shadow rays from random points of random triangles to a random light: a sun, a point
/// light, or points of a sun's disc or of a ball. One sun in four shines along an axis.
RayList randomShadowRays(const Occluders& occluders, std::size_t count, std::mt19937& random);

/// Return rays that are aimed at corners, at middles of edges and at random points of edges. They
/// end just behind these points. One in four goes along an axis.
RayList raysAtEdges(const Occluders& occluders, std::size_t count, std::mt19937& random);

} // namespace gnomon::test
