// `montecarlo`: its samples in GLSL, as the CPU takes them, its search and its rays' space.

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "lights/Bounds.h"
#include "lights/LightSamples.h"
#include "lights/LightViews.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/montecarlo/RaySpace.h"
#include "shadowtech/montecarlo/SlabBounds.h"

#include <cmath>
#include <numeric>
#include <random>

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

} // namespace
} // namespace gnomon::test
