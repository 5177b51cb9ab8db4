// coherence and selective, stage by stage, and against ray tracing.

#include "shadowtech/selective/CertainHit.h"
#include "shadowtech/selective/Chain.h"
#include "shadowtech/selective/LightInCaster.h"
#include "shadowtech/selective/StatusContour.h"

#include "ExactRecord.h"
#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "lights/LightSpace.h"
#include "lights/ShadowSettings.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

/// What casts of a light with a box, as TriangleMap takes it.
std::optional<glm::dvec4> keptFromCentred(const RandomPicture& picture)
{
  return picture.light.box
    ? std::optional(nearFaceCentred(picture.light, picture.occluders.centreWorld))
    : std::nullopt;
}

//------------------------------------------------------------------------------
// Lights in casters

TEST(LightInCaster, IsOnATriangle)
{
  const Occluders occluders = makeOccluders({ { makePlane(4.0), at({ 10.1, 20.2, 30.3 }) } });
  const auto liesIn = [&](const glm::dvec3& place, const LightArea* area = nullptr)
  { return liesInCaster(place - occluders.centreWorld, area, occluders); };
  EXPECT_TRUE(liesIn({ 10.9, 19.0, 30.3 }));
  EXPECT_TRUE(liesIn({ 12.1, 22.2, 30.3 })) << "a corner";
  EXPECT_FALSE(liesIn({ 12.2, 20.2, 30.3 })) << "in its plane, beside it";
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.301 }));
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.299 }));

  const LightArea flat = diskArea({ 0.0, 0.0, -1.0 }, 0.5);
  EXPECT_TRUE(liesIn({ 10.9, 19.0, 30.3 }, &flat));
  EXPECT_TRUE(liesIn({ 12.5, 20.2, 30.3 }, &flat)) << "its rim does";
  EXPECT_FALSE(liesIn({ 12.7, 20.2, 30.3 }, &flat));
  const LightArea standing = diskArea({ 1.0, 0.0, 0.0 }, 0.5);
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.3 }, &standing)) << "it crosses the plane";
  const LightArea ball = ballArea(0.5);
  EXPECT_FALSE(liesIn({ 10.9, 19.0, 30.3 }, &ball)) << "likewise";
}

TEST(LightInCaster, IsOnWhatCastsAlone)
{
  Prop ground{ makePlane(4.0) };
  EXPECT_TRUE(liesInCaster({ 0.0, 0.0, 0.0 }, nullptr, makeOccluders({ ground })));
  ground.casts = false;
  EXPECT_FALSE(liesInCaster({ 0.0, 0.0, 0.0 }, nullptr, makeOccluders({ ground })));
  EXPECT_FALSE(liesInCaster({ 0.0, 0.0, 0.0 }, nullptr, Occluders()));
}

//------------------------------------------------------------------------------
// The contour

std::size_t countOf(const std::vector<std::uint8_t>& contour)
{
  return static_cast<std::size_t>(std::accumulate(contour.begin(), contour.end(), 0));
}

/// Statuses of a picture by a function of column and row.
template <typename Of>
std::vector<PixelStatus> statusesOf(int width, int height, const Of& of)
{
  std::vector<PixelStatus> statuses;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      statuses.push_back(of(x, y));
    }
  }
  return statuses;
}

TEST(StatusContour, ofAnEdgeIsAsWideAsAskedForAndHalfLit)
{
  constexpr int width = 40, height = 30;
  const auto columns = statusesOf(
    width, height, [](int x, int) { return x < 17 ? PixelStatus::Lit : PixelStatus::Shadow; });
  const auto rows = statusesOf(
    width, height, [](int, int y) { return y < 11 ? PixelStatus::Shadow : PixelStatus::Lit; });
  for (int radius = 1; radius <= 3; ++radius)
  {
    const std::vector<std::uint8_t> ofColumns = contourOf(columns, width, height, radius);
    const std::vector<std::uint8_t> ofRows = contourOf(rows, width, height, radius);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        const auto i = static_cast<std::size_t>(y * width + x);
        EXPECT_EQ(ofColumns[i] != 0, x >= 17 - radius && x < 17 + radius) << x << " " << y;
        EXPECT_EQ(ofRows[i] != 0, y >= 11 - radius && y < 11 + radius) << x << " " << y;
      }
    }
  }
}

TEST(StatusContour, isTheDilationOfTheNarrowerOne)
{
  constexpr int width = 64, height = 64;
  Random random(3);
  const auto statuses = statusesOf(width, height,
    [&](int, int) { return random() % 60 == 0 ? PixelStatus::Shadow : PixelStatus::Lit; });
  std::vector<std::uint8_t> narrow = contourOf(statuses, width, height, 1);
  for (int radius = 2; radius <= 3; ++radius)
  {
    const auto dilated = contourOf(statusesOf(width, height,
                                     [&](int x, int y)
                                     {
                                       return narrow[static_cast<std::size_t>(y * width + x)]
                                         ? PixelStatus::Shadow
                                         : PixelStatus::Lit;
                                     }),
      width, height, 1);
    const std::vector<std::uint8_t> wide = contourOf(statuses, width, height, radius);
    for (std::size_t i = 0; i < wide.size(); ++i)
    {
      EXPECT_EQ(wide[i] != 0, narrow[i] != 0 || dilated[i] != 0);
    }
    narrow = wide;
  }
}

TEST(StatusContour, hasNoPixelsWithoutStatus)
{
  // A shadow next to the background, and one next to light across one pixel of background.
  const auto statuses = statusesOf(9, 3,
    [](int x, int) {
      return x == 1 || x == 5 ? PixelStatus::Shadow : x == 7 ? PixelStatus::Lit : PixelStatus::None;
    });
  EXPECT_EQ(countOf(contourOf(statuses, 9, 3, 1)), 0u);
  EXPECT_EQ(countOf(contourOf(statuses, 9, 3, 2)), 6u); // both sides of the gap
  EXPECT_EQ(countOf(contourOf(std::vector<PixelStatus>(), 0, 0, 1)), 0u);
}

//------------------------------------------------------------------------------
// Texels and triangles around

TEST(Neighbourhood, ofFourIsTheBilinearFootprint)
{
  Random random(7);
  for (int run = 0; run < 1000000; ++run)
  {
    MapPlace place;
    place.x = uniform(random, 0.0, 1024.0);
    place.y = uniform(random, 0.0, 1024.0);
    place.column = static_cast<int>(place.x);
    place.row = static_cast<int>(place.y);
    std::vector<std::pair<int, int>> visited;
    const auto visit = [&](int column, int row)
    {
      visited.emplace_back(column, row);
      return false;
    };
    EXPECT_FALSE(visitNeighbourhood(Neighbourhood::Four, place, visit));
    EXPECT_EQ(visited.front(), std::pair(place.column, place.row));
    const int left = static_cast<int>(std::floor(place.x - 0.5));
    const int lower = static_cast<int>(std::floor(place.y - 0.5));
    const std::set<std::pair<int, int>> footprint{ { left, lower }, { left + 1, lower },
      { left, lower + 1 }, { left + 1, lower + 1 } };
    ASSERT_EQ(visited.size(), 4u);
    ASSERT_EQ(std::set(visited.begin(), visited.end()), footprint);

    const std::set<std::pair<int, int>> four(visited.begin(), visited.end());
    visited.clear();
    visitNeighbourhood(Neighbourhood::Nine, place, visit);
    const std::set<std::pair<int, int>> nine(visited.begin(), visited.end());
    ASSERT_EQ(visited.size(), 9u);
    ASSERT_EQ(nine.size(), 9u);
    ASSERT_TRUE(std::includes(nine.begin(), nine.end(), four.begin(), four.end()));
    for (const auto& [column, row] : nine)
    {
      ASSERT_LE(std::abs(column - place.column), 1);
      ASSERT_LE(std::abs(row - place.row), 1);
    }
    visited.clear();
    visitNeighbourhood(Neighbourhood::Centre, place, visit);
    ASSERT_EQ(visited.size(), 1u);
  }
}

/// Triangles of a mesh that count as adjacent to one, itself first.
std::vector<std::uint32_t> adjacentTo(
  const SurfaceFans& fans, std::uint32_t triangle, Adjacency adjacency)
{
  std::vector<std::uint32_t> found;
  EXPECT_FALSE(visitAdjacent(fans, triangle, adjacency,
    [&](std::uint32_t other)
    {
      found.push_back(other);
      return false;
    }));
  EXPECT_EQ(found.front(), triangle);
  const std::set<std::uint32_t> once(found.begin(), found.end());
  EXPECT_EQ(once.size(), found.size());
  return found;
}

/// A sphere all of whose corners have six triangles around them, but for twelve with five.
Mesh makeIcosphere(int levels)
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  Mesh mesh;
  mesh.points = { { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
    { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } };
  mesh.triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 },
    { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
    { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
    { 9, 8, 1 } };
  for (int level = 0; level < levels; ++level)
  {
    // Every triangle has corners of its own, at exactly the same place as its neighbours'.
    Mesh finer;
    for (const glm::uvec3& triangle : mesh.triangles)
    {
      const glm::dvec3 a = mesh.points[triangle.x];
      const glm::dvec3 b = mesh.points[triangle.y];
      const glm::dvec3 c = mesh.points[triangle.z];
      const auto first = static_cast<unsigned int>(finer.points.size());
      for (const glm::dvec3& point : { a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a) })
      {
        finer.points.push_back(std::sqrt(3.0) * glm::normalize(point));
      }
      for (const glm::uvec3& part :
        { glm::uvec3(0, 3, 5), glm::uvec3(3, 1, 4), glm::uvec3(5, 4, 2), glm::uvec3(3, 4, 5) })
      {
        finer.triangles.push_back(first + part);
      }
    }
    mesh = finer;
  }
  return mesh;
}

TEST(TriangleFans, ofAClosedSurfaceHaveThreeNeighboursByEdgesAndTwelveByVertices)
{
  // The plane comes first, so that numbers of the snapshot are not those of the surface.
  const Occluders occluders = makeOccluders({ { makePlane(1.0, 2) }, { makeIcosphere(3) } });
  const Surface& surface = occluders.surfaces[1];
  TriangleFans all;
  all.update(occluders);
  const SurfaceFans& fans = all.of(1);
  std::size_t fewer = 0;
  for (std::uint32_t i = 0; i < surface.triangleCount; ++i)
  {
    const std::uint32_t triangle = surface.firstTriangle + i;
    const std::vector<std::uint32_t> byEdges = adjacentTo(fans, triangle, Adjacency::Edges);
    std::vector<std::uint32_t> byVertices = adjacentTo(fans, triangle, Adjacency::Vertices);
    EXPECT_EQ(byEdges.size(), 1u + 3u);
    fewer += byVertices.size() == 1u + 12u ? 0 : 1;
    EXPECT_GE(byVertices.size(), 1u + 11u);
    for (const std::uint32_t other : byEdges)
    {
      EXPECT_NE(std::find(byVertices.begin(), byVertices.end(), other), byVertices.end());
    }
  }
  EXPECT_EQ(fewer, 12u * 5u);
}

TEST(TriangleFans, haveAnyNumberOfTrianglesAtAnEdge)
{
  Mesh mesh;
  mesh.points = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, { -1.0, 1.0, 0.0 },
    { -1.0, -1.0, 0.0 }, { 0.0, 0.0, 3.0 }, { 0.0, 1.0, 3.0 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 }, { 1, 5, 6 } };
  const Occluders occluders = makeOccluders({ { mesh } });
  TriangleFans all;
  all.update(occluders);
  const SurfaceFans& fans = all.of(0);
  EXPECT_EQ(adjacentTo(fans, 0, Adjacency::Edges), (std::vector<std::uint32_t>{ 0, 1, 2 }));
  EXPECT_EQ(adjacentTo(fans, 0, Adjacency::Vertices), (std::vector<std::uint32_t>{ 0, 1, 2, 3 }));
  EXPECT_EQ(adjacentTo(fans, 3, Adjacency::Edges), (std::vector<std::uint32_t>{ 3 }));
}

TEST(TriangleFans, areKeptWhileTheSameVerticesAreAtTheSamePlace)
{
  Occluders occluders = makeOccluders({ { makePlane(1.0, 2) }, { makeIcosphere(2) } });
  TriangleFans kept;
  kept.update(occluders);
  const auto expectAsFoundAnew = [&](bool isKept)
  {
    // What is found anew lies elsewhere, as what was there before is let go afterwards.
    const glm::uvec3* const before = kept.of(1).corners.data();
    kept.update(occluders);
    EXPECT_EQ(kept.of(1).corners.data() == before, isKept);
    TriangleFans anew;
    anew.update(occluders);
    for (const std::size_t surface : { 0u, 1u })
    {
      EXPECT_EQ(kept.of(surface).firstTriangle, anew.of(surface).firstTriangle);
      EXPECT_EQ(kept.of(surface).corners, anew.of(surface).corners);
      EXPECT_EQ(kept.of(surface).begin, anew.of(surface).begin);
      EXPECT_EQ(kept.of(surface).triangles, anew.of(surface).triangles);
    }
  };
  moveSurface(occluders, 1, { 1.0, 2.0, 3.0 });
  expectAsFoundAnew(true);
  // Two places become one, and come apart again.
  const std::size_t first = occluders.surfaces[1].firstVertex;
  const glm::vec3 place = occluders.positionsCentred[first];
  occluders.positionsCentred[first] = occluders.positionsCentred[first + 1];
  moveSurface(occluders, 1, glm::dvec3(0.0));
  expectAsFoundAnew(false);
  occluders.positionsCentred[first] = place;
  moveSurface(occluders, 1, glm::dvec3(0.0));
  expectAsFoundAnew(false);
}

//------------------------------------------------------------------------------
// The map

/// What a ray of the light meets first, of all that casts.
struct FirstHit
{
  CasterTriangle caster;
  double along = std::numeric_limits<double>::infinity();
  double margin = 0.0; ///< the least barycentric coordinate
};
FirstHit firstHit(
  const Occluders& occluders, const glm::dvec3& origin, const glm::dvec3& direction, double begin)
{
  FirstHit first;
  for (std::uint32_t k = 0; k < occluders.surfaces.size(); ++k)
  {
    const Surface& surface = occluders.surfaces[k];
    for (std::uint32_t i = 0; surface.casts && i < surface.triangleCount; ++i)
    {
      const std::uint32_t triangle = surface.firstTriangle + i;
      const glm::uvec3 corners = occluders.triangles[triangle];
      const glm::dvec3 a(occluders.positionsCentred[corners.x]);
      const glm::dvec3 ab = glm::dvec3(occluders.positionsCentred[corners.y]) - a;
      const glm::dvec3 ac = glm::dvec3(occluders.positionsCentred[corners.z]) - a;
      const glm::dvec3 area = glm::cross(ab, ac);
      const double cosine = glm::dot(area, direction);
      const double t = glm::dot(area, a - origin) / cosine;
      const glm::dvec3 point = origin + t * direction - a;
      const double v = glm::dot(glm::cross(point, ac), area) / glm::dot(area, area);
      const double w = glm::dot(glm::cross(ab, point), area) / glm::dot(area, area);
      const double margin = std::min({ 1.0 - v - w, v, w });
      if (margin >= 0.0 && t > begin && t < first.along && !(surface.oneSided && cosine > 0.0))
      {
        first = { { k, 0, triangle }, t, margin };
      }
    }
  }
  return first;
}

/// A ray of the light, centred, of any length: from the light, or of parallel ones from somewhere.
struct LightRay
{
  glm::dvec3 origin;
  glm::dvec3 direction;
};

/// The one that a map of a view has at a place, in texels.
LightRay rayAt(const LightView& view, int sizeTexels, const glm::dvec2& texels)
{
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dvec2 across = mapped(glm::inverse(texelFromAcross(view, sizeTexels)), texels);
  const auto centred = [&](const glm::dvec4& point) { return glm::dvec3(centredFromView * point); };
  return view.rays.positional
    ? LightRay{ centred({ 0.0, 0.0, 0.0, 1.0 }), centred({ across, 1.0, 0.0 }) }
    : LightRay{ centred({ across, 0.0, 1.0 }), centred({ 0.0, 0.0, 1.0, 0.0 }) };
}

TEST(TriangleMap, hasTheFirstTriangleAtEveryTexelsCentre)
{
  std::size_t found = 0, empty = 0;
  for (const char* name : { "spheres", "soup", "cups", "terrain", "one-sided", "crossing boxes" })
  {
    for (unsigned int seed = 1; seed <= 12; ++seed)
    {
      RandomPicture picture = makeRandomPicture(name, seed);
      const int size = std::min(picture.light.mapSizeTexels, 24);
      const bool positional = picture.light.kind != LightKind::Directional;
      const double begin = picture.light.box ? 0.0 : positional ? 1e-6 : -1e6;
      for (const LightView& view : picture.views.views)
      {
        const TriangleMap map(view, keptFromCentred(picture), size, picture.occluders);
        for (int row = 0; row < size; ++row)
        {
          for (int column = 0; column < size; ++column)
          {
            const LightRay ray = rayAt(view, size, { column + 0.5, row + 0.5 });
            const FirstHit expected = firstHit(picture.occluders, ray.origin, ray.direction, begin);
            const TriangleTexel& texel = map.texel(column, row);
            if (!(texel.caster == expected.caster))
            {
              // Rounding may decide at edges, and where triangles touch.
              const bool atEdge = expected.caster.exists() && expected.margin < 1e-6;
              const FirstHit behind =
                firstHit(picture.occluders, ray.origin, ray.direction, expected.along + 1e-12);
              const bool touches = behind.along - expected.along < 1e-5;
              EXPECT_TRUE(atEdge || touches)
                << picture.description << ", texel " << column << " " << row;
            }
            else if (expected.caster.exists())
            {
              // Depths range over 1, from the light to the farthest caster.
              const std::optional<MapPlace> hit =
                map.placeOf(ray.origin + expected.along * ray.direction, ray.direction);
              ASSERT_TRUE(hit);
              EXPECT_NEAR(texel.depth, hit->depth, 1e-5)
                << picture.description << ", texel " << column << " " << row;
            }
            found += expected.caster.exists() ? 1 : 0;
            empty += expected.caster.exists() ? 0 : 1;
          }
        }
        EXPECT_FALSE(map.texel(-1, 0).caster.exists());
        EXPECT_FALSE(map.texel(0, size).caster.exists());
      }
    }
  }
  EXPECT_GT(found, 10000u);
  EXPECT_GT(empty, 10000u);
}

//------------------------------------------------------------------------------
// Hits that are certain

TEST(CertainHit, isAMarginAwayFromEdgesAndEnds)
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 } };
  const Prop triangle{ mesh };
  const Occluders occluders = makeOccluders({ triangle });
  const CasterTriangle caster{ 0, 0, 0 };
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const float never = std::numeric_limits<float>::infinity();
  const auto hits = [&](const glm::vec3& origin, const glm::vec3& direction, float rayFar) {
    return certainlyStops(occluders, caster, { origin, direction, true }, rayFar);
  };
  EXPECT_TRUE(hits({ 0.0f, 0.0f, -1.0f }, up, never));
  EXPECT_TRUE(hits({ 0.0f, 0.0f, 1.0f }, -up, never));
  // Beside, on and just inside of an edge.
  EXPECT_FALSE(hits({ 0.0f, -1.001f, -1.0f }, up, never));
  EXPECT_FALSE(hits({ 0.0f, -1.0f, -1.0f }, up, never));
  EXPECT_FALSE(hits({ 0.0f, -0.9999999f, -1.0f }, up, never));
  EXPECT_TRUE(hits({ 0.0f, -0.999f, -1.0f }, up, never));
  // Where the ray starts behind it, on it or just before it.
  EXPECT_FALSE(hits({ 0.0f, 0.0f, 1.0f }, up, never));
  EXPECT_FALSE(hits({ 0.0f, 0.0f, 0.0f }, up, never));
  EXPECT_FALSE(hits({ 0.0f, 0.0f, -1e-7f }, up, never));
  EXPECT_TRUE(hits({ 0.0f, 0.0f, -1e-3f }, up, never));
  // Where it ends before it, on it or just behind it.
  EXPECT_FALSE(hits({ 0.0f, 0.0f, -2.0f }, up, 1.0f));
  EXPECT_FALSE(hits({ 0.0f, 0.0f, -1.0f }, up, 1.0f));
  EXPECT_FALSE(hits({ 0.0f, 0.0f, -0.9999999f }, up, 1.0f));
  EXPECT_TRUE(hits({ 0.0f, 0.0f, -0.999f }, up, 1.0f));
  // Along it.
  EXPECT_FALSE(hits({ 0.0f, -3.0f, 0.0f }, { 0.0f, 1.0f, 0.0f }, never));
}

TEST(CertainHit, isNotOnTheBackOfOneSidedCastersAndNotOnCutouts)
{
  Prop plane{ makePlane(2.0) };
  plane.oneSided = true;
  const Occluders oneSided = makeOccluders({ plane });
  const Occluders perforated = makeOccluders({ makePerforatedPlane(2.0, 1) });
  const float never = std::numeric_limits<float>::infinity();
  const auto hits = [&](const Occluders& occluders, float height)
  {
    const ShadowRay ray{ { 0.3f, 0.1f, height }, { 0.0f, 0.0f, -height }, true };
    return certainlyStops(occluders, { 0, 0, 0 }, ray, never) ||
      certainlyStops(occluders, { 0, 0, 1 }, ray, never);
  };
  EXPECT_TRUE(hits(oneSided, -1.0f)); // the light is above, where the front is
  EXPECT_FALSE(hits(oneSided, 1.0f));
  EXPECT_FALSE(hits(perforated, -1.0f));
}

//------------------------------------------------------------------------------
// The chain

/// What a chain made of a picture.
struct ChainRun
{
  std::vector<ChainClass> classes;
  std::vector<float> visibility;
  std::size_t traced = 0;

  std::size_t count(std::initializer_list<ChainClass> of) const
  {
    return static_cast<std::size_t>(std::count_if(this->classes.begin(), this->classes.end(),
      [&](ChainClass pixel) { return std::find(of.begin(), of.end(), pixel) != of.end(); }));
  }
  bool isOutside(std::size_t i) const
  {
    return this->classes[i] == ChainClass::OutsideLit ||
      this->classes[i] == ChainClass::OutsideShadow;
  }
  bool isHinted(std::size_t i) const
  {
    return this->classes[i] == ChainClass::HintedLit ||
      this->classes[i] == ChainClass::HintedShadow;
  }
  bool isConfirmed(std::size_t i) const
  {
    return this->classes[i] == ChainClass::ConfirmedByTexel ||
      this->classes[i] == ChainClass::ConfirmedByNeighbours ||
      this->classes[i] == ChainClass::ConfirmedByAdjacency ||
      this->classes[i] == ChainClass::Corrected;
  }
};

/// A picture with its maps and its truth, for chains of any stages.
class Chained
{
public:
  explicit Chained(RandomPicture picture)
    : picture_(std::move(picture))
    , receivers_(this->picture_.view.images, this->picture_.view.drawnSurfaces,
        this->picture_.occluders, this->stored_)
  {
    this->maps_.bake(this->picture_.views, this->picture_.light.mapSizeTexels,
      this->picture_.occluders, keptFromCentred(this->picture_));
    this->fans_.update(this->picture_.occluders);
    this->tracer_.update(this->picture_.occluders);
    this->needRays_ = this->tracer_.trace(
      this->picture_.light, this->picture_.occluders, this->receivers_, this->truth_);
  }

  ChainRun run(const ChainStages& stages)
  {
    std::vector<std::uint8_t> classes;
    ChainRun run;
    const ViewFitting fitting;
    int mapBakes = 0;
    const ScreenInput input{ this->picture_.light, fitting, this->picture_.occluders,
      this->receivers_, this->tracer_, true, &classes, mapBakes };
    run.traced = Chain(stages, this->maps_, nullptr, this->fans_, input).run(run.visibility);
    for (const std::uint8_t pixel : classes)
    {
      run.classes.push_back(static_cast<ChainClass>(pixel));
    }
    return run;
  }

  const RandomPicture& picture() const { return this->picture_; }
  const ReceiverPixels& receivers() { return this->receivers_.all(); }
  const std::vector<float>& truth() const { return this->truth_; }
  std::size_t needRays() const { return this->needRays_; }
  const std::string& description() const { return this->picture_.description; }

private:
  RandomPicture picture_;
  ReceiverPixels stored_;
  Receivers receivers_;
  TriangleMaps maps_;
  TriangleFans fans_;
  EmbreeTracer tracer_;
  std::vector<float> truth_;
  std::size_t needRays_ = 0;
};

/// All that proves, and the rest traced.
ChainStages provenStages(int contourPixels)
{
  ChainStages stages;
  stages.contourPixels = contourPixels;
  stages.neighbourTexels = 9;
  stages.adjacency = Adjacency::Vertices;
  return stages;
}

class ChainIn : public testing::TestWithParam<const char*>
{
};

INSTANTIATE_TEST_SUITE_P(Scenes, ChainIn, testing::ValuesIn(randomSceneNames()),
  [](const testing::TestParamInfo<const char*>& scene) { return lettersOf(scene.param); });

TEST_P(ChainIn, withoutCoherenceIsNeverWrong)
{
  std::size_t proven = 0, dark = 0;
  Compared compared;
  for (unsigned int seed = 1; seed <= exactRuns(); ++seed)
  {
    Chained chained(makeRandomPicture(GetParam(), seed));
    const ChainRun image = chained.run(provenStages(0));
    const std::size_t wrong = countDifferent(image.visibility, chained.truth());
    EXPECT_EQ(wrong, 0u) << chained.description();
    compared.add({ 1, chained.needRays(), image.traced, wrong });
    const ChainRun contour = chained.run(provenStages(4));
    for (std::size_t i = 0; i < contour.classes.size(); ++i)
    {
      EXPECT_TRUE(contour.isOutside(i) || contour.visibility[i] == chained.truth()[i])
        << chained.description();
      // What decides a pixel of the contour decides it in the whole image.
      EXPECT_TRUE(contour.isOutside(i) || contour.classes[i] == image.classes[i]);
      proven += image.isConfirmed(i) ? 1 : 0;
    }
    EXPECT_EQ(image.traced, image.count({ ChainClass::TracedLit, ChainClass::TracedShadow }));
    for (std::size_t i = 0; i < image.classes.size(); ++i)
    {
      const bool reached = image.classes[i] != ChainClass::Unreached;
      dark += reached && chained.truth()[i] == 0.0f ? 1 : 0;
    }
  }
  recordCompared("selective, contour=image, coherence=off", GetParam(), compared);
  // Holes are no proof.
  EXPECT_GE(proven, GetParam() == std::string("perforated") ? 0 : dark / 2);
  std::cout << GetParam() << ": proven " << proven << " of " << dark << " in shadow" << std::endl;
}

TEST(Chain, isNeverWrongFarAwayAndAtAnyScale)
{
  const glm::dmat4 worlds[] = { at(glm::dvec3(1e6, -2e6, 1e6)), at(glm::dvec3(0.0), 1e-4),
    at(glm::dvec3(0.0), 1e4), at(glm::dvec3(1e6), 1e4) };
  Compared compared;
  for (const glm::dmat4& world : worlds)
  {
    for (const char* name : randomSceneNames())
    {
      for (unsigned int seed = 100; seed < 100 + exactRuns() / 6; ++seed)
      {
        Chained chained(makeRandomPicture(name, seed, world));
        const ChainRun image = chained.run(provenStages(0));
        const std::size_t wrong = countDifferent(image.visibility, chained.truth());
        EXPECT_EQ(wrong, 0u) << chained.description();
        compared.add({ 1, chained.needRays(), image.traced, wrong });
      }
    }
  }
  recordCompared(
    "selective, contour=image, coherence=off", "all, far away or at other scales", compared);
}

TEST(Chain, confirmsMoreWithMoreTriangles)
{
  std::array<std::size_t, 3> byTexels{}, byAdjacency{};
  for (const char* name : { "spheres", "cups", "terrain", "soup", "lamp" })
  {
    for (unsigned int seed = 1; seed <= 8; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      std::vector<ChainRun> runs;
      for (const int texels : { 1, 4, 9 })
      {
        ChainStages stages;
        stages.neighbourTexels = texels;
        runs.push_back(chained.run(stages));
      }
      for (const Adjacency adjacency : { Adjacency::Edges, Adjacency::Vertices })
      {
        ChainStages stages;
        stages.neighbourTexels = 1;
        stages.adjacency = adjacency;
        runs.push_back(chained.run(stages));
      }
      for (std::size_t i = 0; i < chained.truth().size(); ++i)
      {
        const auto implies = [&](std::size_t fewer, std::size_t more)
        { return !runs[fewer].isConfirmed(i) || runs[more].isConfirmed(i); };
        EXPECT_TRUE(implies(0, 1) && implies(1, 2) && implies(0, 3) && implies(3, 4));
        // The own texel's triangle is the first that is tried.
        EXPECT_EQ(runs[0].classes[i] == ChainClass::ConfirmedByTexel,
          runs[2].classes[i] == ChainClass::ConfirmedByTexel);
        for (std::size_t k = 0; k < 3; ++k)
        {
          byTexels[k] += runs[k].isConfirmed(i) ? 1 : 0;
          byAdjacency[k] += runs[k == 0 ? 0 : k + 2].isConfirmed(i) ? 1 : 0;
        }
      }
    }
  }
  EXPECT_LT(byTexels[0], byTexels[1]);
  EXPECT_LT(byTexels[1], byTexels[2]);
  EXPECT_LT(byAdjacency[0], byAdjacency[1]);
  EXPECT_LT(byAdjacency[1], byAdjacency[2]);
}

TEST(Chain, hintsTheStatusOfPixelsWhoseTexelsAgree)
{
  std::array<std::size_t, 2> hinted{}, wrong{};
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 1; seed <= 6; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      std::array<ChainRun, 2> runs;
      for (std::size_t k = 0; k < 2; ++k)
      {
        ChainStages stages;
        stages.coherenceTexels = k == 0 ? 4 : 9;
        runs[k] = chained.run(stages);
      }
      const ChainRun statuses = chained.run({});
      for (std::size_t i = 0; i < chained.truth().size(); ++i)
      {
        EXPECT_TRUE(!runs[1].isHinted(i) || runs[1].classes[i] == runs[0].classes[i]);
        for (std::size_t k = 0; k < 2; ++k)
        {
          const bool isHinted = runs[k].isHinted(i);
          const bool isShadow = statuses.classes[i] == ChainClass::TracedShadow;
          EXPECT_TRUE(!isHinted || isShadow == (runs[k].classes[i] == ChainClass::HintedShadow));
          hinted[k] += isHinted ? 1 : 0;
          wrong[k] += runs[k].visibility[i] != chained.truth()[i] ? 1 : 0;
          EXPECT_TRUE(isHinted || runs[k].visibility[i] == chained.truth()[i]);
        }
        // Pixels that the light does not reach are dark by definition and need no hint.
        EXPECT_EQ(runs[0].classes[i] == ChainClass::Unreached,
          statuses.classes[i] == ChainClass::Unreached);
      }
    }
  }
  EXPECT_LT(hinted[1], hinted[0]);
  EXPECT_LT(wrong[1], wrong[0]);
  EXPECT_GT(wrong[1], 0u); // texels that agree may be wrong
  EXPECT_LT(wrong[0], hinted[0] / 50);
}

TEST(Chain, countsEveryPixelOnceAndItsErrorsAreThoseOfTheMap)
{
  std::size_t wrongOutside = 0, wrongHinted = 0, joined = 0;
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 1; seed <= 6; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      ChainStages stages = provenStages(4);
      stages.coherenceTexels = 4;
      const ChainRun run = chained.run(stages);
      std::size_t wrong = 0, outside = 0, hints = 0, withRay = 0;
      for (std::size_t i = 0; i < run.classes.size(); ++i)
      {
        ASSERT_LT(static_cast<std::size_t>(run.classes[i]), classesOfChain().size());
        const bool isWrong = run.visibility[i] != chained.truth()[i];
        wrong += isWrong ? 1 : 0;
        outside += isWrong && run.isOutside(i) ? 1 : 0;
        hints += isWrong && run.isHinted(i) ? 1 : 0;
        withRay +=
          run.classes[i] != ChainClass::NoReceiver && run.classes[i] != ChainClass::Unreached ? 1
                                                                                              : 0;
      }
      EXPECT_EQ(wrong, outside + hints) << chained.description();
      EXPECT_EQ(withRay, chained.needRays());
      EXPECT_EQ(run.traced, run.count({ ChainClass::TracedLit, ChainClass::TracedShadow }));
      wrongOutside += outside;
      wrongHinted += hints;

      // Without hints only what is outside is wrong; with those checked, less of it.
      stages.coherenceTexels = 0;
      const ChainRun proven = chained.run(stages);
      EXPECT_EQ(countDifferent(proven.visibility, chained.truth()), outside);
      stages.outside = OutsideContour::Check;
      const ChainRun checked = chained.run(stages);
      EXPECT_LE(countDifferent(checked.visibility, chained.truth()), outside);
      for (std::size_t i = 0; i < checked.classes.size(); ++i)
      {
        EXPECT_TRUE(!checked.isOutside(i) || proven.isOutside(i));
        joined += proven.isOutside(i) && !checked.isOutside(i) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(wrongOutside, 0u);
  EXPECT_GT(wrongHinted, 0u);
  EXPECT_GT(joined, 0u);
}

TEST(Chain, leavesWhatNothingDecidesLitOrToTheMajority)
{
  std::size_t wrongByMap = 0, wrongLit = 0, wrongByMajority = 0;
  for (const char* name : { "spheres", "cups", "folds", "crossing boxes", "terrain" })
  {
    for (unsigned int seed = 1; seed <= 8; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      ChainStages stages = provenStages(4);
      const ChainRun traced = chained.run(stages);
      stages.leftovers = Leftovers::Lit;
      const ChainRun lit = chained.run(stages);
      stages.leftovers = Leftovers::Majority;
      const ChainRun majority = chained.run(stages);
      EXPECT_EQ(lit.traced, 0u);
      EXPECT_EQ(majority.traced, 0u);
      for (std::size_t i = 0; i < traced.classes.size(); ++i)
      {
        const bool left = traced.classes[i] == ChainClass::TracedLit ||
          traced.classes[i] == ChainClass::TracedShadow;
        EXPECT_EQ(left, lit.classes[i] == ChainClass::LeftLit);
        EXPECT_EQ(left,
          majority.classes[i] == ChainClass::MajorityLit ||
            majority.classes[i] == ChainClass::MajorityShadow);
        if (left)
        {
          EXPECT_EQ(lit.visibility[i], 1.0f);
          const bool truth = chained.truth()[i] != 0.0f;
          wrongByMap += truth != (traced.classes[i] == ChainClass::TracedLit) ? 1 : 0;
          wrongLit += truth ? 0 : 1;
          wrongByMajority += truth != (majority.visibility[i] != 0.0f) ? 1 : 0;
        }
        else
        {
          EXPECT_EQ(lit.visibility[i], traced.visibility[i]);
          EXPECT_EQ(majority.visibility[i], traced.visibility[i]);
        }
      }
    }
  }
  std::cout << "left over and wrong: by the map " << wrongByMap << ", lit " << wrongLit
            << ", by majority " << wrongByMajority << std::endl;
  EXPECT_LT(wrongLit, wrongByMap);
}

TEST(Chain, withOneStageIsWrongWhereShadowIsNotConfirmedOrLightNotCorrected)
{
  std::vector<ChainStages> alone(5, provenStages(4));
  for (std::size_t k = 0; k < alone.size(); ++k)
  {
    alone[k].leftovers = Leftovers::Lit;
    alone[k].neighbourTexels = k < 3 ? std::array{ 1, 4, 9 }[k] : 0;
    alone[k].adjacency = k < 3 ? Adjacency::Off : k < 4 ? Adjacency::Edges : Adjacency::Vertices;
  }
  ChainStages statusOnly;
  statusOnly.contourPixels = 4;
  std::vector<std::size_t> unconfirmed(alone.size()), uncorrected(alone.size());
  std::size_t falseLight = 0, falseShadow = 0;
  for (const char* name : randomSceneNames())
  {
    for (unsigned int seed = 1; seed <= 3; ++seed)
    {
      Chained chained(makeRandomPicture(name, seed));
      const ChainRun status = chained.run(statusOnly);
      for (std::size_t k = 0; k < alone.size(); ++k)
      {
        const ChainRun run = chained.run(alone[k]);
        std::size_t wrong = 0, expected = 0;
        for (std::size_t i = 0; i < run.classes.size(); ++i)
        {
          const bool byTexelLit = status.classes[i] == ChainClass::TracedLit;
          const bool byTexelShadow = status.classes[i] == ChainClass::TracedShadow;
          if (!byTexelLit && !byTexelShadow)
          {
            continue; // outside of the contour, or without a shadow ray
          }
          const bool isShadow = chained.truth()[i] == 0.0f;
          const bool isConfirmed = run.isConfirmed(i) && run.classes[i] != ChainClass::Corrected;
          const bool leftShadow = byTexelShadow && isShadow && !isConfirmed;
          const bool leftLight = byTexelLit && isShadow && run.classes[i] != ChainClass::Corrected;
          unconfirmed[k] += leftShadow ? 1 : 0;
          uncorrected[k] += leftLight ? 1 : 0;
          expected += leftShadow || leftLight ? 1 : 0;
          wrong += run.visibility[i] != chained.truth()[i] ? 1 : 0;
          falseLight += k == 0 && byTexelLit && isShadow ? 1 : 0;
          falseShadow += k == 0 && byTexelShadow && !isShadow ? 1 : 0;
        }
        EXPECT_EQ(wrong, expected) << chained.description() << ", stage " << k;
      }
    }
  }
  for (std::size_t k = 0; k < alone.size(); ++k)
  {
    EXPECT_GT(unconfirmed[k], 0u);
    EXPECT_GT(uncorrected[k], 0u);
    // Neighbours alone are asked about what their texel calls lit.
    EXPECT_EQ(uncorrected[k] < falseLight, k < 3);
  }
  EXPECT_GT(falseShadow, 0u);
}

TEST(Chain, hasNoAcneOnRidgesAndInValleys)
{
  // A sheet with folds that are wider than texels, and steep, lit from above: nothing is in shadow.
  Mesh sheet;
  for (int i = 0; i <= 20; ++i)
  {
    sheet.points.emplace_back(0.3 * i - 3.0, -2.0, (i % 2) ? 0.4 : 0.0);
    sheet.points.emplace_back(0.3 * i - 3.0, 2.0, (i % 2) ? 0.4 : 0.0);
    if (i > 0)
    {
      const auto last = static_cast<unsigned int>(2 * i);
      sheet.triangles.emplace_back(last - 2, last, last + 1);
      sheet.triangles.emplace_back(last - 2, last + 1, last - 1);
    }
  }
  for (const double turn : { 0.0, 0.4, 1.1 })
  {
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), turn, { 0.0, 0.0, 1.0 });
    const Occluders occluders = makeOccluders({ { sheet, turned } });
    RandomPicture picture;
    picture.occluders = occluders;
    picture.light = directionalLight({ 0.0, 0.0, -1.0 });
    picture.description = "folds";
    Camera camera;
    camera.position = { -1.0, -2.0, 8.0 };
    picture.view = makeView(occluders, camera);
    picture.light.mapSizeTexels = 64;
    picture.views = fitLightViews(
      picture.light, occluders.centreWorld, occluders.castersCentred, picture.light.mapSizeTexels);
    Chained chained(picture);
    const ChainRun run = chained.run({});
    EXPECT_GT(run.count({ ChainClass::TracedLit }), 10000u);
    for (std::size_t i = 0; i < run.classes.size(); ++i)
    {
      // Rays of receivers in the very bottom of a valley may start behind its other side.
      EXPECT_TRUE(run.classes[i] != ChainClass::TracedShadow || chained.truth()[i] == 0.0f) << i;
    }
  }
}

TEST(Chain, hasNoAcneOnSmoothSurfaces)
{
  // Closed and open, convex and concave, and a plane; beyond the contours they are right.
  Mesh bowl = makeSphere(60, 120);
  for (const glm::dvec3& direction :
    { glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.5, 0.3, -1.0), glm::dvec3(1.0, 0.0, -0.4) })
  {
    std::vector<glm::uvec3> kept;
    Mesh lower = bowl;
    for (const glm::uvec3& triangle : bowl.triangles)
    {
      if (std::max({ bowl.points[triangle.x].z, bowl.points[triangle.y].z,
            bowl.points[triangle.z].z }) < 0.01)
      {
        kept.push_back(triangle);
      }
    }
    lower.triangles = kept;
    const Occluders occluders = makeOccluders({ { makePlane(8.0, 16) },
      { bowl, at({ 0.0, 1.5, 1.0 }) }, { lower, at({ 0.0, -1.5, 1.2 }) } });
    RandomPicture picture;
    picture.occluders = occluders;
    picture.light = directionalLight(direction);
    picture.description = "smooth";
    Camera camera;
    camera.position = { -6.0, -2.0, 7.0 };
    picture.view = makeView(occluders, camera);
    picture.light.mapSizeTexels = 256;
    picture.views = fitLightViews(
      picture.light, occluders.centreWorld, occluders.castersCentred, picture.light.mapSizeTexels);
    Chained chained(picture);
    const ChainRun run = chained.run(provenStages(6));
    std::size_t falseShadow = 0;
    for (std::size_t i = 0; i < run.classes.size(); ++i)
    {
      falseShadow += run.isOutside(i) && run.visibility[i] < chained.truth()[i] ? 1 : 0;
    }
    EXPECT_EQ(falseShadow, 0u);
    // Shadows' edges and little else are looked at.
    EXPECT_LT(
      run.count({ ChainClass::TracedLit, ChainClass::TracedShadow }), chained.needRays() / 8);
  }
}

} // namespace
} // namespace gnomon::test
