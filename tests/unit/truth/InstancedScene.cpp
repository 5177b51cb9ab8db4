#include "InstancedScene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstdint>

namespace gnomon::test
{

//------------------------------------------------------------------------------
glm::dmat4 turned(Random& random, double spread)
{
  const glm::dmat4 turn =
    glm::rotate(glm::dmat4(1.0), uniform(random, -3.0, 3.0), unitVector(random));
  return glm::scale(turn, glm::pow(glm::dvec3(10.0), inCube(random, spread)));
}

//------------------------------------------------------------------------------
void makeInstanced(Occluders& occluders, std::size_t surface,
  const std::vector<glm::dmat4>& centredFromSource, bool mirrored)
{
  for (const glm::dmat4& instance : centredFromSource)
  {
    occluders.surfaces[surface].centredFromSource.emplace_back(instance);
  }
  occluders.surfaces[surface].mirrored = mirrored;
}

//------------------------------------------------------------------------------
Occluders expanded(const Occluders& instanced)
{
  Occluders result = instanced;
  result.positionsCentred.clear();
  result.triangles.clear();
  for (Surface& surface : result.surfaces)
  {
    const Surface source = surface;
    surface.centredFromSource.clear();
    surface.mirrored = false;
    surface.firstVertex = static_cast<std::uint32_t>(result.positionsCentred.size());
    surface.firstTriangle = static_cast<std::uint32_t>(result.triangles.size());
    const std::size_t count = std::max<std::size_t>(source.centredFromSource.size(), 1);
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto first = static_cast<std::uint32_t>(result.positionsCentred.size());
      for (std::uint32_t vertex = 0; vertex < source.vertexCount; ++vertex)
      {
        const glm::vec3 position = instanced.positionsCentred[source.firstVertex + vertex];
        result.positionsCentred.push_back(source.isInstanced()
            ? glm::vec3(
                glm::dmat4x3(source.centredFromSource[i]) * glm::dvec4(glm::dvec3(position), 1.0))
            : position);
      }
      for (std::uint32_t triangle = 0; triangle < source.triangleCount; ++triangle)
      {
        result.triangles.push_back(
          instanced.triangles[source.firstTriangle + triangle] - source.firstVertex + first);
      }
      if (i > 0)
      {
        surface.textureCoordinates.insert(surface.textureCoordinates.end(),
          source.textureCoordinates.begin(), source.textureCoordinates.end());
      }
    }
    surface.vertexCount = static_cast<std::uint32_t>(source.vertexCount * count);
    surface.triangleCount = static_cast<std::uint32_t>(source.triangleCount * count);
  }
  result.positionsCentred.emplace_back(0.0f); // padding that Occluders guarantees
  return result;
}

//------------------------------------------------------------------------------
Occluders cupsOverFloor(bool mirrored, bool oneSided)
{
  Mesh cup = makeSphere(8, 12);
  cup.triangles.resize(cup.triangles.size() / 2);
  Occluders occluders =
    makeOccluders({ { makePlane(20.0), at({ 0.0, 0.0, -3.0 }) }, { cup, glm::dmat4(1.0) } });
  for (std::uint32_t i = 0; i < occluders.surfaces[1].vertexCount; ++i) // as if uncentred
  {
    occluders.positionsCentred[occluders.surfaces[1].firstVertex + i] = glm::vec3(cup.points[i]);
  }
  occluders.surfaces[1].oneSided = oneSided;
  Random random(3);
  std::vector<glm::dmat4> instances;
  for (int i = 0; i < 60; ++i)
  {
    glm::dmat4 instance = turned(random, 0.3);
    instance[3] = glm::dvec4(6.0, 6.0, 2.0, 1.0) * glm::dvec4(inCube(random), 1.0);
    instances.push_back(mirrored ? glm::scale(instance, glm::dvec3(1.0, -1.0, 1.0)) : instance);
  }
  makeInstanced(occluders, 1, instances, mirrored);
  return occluders;
}

//------------------------------------------------------------------------------
void perforate(Occluders& occluders)
{
  Surface& cups = occluders.surfaces[1];
  cups.cutout = makePerforatedPlane(1.0, 1).cutout;
  for (std::uint32_t i = 0; i < cups.vertexCount; ++i)
  {
    const glm::vec3 position = occluders.positionsCentred[cups.firstVertex + i];
    cups.textureCoordinates.emplace_back(1.7f * position.x, position.y + 0.4f * position.z);
  }
}

} // namespace gnomon::test
