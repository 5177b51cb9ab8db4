// pcss_estimator.glsl on given maps: its early out, its reads of the map, and its points.

#include "EstimatorGlsl.h"
#include "HalfPlane.h"

#include "lights/KernelShape.h"
#include "lights/LightSamples.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/depth_map/DepthBounds.h"
#include "shadowtech/depth_map/KernelPoints.h"
#include "shadowtech/depth_map/PcssPoints.h"
#include "shadowtech/pcss/Pcss.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

constexpr double pcssSlack = 1e-6;

/// A light of the cube [-1, 1]^3 and its name in tests.
struct AreaCase
{
  const char* name;
  ShadowLight light;
};

std::ostream& operator<<(std::ostream& stream, const AreaCase& each)
{
  return stream << each.name;
}

std::vector<AreaCase> areaCases()
{
  const glm::dvec3 travel = glm::normalize(glm::dvec3(0.2, -0.1, -1.0));
  const glm::dvec3 up(0.3, 1.0, 0.1);
  ShadowLight sun;
  sun.directionWorld = travel;
  ShadowLight spot;
  spot.kind = LightKind::Spot;
  spot.positionWorld = -4.0 * travel;
  spot.directionWorld = travel;
  spot.coneAngleDegrees = 40.0;
  // One face of their cubes sees all casters. Rectangles are oblique to it; the plane of a steep
  // one cuts through it.
  ShadowLight wide = spot;
  wide.coneAngleDegrees = 75.0;
  wide.positionWorld = { 1.5, -1.2, 4.0 };
  wide.directionWorld = glm::normalize(glm::dvec3(0.2, 0.1, -1.0));
  const glm::dvec3 steep = glm::normalize(glm::dvec3(1.0, 0.3, -0.3));
  ShadowLight point = wide;
  point.kind = LightKind::Point;
  const auto with = [](ShadowLight light, const LightArea& area)
  {
    light.area = area;
    return light;
  };
  return { { "sun_disk", with(sun, diskArea(travel, 0.15)) },
    { "sun_rectangle", with(sun, rectangleArea(travel, up, { 0.2, 0.05 })) },
    { "spot_disk", with(spot, diskArea(travel, 0.5)) },
    { "spot_rectangle", with(spot, rectangleArea(travel, up, { 0.6, 0.2 })) },
    { "wide_spot_rectangle", with(wide, rectangleArea(travel, up, { 0.4, 0.3 })) },
    { "wide_spot_steep_rectangle", with(wide, rectangleArea(steep, up, { 0.4, 0.3 })) },
    { "point_ball", with(point, ballArea(0.4)) } };
}

/// Blocks at several heights over an empty ground, and single texels.
float blocks(const glm::ivec2& texel)
{
  const glm::ivec2 block = texel / 12;
  const unsigned bits = static_cast<unsigned>(block.x * 7 + block.y * 13) * 2654435761u;
  const bool single = texel.x % 17 == 5 && texel.y % 13 == 7;
  return single         ? 0.36f
    : bits >> 30u == 0u ? 0.3f + 0.05f * static_cast<float>(bits >> 28u & 3u)
                        : 1.0f;
}

/// A slope that ends in a step.
float slope(const glm::ivec2& texel)
{
  return texel.x < mapSize / 2 ? 0.3f + 0.004f * static_cast<float>(texel.x) : 1.0f;
}

/// A caster above every level receiver, with parts so low that they hide only their own ray.
float layers(const glm::ivec2& texel)
{
  const unsigned bits = static_cast<unsigned>(texel.x * 73 + texel.y * 1009) * 2654435761u;
  return 0.7f - 0.4f * std::exp2(-static_cast<float>(bits >> 29u));
}

/// A receiver in centred coordinates.
struct Receiver
{
  glm::dvec3 position;
  glm::dvec3 normal;
};

/// Return a light's first view of a cube that casts, as the only view.
LightViews firstView(const ShadowLight& light)
{
  LightViews views = fitLightViews(
    light, { glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, {}, { mapSize, 8 }, {} });
  views.views.resize(1);
  for (int& view : views.viewOfFace)
  {
    view = view == 0 ? 0 : LightViews::noView;
  }
  return views;
}

/// Return receivers on a plane that is tilted towards the light's first view.
std::vector<Receiver> receiversOf(const LightViews& views, const glm::dvec2& tilt)
{
  const LightView& view = views.views.front();
  const glm::dmat3 acrossFromTexel = glm::inverse(texelFromAcross(view, mapSize));
  const glm::dmat4 centredFromView = glm::inverse(view.rays.viewFromCentred);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(tilt, -1.0));
  const double distance = (0.7 - view.depthOffset) / view.depthScale;
  std::vector<Receiver> receivers;
  std::vector<glm::dvec2> places = randomPlaces(4);
  places.resize(700);
  for (const glm::dvec2& place : places)
  {
    const glm::dvec2 across = mapped(acrossFromTexel, place);
    // The plane through (0, 0, distance).
    const double z = view.rays.positional
      ? normal.z * distance / glm::dot(normal, glm::dvec3(across, 1.0))
      : distance - glm::dot(glm::dvec2(normal), across) / normal.z;
    const glm::dvec3 position(view.rays.positional ? across * z : across, z);
    const Receiver receiver{ glm::dvec3(centredFromView * glm::dvec4(position, 1.0)),
      glm::dmat3(centredFromView) * normal };
    if (views.layout == ViewLayout::Cube)
    {
      const glm::dvec4 positionLight = views.lightFromCentred * glm::dvec4(receiver.position, 1.0);
      const int face = cubeFaceOf(glm::dvec3(positionLight));
      if (views.viewOfFace[static_cast<std::size_t>(face)] != 0)
      {
        continue; // on another face
      }
    }
    receivers.push_back(receiver);
  }
  return receivers;
}

/// Run a technique's GLSL at receivers on a map.
std::vector<float> run(const PointwiseTechnique& technique, const ShadowLight& light,
  const LightViews& views, const Depths& depths, const std::vector<Receiver>& receivers)
{
  GlTexture map;
  fillDepths(map, depths);
  ShaderLibrary library;
  DepthBounds bounds;
  bounds.bake(map.name(), mapSize, 1, library);
  const std::vector<glm::vec2> lightPoints = pcssPoints(light.pcss.samples, light.area->shape);
  GlTexture pointTexture;
  fillTexture(pointTexture, GL_RG, { lightPoints.size(), 1, 0 }, lightPoints.data());
  const glm::dmat3 lightFromUnit = glm::dmat3(views.lightFromCentred) * light.area->worldFromUnit;
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, {});
  uniforms.push_back({ "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, map.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(pcssSlack, 0.0) });
  uniforms.push_back(bounds.uniform());
  uniforms.push_back({ "lightPoints_LIGHT", TextureBinding{ GL_TEXTURE_2D, pointTexture.name() } });
  uniforms.push_back({ "lightFromUnit_LIGHT", glm::mat3(lightFromUnit) });
  std::vector<glm::vec4> points;
  for (const Receiver& receiver : receivers)
  {
    points.emplace_back(receiver.position, 1.0);
  }
  return visibilityAt(technique, light, library, std::move(points),
    glm::vec3(receivers.front().normal), std::move(uniforms));
}

using PcssGlsl = GlslTestOf<AreaCase>;

INSTANTIATE_TEST_SUITE_P(Lights, PcssGlsl, testing::ValuesIn(areaCases()), byName);

/// The last one's plane cuts through the light.
const glm::dvec2 tilts[] = { { 0.0, 0.0 }, { 0.4, -0.2 }, { -1.5, 0.7 }, { -9.0, 0.5 } };

TEST_P(PcssGlsl, theEarlyOutChangesNothing)
{
  for (const Depths& depths : { Depths(blocks), Depths(slope), Depths(layers),
         Depths([](const glm::ivec2&) { return 0.35f; }) })
  {
    for (const glm::dvec2& tilt : tilts)
    {
      ShadowLight light = GetParam().light;
      const LightViews views = firstView(light);
      const std::vector<Receiver> receivers = receiversOf(views, tilt);
      const std::vector<float> early = run(Pcss(), light, views, depths, receivers);
      light.earlyOut = EarlyOut::None;
      EXPECT_EQ(early, run(Pcss(), light, views, depths, receivers)) << tilt.x;
    }
  }
}

/// Pcss with parts of its GLSL replaced.
class ChangedPcss : public Pcss
{
public:
  using Changes = std::vector<std::pair<std::string, std::string>>;

  explicit ChangedPcss(Changes changes)
    : changes_(std::move(changes))
  {
  }

  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    std::string text = this->Pcss::visibilityGlsl(light);
    for (const auto& [from, to] : this->changes_)
    {
      replaceOnce(text, from, to);
    }
    return text;
  }

private:
  Changes changes_;
};

/// Counts of texels of the map that the shader itself reads for receivers. Each receiver has its
/// own pixel.
struct Reads
{
  int fewest = 1000000;
  int most = 0;
  double all = 0.0;
};
Reads readsOf(const ShadowLight& light, const Depths& depths, const glm::dvec2& tilt)
{
  const std::string pointAndNormal = "(vec3 positionView, vec3 normalView)";
  const ChangedPcss counting(
    ChangedPcss::Changes{ { "float visibility_LIGHT" + pointAndNormal,
                            "int reads_LIGHT = 0;\nfloat pcss_LIGHT" + pointAndNormal +
                              ";\nfloat visibility_LIGHT" + pointAndNormal +
                              "\n{\n  reads_LIGHT = 0;\n"
                              "  pcss_LIGHT(positionView, normalView);\n"
                              "  return float(reads_LIGHT);\n}\nfloat pcss_LIGHT" +
                              pointAndNormal },
      { "float depthAt_LIGHT(int view, ivec2 texel)\n{",
        "float depthAt_LIGHT(int view, ivec2 texel)\n{\n  ++reads_LIGHT;" } });
  const LightViews views = firstView(light);
  Reads reads;
  for (const float each : run(counting, light, views, depths, receiversOf(views, tilt)))
  {
    const int count = static_cast<int>(each);
    reads.fewest = std::min(reads.fewest, count);
    reads.most = std::max(reads.most, count);
    reads.all += count;
  }
  return reads;
}

ShadowLight withSettings(ShadowLight light, PcssSamples samples, EarlyOut earlyOut)
{
  light.pcss.samples = samples;
  light.earlyOut = earlyOut;
  return light;
}

using PcssReads = GlslTest;

/// Apelles, table 4.1.
TEST_F(PcssReads, areThoseOfItsPresets)
{
  const PcssCounts expected[] = { { 16, 16 }, { 36, 64 }, { 64, 256 } };
  const Depths cover = [](const glm::ivec2&) { return 0.35f; };
  const Depths nothing = [](const glm::ivec2&) { return 1.0f; };
  for (int preset = 0; preset < 3; ++preset)
  {
    const auto samples = static_cast<PcssSamples>(preset);
    const ShadowLight light = withSettings(areaCases().front().light, samples, EarlyOut::None);
    const auto [search, filter] = expected[preset];
    // The reads are the receiver's own texel, the search, and the filter. Receivers without
    // blockers are searched, too. Receivers decided by bounds read no texels of the map.
    for (const Depths& depths : { cover, nothing })
    {
      const Reads plain = readsOf(light, depths, {});
      EXPECT_EQ(plain.fewest, 1 + search + filter);
      EXPECT_EQ(plain.most, 1 + search + filter);
      EXPECT_EQ(readsOf(withSettings(light, samples, EarlyOut::Exact), depths, {}).most, 0);
    }
    // The filter searches, too, and compares two depths, at most five times at each.
    const Reads mixed = readsOf(light, layers, {});
    EXPECT_GE(mixed.fewest, 1 + search + filter);
    EXPECT_GT(mixed.most, 1 + search + filter);
    EXPECT_LE(mixed.most, 1 + search + 3 * 5 * filter);
  }
}

/// The map's depths may begin anywhere before its nearest caster, as with a near plane.
TEST_P(PcssGlsl, doesNotDependOnWhereDepthsBegin)
{
  const ShadowLight& light = GetParam().light;
  const LightViews fitted = firstView(light);
  const std::vector<Receiver> receivers = receiversOf(fitted, tilts[1]);
  const std::vector<float> expected = run(Pcss(), light, fitted, blocks, receivers);
  const LightView& from = fitted.views.front();
  for (const double begin : { -4.0, -0.5, 0.1, 0.29 }) // the nearest caster is at 0.3
  {
    LightViews views = fitted;
    LightView& to = views.views.front();
    to.depthScale = from.depthScale / (1.0 - begin);
    to.depthOffset = (from.depthOffset - begin) / (1.0 - begin);
    const Depths depths = [&](const glm::ivec2& texel)
    { return static_cast<float>((blocks(texel) - begin) / (1.0 - begin)); };
    const std::vector<float> values = run(Pcss(), light, views, depths, receivers);
    std::size_t different = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      different += std::abs(values[i] - expected[i]) < 1e-5 ? 0 : 1;
    }
    // Depths are floats: a receiver may lie on a texel's plane, or a place on a texel's border.
    EXPECT_LE(different, values.size() / 50) << begin;
  }
}

TEST(Pcss, pointsKeepTheirDistance)
{
  for (const int count : { 16, 36, 64, 256, 512 })
  {
    const std::vector<glm::dvec2> points = poissonSquare(count);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
    double least = 2.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_LE(std::max(std::abs(points[i].x), std::abs(points[i].y)), 1.0);
      for (std::size_t j = 0; j < i; ++j)
      {
        least = std::min(least, wrappedDistance(points[i], points[j]));
      }
    }
    // Random points have 0.1 of it for 16 points, 0.02 for 256.
    EXPECT_GE(least, 0.69 * largestPoissonDistance(count)) << count;
    EXPECT_LE(least, largestPoissonDistance(count)) << count;
  }
}

TEST(Pcss, pointsOfADiskFillItEvenly)
{
  for (const PcssSamples samples : { PcssSamples::Low, PcssSamples::Medium, PcssSamples::High })
  {
    const std::vector<glm::vec2> points = pcssPoints(samples, LightArea::Shape::Disk);
    const PcssCounts counts = pcssCounts(samples);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(counts.search + counts.filter));
    // Four rings of equal area: chi-square with 3 degrees of freedom. Random points exceed it once
    // in twenty times.
    double chiSquare = 0.0;
    const double expected = 0.25 * counts.filter;
    std::vector<int> rings(4, 0);
    for (std::size_t i = static_cast<std::size_t>(counts.search); i < points.size(); ++i)
    {
      const double radius = glm::length(points[i]);
      ASSERT_LE(radius, 1.0 + 1e-6);
      ++rings[static_cast<std::size_t>(std::min(3.0, 4.0 * radius * radius))];
    }
    for (const int ring : rings)
    {
      chiSquare += (ring - expected) * (ring - expected) / expected;
    }
    EXPECT_LT(chiSquare, 7.8);
  }
}

/// The penumbra of a straight edge under a sun, by 16 points: rows of cells along it.
class PcssEdge : public GlslTest
{
protected:
  static constexpr int rows = 100;

  /// @param across places across the penumbra, from -1 to 1
  /// @return the rows of each of these places
  static std::vector<std::vector<float>> profile(
    const PointwiseTechnique& technique, bool isRound, const std::vector<double>& across)
  {
    ShadowLight light;
    light.directionWorld = { 0.0, 0.0, -1.0 };
    light.area = isRound ? diskArea(light.directionWorld, 0.5)
                         : rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, { 0.5, 0.5 });
    light.pcss.samples = PcssSamples::Low;
    const LightViews views = firstView(light);
    const LightView& view = views.views.front();
    const double distance = (0.7 - view.depthOffset) / view.depthScale;
    const double radiusTexels = 0.5 * mostTexelsAcross(views, mapSize) * 0.4 / view.depthScale;
    std::vector<Receiver> receivers;
    for (const double x : across)
    {
      for (int row = 0; row < rows; ++row)
      {
        const glm::dvec2 place(32.0 + x * radiusTexels, 20.0 + 0.25 * row);
        const glm::dvec3 position(
          mapped(glm::inverse(texelFromAcross(view, mapSize)), place), distance);
        receivers.push_back(
          { glm::dvec3(glm::inverse(view.rays.viewFromCentred) * glm::dvec4(position, 1.0)),
            { 0.0, 0.0, 1.0 } });
      }
    }
    const std::vector<float> values = run(
      technique, light, views,
      [](const glm::ivec2& texel) { return texel.x < mapSize / 2 ? 0.3f : 1.0f; }, receivers);
    std::vector<std::vector<float>> result;
    for (std::size_t i = 0; i < values.size(); i += rows)
    {
      result.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(i),
        values.begin() + static_cast<std::ptrdiff_t>(i) + rows);
    }
    return result;
  }
};

/// Each row's mean is the truth. The noise is white: cells do not depend on their neighbours.
TEST_F(PcssEdge, turningThePointsLeavesNoBandsAndWhiteNoise)
{
  std::vector<double> across;
  for (int i = -16; i <= 16; ++i)
  {
    across.push_back(0.05 * i);
  }
  double variance = 0.0, withNext = 0.0;
  /// Return the root mean square of the rows' means from the truth.
  const auto offBy = [&](const PointwiseTechnique& technique, bool isRound)
  {
    double square = 0.0;
    const auto profile = PcssEdge::profile(technique, isRound, across);
    for (std::size_t x = 0; x < across.size(); ++x)
    {
      const std::vector<float>& row = profile[x];
      const double mean = std::accumulate(row.begin(), row.end(), 0.0) / rows;
      const double truth = isRound ? diskShare(across[x]) : squareShare(across[x]);
      square += std::pow(mean - truth, 2) / static_cast<double>(across.size());
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        variance += (row[i] - mean) * (row[i] - mean);
        withNext += i > 0 ? (row[i] - mean) * (row[i - 1] - mean) : 0.0;
      }
    }
    return std::sqrt(square);
  };
  EXPECT_LT(offBy(Pcss(), false), 0.02); // a level of 16 points is 0.0625
  const double turned = offBy(Pcss(), true);
  EXPECT_LT(turned, 0.02);
  EXPECT_GT(variance, 0.0);
  EXPECT_LT(std::abs(withNext / variance), 0.1);
  const ChangedPcss alike(ChangedPcss::Changes{
    { "float angle = 6.2831853 * noise_LIGHT(cell);", "float angle = 0.0;" } });
  EXPECT_GT(offBy(alike, true), 2.0 * turned) << "the same points in all cells";
}

TEST(Pcss, widthsAreThoseOfSimilarTriangles)
{
  // Selected Real-Time Shadow Techniques, 2.9: a light of width 1, a receiver at 10 and a blocker
  // at 5; a frustum that is 10 wide at the near plane 1. There the penumbra is 0.1 of the map's
  // plane, the filter 0.01.
  ShadowLight light;
  light.kind = LightKind::Spot;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  light.positionWorld = { 0.0, 0.0, 10.0 };
  light.coneAngleDegrees = 50.0;
  light.area = rectangleArea(light.directionWorld, { 0.0, 1.0, 0.0 }, glm::dvec2(0.5));
  const Bounds casters{ { -1.0, -1.0, 5.0 }, { 1.0, 1.0, 5.0 } };
  const Bounds receivers{ { -5.0, -5.0, 0.0 }, glm::dvec3(5.0) };
  LightViews views = fitLightViews(light, { glm::dvec3(0.0), casters, {}, { 1024, 1 }, {} });
  // Half the light's diagonal times 1/5 - 1/10. Distances are cut 0.1 % short, so rounding removes
  // no caster.
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 0.1, 2e-4);
  EXPECT_EQ(reachOfArea(LightArea(), views, casters, receivers), 0.0);
  light.kind = LightKind::Directional;
  views = fitLightViews(light, { glm::dvec3(0.0), casters, {}, { 1024, 1 }, {} });
  EXPECT_NEAR(reachOfArea(*light.area, views, casters, receivers), std::sqrt(0.5) * 5.0, 1e-3);
  // Nothing is nearer to a point light than the casters' box, wherever its faces' planes cut.
  light.kind = LightKind::Point;
  const Bounds wide{ glm::dvec3(-4.0), glm::dvec3(4.0) };
  views = fitLightViews(light, { glm::dvec3(0.0), wide, {}, { 1024, 1 }, {} });
  EXPECT_LT(reachOfArea(ballArea(0.3), views, wide, receivers), 0.3);
}

} // namespace
} // namespace gnomon::test
