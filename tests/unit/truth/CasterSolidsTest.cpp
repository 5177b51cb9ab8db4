// Closed surfaces: which of their triangles rays towards the light can only leave them by.

#include "shadowtech/conservative/CasterSolids.h"

#include "ChosenReceivers.h"
#include "ExactRecord.h"
#include "RandomScenes.h"

#include "lights/LightViews.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/conservative/CasterEdges.h"
#include "shadowtech/conservative/ConservativeMaps.h"
#include "shadowtech/conservative/MapCasters.h"
#include "shadowtech/conservative/MeetingBoxes.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <vtkLine.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTriangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test
{
namespace
{

/// All that maps know of these casters.
CasterEdges edgesOf(const Occluders& occluders)
{
  CasterEdges edges;
  edges.update(occluders);
  return edges;
}

/// Of each triangle; 0 where it bounds no solid.
std::vector<float> clearancesOf(const Occluders& occluders)
{
  const CasterEdges edges = edgesOf(occluders);
  std::vector<float> clearances;
  for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
  {
    clearances.push_back(edges.solids().clearanceOf(i));
  }
  return clearances;
}

std::size_t countClear(const std::vector<Prop>& props)
{
  const std::vector<float> clearances = clearancesOf(makeOccluders(props));
  return static_cast<std::size_t>(std::count_if(
    clearances.begin(), clearances.end(), [](float clearance) { return clearance != 0.0f; }));
}

glm::dvec3 normalOf(const std::array<glm::dvec3, 3>& corners)
{
  return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

std::array<glm::dvec3, 3> cornersOf(const Occluders& occluders, std::uint32_t triangle)
{
  return centredCorners(occluders, occluders.surfaces.front(), 0, triangle);
}

TEST(MeetingBoxes, areAllPairsOnce)
{
  Random random(3);
  std::size_t found = 0;
  for (const std::size_t count : { 0u, 1u, 2u, 3u, 10u, 1000u })
  {
    std::vector<Bounds> boxes(count);
    for (Bounds& box : boxes)
    {
      // Some in each other, some the same, some flat.
      const glm::dvec3 lower(
        uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
      box.add(random() % 10 ? lower : boxes.front().lower);
      box.add(lower + std::pow(10.0, uniform(random, -3.0, -0.3)) * glm::abs(unitVector(random)));
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> visits;
    std::mutex mutex;
    MeetingBoxes().visit(boxes,
      [&](std::uint32_t a, std::uint32_t b)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        ++visits[{ a, b }];
      });
    std::size_t expected = 0;
    for (std::uint32_t a = 0; a < count; ++a)
    {
      for (std::uint32_t b = a + 1; b < count; ++b)
      {
        const glm::dvec3 gap =
          glm::max(boxes[a].lower - boxes[b].upper, boxes[b].lower - boxes[a].upper);
        const double apart = std::max({ gap.x, gap.y, gap.z });
        if (std::abs(apart) > 1e-6) // others may be either, by rounding
        {
          const auto visit = visits.find({ a, b });
          EXPECT_EQ(visit == visits.end() ? 0 : visit->second, apart < 0.0 ? 1 : 0);
          expected += apart < 0.0 ? 1 : 0;
        }
      }
    }
    EXPECT_GE(visits.size(), expected);
    found += expected;
  }
  EXPECT_GT(found, 1000u);
}

TEST(CasterSolids, areClosedSurfacesThatAreWoundAlike)
{
  const Mesh sphere = makeClosedSphere(12, 16);
  const std::size_t all = sphere.triangles.size();
  EXPECT_EQ(countClear({ { sphere } }), all);

  Mesh open = sphere;
  open.triangles.pop_back();
  EXPECT_EQ(countClear({ { open } }), 0u);
  Mesh turned = sphere;
  std::swap(turned.triangles[40].y, turned.triangles[40].z);
  EXPECT_EQ(countClear({ { turned } }), 0u);
  Mesh thrice = sphere; // a fin on one of its edges
  thrice.points.emplace_back(0.0, 0.0, 3.0);
  thrice.triangles.emplace_back(thrice.triangles[40].x, thrice.triangles[40].y,
    static_cast<unsigned int>(thrice.points.size() - 1));
  EXPECT_EQ(countClear({ { thrice } }), 0u);

  Prop oneSided{ sphere };
  oneSided.oneSided = true;
  EXPECT_EQ(countClear({ oneSided }), 0u);
  EXPECT_EQ(countClear({ { sphere, glm::dmat4(1.0), false } }), 0u) << "it does not cast";
  EXPECT_EQ(countClear({ { makePlane(1.0) }, { sphere, at({ 5.0, 0.0, 0.0 }) } }), all);
}

/// How often a mesh winds around a point: its triangles along a ray, those that it leaves by less those that it enters by.
int windingAround(const Occluders& occluders, const glm::dvec3& point, const glm::dvec3& along)
{
  int winding = 0;
  for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
  {
    const auto [a, b, c] = cornersOf(occluders, i);
    const auto side = [&](const glm::dvec3& from, const glm::dvec3& to)
    { return glm::dot(along, glm::cross(from - point, to - point)) > 0.0; };
    const bool s = side(a, b), t = side(b, c), u = side(c, a);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    if (s == t && t == u && glm::dot(area, a - point) * glm::dot(area, along) > 0.0)
    {
      winding += glm::dot(area, along) > 0.0 ? 1 : -1;
    }
  }
  return winding;
}

TEST(CasterSolids, areClearOnTheirOuterSideAlone)
{
  const Mesh sphere = makeClosedSphere(12, 16);
  const Mesh box = makeBox(glm::dvec3(-1.0), glm::dvec3(1.0));
  EXPECT_EQ(countClear({ { sphere } }), sphere.triangles.size());
  EXPECT_EQ(countClear({ { turnedOver(sphere) } }), 0u);
  EXPECT_EQ(countClear({ { turnedOver(box) } }), 0u);
  EXPECT_EQ(countClear({ { sphere, at(glm::dvec3(0.0), -1.0) } }), 0u) << "mirrored";
  EXPECT_EQ(
    countClear({ { turnedOver(sphere), at(glm::dvec3(0.0), -1.0) } }), sphere.triangles.size());
}

/// A tube along the x-axis and around, whose end comes back into its beginning from behind, and lies closely below its top.
Mesh makeTubeIntoItself(double gap)
{
  struct Station
  {
    glm::dvec2 middle;
    glm::dvec2 across; ///< half its width
    double low, high;
  };
  std::vector<Station> stations;
  const auto add = [&](double x, double y, double acrossX, double acrossY, double low, double high)
  {
    stations.push_back({ { x, y }, { acrossX, acrossY }, low, high });
  };
  // The end first, so that its triangles are.
  for (int i = 0; i <= 5; ++i)
  {
    add(1.5 - 0.25 * i, 0.0, 0.0, 0.3, 0.2, 1.0 - gap);
  }
  add(-2.5, 0.0, 0.3, 0.3, 0.2, 0.8);
  add(-2.5, 2.5, 0.3, -0.3, 0.2, 0.8);
  add(2.5, 2.5, -0.3, -0.3, 0.2, 0.8);
  add(2.5, 0.0, -0.3, 0.3, 0.2, 0.8);
  for (int i = 0; i <= 8; ++i)
  {
    add(2.0 - 0.25 * i, 0.0, 0.0, 0.5, 0.0, 1.0);
  }
  Mesh mesh;
  for (const Station& station : stations)
  {
    for (const double side : { 1.0, -1.0 })
    {
      for (const double z :
        { side > 0.0 ? station.low : station.high, side > 0.0 ? station.high : station.low })
      {
        const glm::dvec2 place = station.middle + side * station.across;
        mesh.points.emplace_back(place, z);
      }
    }
  }
  const auto quad = [&](unsigned int a, unsigned int b, unsigned int c, unsigned int d)
  {
    mesh.triangles.emplace_back(a, c, b);
    mesh.triangles.emplace_back(a, d, c);
  };
  const auto last = static_cast<unsigned int>(4 * (stations.size() - 1));
  for (unsigned int i = 0; i < last; i += 4)
  {
    for (unsigned int k = 0; k < 4; ++k)
    {
      quad(i + k, i + (k + 1) % 4, i + 4 + (k + 1) % 4, i + 4 + k);
    }
  }
  quad(0, 3, 2, 1);
  quad(last, last + 1, last + 2, last + 3);
  return mesh;
}

TEST(CasterSolids, areNotClearWhereTheirOuterSideIsInsideOfAnotherPart)
{
  for (const double gap : { 0.1, 0.001 })
  {
    for (const bool turned : { false, true })
    {
      const Mesh tube = makeTubeIntoItself(gap);
      const Occluders occluders = makeOccluders({ { turned ? turnedOver(tube) : tube } });
      const std::vector<float> clearances = clearancesOf(occluders);
      std::size_t clear = 0;
      for (std::uint32_t i = 0; i < clearances.size(); ++i)
      {
        const std::array<glm::dvec3, 3> corners = cornersOf(occluders, i);
        const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        clear += clearances[i] > 0.0f ? 1 : 0;
        if (clearances[i] > 0.0f)
        {
          const glm::dvec3 outside = middle + 1e-4 * normalOf(corners);
          EXPECT_EQ(
            windingAround(occluders, outside, glm::normalize(glm::dvec3(0.3, 0.2, 0.9))), 0);
        }
      }
      EXPECT_EQ(clear > 0, !turned) << "what is around it is outside";
      std::cout << "gap " << gap << (turned ? ", turned over: " : ": ") << clear << " of "
                << clearances.size() << " clear" << std::endl;
    }
  }
}

TEST(CasterSolids, ofBoxesAreClearAndOfGroovesAreNot)
{
  EXPECT_EQ(countClear({ { makeBox(glm::dvec3(-1.0), glm::dvec3(1.0)) } }), 12u);
  // A groove whose sides meet at 50 degrees.
  const double halfWidth = 0.4 * std::tan(glm::radians(25.0));
  const std::vector<glm::dvec2> profile{ { -1.0, 0.3 }, { -halfWidth, 0.3 }, { 0.0, -0.1 },
    { halfWidth, 0.3 }, { 1.0, 0.3 } };
  const Occluders occluders = makeOccluders({ { makeBlock(profile) } });
  const std::vector<float> clearances = clearancesOf(occluders);
  std::size_t ofGroove = 0, top = 0;
  for (std::uint32_t i = 0; i < clearances.size(); ++i)
  {
    const glm::dvec3 normal = normalOf(cornersOf(occluders, i));
    if (std::abs(normal.x) > 0.1 && std::abs(normal.x) < 0.99)
    {
      ++ofGroove;
      EXPECT_EQ(clearances[i], 0.0f);
    }
    else if (normal.z > 0.99)
    {
      ++top;
      EXPECT_GT(clearances[i], 0.0f);
    }
  }
  EXPECT_EQ(ofGroove, 4u);
  EXPECT_EQ(top, 4u);
}

/// Of triangles that do not meet; one may be a segment, with an end twice.
double distanceBetween(std::array<glm::dvec3, 3> a, std::array<glm::dvec3, 3> b)
{
  double least = std::numeric_limits<double>::infinity();
  double closest[3], otherClosest[3], t1, t2;
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      least = std::min(least,
        vtkLine::DistanceBetweenLineSegments(glm::value_ptr(a[i]), glm::value_ptr(a[(i + 1) % 3]),
          glm::value_ptr(b[j]), glm::value_ptr(b[(j + 1) % 3]), closest, otherClosest, t1, t2));
    }
  }
  for (const auto& [triangle, points] : { std::pair(a, b), std::pair(b, a) })
  {
    vtkNew<vtkTriangle> cell;
    for (std::size_t i = 0; i < 3; ++i)
    {
      cell->GetPoints()->SetPoint(static_cast<vtkIdType>(i), glm::value_ptr(triangle[i]));
    }
    for (const glm::dvec3& point : points)
    {
      int subId;
      double distance, parametric[3], weights[3];
      if (cell->EvaluatePosition(
            glm::value_ptr(point), closest, subId, parametric, distance, weights) >= 0)
      {
        least = std::min(least, distance);
      }
    }
  }
  return std::sqrt(least);
}

/// A roof with a steep point of that size at its ridge. All else near the tip slopes little more than the flat side.
Mesh makePointedRidge(double size)
{
  const auto slope = [size](double x, double y) { return glm::dvec3(x, y, -0.58 * (x + size)); };
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { -1.0, 1.0, 0.0 }, slope(-size, -1.0), slope(-size, 1.0),
    slope(-size, -0.5), slope(-size, 0.5), { 0.0, 0.0, 0.0 }, slope(0.5 * size, -0.3 * size),
    slope(0.5 * size, 0.3 * size), slope(1.0, -1.0), slope(1.0, 1.0), { 0.0, 0.0, -3.0 } };
  mesh.triangles = { { 0, 2, 4 }, { 0, 4, 1 }, { 1, 4, 5 }, { 1, 5, 3 }, { 4, 6, 5 }, // flat
    { 4, 7, 6 }, { 6, 7, 8 }, { 6, 8, 5 },                                            // steep
    { 2, 9, 4 }, { 4, 9, 7 }, { 7, 9, 8 }, { 8, 9, 10 }, { 8, 10, 5 }, { 5, 10, 3 },  // sloped
    { 2, 0, 11 }, { 9, 2, 11 }, { 10, 9, 11 }, { 3, 10, 11 }, { 1, 3, 11 }, { 0, 1, 11 } };
  return mesh;
}

TEST(CasterSolids, areClearByNoMoreThanOthersAreAway)
{
  Random random(7);
  std::size_t clear = 0, close = 0, closeNeighbours = 0;
  for (int run = 0; run < 40; ++run)
  {
    const char* const kinds[] = { "solids", "knots", "grooves" };
    Mesh mesh = makeRandomScene(kinds[run % 3], random).front().mesh;
    const double size = uniform(random, 1e-5, 4e-3); // of what is close to something else
    if (run % 4 == 1)
    {
      // A block with a slot, at most about as wide as is looked for.
      mesh = makeBlock({ { -1.0, 0.3 }, { -size, 0.3 }, { -0.9 * size, 0.0 }, { 0.9 * size, 0.0 },
        { size, 0.3 }, { 1.0, 0.3 } });
    }
    else if (run % 4 == 3)
    {
      mesh = makePointedRidge(size);
    }
    const Occluders occluders = makeOccluders({ { mesh } });
    const CasterEdges edges = edgesOf(occluders);
    const std::vector<std::uint32_t>& welded = edges.of(0).welded;
    // Corners that a triangle has and another has not.
    const auto cornersApart = [&](std::uint32_t of, std::uint32_t from)
    {
      std::vector<glm::dvec3> apart;
      for (int i = 0; i < 3; ++i)
      {
        const std::uint32_t corner = welded[occluders.triangles[of][i]];
        const glm::uvec3& others = occluders.triangles[from];
        if (corner != welded[others.x] && corner != welded[others.y] && corner != welded[others.z])
        {
          apart.push_back(cornersOf(occluders, of)[static_cast<std::size_t>(i)]);
        }
      }
      return apart;
    };
    const double reach = 2.0 / 512.0 * occluders.castersCentred.radius();
    for (int k = 0; k < 40; ++k)
    {
      const auto a = static_cast<std::uint32_t>(random() % occluders.triangles.size());
      const double clearance = edges.solids().clearanceOf(a);
      if (clearance == 0.0)
      {
        continue;
      }
      double least = std::numeric_limits<double>::infinity();
      double leastOfNeighbours = least;
      const std::array<glm::dvec3, 3> ofA = cornersOf(occluders, a);
      for (std::uint32_t b = 0; b < occluders.triangles.size(); ++b)
      {
        const std::array<glm::dvec3, 3> ofB = cornersOf(occluders, b);
        if (!(glm::dot(normalOf(ofA), normalOf(ofB)) < sharpCosine - 1e-9))
        {
          continue;
        }
        const std::vector<glm::dvec3> apart = cornersApart(b, a);
        if (apart.size() == 3)
        {
          least = std::min(least, distanceBetween(ofA, ofB));
        }
        else if (apart.size() == 2)
        {
          leastOfNeighbours =
            std::min(leastOfNeighbours, distanceBetween(ofA, { apart[0], apart[1], apart[1] }));
        }
      }
      ++clear;
      close += least < reach ? 1 : 0;
      closeNeighbours += leastOfNeighbours < std::min(least, reach) ? 1 : 0;
      EXPECT_LE(clearance, 1.001 * least) << "run " << run << ", triangle " << a;
      EXPECT_LE(clearance, 1.001 * leastOfNeighbours) << "run " << run << ", triangle " << a;
      EXPECT_LE(clearance, 1.001 * reach);
    }
  }
  EXPECT_GT(clear, 500u);
  EXPECT_GT(close, 20u) << "some are near enough to tell";
  EXPECT_GT(closeNeighbours, 20u) << "of some, nothing is as near as the far side of a neighbour";
  std::cout << clear << ", of which " << close << " are near others, and " << closeNeighbours
            << " nearer to neighbours' far sides" << std::endl;
}

TEST(CasterSolids, haveNothingOfThemselvesOutsideEvenWhereTheyCrossThemselves)
{
  Random random(8);
  std::size_t clear = 0, crossing = 0;
  for (int run = 0; run < 40; ++run)
  {
    const Occluders occluders = makeOccluders({ makeRandomScene("knots", random).front() });
    const std::vector<float> clearances = clearancesOf(occluders);
    crossing += std::count(clearances.begin(), clearances.end(), 0.0f) > 0 ? 1 : 0;
    for (int k = 0; k < 50; ++k)
    {
      const auto triangle = static_cast<std::uint32_t>(random() % clearances.size());
      const double clearance = clearances[triangle];
      if (clearance == 0.0)
      {
        continue;
      }
      ++clear;
      const std::array<glm::dvec3, 3> corners = cornersOf(occluders, triangle);
      const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      for (const double share : { 0.01, 0.9 })
      {
        const glm::dvec3 outside = middle + share * clearance * normalOf(corners);
        EXPECT_EQ(windingAround(occluders, outside, unitVector(random)), 0) << run;
      }
    }
  }
  EXPECT_GT(clear, 200u);
  EXPECT_GT(crossing, 5u);
}

TEST(CasterSolids, ofThoseThatMeetTheOneWithMoreClearTrianglesStays)
{
  const Mesh sphere = makeClosedSphere(12, 16);
  const Mesh box = makeBox(glm::dvec3(-0.5), glm::dvec3(0.5));
  const std::size_t all = sphere.triangles.size();
  EXPECT_EQ(countClear({ { box, at({ 1.6, 0.0, 0.0 }) }, { sphere } }), all + 12);
  EXPECT_EQ(countClear({ { box, at({ 1.5001, 0.0, 0.0 }) }, { sphere } }), all) << "nearly touches";
  EXPECT_EQ(countClear({ { sphere }, { box, at({ 1.2, 0.0, 0.0 }) } }), all) << "crosses";
  EXPECT_EQ(countClear({ { box, at(glm::dvec3(0.0), 0.5) }, { sphere } }), all) << "is inside";
  // What crosses what has gone may stay.
  EXPECT_EQ(
    countClear({ { sphere }, { box, at({ 1.2, 0.0, 0.0 }) }, { box, at({ 1.9, 0.0, 0.0 }) } }),
    all + 12);
}

TEST(CasterSolids, areFoundInWhatIsNewAndInWhatStays)
{
  Occluders occluders =
    makeOccluders({ { makeClosedSphere(12, 16) }, { makePlane(1.0), at({ 3.0, 0.0, 0.0 }) } });
  CasterEdges edges;
  edges.update(occluders);
  EXPECT_TRUE(edges.solids().areAllFound());
  const float clearance = edges.solids().clearanceOf(20);
  EXPECT_GT(clearance, 0.0f);
  moveSurface(occluders, 0, { 0.0, 0.0, 1.0 });
  edges.update(occluders);
  EXPECT_FALSE(edges.solids().areAllFound());
  EXPECT_EQ(edges.solids().clearanceOf(20), 0.0f);
  moveSurface(occluders, 0, { 0.0, 0.0, 1.0 });
  edges.update(occluders);
  EXPECT_EQ(edges.solids().clearanceOf(20), 0.0f) << "it moves on";
  edges.update(occluders);
  EXPECT_TRUE(edges.solids().areAllFound());
  EXPECT_NEAR(edges.solids().clearanceOf(20), clearance, 1e-4);
  // Others may move meanwhile.
  moveSurface(occluders, 1, { 0.0, 0.0, 1.0 });
  edges.update(occluders);
  EXPECT_NEAR(edges.solids().clearanceOf(20), clearance, 1e-4);
}

TEST(CasterSolids, areForgottenWhereASurfaceComesToCastOnOneSide)
{
  Occluders occluders = makeOccluders({ { makeClosedSphere(12, 16) } });
  CasterEdges edges;
  edges.update(occluders);
  const float clearance = edges.solids().clearanceOf(20);
  EXPECT_GT(clearance, 0.0f);
  for (const bool oneSided : { true, false })
  {
    occluders.surfaces.front().oneSided = oneSided;
    ++occluders.topologyVersion;
    ++occluders.positionsVersion;
    edges.update(occluders);
    EXPECT_EQ(edges.solids().clearanceOf(20), oneSided ? 0.0f : clearance);
  }
}

/// Of the casters of a map, those that rays can only leave solids by.
std::vector<MapPolygon> exitsOf(const CasterEdges& edges, const CasterScene& scene)
{
  std::vector<MapPolygon> exits;
  std::mutex mutex;
  const MapCasters casters(scene, edges, Covering::Triangle,
    [&](const BandItem&, const MapPolygon& polygon)
    {
      if (polygon.isExit)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        exits.push_back(polygon);
      }
    });
  return exits;
}

std::size_t countExits(const std::vector<Prop>& props, const ShadowLight& light)
{
  const Occluders occluders = makeOccluders(props);
  const CasterEdges edges = edgesOf(occluders);
  const LightViews views =
    fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels);
  std::size_t exits = 0;
  for (const LightView& view : views.views)
  {
    exits +=
      exitsOf(edges, casterScene(view, views.box.z > 0.0, light.mapSizeTexels, occluders)).size();
  }
  return exits;
}

TEST(CasterSolids, haveExitsOnTheirSideTowardsTheLight)
{
  const Mesh sphere = makeClosedSphere(32, 48);
  const Occluders occluders = makeOccluders({ { sphere } });
  const CasterEdges edges = edgesOf(occluders);
  ShadowLight light = directionalLight({ 0.3, 0.2, -1.0 });
  light.mapSizeTexels = 1024;
  const LightViews views =
    fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels);
  const CasterScene scene = casterScene(views.views.front(), false, light.mapSizeTexels, occluders);
  const std::vector<MapPolygon> exits = exitsOf(edges, scene);
  std::size_t towards = 0;
  for (std::uint32_t i = 0; i < occluders.triangles.size(); ++i)
  {
    const double cosine =
      glm::dot(normalOf(cornersOf(occluders, i)), -glm::normalize(light.directionWorld));
    towards += cosine > 1.0 / std::hypot(1.0, steepestExit) ? 1 : 0;
  }
  EXPECT_EQ(exits.size(), towards) << "all that are not too steep";
  for (const MapPolygon& exit : exits)
  {
    EXPECT_GT(exit.cosineToLight, 0.99 / std::hypot(1.0, steepestExit));
    EXPECT_LE(exit.noise, scene.lateral / 16.0);
  }
}

TEST(CasterSolids, haveNoExitsWhereTexelsAreCoarse)
{
  const std::vector<Prop> sphere{ { makeClosedSphere(32, 48) } };
  const auto withMap = [](ShadowLight light, int sizeTexels)
  {
    light.mapSizeTexels = sizeTexels;
    return light;
  };
  const ShadowLight sun = directionalLight({ 0.3, 0.2, -1.0 });
  EXPECT_GT(countExits(sphere, withMap(sun, 1024)), 0u);
  EXPECT_EQ(countExits(sphere, withMap(sun, 16)), 0u) << "rays may start too far off";
  ShadowLight lamp = pointLight({ 0.0, 0.3, 2.5 });
  lamp.projection = Projection::Cube;
  EXPECT_GT(countExits(sphere, withMap(lamp, 1024)), 0u);
  lamp.positionWorld = { 0.1, 0.2, 0.3 };
  EXPECT_EQ(countExits(sphere, withMap(lamp, 1024)), 0u)
    << "from inside, no side is turned to the lamp";
}

TEST(CasterSolids, areNotLookedAtWhereTheSceneIsMuchLarger)
{
  const Mesh sphere = makeClosedSphere(12, 16);
  const auto beside = [&](double distance) {
    return std::vector<Prop>{ { sphere }, { makePlane(1.0), at({ distance, 0.0, 0.0 }) } };
  };
  EXPECT_EQ(countClear(beside(10.0)), sphere.triangles.size());
  EXPECT_EQ(countClear(beside(200.0)), 0u);
  // And again where it is not.
  Occluders occluders = makeOccluders(beside(200.0));
  CasterEdges edges;
  edges.update(occluders);
  EXPECT_EQ(edges.solids().clearanceOf(20), 0.0f);
  occluders.allCentred = Bounds();
  occluders.allCentred.add(glm::dvec3(-2.0));
  occluders.allCentred.add(glm::dvec3(2.0));
  ++occluders.positionsVersion;
  edges.update(occluders);
  EXPECT_GT(edges.solids().clearanceOf(20), 0.0f);
}

TEST(CasterSolids, areGivenUpWhereTooManyTrianglesAreClose)
{
  // A box whose top is cut finely in one place.
  const auto boxWithFineTop = [](int cells)
  {
    std::vector<glm::dvec2> profile{ { -1.0, 0.3 } };
    for (int i = 0; i < cells; ++i)
    {
      profile.emplace_back(1e-3 * i / cells, 0.3 + (i % 2 ? 1e-4 : 0.0));
    }
    profile.emplace_back(1.0, 0.3);
    return makeBlock(profile);
  };
  EXPECT_GT(countClear({ { boxWithFineTop(10) } }), 0u);
  EXPECT_EQ(countClear({ { boxWithFineTop(20000) } }), 0u);
}

TEST(CasterSolids, leaveLessToBeTraced)
{
  // The same, once closed, and once with a triangle turned over on the side away from light and camera.
  Mesh closed = makeClosedSphere(48, 64);
  for (glm::dvec3& point : closed.points)
  {
    point *= 1.0 + 0.1 * std::sin(9.0 * point.x) * std::sin(8.0 * point.y);
  }
  Mesh other = closed;
  glm::uvec3& triangle = *std::min_element(other.triangles.begin(), other.triangles.end(),
    [&](const glm::uvec3& a, const glm::uvec3& b)
    { return other.points[a.x].z < other.points[b.x].z; });
  std::swap(triangle.y, triangle.z);
  ShadowLight light = directionalLight({ 0.5, 0.2, -0.6 });
  light.mapSizeTexels = 512;
  std::size_t traced[2] = { 0, 0 };
  for (const Covering covering : { Covering::Triangle, Covering::Ring, Covering::Silhouette })
  {
    for (const bool isClosed : { true, false })
    {
      const Occluders occluders = makeOccluders({ { isClosed ? closed : other } });
      Camera camera;
      camera.width = camera.height = 400;
      camera.position = { 1.0, -2.0, 2.5 };
      camera.target = { 0.0, 0.0, 0.0 };
      const View view = makeView(occluders, camera);
      ReceiverPixels stored;
      const Receivers receivers(view.images, view.drawnSurfaces, occluders, stored);
      ConservativeMaps maps;
      maps.bake(light,
        fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
        occluders, certainRule(covering));
      EmbreeTracer tracer;
      tracer.update(occluders);
      std::vector<float> truth, visibility;
      tracer.trace(light, occluders, receivers, truth);
      traced[isClosed] = tracer.trace(light, occluders, receivers, visibility, &maps);
      EXPECT_EQ(countDifferent(truth, visibility), 0u);
    }
    EXPECT_LT(traced[1], traced[0] * 19 / 20) << static_cast<int>(covering);
    std::cout << "traced " << traced[1] << " in place of " << traced[0] << std::endl;
  }
}

/// Points of casters, on the side towards the light, near edges and corners or not, whether anybody sees them or not; with the
/// offsets that pixels of all sizes ask for.
ChosenReceivers receiversOn(
  const Occluders& occluders, const ShadowLight& light, int count, Random& random)
{
  ChosenReceivers chosen(count, 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
  {
    const auto triangle = static_cast<std::uint32_t>(random() % occluders.triangles.size());
    const auto surface = static_cast<std::size_t>(
      std::find_if(occluders.surfaces.begin(), occluders.surfaces.end(),
        [&](const Surface& of) { return triangle < of.firstTriangle + of.triangleCount; }) -
      occluders.surfaces.begin());
    const std::array<glm::dvec3, 3> corners =
      centredCorners(occluders, occluders.surfaces[surface], 0, triangle);
    glm::dvec3 share(
      uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    for (int k = 0; k < 3; ++k)
    {
      share[k] *= random() % 2 ? 1.0 : std::pow(10.0, uniform(random, -7.0, 0.0));
    }
    share /= share.x + share.y + share.z;
    glm::dvec3 place = share.x * corners[0] + share.y * corners[1] + share.z * corners[2];
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    glm::dvec3 normal = glm::normalize(area);
    const glm::dvec3 towards = light.kind == LightKind::Directional
      ? -light.directionWorld
      : light.positionWorld - occluders.centreWorld - place;
    normal = glm::dot(normal, towards) < 0.0 ? -normal : normal;
    const float noise = noiseOf(
      occluders, occluders.surfaces[surface], 0, triangle, corners, normal, glm::length(area));
    const auto footprint = static_cast<float>(std::pow(10.0, uniform(random, -6.0, -2.0)));
    const bool inside = random() % 2;
    if (!inside)
    {
      // A fragment may lie past its triangle's edge.
      const glm::dvec3 along = glm::cross(normal, unitVector(random));
      place += 0.003 * static_cast<double>(footprint) * glm::normalize(along);
    }
    chosen.pixels.surface[i] = static_cast<std::uint32_t>(surface);
    chosen.set(i, place, normal,
      inside ? shadowRayOffsetInside(noise, footprint) : shadowRayOffset(noise, footprint));
  }
  return chosen;
}

class SolidsIn : public testing::TestWithParam<const char*>
{
};

TEST_P(SolidsIn, areNeverWrongAboutAnyReceiverOnThem)
{
  Random random(11);
  Compared sum;
  const unsigned int runs = exactRuns();
  for (unsigned int run = 0; run < runs; ++run)
  {
    const Occluders occluders = makeOccluders(makeRandomScene(this->GetParam(), random));
    ShadowLight light = makeRandomLight(random);
    if (light.kind == LightKind::Point && random() % 2)
    {
      // Inside of one, perhaps.
      light.positionWorld = occluders.centreWorld + uniform(random, 0.0, 0.5) * unitVector(random);
    }
    const int sizes[] = { 256, 512, 1024, 2048 };
    light.mapSizeTexels = sizes[random() % 4];
    const std::string refused = refusedProjection(light);
    light.projection = refused.empty() ? light.projection : Projection::Cube;
    const ChosenReceivers chosen = receiversOn(occluders, light, 20000, random);
    ConservativeMaps maps;
    maps.bake(light,
      fitLightViews(light, occluders.centreWorld, occluders.castersCentred, light.mapSizeTexels),
      occluders, certainRule(random() % 2 ? Covering::Silhouette : Covering::Triangle));
    EmbreeTracer tracer;
    tracer.update(occluders);
    std::vector<float> truth, visibility;
    Compared compared;
    compared.pictures = 1;
    compared.receivers = tracer.trace(light, occluders, chosen.pixels, truth);
    compared.traced = tracer.trace(light, occluders, chosen.pixels, visibility, &maps);
    compared.wrong = countDifferent(truth, visibility);
    EXPECT_EQ(compared.wrong, 0u) << "run " << run << ", light " << static_cast<int>(light.kind)
                                  << ", map " << light.mapSizeTexels;
    sum.add(compared);
  }
  EXPECT_LT(sum.traced, sum.receivers * 3 / 4);
  recordCompared(
    "crsm and silhouette by turns, receivers anywhere on casters", this->GetParam(), sum);
  std::cout << this->GetParam() << ": traced "
            << 100.0 * static_cast<double>(sum.traced) / static_cast<double>(sum.receivers)
            << " % of " << sum.receivers << std::endl;
}

INSTANTIATE_TEST_SUITE_P(CasterSolids, SolidsIn, testing::Values("solids", "knots", "grooves"),
  [](const testing::TestParamInfo<const char*>& name) { return std::string(name.param); });

} // namespace
} // namespace gnomon::test
