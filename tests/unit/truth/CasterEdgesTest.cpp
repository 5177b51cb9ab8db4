#include "shadowtech/mesh/CasterEdges.h"

#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "shadowtech/mesh/WeldedVertices.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::test
{
namespace
{

SurfaceEdges findCasterEdges(const Occluders& occluders, const Surface& surface)
{
  SurfaceEdges edges;
  updateCasterEdges(occluders, surface, edges);
  return edges;
}

std::vector<CasterEdge> casterEdgesOf(const Mesh& mesh)
{
  const Occluders occluders = makeOccluders({ { mesh } });
  return findCasterEdges(occluders, occluders.surfaces.front()).edges;
}

std::size_t countEnds(const std::vector<CasterEdge>& edges)
{
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(),
    [](const CasterEdge& edge) { return edge.triangles[1] == CasterEdge::none; }));
}

std::size_t countSharp(const std::vector<CasterEdge>& edges)
{
  return static_cast<std::size_t>(
    std::count_if(edges.begin(), edges.end(), [](const CasterEdge& edge) { return edge.sharp; }));
}

/// A sphere whose seam and poles close, which else they do but for rounding.
Mesh makeClosedSphere(int rings, int segments)
{
  Mesh sphere = makeSphere(rings, segments);
  for (glm::dvec3& point : sphere.points)
  {
    point = glm::round(1e6 * point) / 1e6;
  }
  return sphere;
}

/// The same triangles, each with corners of its own.
Mesh apart(const Mesh& mesh)
{
  Mesh result;
  for (const glm::uvec3& triangle : mesh.triangles)
  {
    const auto first = static_cast<unsigned int>(result.points.size());
    for (int k = 0; k < 3; ++k)
    {
      result.points.push_back(mesh.points[triangle[k]]);
    }
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

TEST(CasterEdges, ofClosedMeshesHaveTwoTriangles)
{
  const Mesh sphere = makeClosedSphere(32, 64);
  for (const Mesh& mesh : { sphere, apart(sphere) })
  {
    const std::vector<CasterEdge> edges = casterEdgesOf(mesh);
    EXPECT_EQ(2 * edges.size(), 3 * mesh.triangles.size());
    EXPECT_EQ(countEnds(edges), 0u);
    for (const CasterEdge& edge : edges)
    {
      EXPECT_NE(edge.triangles[0], edge.triangles[1]);
      EXPECT_FALSE(edge.sameDirection);
    }
    EXPECT_EQ(countSharp(edges), 0u);
  }
}

TEST(CasterEdges, leadFromEachSideToTheTriangleAcrossIt)
{
  for (const Mesh& mesh : { makeClosedSphere(8, 16), makePlane(2.0, 3) })
  {
    const Occluders occluders = makeOccluders({ { mesh } });
    const SurfaceEdges edges = findCasterEdges(occluders, occluders.surfaces.front());
    // By place, as corners of a seam are there twice.
    const auto hasBoth = [&](std::uint32_t triangle, const glm::vec3& from, const glm::vec3& to)
    {
      int found = 0;
      for (int k = 0; k < 3; ++k)
      {
        const glm::vec3& place = occluders.positionsCentred[occluders.triangles[triangle][k]];
        found += place == from || place == to ? 1 : 0;
      }
      return found == 2;
    };
    std::size_t missing = 0;
    for (std::uint32_t i = 0; i < edges.ofTriangle.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::uint32_t other =
          edges.edges[edges.ofTriangle[i][static_cast<std::size_t>(k)]].other(i);
        const glm::uvec3& corners = occluders.triangles[i];
        const glm::vec3& from = occluders.positionsCentred[corners[k]];
        const glm::vec3& to = occluders.positionsCentred[corners[(k + 1) % 3]];
        missing += other == CasterEdge::none ? 1 : 0;
        EXPECT_TRUE(other == CasterEdge::none || (other != i && hasBoth(other, from, to)));
      }
    }
    EXPECT_EQ(missing, mesh.triangles.size() == 18 ? 12u : 0u);
  }
}

TEST(CasterEdges, ofASheetEndAtItsBorder)
{
  const std::vector<CasterEdge> edges = casterEdgesOf(makePlane(2.0, 3));
  EXPECT_EQ(countEnds(edges), 12u);
  EXPECT_EQ(edges.size(), 12u + 12u + 9u); // border, between cells, across cells
}

TEST(CasterEdges, ofABoxAreSharpWhereItsSidesMeet)
{
  const std::vector<CasterEdge> edges = casterEdgesOf(makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)));
  EXPECT_EQ(edges.size(), 18u);
  // Its corners have sides all around them that are too far apart, and every edge leads to one.
  EXPECT_EQ(countSharp(edges), 18u);
}

TEST(CasterEdges, thatThreeTrianglesShareEndEachOfThem)
{
  Mesh mesh;
  mesh.points = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, { -1.0, 1.0, 0.0 },
    { -1.0, -1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  const std::vector<CasterEdge> edges = casterEdgesOf(mesh);
  EXPECT_EQ(edges.size(), 9u);
  EXPECT_EQ(countEnds(edges), 9u);
}

TEST(CasterEdges, ofTrianglesThatAreWoundDifferentlySaySo)
{
  Mesh mesh = makePlane(1.0);
  std::swap(mesh.triangles[1].x, mesh.triangles[1].y);
  const std::vector<CasterEdge> edges = casterEdgesOf(mesh);
  ASSERT_EQ(countEnds(edges), 4u);
  const auto inner = std::find_if(edges.begin(), edges.end(),
    [](const CasterEdge& edge) { return edge.triangles[1] != CasterEdge::none; });
  ASSERT_NE(inner, edges.end());
  EXPECT_TRUE(inner->sameDirection);
  EXPECT_FALSE(inner->sharp);
}

TEST(CasterEdges, ofNeedlesAreSharp)
{
  Mesh mesh;
  mesh.points = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.5, 1e-6, 0.0 }, { 0.5, -1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 } };
  EXPECT_EQ(countSharp(casterEdgesOf(mesh)), 5u);
}

TEST(CasterEdges, areKeptUntilTheSurfaceChanges)
{
  Occluders occluders = makeOccluders({ { makePlane(1.0) }, { makeSphere(4, 8) } });
  CasterEdges edges;
  edges.update(occluders);
  const CasterEdge* const plane = edges.of(0).edges.data();
  const CasterEdge* const sphere = edges.of(1).edges.data();
  edges.update(occluders);
  EXPECT_EQ(edges.of(0).edges.data(), plane);
  EXPECT_EQ(edges.of(1).edges.data(), sphere);
  moveSurface(occluders, 1, { 0.0, 0.0, 1.0 });
  edges.update(occluders);
  EXPECT_EQ(edges.of(0).edges.data(), plane);
  EXPECT_EQ(edges.of(1).edges.size(), casterEdgesOf(makeSphere(4, 8)).size());
}

/// Moves the vertices of a surface, and marks what changed.
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

glm::dmat4 randomTurn(Random& random)
{
  return glm::rotate(glm::dmat4(1.0), uniform(random, -3.0, 3.0), unitVector(random));
}

/// Turns a surface, and puts it somewhere else.
void turnSurface(Occluders& occluders, std::size_t index, Random& random)
{
  const glm::dmat4 turned =
    glm::translate(glm::dmat4(1.0), 3.0 * unitVector(random)) * randomTurn(random);
  deformSurface(occluders, index,
    [&](const glm::dvec3& point) { return glm::dvec3(turned * glm::dvec4(point, 1.0)); });
}

/// That edges, seams and parts which have been kept are those that would be found anew, number by
/// number.
void expectAsFoundAnew(
  const CasterEdges& kept, const Occluders& occluders, const std::string& after)
{
  CasterEdges anew;
  anew.update(occluders);
  for (std::size_t i = 0; i < occluders.surfaces.size(); ++i)
  {
    if (!occluders.surfaces[i].casts)
    {
      continue;
    }
    const SurfaceEdges& one = kept.of(i);
    const SurfaceEdges& other = anew.of(i);
    const auto same = [&](const auto& a, const auto& b, const auto& isSame)
    { return std::equal(a.begin(), a.end(), b.begin(), b.end(), isSame); };
    EXPECT_EQ(one.ofTriangle, other.ofTriangle) << after;
    EXPECT_TRUE(same(one.edges, other.edges,
      [](const CasterEdge& a, const CasterEdge& b)
      {
        return a.from == b.from && a.to == b.to && a.triangles == b.triangles &&
          a.sameDirection == b.sameDirection && a.sharp == b.sharp;
      }))
      << after << ", surface " << i;
    EXPECT_TRUE(same(one.rims, other.rims,
      [](const Rim& a, const Rim& b)
      {
        return a.edge == b.edge &&
          std::equal(a.corners.begin(), a.corners.end(), b.corners.begin(),
            [](const NormalCone& c, const NormalCone& d)
            { return c.axis == d.axis && c.leastCosine == d.leastCosine; });
      }))
      << after << ", surface " << i;
    EXPECT_TRUE(same(kept.seams().of(i), anew.seams().of(i),
      [](const Seam& a, const Seam& b)
      {
        return a.edge == b.edge && a.otherSurface == b.otherSurface &&
          a.otherTriangle == b.otherTriangle && a.sameDirection == b.sameDirection &&
          a.sharp == b.sharp;
      }))
      << after << ", surface " << i;
  }
  for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
  {
    ASSERT_EQ(kept.partOf(i), anew.partOf(i)) << after;
  }
}

TEST(CasterEdges, areNotFoundAgainWhereASurfaceTurnsMovesOrIsScaled)
{
  Random random(1);
  Occluders occluders = makeOccluders({ { makePlane(4.0, 3) }, { makeClosedSphere(16, 32) },
    { apart(makeBox(glm::dvec3(-1.0), glm::dvec3(1.0))) } });
  CasterEdges edges;
  edges.update(occluders);
  // What is found anew lies elsewhere, as what was there before is let go afterwards.
  const CasterEdge* const found = edges.of(1).edges.data();
  const CasterEdge* const foundApart = edges.of(2).edges.data();
  for (int i = 0; i < 100; ++i)
  {
    turnSurface(occluders, 1, random);
    turnSurface(occluders, 2, random);
    const double scale = uniform(random, 0.5, 1.5);
    deformSurface(occluders, 1, [&](const glm::dvec3& point) { return scale * point; });
    edges.update(occluders);
    ASSERT_EQ(edges.of(1).edges.data(), found) << i;
    ASSERT_EQ(edges.of(2).edges.data(), foundApart) << i;
    expectAsFoundAnew(edges, occluders, "step " + std::to_string(i));
  }
}

TEST(CasterEdges, areFoundAgainWhereMovingMakesPlacesOneThatWereApartByARounding)
{
  Occluders occluders = makeOccluders({ { makeSphere(8, 16) } });
  CasterEdges edges;
  edges.update(occluders);
  EXPECT_GT(edges.of(0).rims.size(), 0u) << "open at the seam";
  moveSurface(occluders, 0, { 1.0, 2.0, 3.0 });
  edges.update(occluders);
  EXPECT_EQ(edges.of(0).rims.size(), 0u) << "closed";
  expectAsFoundAnew(edges, occluders, "moved");
}

TEST(CasterEdges, areThoseFoundAnewHoweverCastersAreDeformed)
{
  std::size_t keptAfterAll = 0, foundAfterAll = 0;
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
            ++(isKept ? keptAfterAll : foundAfterAll);
          }
        }
        expectAsFoundAnew(edges, occluders, name + what);
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
  EXPECT_GT(foundAfterAll, 500u);
}

TEST(CasterEdges, areKeptWhereOtherSurfacesComeAndGo)
{
  const std::vector<Prop> props = { { makePlane(1.0, 2) }, { makeSphere(8, 16) },
    { makePlane(2.0, 3), at({ 0.0, 0.0, 2.0 }) } };
  const Occluders all = makeOccluders(props);
  // The same without the first one: numbers are smaller, positions stay.
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
  expectAsFoundAnew(edges, fewer, "one gone");
  edges.update(all);
  EXPECT_EQ(edges.of(1).edges.data(), sphere);
  expectAsFoundAnew(edges, all, "one back");
}

TEST(CasterEdges, areFoundAgainWhereTrianglesAreOthers)
{
  Mesh mesh = makeSphere(8, 16);
  Occluders before = makeOccluders({ { mesh } });
  CasterEdges edges;
  edges.update(before);
  mesh.triangles.pop_back();
  std::swap(mesh.triangles[3].x, mesh.triangles[3].y);
  const Occluders after = makeOccluders({ { mesh } }); // a surface with a version of its own
  edges.update(after);
  expectAsFoundAnew(edges, after, "cells changed");
}

TEST(WeldedVertices, areTheFirstOnesAtTheirPlace)
{
  Random random(2);
  for (const int places : { 1, 3, 20, 1000 })
  {
    Mesh mesh;
    for (int i = 0; i < 3000; ++i)
    {
      // Either zero is the same place.
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

/// Two unit squares side by side, of two triangles each, the second at an angle to the first.
std::vector<Mesh> squaresAtAngle(double degrees)
{
  const double angle = glm::radians(degrees);
  Mesh flat;
  flat.points = { { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { -1.0, 1.0, 0.0 } };
  flat.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  Mesh raised;
  raised.points = { { 0.0, 0.0, 0.0 }, { std::cos(angle), 0.0, std::sin(angle) },
    { std::cos(angle), 1.0, std::sin(angle) }, { 0.0, 1.0, 0.0 } };
  raised.triangles = flat.triangles;
  return { flat, raised };
}

CasterEdges casterEdgesOf(const Occluders& occluders)
{
  CasterEdges edges;
  edges.update(occluders);
  return edges;
}

TEST(CasterSeams, areWhereTwoSurfacesShareAnEdge)
{
  const std::vector<Mesh> squares = squaresAtAngle(20.0);
  const Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] } });
  const CasterEdges edges = casterEdgesOf(occluders);
  for (const std::uint32_t surface : { 0u, 1u })
  {
    ASSERT_EQ(edges.seams().of(surface).size(), 1u);
    const Seam& seam = edges.seams().of(surface).front();
    const CasterEdge& edge = edges.of(surface).edges[seam.edge];
    EXPECT_EQ(edge.triangles[1], CasterEdge::none);
    EXPECT_EQ(occluders.positionsCentred[edge.from].x, occluders.positionsCentred[edge.to].x);
    EXPECT_EQ(seam.otherSurface, 1u - surface);
    EXPECT_EQ(seam.otherTriangle, surface == 0u ? 3u : 0u);
    EXPECT_FALSE(seam.sameDirection);
    EXPECT_FALSE(seam.sharp);
    EXPECT_EQ(edges.seams().at(surface, seam.edge), &seam);
    EXPECT_EQ(edges.seams().at(surface, seam.edge + 1), nullptr);
  }
  EXPECT_EQ(edges.partOf(3), 0u) << "it is all one part";

  Mesh turned = squares[1];
  turned.triangles = { { 0, 2, 1 }, { 0, 3, 2 } };
  const Occluders otherwise = makeOccluders({ { squares[0] }, { turned } });
  EXPECT_TRUE(casterEdgesOf(otherwise).seams().of(0).front().sameDirection);
  EXPECT_FALSE(casterEdgesOf(otherwise).seams().of(0).front().sharp);
}

TEST(CasterSeams, areSharpWhereShadowRaysMayStartBehindTheOtherSide)
{
  for (const double degrees : { 40.0, -40.0, 43.0, 137.0, 175.0 })
  {
    const std::vector<Mesh> squares = squaresAtAngle(degrees);
    const Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] } });
    const CasterEdges edges = casterEdgesOf(occluders);
    ASSERT_EQ(edges.seams().of(0).size(), 1u);
    EXPECT_EQ(edges.seams().of(0).front().sharp, std::abs(degrees) > 41.0) << degrees;
  }
}

TEST(CasterSeams, areSharpAtCornersWithOtherTrianglesTooFarApart)
{
  // A third surface goes on from the second one around the corner, steeply.
  std::vector<Mesh> squares = squaresAtAngle(30.0);
  Mesh wing;
  wing.points = { { 0.0, 0.0, 0.0 }, squares[1].points[1], { 0.5, -0.2, -1.0 } };
  wing.triangles = { { 0, 2, 1 } };
  const Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] }, { wing } });
  const CasterEdges edges = casterEdgesOf(occluders);
  ASSERT_EQ(edges.seams().of(1).size(), 2u);
  for (const Seam& seam : edges.seams().of(1))
  {
    EXPECT_TRUE(seam.sharp) << seam.otherSurface;
  }
}

/// Triangles around the origin, each a surface of its own.
std::vector<Prop> makeUmbrella(const std::vector<glm::dvec3>& corners)
{
  std::vector<Prop> props;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec3& next = corners[(i + 1) % corners.size()];
    props.push_back({ { { glm::dvec3(0.0), corners[i], next }, { { 0, 1, 2 } } } });
  }
  return props;
}

/// The same with as many outer corners as there are angles by which they go down.
std::vector<Prop> makeUmbrella(const std::vector<double>& slopesDegrees)
{
  std::vector<glm::dvec3> corners;
  for (const double slope : slopesDegrees)
  {
    const double around = glm::radians(
      360.0 * static_cast<double>(corners.size()) / static_cast<double>(slopesDegrees.size()));
    corners.emplace_back(std::cos(around), std::sin(around), -std::tan(glm::radians(slope)));
  }
  return makeUmbrella(corners);
}

/// The most that normals of single triangles are apart, in degrees.
double widestAngle(const std::vector<Prop>& triangles)
{
  double least = 1.0;
  const auto normalOf = [](const Prop& prop)
  {
    const std::vector<glm::dvec3>& points = prop.mesh.points;
    return glm::normalize(glm::cross(points[1] - points[0], points[2] - points[0]));
  };
  for (const Prop& one : triangles)
  {
    for (const Prop& other : triangles)
    {
      least = std::min(least, std::abs(glm::dot(normalOf(one), normalOf(other))));
    }
  }
  return glm::degrees(std::acos(least));
}

std::size_t countSharpSeams(const std::vector<Prop>& props)
{
  const CasterEdges edges = casterEdgesOf(makeOccluders(props));
  std::size_t sharp = 0;
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    EXPECT_EQ(edges.seams().of(i).size(), 2u);
    for (const Seam& seam : edges.seams().of(i))
    {
      sharp += seam.sharp ? 1 : 0;
    }
  }
  return sharp;
}

TEST(CasterSeams, areSharpAtCornersWhereManySurfacesDoNotFitIntoTheAngle)
{
  for (const std::size_t count : { 8u, 9u, 100u, 1001u })
  {
    EXPECT_EQ(countSharpSeams(makeUmbrella(std::vector<double>(count, 16.0))), 0u) << count;
    EXPECT_EQ(countSharpSeams(makeUmbrella(std::vector<double>(count, 23.5))), 2 * count) << count;
  }
  // Many that are alike do not outvote a few: a sheet that is bent by less than the angle.
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 20; ++i)
  {
    const double around = glm::radians(90.0 + 9.0 * i);
    corners.emplace_back(std::cos(around), std::sin(around), 0.0);
  }
  corners.emplace_back(0.0, -1.0, 0.0);
  corners.emplace_back(1.0, 0.0, std::tan(glm::radians(35.0)));
  EXPECT_EQ(countSharpSeams(makeUmbrella(corners)), 0u);
}

TEST(CasterSeams, areSharpAtCornersWhereAnyTwoOfTheSurfacesAreTooFarApart)
{
  Random random(3);
  std::size_t sharp = 0, flat = 0;
  for (int run = 0; run < 2000; ++run)
  {
    std::vector<double> slopes(6 + random() % 10);
    const double most = uniform(random, 5.0, 30.0);
    for (double& slope : slopes)
    {
      slope = uniform(random, -most, most);
    }
    const std::vector<Prop> umbrella = makeUmbrella(slopes);
    const double widest = widestAngle(umbrella);
    const std::size_t count = countSharpSeams(umbrella);
    if (widest > 41.5)
    {
      EXPECT_EQ(count, 2 * slopes.size()) << widest;
      ++sharp;
    }
    // A circle around points that are so far apart need not be larger (Jung's theorem), nor one
    // that is not the least.
    else if (widest < 30.0)
    {
      EXPECT_EQ(count, 0u) << widest;
      ++flat;
    }
  }
  EXPECT_GT(sharp, 200u);
  EXPECT_GT(flat, 200u);
}

TEST(CasterSeams, areNotWhereAThirdSurfaceMeetsNorWhereOneIsDifferent)
{
  const std::vector<Mesh> squares = squaresAtAngle(20.0);
  const std::vector<Mesh> others = squaresAtAngle(-50.0);
  const auto seams = [](const std::vector<Prop>& props)
  {
    const CasterEdges edges = casterEdgesOf(makeOccluders(props));
    EXPECT_EQ(edges.partOf(1), 0u);
    EXPECT_EQ(edges.partOf(2), edges.seams().of(0).empty() ? 2u : 0u);
    return edges.seams().of(0).size();
  };
  EXPECT_EQ(seams({ { squares[0] }, { squares[1] } }), 1u);
  EXPECT_EQ(seams({ { squares[0] }, { squares[1] }, { others[1] } }), 0u);
  Prop different{ squares[1] };
  different.oneSided = true;
  EXPECT_EQ(seams({ { squares[0] }, different }), 0u);
  different.oneSided = false;
  different.casts = false;
  EXPECT_EQ(seams({ { squares[0] }, different }), 0u);
  different = { squares[1], at({ 0.0, 1e-6, 0.0 }) };
  EXPECT_EQ(seams({ { squares[0] }, different }), 0u);
}

TEST(CasterSeams, areFoundAgainWhenASurfaceMoves)
{
  const std::vector<Mesh> squares = squaresAtAngle(20.0);
  Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] } });
  CasterEdges edges;
  edges.update(occluders);
  EXPECT_EQ(edges.seams().of(0).size(), 1u);
  moveSurface(occluders, 1, { 0.0, 0.0, 0.5 });
  edges.update(occluders);
  EXPECT_EQ(edges.seams().of(0).size(), 0u);
  moveSurface(occluders, 1, { 0.0, 0.0, -0.5 });
  edges.update(occluders);
  EXPECT_EQ(edges.seams().of(0).size(), 1u);
}

} // namespace
} // namespace gnomon::test
