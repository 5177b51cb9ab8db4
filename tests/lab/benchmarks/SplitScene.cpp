#include "SplitScene.h"

#include "RandomScenes.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace gnomon::test
{
namespace
{

/// Return the numbers of all triangles in the order that parts take runs of.
std::vector<std::uint32_t> orderOf(const Occluders& whole, SplitWay way, std::mt19937& random)
{
  std::vector<std::uint32_t> order(whole.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  if (way == SplitWay::Slabs)
  {
    // Along an axis, parts meet in sides of boxes.
    glm::dvec3 direction = unitVector(random);
    const auto axis = static_cast<int>(uniform(random, 0.0, 6.0));
    if (axis < 3)
    {
      direction = glm::dvec3(0.0);
      direction[axis] = 1.0;
    }
    std::vector<double> places;
    places.reserve(order.size());
    for (const glm::uvec3& corners : whole.triangles)
    {
      places.push_back(glm::dot(direction,
        glm::dvec3(whole.positionsCentred[corners.x]) +
          glm::dvec3(whole.positionsCentred[corners.y]) +
          glm::dvec3(whole.positionsCentred[corners.z])));
    }
    std::stable_sort(order.begin(), order.end(),
      [&](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
  }
  return order;
}

} // namespace

//------------------------------------------------------------------------------
std::unique_ptr<TracedScene> makeTracedScene(
  const Occluders& whole, const std::vector<bool>& isTaken)
{
  auto scene = std::make_unique<TracedScene>();
  Occluders& part = scene->occluders;
  part = whole;
  part.triangles.clear();
  part.positionsCentred.reserve(part.positionsCentred.size() + 1); // Embree reads beyond the last
  for (Surface& surface : part.surfaces)
  {
    const std::uint32_t first = surface.firstTriangle;
    surface.firstTriangle = static_cast<std::uint32_t>(part.triangles.size());
    for (std::uint32_t i = first; i < first + surface.triangleCount; ++i)
    {
      if (isTaken.empty() || isTaken[i])
      {
        part.triangles.push_back(whole.triangles[i]);
      }
    }
    surface.triangleCount =
      static_cast<std::uint32_t>(part.triangles.size()) - surface.firstTriangle;
    surface.triangleOfDrawn.clear();
  }
  scene->tracer.update(part);
  return scene;
}

//------------------------------------------------------------------------------
std::vector<int> splitTriangles(
  const Occluders& whole, SplitWay way, int parts, std::mt19937& random)
{
  const std::size_t count = whole.triangles.size();
  std::vector<int> partOf(count);
  if (way == SplitWay::Scattered)
  {
    std::uniform_int_distribution<int> part(0, parts - 1);
    std::generate(partOf.begin(), partOf.end(), [&] { return part(random); });
    return partOf;
  }
  std::vector<std::size_t> ends(static_cast<std::size_t>(parts), count);
  std::uniform_int_distribution<std::size_t> place(0, count);
  std::generate(ends.begin(), ends.end() - 1, [&] { return place(random); });
  std::sort(ends.begin(), ends.end());
  const std::vector<std::uint32_t> order = orderOf(whole, way, random);
  std::size_t begin = 0;
  for (std::size_t part = 0; part < ends.size(); ++part)
  {
    for (; begin < ends[part]; ++begin)
    {
      partOf[order[begin]] = static_cast<int>(part);
    }
  }
  return partOf;
}

} // namespace gnomon::test
