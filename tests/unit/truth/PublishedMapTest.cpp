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

/// Return a point's distance into an eroded triangle, case by case: each side stays or moves. The
/// corner between two sides that stay is cut off where each meets the other one moved.
double depthInEroded(
  const Corners& corners, const SharedSides& shared, double offset, const glm::dvec2& point)
{
  const double inwards = doubleAreaOf(corners) > 0.0 ? 1.0 : -1.0;
  std::array<Line, 3> own, moved;
  for (std::size_t k = 0; k < 3; ++k)
  {
    own[k] = lineBetween(corners[k], corners[(k + 1) % 3], inwards);
    moved[k] = { own[k].normal, own[k].c + offset };
  }
  double least = infinity;
  for (std::size_t out = 0; out < 3; ++out)
  {
    const std::size_t in = (out + 2) % 3;
    least = std::min(least, (shared[out] ? own : moved)[out].distance(point));
    if (shared[in] && shared[out])
    {
      const Line cut =
        lineBetween(crossing(own[in], moved[out]), crossing(own[out], moved[in]), 1.0);
      const double side = cut.distance(corners[out]) > 0.0 ? -1.0 : 1.0;
      least = std::min(least, side * cut.distance(point));
    }
  }
  return least;
}

SharedSides sharedBy(int combination)
{
  return { { (combination & 1) != 0, (combination & 2) != 0, (combination & 4) != 0 } };
}

TEST(PublishedMap, holdsTexelsWhoseCentresLieBetweenMovedSides)
{
  EXPECT_NEAR(publishedOffset(2.0), 2.0 * std::sqrt(0.5), 1e-15);
  Random random(1);
  std::size_t held = 0, emptied = 0;
  for (int i = 0; i < 600; ++i)
  {
    const Corners corners = randomTriangle(random, width);
    const double offset = publishedOffset(std::array{ 0.5, 1.0, 2.0 }[i % 3]);
    const MapPolygon polygon = polygonWith(corners);
    const auto expectTexels = [&](const TexelRegion& region, const auto& depthAt)
    {
      const std::set<std::size_t> texels = texelsOf(region);
      for (std::size_t texel = 0; texel < width * width; ++texel)
      {
        const double depth = depthAt(glm::dvec2(texel % width, texel / width) + 0.5);
        if (std::abs(depth) > 1e-6) // rounding decides on the border
        {
          ASSERT_EQ(texels.count(texel) == 1, depth > 0.0) << i;
        }
      }
      held += texels.size();
      emptied += texels.empty() ? 1 : 0;
    };
    for (int combination = 0; combination < 8; ++combination)
    {
      const SharedSides shared = sharedBy(combination);
      expectTexels(erodedRegion(polygon, shared, offset),
        [&](const glm::dvec2& point) { return depthInEroded(corners, shared, offset, point); });
    }
    const auto [a, b, c] = corners;
    const glm::dvec2 low = glm::min(a, glm::min(b, c)) - 0.5;
    const glm::dvec2 high = glm::max(a, glm::max(b, c)) + 0.5;
    expectTexels(dilatedRegion(polygon, offset),
      [&](const glm::dvec2& point)
      {
        const glm::dvec2 inBox = glm::min(point - low, high - point);
        return std::min({ depthInEroded(corners, {}, -offset, point), inBox.x, inBox.y });
      });
  }
  EXPECT_GT(held, 20000u);
  EXPECT_GT(emptied, 500u);
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
    receivers.put(static_cast<std::size_t>(i), point, glm::vec3(0.0f), 0.0f, 0);
  }
  return receivers;
}

/// A triangle in the middle of the map and one across each side. Some of them face away from the
/// light.
struct Flaps
{
  Occluders occluders;
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
    this->view =
      viewsOf(withMap(directionalLight({ 0.0, 0.0, -1.0 }), width), this->occluders).views.front();
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
    this->view = viewsOf(withMap(light, width), this->occluders).views.front();
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
