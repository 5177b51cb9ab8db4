#include "shadowtech/base/SmoothFacet.h"

#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/SeenTriangle.h"

#include <algorithm>
#include <cmath>

namespace gnomon
{
namespace
{

/// Return the normals of a triangle's corners; none if one is too far off the triangle's normal.
/// @param turn transforms normals to centred coordinates and the camera's side
std::optional<std::array<glm::vec3, 3>> turnedNormals(const glm::dmat3& turn,
  const glm::vec3* normals, const glm::uvec3& vertices, const glm::dvec3& normal)
{
  std::array<glm::vec3, 3> turned;
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 centred = turn * glm::dvec3(normals[vertices[i]]);
    const double length = glm::length(centred);
    // Written so that NaN fails.
    if (!(glm::dot(centred, normal) > leastCosineOfCurve * length))
    {
      return std::nullopt;
    }
    turned[static_cast<std::size_t>(i)] = centred / length;
  }
  return turned;
}

} // namespace

std::optional<std::array<glm::vec3, 3>> cornerNormals(
  const Occluders& occluders, const TriangleOfFragment& found, const glm::dvec3& normal, bool back)
{
  const Surface& surface = occluders.surfaces[found.surface];
  if (surface.pointNormals.empty())
  {
    return std::nullopt;
  }
  const glm::dmat3 linear = surface.isInstanced()
    ? glm::dmat3(glm::dmat4(surface.centredFromSource[found.instance]))
    : glm::dmat3(surface.centredFromNormals);
  return turnedNormals(normalMatrix(linear) * (back ? -1.0 : 1.0), surface.pointNormals.data(),
    occluders.triangles[found.triangle] - surface.firstVertex, normal);
}

float largestHeightOf(const std::vector<glm::vec3>& positions,
  const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec3>& normals)
{
  const auto isThere = [&](const glm::uvec3& triangle) {
    return std::max({ triangle.x, triangle.y, triangle.z }) < positions.size();
  };
  float largest = 0.0f;
  double curvedArea = 0.0, flatArea = 0.0; // doubled
  for (const glm::uvec3& triangle : triangles)
  {
    if (!isThere(triangle))
    {
      continue;
    }
    const std::array<glm::dvec3, 3> corners{ positions[triangle.x], positions[triangle.y],
      positions[triangle.z] };
    const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::length(areaVector);
    // NaN without area; then the normals are rejected.
    const auto turned = turnedNormals(glm::dmat3(1.0), normals.data(), triangle, areaVector / area);
    (turned ? curvedArea : flatArea) += area;
    if (turned)
    {
      largest = std::max(largest, SmoothFacet(corners, *turned).largestHeight());
    }
  }
  return flatArea > 0.01 * curvedArea ? 0.0f : largest;
}

SmoothFacet::SmoothFacet(
  const std::array<glm::dvec3, 3>& corners, const std::array<glm::vec3, 3>& normals)
  : first_(corners[0])
  , normals_(normals)
{
  const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double perArea = 1.0 / glm::dot(areaVector, areaVector);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const glm::dvec3 opposite = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    this->gradients_[i] = glm::cross(areaVector, opposite) * perArea;
    this->corners_[i] = corners[i] - corners[0];
    this->below_[i] = -glm::dot(this->normals_[i], this->corners_[i]);
  }
}

#ifdef __x86_64__
[[gnu::target_clones("avx2", "default")]]
#endif
void
SmoothFacet::look(std::size_t count, const PointArrays& points, float* heights,
  const std::array<float*, 3>& normals) const
{
  const glm::vec3 first = this->first_;
  const std::array<glm::vec3, 3> gradients = this->gradients_;
  const std::array<glm::vec3, 3> ofCorners = this->normals_;
  const std::array<float, 3> below = this->below_;
  float *const normalX = normals[0], *const normalY = normals[1], *const normalZ = normals[2];
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i)
  {
    const float x = points.x[i] - first.x, y = points.y[i] - first.y, z = points.z[i] - first.z;
    float height = 0.0f;
    float sumX = 0.0f, sumY = 0.0f, sumZ = 0.0f;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::vec3 normal = ofCorners[k];
      const float share = std::max(0.0f,
        gradients[k].x * x + gradients[k].y * y + gradients[k].z * z + (k == 0 ? 1.0f : 0.0f));
      const float above = normal.x * x + normal.y * y + normal.z * z + below[k];
      height += share * std::max(0.0f, -above);
      sumX += share * normal.x;
      sumY += share * normal.y;
      sumZ += share * normal.z;
    }
    const float perLength = 1.0f / std::sqrt(sumX * sumX + sumY * sumY + sumZ * sumZ);
    heights[i] = height;
    normalX[i] = sumX * perLength;
    normalY[i] = sumY * perLength;
    normalZ[i] = sumZ * perLength;
  }
}

float SmoothFacet::largestHeight() const
{
  std::array<std::array<float, 4>, 3> places, normals;
  for (glm::length_t axis = 0; axis < 3; ++axis)
  {
    const float a = this->corners_[0][axis], b = this->corners_[1][axis],
                c = this->corners_[2][axis];
    const float first = this->first_[axis];
    places[static_cast<std::size_t>(axis)] = { first + (a + b + c) / 3.0f, first + 0.5f * (a + b),
      first + 0.5f * (b + c), first + 0.5f * (c + a) };
  }
  std::array<float, 4> heights;
  this->look(4, { places[0].data(), places[1].data(), places[2].data() }, heights.data(),
    { normals[0].data(), normals[1].data(), normals[2].data() });
  return *std::max_element(heights.begin(), heights.end());
}

} // namespace gnomon
