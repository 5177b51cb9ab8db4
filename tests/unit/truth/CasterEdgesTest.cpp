#include "shadowtech/conservative/CasterEdges.h"

#include "SyntheticScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

std::vector<CasterEdge> edgesOf(const Mesh& mesh)
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
  Mesh sphere = makeSphere(32, 64);
  for (glm::dvec3& point : sphere.points)
  {
    point = glm::round(1e6 * point) / 1e6; // its seam closes but for rounding
  }
  for (const Mesh& mesh : { sphere, apart(sphere) })
  {
    const std::vector<CasterEdge> edges = edgesOf(mesh);
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
  Mesh closed = makeSphere(8, 16);
  for (glm::dvec3& point : closed.points)
  {
    point = glm::round(1e6 * point) / 1e6; // its seam closes but for rounding
  }
  for (const Mesh& mesh : { closed, makePlane(2.0, 3) })
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
  const std::vector<CasterEdge> edges = edgesOf(makePlane(2.0, 3));
  EXPECT_EQ(countEnds(edges), 12u);
  EXPECT_EQ(edges.size(), 12u + 12u + 9u); // border, between cells, across cells
}

TEST(CasterEdges, ofABoxAreSharpWhereItsSidesMeet)
{
  const std::vector<CasterEdge> edges = edgesOf(makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)));
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
  const std::vector<CasterEdge> edges = edgesOf(mesh);
  EXPECT_EQ(edges.size(), 9u);
  EXPECT_EQ(countEnds(edges), 9u);
}

TEST(CasterEdges, ofTrianglesThatAreWoundDifferentlySaySo)
{
  Mesh mesh = makePlane(1.0);
  std::swap(mesh.triangles[1].x, mesh.triangles[1].y);
  const std::vector<CasterEdge> edges = edgesOf(mesh);
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
  EXPECT_EQ(countSharp(edgesOf(mesh)), 5u);
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
  EXPECT_EQ(edges.of(1).edges.size(), edgesOf(makeSphere(4, 8)).size());
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

CasterEdges edgesOf(const Occluders& occluders)
{
  CasterEdges edges;
  edges.update(occluders);
  return edges;
}

TEST(CasterSeams, areWhereTwoSurfacesShareAnEdge)
{
  const std::vector<Mesh> squares = squaresAtAngle(20.0);
  const Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] } });
  const CasterEdges edges = edgesOf(occluders);
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
  EXPECT_TRUE(edgesOf(otherwise).seams().of(0).front().sameDirection);
  EXPECT_FALSE(edgesOf(otherwise).seams().of(0).front().sharp);
}

TEST(CasterSeams, areSharpWhereShadowRaysMayStartBehindTheOtherSide)
{
  for (const double degrees : { 40.0, -40.0, 43.0, 137.0, 175.0 })
  {
    const std::vector<Mesh> squares = squaresAtAngle(degrees);
    const Occluders occluders = makeOccluders({ { squares[0] }, { squares[1] } });
    const CasterEdges edges = edgesOf(occluders);
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
  const CasterEdges edges = edgesOf(occluders);
  ASSERT_EQ(edges.seams().of(1).size(), 2u);
  for (const Seam& seam : edges.seams().of(1))
  {
    EXPECT_TRUE(seam.sharp) << seam.otherSurface;
  }
}

TEST(CasterSeams, areNotWhereAThirdSurfaceMeetsNorWhereOneIsDifferent)
{
  const std::vector<Mesh> squares = squaresAtAngle(20.0);
  const std::vector<Mesh> others = squaresAtAngle(-50.0);
  const auto seams = [](const std::vector<Prop>& props)
  {
    const CasterEdges edges = edgesOf(makeOccluders(props));
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
