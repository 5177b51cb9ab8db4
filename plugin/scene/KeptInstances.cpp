#include "plugin/scene/KeptInstances.h"

#include "shadowtech/base/Instances.h"
#include "shadowtech/base/Occluders.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon
{
namespace
{

constexpr std::size_t fewestTrianglesOfSource = 64;
constexpr std::size_t fewestTriangles = 1u << 18;

bool isAffine(const glm::dmat4& matrix)
{
  return matrix[0].w == 0.0 && matrix[1].w == 0.0 && matrix[2].w == 0.0 && matrix[3].w == 1.0;
}

/// True if an instance is larger than the spacing of floats where it is, so that floats can
/// distinguish its vertices.
bool isVisible(const glm::mat4x3& instance, const glm::dvec3& extentSource)
{
  const glm::dmat4x3 matrix(instance);
  const glm::dvec3 extent = glm::abs(matrix[0]) * extentSource.x +
    glm::abs(matrix[1]) * extentSource.y + glm::abs(matrix[2]) * extentSource.z;
  const glm::dvec3 place = glm::abs(matrix[3]);
  const double spacing = std::ldexp(std::max(place.x, std::max(place.y, place.z)), -24);
  return std::max(extent.x, std::max(extent.y, extent.z)) > spacing;
}

} // namespace

bool areInstancesCheaper(std::size_t trianglesOfSource, std::size_t instances)
{
  return trianglesOfSource >= fewestTrianglesOfSource &&
    trianglesOfSource * instances >= fewestTriangles;
}

bool PlacedInstances::areMoved(const Surface& before) const
{
  const auto sameLeftOut = [](const glm::mat4x3& a, const glm::mat4x3& b)
  { return Surface::isLeftOut(a) == Surface::isLeftOut(b); };
  return this->mirrored == before.mirrored &&
    std::equal(this->centredFromSource.begin(), this->centredFromSource.end(),
      before.centredFromSource.begin(), before.centredFromSource.end(), sameLeftOut);
}

std::optional<PlacedInstances> placeKeptInstances(const glm::dmat4& worldFromModel,
  const std::vector<glm::mat4>& modelFromInstance, const SceneFrame& source,
  const Bounds& boundsSource, const SceneFrame& frame)
{
  if (!isAffine(worldFromModel))
  {
    return std::nullopt;
  }
  PlacedInstances placed;
  placed.centredFromSource.reserve(modelFromInstance.size());
  const glm::dvec3 extentSource = boundsSource.upper - boundsSource.lower;
  bool mirroring = false;
  bool keeping = false;
  for (const glm::mat4& place : modelFromInstance)
  {
    glm::dmat4 instance = worldFromModel * glm::dmat4(place);
    instance = glm::scale(instance, glm::dvec3(source.unitWorld()));
    instance = glm::translate(instance, source.centre);
    const bool finite = isWithin(affinelyTransformed(boundsSource, instance), largestOfWorld);
    const glm::mat4x3 rounded(frame.centredFrom(instance));
    if (!finite || !isVisible(rounded, extentSource))
    {
      ++(finite ? placed.leftOutVanished : placed.leftOutNonFinite);
      placed.centredFromSource.emplace_back(0.0f);
      continue;
    }
    const glm::dmat3 linear{ glm::dmat4x3(rounded) };
    if (!isRegular(linear))
    {
      return std::nullopt;
    }
    (glm::determinant(linear) < 0.0 ? mirroring : keeping) = true;
    placed.centredFromSource.push_back(rounded);
  }
  placed.mirrored = mirroring;
  return mirroring && keeping ? std::nullopt : std::optional(std::move(placed));
}

} // namespace gnomon
