// The published construction of conservative shadow maps: its offset lines, its eroded triangles,
// and its neighbours.

#include "shadowtech/published/PublishedMap.h"

#include "TexelPolygons.h"

#include "shadowtech/base/Receivers.h"
#include "shadowtech/mesh/CasterEdges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr int width = 32;

using Points = std::vector<glm::dvec2>;

double areaOf(const Points& polygon)
{
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    area += 0.5 * perp(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return area;
}

/// Return the corners that half planes leave of a square far around the map, without coincident
/// ones.
Points cornersOf(const TexelRegion& region)
{
  const double far = 4.0 * width;
  Points points{ { -far, -far }, { far, -far }, { far, far }, { -far, far } };
  for (std::size_t i = 0; i < region.count; ++i)
  {
    const HalfPlane& side = region.sides[i];
    const auto distance = [&](const glm::dvec2& p)
    { return side.nx * p.x + side.ny * p.y + side.c; };
    Points kept;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const glm::dvec2 a = points[k];
      const glm::dvec2 b = points[(k + 1) % points.size()];
      if (distance(a) >= 0.0)
      {
        kept.push_back(a);
      }
      if ((distance(a) >= 0.0) != (distance(b) >= 0.0))
      {
        kept.push_back(a + (b - a) * (distance(a) / (distance(a) - distance(b))));
      }
    }
    points = kept;
  }
  Points apart;
  for (const glm::dvec2& point : points)
  {
    if (apart.empty() || glm::distance(point, apart.back()) > 1e-9)
    {
      apart.push_back(point);
    }
  }
  if (apart.size() > 1 && glm::distance(apart.front(), apart.back()) <= 1e-9)
  {
    apart.pop_back();
  }
  return apart;
}

std::set<std::size_t> texelsOf(const TexelRegion& region)
{
  std::set<std::size_t> texels;
  for (int y = 0; y < width; ++y)
  {
    const Span row = region.row(y, width);
    for (int x = row.first; x <= row.last; ++x)
    {
      texels.insert(static_cast<std::size_t>(y * width + x));
    }
  }
  return texels;
}

/// Return the published corners of an eroded triangle, case by case: walking around it, each side
/// stays or moves, and the corner between two sides that stay goes.
Points publishedCorners(const Corners& corners, const SharedSides& shared, double offset)
{
  const double inwards = doubleAreaOf(corners) > 0.0 ? 1.0 : -1.0;
  std::array<Line, 3> own, moved;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const glm::dvec2 from(corners[k]), to(corners[(k + 1) % 3]);
    own[k] = movedLine(from, to, inwards, 0.0);
    moved[k] = movedLine(from, to, inwards, offset);
  }
  Points points;
  for (std::size_t out = 0; out < 3; ++out)
  {
    const std::size_t in = (out + 2) % 3;
    if (shared[in] && shared[out])
    {
      points.push_back(crossing(own[in], moved[out]));
      points.push_back(crossing(own[out], moved[in]));
    }
    else
    {
      points.push_back(
        crossing(shared[in] ? own[in] : moved[in], shared[out] ? own[out] : moved[out]));
    }
  }
  return points;
}

/// Return the remaining share of a triangle's sides: 1 - offset / radius of the inscribed circle.
double shrunkBy(const Corners& corners, double offset)
{
  const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
  const double perimeter = glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, a);
  return 1.0 - offset * perimeter / std::abs(doubleAreaOf(corners));
}

SharedSides sharedBy(int combination)
{
  return { { (combination & 1) != 0, (combination & 2) != 0, (combination & 4) != 0 } };
}

TEST(PublishedMap, movesSidesByEtaTimesHalfATexelsDiagonal)
{
  Random random(1);
  for (int i = 0; i < 20000; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    const Corners turned{ { corners[0], corners[2], corners[1] } };
    if (std::abs(doubleAreaOf(corners)) < 1e-6)
    {
      continue;
    }
    for (const double eta : { 0.5, 1.0, 2.0 })
    {
      const double offset = publishedOffset(eta);
      EXPECT_NEAR(offset, eta * std::sqrt(0.5), 1e-15);
      const auto expectDistances = [&](const TexelRegion& region, double distance)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          const HalfPlane& side = region.sides[k];
          EXPECT_NEAR(std::hypot(side.nx, side.ny), 1.0, 1e-12);
          EXPECT_NEAR(side.nx * corners[k].x + side.ny * corners[k].y + side.c, distance, 1e-9);
          const glm::dvec3& next = corners[(k + 1) % 3];
          EXPECT_NEAR(side.nx * next.x + side.ny * next.y + side.c, distance, 1e-9);
        }
      };
      const bool counterClockwise = doubleAreaOf(corners) > 0.0;
      const MapPolygon polygon = polygonWith(counterClockwise ? corners : turned);
      const MapPolygon other = polygonWith(counterClockwise ? turned : corners);
      if (counterClockwise)
      {
        expectDistances(dilatedRegion(polygon, offset), offset);
        expectDistances(erodedRegion(polygon, {}, offset), -offset);
      }
      EXPECT_EQ(texelsOf(dilatedRegion(polygon, offset)), texelsOf(dilatedRegion(other, offset)));
      EXPECT_EQ(
        texelsOf(erodedRegion(polygon, {}, offset)), texelsOf(erodedRegion(other, {}, offset)));
    }
  }
}

TEST(PublishedMap, erodesSmallTrianglesToNothing)
{
  Random random(3);
  std::size_t turnedOver = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    const double doubleArea = std::abs(doubleAreaOf(corners));
    if (doubleArea < 1e-3)
    {
      continue;
    }
    const double offset = publishedOffset(1.0);
    const double k = shrunkBy(corners, offset);
    const Points left = cornersOf(erodedRegion(polygonWith(corners), {}, offset));
    if (k <= 0.0)
    {
      // Crossing its lines still gives a triangle, wound like the first one: its area is k * k of
      // the first one's.
      const Corners crossed = withMovedSides(corners, [&](const glm::dvec2&) { return offset; });
      EXPECT_GE(doubleAreaOf(crossed) * doubleAreaOf(corners), 0.0);
      EXPECT_LT(left.size(), 3u);
      EXPECT_TRUE(texelsOf(erodedRegion(polygonWith(corners), {}, offset)).empty());
      ++turnedOver;
    }
    else
    {
      EXPECT_NEAR(areaOf(left), 0.5 * k * k * doubleArea, 1e-6);
    }
  }
  EXPECT_GT(turnedOver, 10000u);
}

TEST(PublishedMap, erodesTrianglesAsTheirNeighboursSay)
{
  Random random(4);
  const double offset = publishedOffset(1.0);
  std::size_t compared = 0;
  while (compared < 2000)
  {
    const Corners corners = randomTriangle(random, width);
    if (shrunkBy(corners, offset) < 0.05)
    {
      continue;
    }
    ++compared;
    for (int combination = 0; combination < 8; ++combination)
    {
      const SharedSides shared = sharedBy(combination);
      const auto stay = static_cast<std::size_t>(std::count(shared.begin(), shared.end(), true));
      const Points expected = publishedCorners(corners, shared, offset);
      Points found = cornersOf(erodedRegion(polygonWith(corners), shared, offset));
      const std::size_t counts[] = { 3, 3, 4, 6 };
      ASSERT_EQ(expected.size(), counts[stay]);
      ASSERT_EQ(found.size(), counts[stay]);
      for (const glm::dvec2& corner : expected)
      {
        EXPECT_TRUE(std::any_of(found.begin(), found.end(),
          [&](const glm::dvec2& other) { return glm::distance(corner, other) < 1e-7; }));
      }
      // The published pieces, a fan of it, then do not overlap.
      EXPECT_NEAR(areaOf(found), std::abs(areaOf(expected)), 1e-6);
    }
  }
}

/// Return receivers at texels' centres, at this distance along the view.
ReceiverPixels receiversAt(
  const LightView& view, const std::function<double(const glm::dvec2&)>& depthAt)
{
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, width));
  ReceiverPixels receivers;
  receivers.resize(width, width);
  for (int i = 0; i < width * width; ++i)
  {
    const glm::dvec2 texel(i % width + 0.5, i / width + 0.5);
    const glm::dvec4 point =
      centredFromView * glm::dvec4(mapped(acrossFromTexel, texel), depthAt(texel), 1.0);
    const auto at = static_cast<std::size_t>(i);
    receivers.positionX[at] = static_cast<float>(point.x);
    receivers.positionY[at] = static_cast<float>(point.y);
    receivers.positionZ[at] = static_cast<float>(point.z);
    receivers.surface[at] = 0;
  }
  return receivers;
}

/// A triangle in the middle of the map and one across each side. Some of them face away from the
/// light.
struct Flaps
{
  Occluders occluders;
  ShadowLight light = directionalLight({ 0.0, 0.0, -1.0 });
  LightView view;

  explicit Flaps(const SharedSides& away)
  {
    Mesh mesh;
    mesh.points = { { -1.0, -0.9, 0.0 }, { 0.1, 1.0, 0.0 }, { 1.0, -0.8, 0.0 }, { -1.1, 0.5, 0.1 },
      { 1.2, 0.4, 0.1 }, { 0.1, -1.6, 0.1 } };
    // Clockwise from above, where the light is: it faces away.
    mesh.triangles = { { 0, 1, 2 }, { 1, 0, 3 }, { 2, 1, 4 }, { 0, 2, 5 } };
    for (std::size_t k = 0; k < 3; ++k)
    {
      glm::uvec3& flap = mesh.triangles[k + 1];
      flap = away[k] ? flap : glm::uvec3(flap.y, flap.x, flap.z);
    }
    this->occluders = makeOccluders({ { mesh } });
    this->view = fitLightViews(this->light,
      { this->occluders.frame.centre, this->occluders.castersCentred, {}, { width, 1 },
        {} }).views.front();
  }

  MapPolygon polygon(std::uint32_t triangle) const
  {
    return polygonOf(casterScene(this->view, false, width, this->occluders),
      this->occluders.surfaces.front(), 0, triangle);
  }

  /// Return the texels in which receivers far below are certain, by the map's rule.
  std::vector<Certainty> ask(PublishedLayers layers) const
  {
    const ReceiverPixels receivers =
      receiversAt(this->view, [](const glm::dvec2&) { return 100.0; });
    CasterEdges edges;
    edges.update(this->occluders);
    std::vector<Certainty> certain(receivers.size(), Certainty::Uncertain);
    publishedRule(layers)(this->view, false, width, this->occluders, edges)
      .ask(receivers, 0, receivers.size(), { 0, 1 }, certain.data());
    return certain;
  }
};

TEST(PublishedMap, sharesSidesWithNeighboursThatFaceAwayAndNoOthers)
{
  for (int combination = 0; combination < 8; ++combination)
  {
    const Flaps flaps(sharedBy(combination));
    const SharedSides shared = sharedBy(combination);
    const double offset = publishedOffset(1.0);
    for (const PublishedLayers layers : { PublishedLayers::Crsm, PublishedLayers::Crsma })
    {
      const bool adjacency = layers == PublishedLayers::Crsma;
      std::set<std::size_t> shadow, met;
      const auto add = [&](std::uint32_t triangle, const SharedSides& sides)
      {
        const MapPolygon polygon = flaps.polygon(triangle);
        shadow.merge(texelsOf(erodedRegion(polygon, adjacency ? sides : SharedSides(), offset)));
        met.merge(texelsOf(dilatedRegion(polygon, offset)));
      };
      add(0, shared);
      for (std::uint32_t k = 0; k < 3; ++k)
      {
        if (shared[k])
        {
          add(k + 1, { { true, false, false } }); // its other neighbours are missing
        }
      }
      EXPECT_GT(shadow.size(), 20u);
      const std::vector<Certainty> certain = flaps.ask(layers);
      for (std::size_t i = 0; i < certain.size(); ++i)
      {
        const Certainty expected = shadow.count(i) ? Certainty::Shadow
          : met.count(i)                           ? Certainty::Uncertain
                                                   : Certainty::Lit;
        EXPECT_EQ(certain[i], expected) << combination << ", texel " << i;
      }
    }
  }
}

/// A triangle that faces away from the light, askew.
struct Askew
{
  Occluders occluders;
  LightView view;
  Corners corners; ///< in texels, and z along the view

  explicit Askew(const ShadowLight& light = directionalLight({ 0.0, 0.0, -1.0 }))
  {
    Mesh mesh;
    mesh.points = { { -1.0, -0.9, 0.0 }, { 0.1, 1.0, 0.7 }, { 1.0, -0.8, 0.3 } };
    mesh.triangles = { { 0, 1, 2 } };
    this->occluders = makeOccluders({ { mesh } });
    this->view = fitLightViews(light,
      { this->occluders.frame.centre, this->occluders.castersCentred, {}, { width, 1 },
        {} }).views.front();
    const glm::dmat3 texels = texelFromAcross(this->view, width);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const glm::dvec3 point(this->view.rays.viewFromCentred *
        glm::dvec4(glm::dvec3(this->occluders.positionsCentred[k]), 1.0));
      const glm::dvec3 texel = texels * glm::dvec3(glm::dvec2(point), 1.0);
      this->corners[k] = glm::dvec3(glm::dvec2(texel) / texel.z, point.z);
    }
  }

  ConservativeMap map() const
  {
    CasterEdges edges;
    edges.update(this->occluders);
    return publishedRule(PublishedLayers::Crsm)(this->view, false, width, this->occluders, edges);
  }

  /// Return the map's answers for points at texels' centres, so far behind the triangle's plane.
  std::vector<Certainty> ask(double behind, bool onCaster) const
  {
    const auto depthAt = depthOf(this->corners);
    const ReceiverPixels receivers =
      receiversAt(this->view, [&](const glm::dvec2& texel) { return depthAt(texel) + behind; });
    std::vector<Certainty> certain(receivers.size(), Certainty::Uncertain);
    const std::uint8_t casts = onCaster ? 1 : 0;
    this->map().ask(receivers, 0, receivers.size(), { 0, casts }, certain.data());
    return certain;
  }
};

TEST(PublishedMap, comparesWithATrianglesPlaneAtTexelsCentres)
{
  Askew askew;
  const MapPolygon polygon = polygonWith(askew.corners);
  const double offset = publishedOffset(1.0);
  const std::set<std::size_t> met = texelsOf(dilatedRegion(polygon, offset));
  const std::set<std::size_t> covered = texelsOf(erodedRegion(polygon, {}, offset));
  EXPECT_GT(covered.size(), 100u);
  for (const bool onCaster : { false, true })
  {
    const std::vector<Certainty> before = askew.ask(-1e-4, onCaster);
    const std::vector<Certainty> behind = askew.ask(1e-4, onCaster);
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      EXPECT_EQ(before[i], Certainty::Lit) << i;
      EXPECT_EQ(behind[i],
        covered.count(i) ? Certainty::Shadow
          : met.count(i) ? Certainty::Uncertain
                         : Certainty::Lit)
        << i;
    }
  }
}

TEST(PublishedMap, isUncertainBelowCutouts)
{
  Askew askew;
  askew.occluders.surfaces.front().cutout = makePerforatedPlane(1.0, 1).cutout;
  const std::vector<Certainty> certain = askew.ask(1.0, false);
  EXPECT_EQ(std::count(certain.begin(), certain.end(), Certainty::Shadow), 0);
  EXPECT_GT(std::count(certain.begin(), certain.end(), Certainty::Uncertain), 100);
}

TEST(PublishedMap, isEmptyWithTheLightInACaster)
{
  EXPECT_GT(Askew(spotLight({ 0.1, 0.0, 2.0 }, { 0.0, 0.0, 0.0 }, 40.0)).map().bytes(), 0u);
  // A light in the middle of the triangle.
  EXPECT_EQ(
    Askew(spotLight({ 0.1 / 3.0, -0.7 / 3.0, 1.0 / 3.0 }, { 0.0, 0.0, -5.0 }, 55.0)).map().bytes(),
    0u);
}

} // namespace
} // namespace gnomon::test
