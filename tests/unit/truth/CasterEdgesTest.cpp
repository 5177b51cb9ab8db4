#include "shadowtech/mesh/CasterEdges.h"

#include "RandomScenes.h"

#include "shadowtech/base/WeldedVertices.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::test
{
namespace
{

CasterEdges casterEdgesOf(const Occluders& occluders)
{
  CasterEdges edges;
  edges.update(occluders);
  return edges;
}

/// A sphere whose seam and poles close exactly, not only to within rounding.
Mesh makeClosedSphere(int rings, int segments)
{
  Mesh sphere = makeSphere(rings, segments);
  for (glm::dvec3& point : sphere.points)
  {
    point = glm::round(1e6 * point) / 1e6;
  }
  return sphere;
}

TEST(CasterEdges, areAsManyAndEndAndAreSharpAsTheMeshSays)
{
  const Mesh sphere = makeClosedSphere(32, 64);
  const std::size_t ofSphere = 3 * sphere.triangles.size() / 2;
  Mesh wound = makePlane(1.0);
  std::swap(wound.triangles[1].x, wound.triangles[1].y);
  const Mesh threeAtAnEdge{ { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 },
                              { -1.0, 1.0, 0.0 }, { -1.0, -1.0, 0.0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } } };
  const Mesh needle{ { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.5, 1e-6, 0.0 },
                       { 0.5, -1.0, 0.0 } },
    { { 0, 1, 2 }, { 1, 0, 3 } } };
  struct Case
  {
    const char* name;
    Mesh mesh;
    std::size_t edges, ends, sharp, sameDirection;
  };
  const Case cases[] = { { "closed", sphere, ofSphere, 0, 0, 0 },
    { "closed, without common vertices", apart(sphere), ofSphere, 0, 0, 0 },
    { "sheet", makePlane(2.0, 3), 12 + 12 + 9, 12, 12, 0 }, // border, between cells, across cells
    // Every edge leads to a corner, where the angle between the sides is too large.
    { "box", makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)), 18, 0, 18, 0 },
    { "three triangles share an edge", threeAtAnEdge, 9, 9, 9, 0 },
    { "wound differently", wound, 5, 4, 4, 1 }, { "needle", needle, 5, 4, 5, 0 } };
  for (const auto& [name, mesh, count, ends, sharp, sameDirection] : cases)
  {
    const CasterEdges found = casterEdgesOf(makeOccluders({ { mesh } }));
    const std::vector<CasterEdge>& edges = found.of(0).edges;
    const auto countIf = [&](const auto& is)
    { return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), is)); };
    EXPECT_EQ(edges.size(), count) << name;
    EXPECT_EQ(countIf([](const CasterEdge& e) { return e.triangles[1] == CasterEdge::none; }), ends)
      << name;
    EXPECT_EQ(countIf([](const CasterEdge& e) { return e.sharp; }), sharp) << name;
    EXPECT_EQ(countIf([](const CasterEdge& e) { return e.sameDirection; }), sameDirection) << name;
  }
}

/// Move the vertices of a surface, and mark the changes.
template <typename Move>
void deformSurface(Occluders& occluders, std::size_t index, const Move& move)
{
  const Surface& surface = occluders.surfaces[index];
  for (std::uint32_t i = surface.firstVertex; i < surface.firstVertex + surface.vertexCount; ++i)
  {
    occluders.positionsCentred[i] =
      glm::vec3(glm::dvec3(move(glm::dvec3(occluders.positionsCentred[i]))));
  }
  moveSurface(occluders, index, glm::dvec3(0.0));
}

/// Turn a surface, and move it.
void turnSurface(Occluders& occluders, std::size_t index, Random& random)
{
  const glm::dmat4 turned =
    glm::rotate(at(3.0 * unitVector(random)), uniform(random, -3.0, 3.0), unitVector(random));
  deformSurface(occluders, index,
    [&](const glm::dvec3& point) { return glm::dvec3(turned * glm::dvec4(point, 1.0)); });
}

/// Return the edges and parts of a snapshot as numbers.
std::vector<double> numbersOf(const CasterEdges& edges, const Occluders& occluders)
{
  std::vector<double> numbers;
  const auto add = [&](const auto&... each)
  { (numbers.push_back(static_cast<double>(each)), ...); };
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    if (!occluders.surfaces[i].casts)
    {
      continue;
    }
    const SurfaceEdges& of = edges.of(i);
    add(of.edges.size());
    for (const auto& [a, b, c] : of.ofTriangle)
    {
      add(a, b, c);
    }
    for (const CasterEdge& edge : of.edges)
    {
      add(edge.from, edge.to, edge.triangles[0], edge.triangles[1], edge.sameDirection, edge.sharp);
    }
  }
  for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
  {
    add(edges.partOf(i));
  }
  return numbers;
}

/// Expect cached edges to equal those of a new CasterEdges.
void expectAsRebuilt(const CasterEdges& kept, const Occluders& occluders, const std::string& after)
{
  EXPECT_TRUE(numbersOf(kept, occluders) == numbersOf(casterEdgesOf(occluders), occluders))
    << after;
}

TEST(CasterEdges, matchARebuildAfterEachDeformation)
{
  std::size_t keptAfterAll = 0, rebuiltAfterAll = 0;
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 0; seed < 4; ++seed)
    {
      Random random(seed);
      std::vector<Prop> props = makeRandomScene(name, random);
      for (std::size_t i = 0; i < props.size(); i += 2)
      {
        props[i].mesh = apart(props[i].mesh);
      }
      Occluders occluders = makeOccluders(props);
      CasterEdges edges;
      edges.update(occluders);
      const auto expectRight = [&](const std::string& what)
      {
        // Rebuilt edges have another address, since the old ones are freed after that.
        std::vector<std::vector<std::uint32_t>> welded;
        std::vector<const CasterEdge*> before;
        for (std::size_t i = 0; i < props.size(); ++i)
        {
          before.push_back(props[i].casts ? edges.of(i).edges.data() : nullptr);
          welded.push_back(props[i].casts ? edges.of(i).welded : std::vector<std::uint32_t>());
        }
        edges.update(occluders);
        for (std::size_t i = 0; i < props.size(); ++i)
        {
          if (props[i].casts && !props[i].mesh.triangles.empty())
          {
            const bool isKept = edges.of(i).edges.data() == before[i];
            EXPECT_EQ(isKept, edges.of(i).welded == welded[i]) << name << what;
            ++(isKept ? keptAfterAll : rebuiltAfterAll);
          }
        }
        expectAsRebuilt(edges, occluders, name + what);
      };
      for (std::size_t i = 0; i < props.size(); ++i)
      {
        const std::vector<glm::vec3> whole = occluders.positionsCentred;
        turnSurface(occluders, i, random);
        expectRight(": turned");
        const double bend = uniform(random, 0.2, 2.0);
        deformSurface(occluders, i,
          [&](const glm::dvec3& point)
          { return point + glm::dvec3(0.0, 0.0, bend * std::sin(point.x + 2.0 * point.y)); });
        expectRight(": bent, what was one place staying one");
        deformSurface(
          occluders, i, [&](const glm::dvec3& point) { return point + 0.01 * unitVector(random); });
        expectRight(": torn");
        deformSurface(
          occluders, i, [](const glm::dvec3& point) { return glm::round(4.0 * point) / 4.0; });
        expectRight(": points merged");
        occluders.positionsCentred = whole;
        moveSurface(occluders, i, glm::dvec3(0.0));
        expectRight(": put together again");
      }
    }
  }
  EXPECT_GT(keptAfterAll, 1000u);
  EXPECT_GT(rebuiltAfterAll, 500u);
}

TEST(CasterEdges, areReusedWhenOtherSurfacesComeAndGo)
{
  const std::vector<Prop> props = { { makePlane(1.0, 2) }, { makeSphere(8, 16) },
    { makePlane(2.0, 3), at({ 0.0, 0.0, 2.0 }) } };
  const Occluders all = makeOccluders(props);
  // The same surfaces without the first one: numbers are smaller, positions stay.
  Occluders fewer = makeOccluders({ props[1], props[2] });
  for (std::size_t i = 0; i < fewer.surfaces.size(); ++i)
  {
    fewer.surfaces[i].topologyVersion = all.surfaces[i + 1].topologyVersion;
    fewer.surfaces[i].positionsVersion = all.surfaces[i + 1].positionsVersion;
  }
  CasterEdges edges;
  edges.update(all);
  const CasterEdge* const sphere = edges.of(1).edges.data();
  const CasterEdge* const plane = edges.of(2).edges.data();
  edges.update(fewer);
  EXPECT_EQ(edges.of(0).edges.data(), sphere);
  EXPECT_EQ(edges.of(1).edges.data(), plane);
  expectAsRebuilt(edges, fewer, "one gone");
  edges.update(all);
  EXPECT_EQ(edges.of(1).edges.data(), sphere);
  expectAsRebuilt(edges, all, "one back");
  std::vector<Prop> changed = props; // a surface with its own version
  changed[1].mesh.triangles.pop_back();
  std::swap(changed[1].mesh.triangles[3].x, changed[1].mesh.triangles[3].y);
  const Occluders after = makeOccluders(changed);
  edges.update(after);
  expectAsRebuilt(edges, after, "cells changed");
}

TEST(WeldedVertices, areTheFirstOnesAtTheirPlace)
{
  Random random(2);
  for (const int places : { 1, 3, 20, 1000 })
  {
    Mesh mesh;
    for (int i = 0; i < 3000; ++i)
    {
      // Both zeros are the same place.
      const double x = static_cast<int>(random() % static_cast<unsigned int>(places)) - places / 2;
      mesh.points.emplace_back(x, random() % 2 == 0 ? 0.0 : -0.0, 1e-3 * x * x);
    }
    Occluders occluders = makeOccluders({ { makePlane(1.0) }, { mesh } });
    const Surface& surface = occluders.surfaces[1];
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      occluders.positionsCentred[surface.firstVertex + i] = glm::vec3(mesh.points[i]);
    }
    const std::vector<std::uint32_t> welded = weldedVertices(occluders, surface);
    std::map<double, std::uint32_t> first;
    for (std::uint32_t i = 0; i < welded.size(); ++i)
    {
      EXPECT_EQ(welded[i], first.emplace(mesh.points[i].x, i).first->second);
    }
  }
}

} // namespace
} // namespace gnomon::test
