// `montecarlo`: its samples in GLSL, as the CPU takes them, its search and its rays' space.

#include "EstimatorGlsl.h"
#include "RandomScenes.h"
#include "SyntheticScene.h"

#include "lights/Bounds.h"
#include "lights/LightSamples.h"
#include "lights/LightViews.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/montecarlo/DepthLayers.h"
#include "shadowtech/montecarlo/RaySpace.h"
#include "shadowtech/montecarlo/SlabBounds.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <string>

namespace gnomon::test
{
namespace
{

using MonteCarloGlsl = GlslTest;

TEST_F(MonteCarloGlsl, takesTheJitteredSamplesOfTheLight)
{
  ShaderLibrary library;
  ShadowLight light;
  light.lightSampling = LightSampling::Jittered;
  light.lightSamples = 9;
  light.lightSeed = 3;
  std::vector<glm::ivec4> places;
  for (int i = 0; i < 9000; ++i)
  {
    places.emplace_back(i / 9 % 40, i / 360, i % 9, 0);
  }
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
  const LightArea areas[] = { rectangleArea(travel, { 0.0, 0.0, 1.0 }, { 0.5, 0.25 }),
    diskArea(travel, 0.75), ballArea(0.5) };
  for (const LightArea& area : areas)
  {
    light.area = area;
    const LightSamples samples(light);
    const auto points = runCompute<glm::vec4>(library,
      computeGlsl(ShaderLibrary::source("shadowtech/montecarlo/light_points.glsl"), "ivec4", "vec4",
        "ivec4 at = given[i];\n"
        "result[i] = vec4(lightPoint(fourPoints(at.xy, at.z), at.z), 0.0);\n"),
      places,
      { { "viewFromUnit", glm::mat3(area.worldFromUnit) }, { "lightSeed", light.lightSeed } },
      { "RAYS 3", "SHAPE " + std::to_string(static_cast<int>(area.shape)) });
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const glm::ivec4& at = places[i];
      const SamplePixel pixel =
        samples.pixel(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y));
      ASSERT_LT(glm::distance(glm::vec3(points[i]), samples.offset(at.z, pixel)), 3e-5f)
        << i << " of shape " << static_cast<int>(area.shape);
    }
  }
}

/// Along a row of pixels of two surfaces, of which one has visibility 0.4, the other 0.6.
TEST_F(MonteCarloGlsl, filterKeepsSurfacesApart)
{
  constexpr int side = 22;
  ShaderLibrary library;
  for (const char* apart : { "gap", "crease", "turned away" })
  {
    std::vector<glm::vec4> fragments, points, visibility;
    for (int x = 0; x < side; ++x)
    {
      const bool right = x >= side / 2;
      const bool along = right && apart == std::string("crease"); // its normal is x
      fragments.emplace_back(1.0f, 0.0f, along ? 1.0f : 0.0f, 0.0f);
      points.emplace_back(
        x, 0.0f, right && apart == std::string("gap") ? -110.0f : -10.0f, along ? 0.0f : 1.0f);
      visibility.emplace_back(right ? 0.6f : 0.4f,
        !right && apart == std::string("turned away") ? 1.0f : 5.0f, 0.0f, 0.0f);
    }
    GlTexture textures[6];
    const std::vector<glm::vec4> none(side, glm::vec4(0.0f));
    const glm::vec4* const texels[] = { fragments.data(), points.data(), visibility.data(),
      none.data(), none.data(), none.data() };
    std::vector<TextureBinding> bound;
    for (int i = 0; i < 6; ++i)
    {
      fillTexture(textures[i], GL_RGBA, { side, 1, 0 }, texels[i]);
      bound.push_back({ GL_TEXTURE_2D, textures[i].name() });
    }
    const GLuint program = ScreenPass::use(library,
      ShaderLibrary::source("shadowtech/montecarlo/visibility_filter.frag.glsl"),
      { "FILTER_PIXELS 5", "RAYS 3" });
    ShaderLibrary::setUniforms(program,
      { { "receiverFragments", bound[0] }, { "receiverPoints", bound[1] },
        { "unfiltered", bound[2] }, { "source", bound[2] }, { "slopes", bound[3] },
        { "axis", glm::ivec2(1, 0) }, { "pixelSide", glm::vec2(1.0f, 0.0f) }, { "lit", 1.0f } },
      0, 0);
    ScreenPass().fill({ { bound[4].texture }, { bound[5].texture } }, side, 1);
    std::vector<glm::vec4> row(side);
    glBindTexture(GL_TEXTURE_2D, bound[4].texture);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, row.data());
    for (int x = 0; x < side; ++x)
    {
      const auto pixel = static_cast<std::size_t>(x);
      EXPECT_NEAR(row[pixel].x, visibility[pixel].x, 0.002) << apart << ", " << x;
    }
  }
}

/// Few cells on average, also past sixty boxes, a sixth of the map wide each, which form a maze.
TEST_F(MonteCarloGlsl, searchesVisitFewCells)
{
  constexpr int side = 128;
  std::mt19937 random(7);
  const auto number = [&](double end) { return end * (random() / 4294967296.0); };
  std::vector<glm::mat2x4> lines; // from behind all boxes to before them, most of them short
  for (int i = 0; i < 20000; ++i)
  {
    const glm::dvec2 from(number(side), number(side));
    const glm::dvec2 to =
      glm::mix(from, glm::dvec2(number(side), number(side)), std::pow(number(1.0), 3.0));
    lines.emplace_back(glm::vec4(from, 1.0f, 0.0f), glm::vec4(to, 0.0f, 0.0f));
  }
  ShaderLibrary library;
  for (const auto& [boxes, visits] : { std::pair(6, 5.5), { 60, 16.0 } })
  {
    std::vector<glm::vec4> slabs(side * side, glm::vec4(2.0f)); // none, as slabs.glsl has them
    for (int i = 0; i < boxes; ++i)
    {
      const glm::dvec2 lower(number(side), number(side));
      const glm::dvec2 upper = lower + glm::dvec2(number(side / 3), number(side / 3));
      const double begin = number(0.8);
      for (int texel = 0; texel < side * side; ++texel)
      {
        const glm::dvec2 at(texel % side, texel / side);
        if (glm::all(glm::lessThan(lower, at)) && glm::all(glm::lessThan(at, upper)))
        {
          slabs[static_cast<std::size_t>(texel)] = { begin, -begin - 0.04, 2.0, 2.0 };
        }
      }
    }
    GlTexture texture;
    fillTexture(texture, GL_RGBA, { side, side, 1 }, slabs.data());
    SlabBounds bounds;
    bounds.build(texture.name(), 1, side, 1, library);
    const auto found = runCompute<glm::uvec2>(library,
      computeGlsl(ShaderLibrary::source("shadowtech/montecarlo/slab_search.glsl"), "mat2x4",
        "uvec2",
        "float where;\nbool meets = meetsSlabs(0, given[i][0].xyz, given[i][1].xyz, where);\n"
        "result[i] = uvec2(meets, cellsVisited);\n"),
      lines,
      { { "slabs", TextureBinding{ GL_TEXTURE_2D_ARRAY, texture.name() } },
        { "slabBounds", TextureBinding{ GL_TEXTURE_2D_ARRAY, bounds.texture() } },
        { "mapSide", side }, { "topLevel", bounds.topLevel() } },
      { "PAGES 1" });
    const glm::uvec2 sum = std::accumulate(found.begin(), found.end(), glm::uvec2(0u));
    EXPECT_GT(sum.x, lines.size() / 50) << "meet a box";
    EXPECT_LT(sum.x, lines.size() * 49 / 50);
    EXPECT_LT(sum.y, visits * 20000.0) << boxes;
  }
}

ShadowLight lampOver(double radius, double coneAngleDegrees)
{
  return withArea(spotLight({ 1.0, 2.0, 10.0 }, { 1.0, 2.0, 0.0 }, coneAngleDegrees),
    diskArea({ 0.0, 0.0, -1.0 }, radius));
}

TEST(RaySpace, stepsBackUntilItsConeHoldsTheLight)
{
  ShadowLight light = lampOver(0.0, 30.0);
  EXPECT_EQ(distanceToProjectionPoint(light), 0.0);
  light.area = ballArea(1.0);
  EXPECT_NEAR(distanceToProjectionPoint(light), 2.0, 1e-12);
  EXPECT_NEAR(nearestOfArea(light), 1.0, 1e-12);
  const LightArea flat[] = { diskArea(light.directionWorld, 1.0),
    rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, { 0.6, 0.8 }) };
  for (const LightArea& area : flat)
  {
    light.area = area;
    EXPECT_NEAR(distanceToProjectionPoint(light), std::sqrt(3.0), 1e-6);
    EXPECT_EQ(lightOfMap(light).positionWorld.z, 10.0 + distanceToProjectionPoint(light));
  }

  // Lines from points of the cone to points of the light stay in the cone.
  const ShadowLight seen = lightOfMap(light);
  std::mt19937 random(3);
  const auto number = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  const double tangent = std::tan(glm::radians(30.0));
  for (int i = 0; i < 10000; ++i)
  {
    const double distance = 5.0 + 4.0 * number();
    const double angle = 3.14159 * number();
    const glm::dvec3 receiver = light.positionWorld +
      distance * glm::dvec3(tangent * std::cos(angle), tangent * std::sin(angle), -1.0);
    const glm::dvec3 end =
      light.positionWorld + light.area->worldFromUnit * glm::dvec3(number(), number(), 0.0);
    const glm::dvec3 at = glm::mix(receiver, end, 0.5 + 0.5 * number()) - seen.positionWorld;
    ASSERT_LE(std::hypot(at.x, at.y), -at.z * tangent * (1.0 + 1e-9));
  }
  light.kind = LightKind::Point;
  EXPECT_EQ(distanceToProjectionPoint(light), 0.0) << "the faces of a cube see all around";
}

TEST(RaySpace, keepsLinesStraightAndDepthsInOrder)
{
  const Bounds casters{ { -3.0, -2.0, -1.0 }, { 2.0, 4.0, 5.0 } };
  for (const ShadowLight& light : { lampOver(1.0, 40.0), directionalLight({ 0.2, -0.3, -1.0 }) })
  {
    const LightViews views =
      fitLightViews(lightOfMap(light), { glm::dvec3(0.0), casters, {}, { 256, 1 }, {} });
    ASSERT_EQ(views.views.size(), 1u);
    const LightView& view = views.views[0];
    const double nearest = 2.0;
    const auto at = [&](const glm::dvec3& point)
    {
      const glm::dvec4 image = rayFromCentred(view, 256, nearest) * glm::dvec4(point, 1.0);
      EXPECT_GT(image.w, 0.0);
      return glm::dvec3(image) / image.w;
    };
    const glm::dvec3 from(-1.0, 1.0, 0.0), to(1.5, 3.0, 4.0);
    const glm::dvec3 a = at(from), b = at(to), between = at(glm::mix(from, to, 0.3));
    EXPECT_GT(a.z, b.z) << "farther from the light";
    const double share = (between.z - a.z) / (b.z - a.z);
    EXPECT_LT(glm::length(between - glm::mix(a, b, share)), 1e-10);
    // The place in the map.
    const glm::dvec3 inView(view.rays.viewFromCentred * glm::dvec4(from, 1.0));
    const glm::dvec2 texel = mapped(texelFromAcross(view, 256), view.rays.across(inView));
    EXPECT_LT(glm::distance(glm::dvec2(a), texel), 1e-9);
    EXPECT_NEAR(a.z,
      view.rays.positional ? -nearest / inView.z : inView.z * view.depthScale + view.depthOffset,
      1e-12);
  }
}

// The layers of `montecarlo`, against rays along the light through the texels' centres.

/// A surface along a texel's ray.
struct Hit
{
  double depth; ///< in ray space
  double span;  ///< of its plane within the texel
  bool front;   ///< faces the light
};

/// The layers of a light with a single view, and the rays along which they were seen.
class Layers
{
public:
  Layers(ShadowLight light, const std::vector<Prop>& props, RayLayers kind, int side)
    : side_(side)
    , occluders_(makeOccluders(props))
  {
    light.mapSizeTexels = side;
    light.monteCarlo.layers = kind;
    const LightViews views = viewsOf(lightOfMap(light), this->occluders_);
    this->view_ = views.views.at(0);
    if (this->view_.rays.positional)
    {
      this->nearest_ = this->view_.beginsAt;
    }
    OccluderBuffers buffers;
    buffers.update(this->occluders_);
    ShaderLibrary shaders;
    DepthLayers layers;
    {
      const GlStateGuard guard;
      layers.draw({ light, views, this->occluders_, buffers, shaders }, this->nearest_);
    }
    std::vector<glm::vec4> pages(this->texels() * static_cast<std::size_t>(layers.pages()));
    glBindTexture(GL_TEXTURE_2D_ARRAY, layers.slabs());
    glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_FLOAT, pages.data());
    this->slabs_.resize(this->texels());
    for (std::size_t i = 0; i < pages.size(); ++i)
    {
      std::vector<glm::dvec2>& slabs = this->slabs_[i % this->texels()];
      slabs.emplace_back(pages[i].x, -pages[i].y);
      slabs.emplace_back(pages[i].z, -pages[i].w);
    }
  }

  int side() const { return this->side_; }
  /// Return a texel's slabs, including empty ones.
  const std::vector<glm::dvec2>& slabs(int x, int y) const
  {
    return this->slabs_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->side_) +
      static_cast<std::size_t>(x)];
  }
  bool isEmpty(int x, int y) const
  {
    const std::vector<glm::dvec2>& all = this->slabs(x, y);
    return std::all_of(
      all.begin(), all.end(), [](const glm::dvec2& slab) { return slab == glm::dvec2(2.0, -2.0); });
  }

  /// Return the depth in ray space of a distance along the view.
  double depthAt(double z) const
  {
    return this->view_.rays.positional ? -this->nearest_ / z
                                       : z * this->view_.depthScale + this->view_.depthOffset;
  }
  /// Return the hits of a texel's ray in order. Nothing if they change when a corner is drawn
  /// slightly off its place, as rasterisers may.
  std::optional<std::vector<Hit>> hits(int x, int y) const
  {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    std::vector<Hit> hits = this->hitsAt(centre);
    for (const glm::dvec2& off :
      { glm::dvec2(0.015, 0.015), { -0.015, 0.015 }, { 0.015, -0.015 }, { -0.015, -0.015 } })
    {
      const std::vector<Hit> beside = this->hitsAt(centre + off);
      if (!std::equal(hits.begin(), hits.end(), beside.begin(), beside.end(),
            [](const Hit& a, const Hit& b) { return a.front == b.front; }))
      {
        return std::nullopt;
      }
    }
    return hits;
  }

private:
  std::size_t texels() const
  {
    return static_cast<std::size_t>(this->side_) * static_cast<std::size_t>(this->side_);
  }

  std::vector<Hit> hitsAt(const glm::dvec2& texel) const
  {
    std::vector<Hit> hits;
    for (const CastingTriangle& triangle : this->triangles_)
    {
      const auto meetAt = [&](const glm::dvec2& place)
      {
        const LightRay ray = rayAt(this->view_, this->side_, place); // 1 long along the view
        return meet(triangle, ray.origin, ray.direction);
      };
      const auto hit = meetAt(texel);
      if (hit && hit->isInside())
      {
        const double depth = this->depthAt(hit->at);
        const double span =
          std::abs(this->depthAt(meetAt(texel + glm::dvec2(1.0, 0.0))->at) - depth) +
          std::abs(this->depthAt(meetAt(texel + glm::dvec2(0.0, 1.0))->at) - depth);
        hits.push_back({ depth, span, hit->cosine < 0.0 });
      }
    }
    std::sort(
      hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    return hits;
  }

  int side_;
  Occluders occluders_;
  std::vector<CastingTriangle> triangles_ = castingTriangles(occluders_);
  LightView view_;
  double nearest_ = 1.0;
  std::vector<std::vector<glm::dvec2>> slabs_;
};

/// Corners are drawn to within 1/256 of a texel, and depths are rounded: a small part of the
/// plane's span in the texel.
double tolerance(const Hit& hit)
{
  return hit.span / 100.0 + 4e-6;
}

/// A box, a sphere and two sheets of either winding over a floor; none of them touch.
std::vector<Prop> things()
{
  return { { makePlane(8.0) }, { makeBox({ -1.2, -1.0, 0.5 }, { 0.2, 0.3, 1.6 }) },
    { makeSphere(12, 16), at({ 1.2, 0.8, 1.3 }, 0.8) },
    { makePlane(1.5), glm::rotate(at({ -0.3, 0.4, 2.6 }), 0.5, glm::dvec3(1.0, 0.4, 0.0)) },
    { makePlane(1.2), glm::rotate(at({ 0.6, -0.5, 2.2 }), 2.7, glm::dvec3(0.2, 1.0, 0.0)) } };
}

std::vector<ShadowLight> lights()
{
  return { directionalLight({ 0.4, 0.3, -1.0 }), directionalLight({ 0.0, 0.0, -1.0 }),
    spotLight({ -2.0, -2.5, 6.0 }, { 0.0, 0.0, 0.5 }, 40.0) };
}

using DepthLayersTest = GlslTest;

/// Return the largest depth of a solid that ends at a surface of a texel. A sheet spans the texel.
/// If a body's front spans more than the body's thickness, the body extends to that front's depths
/// in the texels beside it.
double reachOf(const Layers& layers, int x, int y, const std::vector<Hit>& hits, std::size_t i)
{
  double reach = hits[i].depth + hits[i].span;
  if (i == 0 || !hits[i - 1].front || hits[i].front)
  {
    return reach;
  }
  const Hit& front = hits[i - 1];
  const double farthest = front.depth + 1.01 * front.span + tolerance(front);
  for (const glm::ivec2& beside : { glm::ivec2(1, 0), { -1, 0 }, { 0, 1 }, { 0, -1 } })
  {
    const int column = x + beside.x;
    const int row = y + beside.y;
    if (std::clamp(column, 0, layers.side() - 1) != column ||
      std::clamp(row, 0, layers.side() - 1) != row)
    {
      continue;
    }
    const std::optional<std::vector<Hit>> others = layers.hits(column, row);
    if (!others)
    {
      return std::max(reach, farthest); // the neighbour's hits are uncertain
    }
    for (const Hit& other : *others)
    {
      if (other.front && other.depth <= farthest &&
        other.depth - 1.01 * other.span <= front.depth + tolerance(other))
      {
        reach = std::max(reach, other.depth + tolerance(other));
      }
    }
  }
  return reach;
}

/// Expect a texel of two layers to end at the last surface, or within its span.
void expectEnd(const glm::dvec2& slab, const std::vector<Hit>& hits)
{
  double least = -2.0, farthest = -2.0;
  for (const Hit& hit : hits)
  {
    least = std::max(least, hit.depth - tolerance(hit));
    farthest = std::max(farthest, hit.depth + hit.span + 2.0 * tolerance(hit));
  }
  EXPECT_GE(slab.y, least);
  EXPECT_LE(slab.y, farthest);
}

/// Expect a texel of peeled layers to be solid from fronts to backs, and empty from backs to
/// fronts.
/// @return the numbers of solids and gaps
glm::ivec2 expectSolids(const Layers& layers, int x, int y, const std::vector<Hit>& hits)
{
  glm::ivec2 found(0);
  const auto isSolid = [&](double depth, double slack)
  {
    const std::vector<glm::dvec2>& slabs = layers.slabs(x, y);
    return std::any_of(slabs.begin(), slabs.end(),
      [&](const glm::dvec2& slab) { return slab.x - slack <= depth && depth <= slab.y + slack; });
  };
  for (std::size_t i = 0; i < hits.size(); ++i)
  {
    const Hit& hit = hits[i];
    EXPECT_TRUE(isSolid(hit.depth, tolerance(hit))) << hit.depth;
    if (i + 1 == hits.size())
    {
      continue;
    }
    const double middle = 0.5 * (hit.depth + hits[i + 1].depth);
    if (hit.front && !hits[i + 1].front)
    {
      ++found.x;
      EXPECT_TRUE(isSolid(middle, 0.0)) << middle;
    }
    else if (reachOf(layers, x, y, hits, i) + tolerance(hit) < middle)
    {
      ++found.y;
      EXPECT_FALSE(isSolid(middle, 0.0)) << middle;
    }
  }
  return found;
}

TEST_F(DepthLayersTest, areWhatEachTexelsRayMeets)
{
  for (const ShadowLight& light : lights())
  {
    for (const RayLayers kind : { RayLayers::Near, RayLayers::NearFar, RayLayers::Peeled })
    {
      const Layers layers(light, things(), kind, 64);
      int counted = 0, empty = 0;
      glm::ivec2 solidsAndGaps(0);
      for (int i = 0; i < 64 * 64 && !HasFailure(); ++i)
      {
        const int x = i % 64, y = i / 64;
        SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
        const std::optional<std::vector<Hit>> hits = layers.hits(x, y);
        if (!hits)
        {
          continue;
        }
        ++counted;
        if (hits->empty())
        {
          ++empty;
          EXPECT_TRUE(layers.isEmpty(x, y));
          continue;
        }
        const std::vector<glm::dvec2>& slabs = layers.slabs(x, y);
        const double begin = std::min_element(slabs.begin(), slabs.end(),
          [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x < b.x;
          })->x;
        EXPECT_NEAR(begin, hits->front().depth, tolerance(hits->front()));
        if (kind == RayLayers::NearFar)
        {
          expectEnd(slabs[0], *hits);
        }
        else if (kind == RayLayers::Peeled)
        {
          solidsAndGaps += expectSolids(layers, x, y, *hits);
        }
      }
      EXPECT_GT(counted, 64 * 64 * 8 / 10);
      EXPECT_GT(empty, light.directionWorld == lights()[1].directionWorld ? -1 : 50);
      EXPECT_TRUE(kind != RayLayers::Peeled || (solidsAndGaps.x > 150 && solidsAndGaps.y > 300));
    }
  }
}

} // namespace
} // namespace gnomon::test
