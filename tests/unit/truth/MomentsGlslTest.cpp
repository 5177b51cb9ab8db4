// The estimators over moments and the blur, against twins in double precision.

#include "EstimatorGlsl.h"

#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/moment_map/BoxBlur.h"
#include "shadowtech/moment_map/MomentEstimators.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

/// A depth in [0, 1] and the share of a kernel that it covers.
struct Covered
{
  double depth;
  double share;
};
using CoveredDepths = std::vector<Covered>;

double centred(double depth)
{
  return 2.0 * depth - 1.0;
}

/// Return the mean of a function of the centred depths.
double mean(const CoveredDepths& depths, const std::function<double(double)>& function)
{
  double sum = 0.0;
  for (const Covered& covered : depths)
  {
    sum += covered.share * function(centred(covered.depth));
  }
  return sum;
}

/// An estimator over moments, and its moments.
struct MomentsTwin
{
  MomentEstimator estimator;
  glm::dvec4 (*moments)(const CoveredDepths&); ///< as stored in the map
};

glm::dvec4 powers(const CoveredDepths& depths)
{
  glm::dvec4 result;
  for (int i = 0; i < 4; ++i)
  {
    result[i] = mean(depths, [i](double z) { return std::pow(z, i + 1); });
  }
  return result;
}

glm::dvec4 warpedPowers(const CoveredDepths& depths)
{
  const auto positive = [](double z) { return std::exp(exponentPositive * z); };
  const auto negative = [](double z) { return -std::exp(-exponentNegative * z); };
  return { mean(depths, positive), mean(depths, [&](double z) { return std::pow(positive(z), 2); }),
    mean(depths, negative), mean(depths, [&](double z) { return std::pow(negative(z), 2); }) };
}

glm::dvec4 warpedMean(const CoveredDepths& depths)
{
  const auto warped = [](double z) { return std::exp(exponentPositive * z); };
  return { mean(depths, warped), 0.0, 0.0, 0.0 };
}

using MomentMapsGlsl = GlslTest;

using MomentsGlsl = GlslTestOf<MomentsTwin>;

INSTANTIATE_TEST_SUITE_P(Techniques, MomentsGlsl,
  testing::Values(MomentsTwin{ singleExponential(), warpedMean }, MomentsTwin{ variance(), powers },
    MomentsTwin{ exponential(), warpedPowers }, MomentsTwin{ fourMoments(), powers }),
  [](const testing::TestParamInfo<MomentsTwin>& tested)
  { return tested.param.estimator.info.name; });

GlTexture layersTexture(const std::vector<glm::vec4>& texels, int size, int layers, GLint filter)
{
  GlTexture texture;
  fillTexture(texture, GL_RGBA, { size, size, layers }, texels.data());
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, filter);
  return texture;
}

ShadowLight sun(double bleeding, int kernelTexels = 1)
{
  ShadowLight light;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  light.momentMap.bleeding = bleeding;
  light.kernel.sizeTexels = kernelTexels;
  return light;
}

/// A receiver: its place on the map in texels, and its depth.
struct PlaneReceiver
{
  glm::dvec2 place;
  double depth;
};

/// Run the technique's shader at points of a map of a directional light, on planes across it.
/// @param map the moments of each texel
std::vector<float> estimate(const MomentsTwin& twin, const ShadowLight& light,
  const std::vector<glm::vec4>& map, const std::vector<PlaneReceiver>& receivers)
{
  const LightViews views = sunViews(light);
  const glm::dmat4 centredFromClip = glm::inverse(views.views.front().clipFromCentred());
  std::vector<glm::vec4> points;
  for (const PlaneReceiver& receiver : receivers)
  {
    points.emplace_back(centredFromClip *
      glm::dvec4(2.0 * receiver.place / double(mapSize) - 1.0, 2.0 * receiver.depth - 1.0, 1.0));
  }
  const GlTexture texture = layersTexture(map, mapSize, 1, GL_LINEAR);
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, {});
  uniforms.push_back({ "momentMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, texture.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(1e-6, 0.0) });
  ShaderLibrary library;
  return visibilityAt(MomentMapTechnique(twin.estimator), light, library, std::move(points),
    { 0.0f, 0.0f, 1.0f }, std::move(uniforms));
}

/// Run it at points of these depths, over a map with the same moments everywhere.
std::vector<float> estimate(const MomentsTwin& twin, double bleeding, const CoveredDepths& depths,
  const std::vector<double>& receiverDepths)
{
  std::vector<PlaneReceiver> receivers;
  for (const double depth : receiverDepths)
  {
    receivers.push_back({ glm::dvec2(20.3, 40.6), depth });
  }
  const std::vector<glm::vec4> map(
    static_cast<std::size_t>(mapSize * mapSize), glm::vec4(twin.moments(depths)));
  return estimate(twin, sun(bleeding), map, receivers);
}

TEST_P(MomentsGlsl, areExactForAPlaneThatAnotherOneShadows)
{
  for (int i = 0; i <= 20; ++i)
  {
    const double covered = i / 20.0;
    for (const double caster : { 0.05, 0.3, 0.5 })
    {
      const CoveredDepths depths = { { caster, covered }, { 0.8, 1.0 - covered } };
      const float visibility = estimate(this->GetParam(), 0.0, depths, { 0.8 })[0];
      EXPECT_NEAR(visibility, 1.0 - covered, 1e-3) << "caster at " << caster;
    }
  }
}

TEST_P(MomentsGlsl, areVisibilitiesForAllDepths)
{
  std::mt19937 random(7);
  const auto number = [&] { return random() / 4294967296.0; };
  std::vector<double> receivers;
  for (int i = 0; i <= 200; ++i)
  {
    receivers.push_back(i / 200.0);
  }
  receivers.insert(receivers.end(), { -1e6, -0.1, 1.0 + 1e-7, 1.1, 1e6 });
  for (int trial = 0; trial < 40; ++trial)
  {
    CoveredDepths depths;
    double sum = 0.0;
    for (int i = 0; i <= trial % 5; ++i)
    {
      // Also at the ends, and with two equal depths.
      const double depth = trial % 7 == 0 ? std::round(number()) : number();
      depths.push_back({ depth, number() + 1e-3 });
      sum += depths.back().share;
    }
    for (Covered& covered : depths)
    {
      covered.share /= sum;
    }
    const std::vector<float> answers = estimate(this->GetParam(), 0.0, depths, receivers);
    const std::vector<float> cut = estimate(this->GetParam(), 0.2, depths, receivers);
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      ASSERT_TRUE(answers[i] >= 0.0f && answers[i] <= 1.0f)
        << answers[i] << " at " << receivers[i] << ", trial " << trial;
      // Bound: at least the share of depths as far as the receiver or farther.
      double behind = 0.0;
      for (const Covered& covered : depths)
      {
        behind += covered.depth >= std::clamp(receivers[i], 0.0, 1.0) ? covered.share : 0.0;
      }
      ASSERT_GE(answers[i], behind - 2e-3) << "at " << receivers[i] << ", trial " << trial;
      ASSERT_TRUE(behind < 0.999999 || std::min(answers[i], cut[i]) >= 0.999f)
        << "before all casters at " << receivers[i] << ", trial " << trial;
    }
  }
}

TEST_P(MomentsGlsl, filterAsASquareAroundThePlaceDoes)
{
  // Half of the map is covered, and the map is blurred on the CPU. Bilinear filtering turns boxes
  // of even and of odd width into a square around the place.
  for (const int texels : { 1, 2, 3, 6 })
  {
    std::vector<glm::vec4> map;
    for (int y = 0; y < mapSize; ++y)
    {
      for (int x = 0; x < mapSize; ++x)
      {
        double covered = 0.0;
        for (int i = x - texels / 2; i < x - texels / 2 + texels; ++i)
        {
          covered += i >= mapSize / 2 ? 1.0 / texels : 0.0;
        }
        map.emplace_back(this->GetParam().moments({ { 0.3, covered }, { 0.8, 1.0 - covered } }));
      }
    }
    std::vector<PlaneReceiver> receivers;
    for (double x = 24.0; x < 40.0; x += 0.03)
    {
      receivers.push_back({ { x, 20.0 + x / 7.0 }, 0.8 });
    }
    const std::vector<float> answers = estimate(this->GetParam(), sun(0.0, texels), map, receivers);
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      const double edge = receivers[i].place.x + 0.5 * texels - mapSize / 2;
      ASSERT_NEAR(answers[i], 1.0 - std::clamp(edge / texels, 0.0, 1.0), 3e-3)
        << texels << " texels, at " << receivers[i].place.x;
    }
  }
}

TEST_P(MomentsGlsl, ofADepthAreTheMeansOverItsSpread)
{
  std::vector<glm::vec4> inputs;
  for (const double depth : { 0.0, 0.2, 0.5, 0.9, 1.0 })
  {
    for (const double spread : { 0.0, 1e-3, 0.01, 0.1, 1.0 })
    {
      inputs.emplace_back(centred(depth), spread, depth, 0.0);
    }
  }
  ShaderLibrary library;
  const auto answers = runCompute<glm::vec4>(library,
    computeGlsl(ShaderLibrary::source(this->GetParam().estimator.momentsFile), "vec4", "vec4",
      "result[i] = momentsOf(given[i].x, given[i].y);\n"),
    inputs);
  const std::string name = this->GetParam().estimator.info.name;
  const bool isExponential = name != "variance" && name != "moments";
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    for (int channel = 0; channel < 4; ++channel)
    {
      ASSERT_TRUE(std::isfinite(answers[i][channel]));
      ASSERT_LE(std::abs(answers[i][channel]), 1e37f) << "32 of them must not overflow";
    }
    // In the exponential's own units, the spread is linear.
    const double half = 0.5 * inputs[i].y;
    const glm::dvec4 flat = this->GetParam().moments({ { inputs[i].z, 1.0 } });
    glm::dvec4 expected =
      this->GetParam().moments({ { inputs[i].z - half, 0.5 }, { inputs[i].z + half, 0.5 } });
    const auto spreads = [&](double c) { return std::pow(std::min(c * inputs[i].y, 1.0), 2); };
    if (name == "single_exponential")
    {
      expected.x = flat.x * (1.0 + 0.5 * spreads(exponentPositive));
    }
    else if (isExponential)
    {
      expected = { flat.x, flat.y * (1.0 + spreads(exponentPositive)), flat.z,
        flat.w * (1.0 + spreads(exponentNegative)) };
    }
    for (int channel = 0; channel < this->GetParam().estimator.count; ++channel)
    {
      EXPECT_NEAR(answers[i][channel], expected[channel],
        1e-6 + 1e-4 * (isExponential ? std::abs(expected[channel]) : 0.0))
        << "moment " << channel << " of " << inputs[i].z << ", spread " << inputs[i].y;
    }
  }
}

TEST_P(MomentsGlsl, ofNoCasterAreThoseOfDepthOne)
{
  const glm::dvec4 expected = this->GetParam().moments({ { 1.0, 1.0 } });
  const glm::vec4 empty = this->GetParam().estimator.empty;
  for (int channel = 0; channel < this->GetParam().estimator.count; ++channel)
  {
    EXPECT_NEAR(empty[channel] / expected[channel], 1.0, 1e-6) << channel;
  }
  for (const float visibility :
    estimate(this->GetParam(), 0.2, { { 1.0, 1.0 } }, { 0.5, 1.0, 2.0 }))
  {
    EXPECT_NEAR(visibility, 1.0f, 1e-5); // four moments' bias
  }
}

TEST_P(MomentsGlsl, bleedThroughTwoCastersAsChebyshevSays)
{
  // Casters at depths 0 and 1, half covered each. A receiver at 1 + k should be dark.
  constexpr double unit = 0.3;
  std::vector<double> receivers;
  for (const double k : { 0.05, 0.1, 0.25, 0.5, 1.0, 2.0 })
  {
    receivers.push_back(0.05 + unit * (1.0 + k));
  }
  const CoveredDepths casters = { { 0.05, 0.5 }, { 0.05 + unit, 0.5 } };
  const std::vector<float> all = estimate(this->GetParam(), 0.0, casters, receivers);
  const std::vector<float> cut = estimate(this->GetParam(), 0.3, casters, receivers);
  const std::vector<double> expected = { 0.4525, 0.4098, 0.3077, 0.2, 0.1, 0.0385 };
  const std::vector<double> expectedCut = { 0.218, 0.157, 0.011, 0.0, 0.0, 0.0 };
  const std::string name = this->GetParam().estimator.info.name;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    if (name == "variance")
    {
      EXPECT_NEAR(all[i], expected[i], 0.01);
      EXPECT_NEAR(cut[i], expectedCut[i], 0.01);
    }
    else
    {
      EXPECT_LT(all[i], expected[i]);
      EXPECT_LE(cut[i], expectedCut[i]);
    }
    // Four moments can tell two depths and the receiver's apart.
    EXPECT_TRUE(name != "moments" || all[i] <= 0.01f);
  }
}

/// A map of several layers, surrounded by `empty`.
struct LayeredMap
{
  int size;
  int count;
  std::vector<glm::vec4> texels;
  inline static const glm::vec4 empty{ 1.0f, 0.5f, -1.0f, 0.25f };

  /// Return random values between -largest and largest.
  static LayeredMap random(int size, int count, const glm::vec4& largest = glm::vec4(1.0f))
  {
    std::mt19937 random(11);
    LayeredMap layers{ size, count, std::vector<glm::vec4>(std::size_t(size * size * count)) };
    for (glm::vec4& texel : layers.texels)
    {
      for (int channel = 0; channel < 4; ++channel)
      {
        texel[channel] = largest[channel] * static_cast<float>(random() / 2147483648.0 - 1.0);
      }
    }
    return layers;
  }

  /// Return the mean over a rectangle, by all of its texels.
  glm::dvec4 mean(const glm::dvec2& lower, const glm::dvec2& upper, int layer) const
  {
    const auto covered = [](double from, double to, int texel)
    { return std::max(std::min(to, texel + 1.0) - std::max(from, double(texel)), 0.0); };
    glm::dvec4 sum(0.0);
    for (int y = int(std::floor(lower.y)); y < upper.y; ++y)
    {
      for (int x = int(std::floor(lower.x)); x < upper.x; ++x)
      {
        const bool inside = x >= 0 && y >= 0 && x < this->size && y < this->size;
        const auto index = static_cast<std::size_t>((layer * this->size + y) * this->size + x);
        sum += covered(lower.x, upper.x, x) * covered(lower.y, upper.y, y) *
          glm::dvec4(inside ? this->texels[index] : empty);
      }
    }
    return sum / ((upper.x - lower.x) * (upper.y - lower.y));
  }
};

/// Return the largest difference of any channel, in units.
double differenceOf(const glm::vec4& answer, const glm::dvec4& expected, const glm::dvec4& units)
{
  const glm::dvec4 off = glm::abs(glm::dvec4(answer) - expected) / units;
  return std::max(std::max(off.x, off.y), std::max(off.z, off.w));
}

TEST_F(MomentMapsGlsl, boxBlurIsTheMeanOverTheBox)
{
  constexpr int layers = 3;
  for (const int size : { 16, 67 })
  {
    const LayeredMap map = LayeredMap::random(size, layers);
    for (const int width : { 2, 3, 8, 31, 32 })
    {
      const GlTexture texture = layersTexture(map.texels, size, layers, GL_NEAREST);
      ShaderLibrary library;
      BoxBlur blur;
      blur.allocate({ GL_RGBA32F, GL_RGBA, 4 }, size);
      blur.apply(texture.name(), layers, width, LayeredMap::empty, library);
      glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
      std::vector<glm::vec4> blurred(map.texels.size());
      glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
      glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_FLOAT, blurred.data());

      double worst = 0.0;
      std::mt19937 random(3);
      for (int trial = 0; trial < 2000; ++trial)
      {
        const auto below = [&](int end) { return static_cast<int>(random() % unsigned(end)); };
        // The layer's corners, too.
        const glm::ivec3 at(
          trial % 4 ? below(size) : below(3), trial % 3 ? below(size) : size - 1, below(layers));
        const glm::dvec2 lower = glm::dvec2(at) - double(width / 2);
        worst = std::max(worst,
          differenceOf(blurred[static_cast<std::size_t>((at.z * size + at.y) * size + at.x)],
            map.mean(lower, lower + double(width), at.z), glm::dvec4(1.0)));
      }
      EXPECT_LE(worst, 1e-6) << "size " << size << ", width " << width;
    }
  }
}

/// Compare a summed-area table with sums over all texels, in rectangles around random places.
/// @param lower,upper bounds of the places' coordinates, which are sixteenths of texels
/// @param units of differences; 0: relative to the expected values
/// @return the largest difference
double worstOfTable(const SummedAreaTable& table, const LayeredMap& map, int layer,
  const glm::dvec2& sides, int count, double lower, double upper, const glm::dvec4& units)
{
  std::mt19937 random(5);
  const auto coordinate = [&]
  { return std::round(16.0 * (lower + (upper - lower) * (random() / 4294967296.0))) / 16.0; };
  std::vector<glm::vec4> rectangles; // lower corners and upper ones
  for (int i = 0; i < count; ++i)
  {
    const double x = coordinate();
    const glm::dvec2 place(x, coordinate());
    rectangles.emplace_back(place - 0.5 * sides, place + 0.5 * sides);
  }
  ShaderLibrary library;
  const auto answers = runCompute<glm::vec4>(library,
    computeGlsl(ShaderLibrary::source("shadowtech/moment_map/summed_area.glsl"), "vec4", "vec4",
      "result[i] = meanOver_LIGHT(given[i].xy, given[i].zw, " + std::to_string(layer) + ");\n"),
    rectangles, table.uniforms(LayeredMap::empty));
  double worst = 0.0;
  for (std::size_t i = 0; i < rectangles.size(); ++i)
  {
    const glm::dvec4 rectangle(rectangles[i]);
    const glm::dvec4 expected =
      map.mean({ rectangle.x, rectangle.y }, { rectangle.z, rectangle.w }, layer);
    worst = std::max(worst, differenceOf(answers[i], expected, units.x > 0.0 ? units : expected));
  }
  return worst;
}

void sumUp(SummedAreaTable& table, const LayeredMap& map, const glm::vec4& largest, double widest)
{
  const GlTexture texture = layersTexture(map.texels, map.size, map.count, GL_NEAREST);
  ShaderLibrary library;
  table.allocate(4, map.size, map.count);
  table.setUnits(largest, widest);
  for (int layer = 0; layer < map.count; ++layer)
  {
    table.sum(texture.name(), layer, layer, library);
  }
}

/// Any place and any sides, also beyond the layer.
TEST_F(MomentMapsGlsl, summedAreaTableIsTheMeanOverARectangle)
{
  const glm::vec4 largest(1.0f, 2.0f, 4.0f, 8.0f);
  for (const int size : { 16, 67, 256 })
  {
    const LayeredMap map = LayeredMap::random(size, 3, largest);
    SummedAreaTable table;
    sumUp(table, map, largest, 40.0);
    for (const glm::dvec2& sides :
      { glm::dvec2(1.0), { 3.0, 3.0 }, { 1.5, 9.25 }, { 32.0, 32.0 }, { 40.0, 8.0 } })
    {
      for (int layer = 0; layer < map.count; ++layer)
      {
        EXPECT_LE(worstOfTable(table, map, layer, sides, 300, -3.0, size + 3.0, largest), 2e-6)
          << "size " << size << ", sides " << sides.x << " " << sides.y;
      }
    }
  }
}

/// Sums over a map of 1024, of which floats would lose a thousandth. Tested with a plane, whose
/// texels are all rounded the same way, and with a noisy slope.
TEST_F(MomentMapsGlsl, summedAreaTableOfALargeMapLosesNoDigits)
{
  constexpr int size = 1024;
  std::mt19937 random(9);
  LayeredMap map{ size, 1, {} };
  for (int i = 0; i < size * size; ++i)
  {
    const double slope = 0.6 + 0.2 * (i % size + 2.0 * (i / size)) / size;
    const double depth = 0.1 * (random() / 4294967296.0) + 0.5;
    map.texels.emplace_back(0.8123457, 0.65990554, slope * depth, 0.7);
  }
  for (const int width : { 1, 3, 9, 32, 128 })
  {
    SummedAreaTable table;
    sumUp(table, map, { 1.0f, 2.0f, 4.0f, 8.0f }, width);
    // Row 23 of the literature's table requires 1e-4.
    EXPECT_LE(
      worstOfTable(table, map, 0, glm::dvec2(width), 200, width, size - width, glm::dvec4(0.0)),
      1e-6)
      << "width " << width;
  }
}

} // namespace
} // namespace gnomon::test
