// The estimators over moments and the blur against twins in double precision.

#include "shadowtech/base/Gl.h"
#include "shadowtech/base/Kernel.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/moment_map/BoxBlur.h"
#include "shadowtech/moment_map/Exponential.h"
#include "shadowtech/moment_map/FourMoments.h"
#include "shadowtech/moment_map/MomentMapTechnique.h"
#include "shadowtech/moment_map/SingleExponential.h"
#include "shadowtech/moment_map/SummedAreaTable.h"
#include "shadowtech/moment_map/Variance.h"

#include "SyntheticScene.h"
#include "vtkGnomonEGLRenderWindow.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

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

constexpr int mapSize = 64;

/// Depths in [0, 1] and how much of a kernel each of them covers.
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

/// The mean of a function of the centred depths.
double mean(const CoveredDepths& depths, const std::function<double(double)>& function)
{
  double sum = 0.0;
  for (const Covered& covered : depths)
  {
    sum += covered.share * function(centred(covered.depth));
  }
  return sum;
}

/// Variance, Exponential or FourMoments, with what they keep to themselves.
template <typename Technique>
struct Open : Technique
{
  using Technique::moments;
};

/// A technique over moments, and its twin.
struct MomentsTwin
{
  const char* name;
  std::unique_ptr<PointwiseTechnique> (*create)();
  std::string (*momentsGlsl)();
  glm::vec4 (*empty)();
  glm::dvec4 (*moments)(const CoveredDepths&); ///< as the map has them
};

template <typename T>
MomentsTwin twin(const char* name, glm::dvec4 (*moments)(const CoveredDepths&))
{
  return { name, [] { return std::unique_ptr<PointwiseTechnique>(new T); },
    [] { return Open<T>().moments().glsl; }, [] { return Open<T>().moments().empty; }, moments };
}

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
  const auto positive = [](double z) { return std::exp(Exponential::exponentPositive * z); };
  const auto negative = [](double z) { return -std::exp(-Exponential::exponentNegative * z); };
  return { mean(depths, positive), mean(depths, [&](double z) { return std::pow(positive(z), 2); }),
    mean(depths, negative), mean(depths, [&](double z) { return std::pow(negative(z), 2); }) };
}

glm::dvec4 singleExponential(const CoveredDepths& depths)
{
  const auto warped = [](double z) { return std::exp(SingleExponential::exponent * z); };
  return { mean(depths, warped), 0.0, 0.0, 0.0 };
}

class OnGpu : public testing::Test
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
  }
  vtkNew<vtkGnomonEGLRenderWindow> window_;
};

class MomentsGlsl
  : public OnGpu
  , public testing::WithParamInterface<MomentsTwin>
{
};

INSTANTIATE_TEST_SUITE_P(Techniques, MomentsGlsl,
  testing::Values(twin<SingleExponential>("single_exponential", singleExponential),
    twin<Variance>("variance", powers), twin<Exponential>("exponential", warpedPowers),
    twin<FourMoments>("moments", powers)),
  [](const testing::TestParamInfo<MomentsTwin>& tested) { return std::string(tested.param.name); });

/// What a compute shader with `main` makes of each vec4.
std::vector<glm::vec4> compute(const std::string& source, std::vector<glm::vec4> inputs,
  const std::vector<Uniform>& uniforms = {})
{
  const std::size_t count = inputs.size();
  inputs.resize((count + 63) / 64 * 64);
  ShaderLibrary library;
  const GLuint program = library.program({ { GL_COMPUTE_SHADER,
    numberedForLight(source, 0) +
      "layout(local_size_x = 64) in;\n"
      "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };\n"
      "void main()\n{\n  uint i = gl_GlobalInvocationID.x;\n  outputs[i] = "
      "answer(inputs[i]);\n}\n" } });
  GlBuffer buffers[2];
  const auto bytes = static_cast<GLsizeiptr>(inputs.size() * sizeof(glm::vec4));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0].create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, inputs.data(), GL_STATIC_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1].create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  glDispatchCompute(static_cast<GLuint>(inputs.size() / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, inputs.data());
  glUseProgram(0);
  inputs.resize(count);
  return inputs;
}

ShadowLight sun(double bleeding, int kernelTexels = 1)
{
  ShadowLight light;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  light.of<MomentMapSettings>().bleeding = bleeding;
  light.of<KernelSettings>().sizeTexels = kernelTexels;
  return light;
}

/// A receiver: where it is on the map in texels, and its depth.
struct PlaneReceiver
{
  glm::dvec2 place;
  double depth;
};

/// What the technique's shader answers at points of a map of a directional light, on planes across
/// it.
/// @param map the moments of each texel
std::vector<float> estimate(const MomentsTwin& twin, const ShadowLight& light,
  const std::vector<glm::vec4>& map, const std::vector<PlaneReceiver>& receivers)
{
  const LightViews views =
    fitLightViews(light, glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, mapSize);
  const glm::dmat4 centredFromClip = glm::inverse(views.views.front().clipFromCentred());
  std::vector<glm::vec4> points;
  for (const PlaneReceiver& receiver : receivers)
  {
    points.emplace_back(centredFromClip *
      glm::dvec4(2.0 * receiver.place / double(mapSize) - 1.0, 2.0 * receiver.depth - 1.0, 1.0));
  }
  GlTexture texture;
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.create());
  glTexImage3D(
    GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32F, mapSize, mapSize, 1, 0, GL_RGBA, GL_FLOAT, map.data());
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, {});
  uniforms.push_back({ "momentMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, texture.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(1e-6, 0.0) });
  const std::vector<glm::vec4> answers = compute(twin.create()->visibilityGlsl(light) +
      "vec4 answer(vec4 point) { return vec4(visibility_LIGHT(point.xyz, vec3(0.0, 0.0, 1.0))); "
      "}\n",
    points, uniforms);
  std::vector<float> visibilities;
  for (const glm::vec4& answer : answers)
  {
    visibilities.push_back(answer.x);
  }
  return visibilities;
}

/// At points of these depths, over a map that holds the same moments everywhere.
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

/// How many moments a technique has.
int countOf(const MomentsTwin& twin)
{
  const std::string name = twin.name;
  return name == "single_exponential" ? 1 : name == "variance" ? 2 : 4;
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

TEST_P(MomentsGlsl, lightAllThatLiesBeforeTheCasters)
{
  const CoveredDepths depths = { { 0.4, 0.5 }, { 0.7, 0.5 } };
  for (const float visibility :
    estimate(this->GetParam(), 0.2, depths, { 0.0, 0.1, 0.2, 0.3, 0.39, 0.4 }))
  {
    EXPECT_GE(visibility, 0.999f);
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
      // Also at the ends, and two of the same.
      const double depth = trial % 7 == 0 ? std::round(number()) : number();
      depths.push_back({ depth, number() + 1e-3 });
      sum += depths.back().share;
    }
    for (Covered& covered : depths)
    {
      covered.share /= sum;
    }
    const std::vector<float> answers = estimate(this->GetParam(), 0.0, depths, receivers);
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      ASSERT_TRUE(answers[i] >= 0.0f && answers[i] <= 1.0f)
        << answers[i] << " at " << receivers[i] << ", trial " << trial;
      // The bound: no less than what lies as far as the receiver.
      double behind = 0.0;
      for (const Covered& covered : depths)
      {
        behind += covered.depth >= std::clamp(receivers[i], 0.0, 1.0) ? covered.share : 0.0;
      }
      ASSERT_GE(answers[i], behind - 2e-3) << "at " << receivers[i] << ", trial " << trial;
    }
  }
}

TEST_P(MomentsGlsl, filterAsASquareAroundThePlaceDoes)
{
  // Half of the map is covered. The map is blurred on the CPU; bilinear filtering makes of boxes of
  // even and of odd width a square around the place.
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
  const std::vector<glm::vec4> answers = compute(this->GetParam().momentsGlsl() +
      "vec4 answer(vec4 depth) { return momentsOf(depth.x, depth.y); }\n",
    inputs);
  const std::string name = this->GetParam().name;
  const bool exponential = name != "variance" && name != "moments";
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    for (int channel = 0; channel < 4; ++channel)
    {
      ASSERT_TRUE(std::isfinite(answers[i][channel]));
      ASSERT_LE(std::abs(answers[i][channel]), 1e37f) << "32 of them must not overflow";
    }
    // In the exponential's own terms: the spread is linear there.
    const double half = 0.5 * inputs[i].y;
    const glm::dvec4 flat = this->GetParam().moments({ { inputs[i].z, 1.0 } });
    glm::dvec4 expected =
      this->GetParam().moments({ { inputs[i].z - half, 0.5 }, { inputs[i].z + half, 0.5 } });
    const auto spreads = [&](double c) { return std::pow(std::min(c * inputs[i].y, 1.0), 2); };
    if (name == "single_exponential")
    {
      expected.x = flat.x * (1.0 + 0.5 * spreads(SingleExponential::exponent));
    }
    else if (exponential)
    {
      expected = { flat.x, flat.y * (1.0 + spreads(Exponential::exponentPositive)), flat.z,
        flat.w * (1.0 + spreads(Exponential::exponentNegative)) };
    }
    for (int channel = 0; channel < countOf(this->GetParam()); ++channel)
    {
      EXPECT_NEAR(answers[i][channel], expected[channel],
        1e-6 + 1e-4 * (exponential ? std::abs(expected[channel]) : 0.0))
        << "moment " << channel << " of " << inputs[i].z << ", spread " << inputs[i].y;
    }
  }
}

TEST_P(MomentsGlsl, ofNoCasterAreThoseOfDepthOne)
{
  const glm::dvec4 expected = this->GetParam().moments({ { 1.0, 1.0 } });
  const glm::vec4 empty = this->GetParam().empty();
  for (int channel = 0; channel < countOf(this->GetParam()); ++channel)
  {
    EXPECT_NEAR(empty[channel] / expected[channel], 1.0, 1e-6) << channel;
  }
  for (const float visibility :
    estimate(this->GetParam(), 0.2, { { 1.0, 1.0 } }, { 0.5, 1.0, 2.0 }))
  {
    EXPECT_NEAR(visibility, 1.0f, 1e-5); // four moments' bias
  }
}

/// How much light bleeds through casters at depths 0 and 1, half covered each, to a receiver at 1 +
/// k, of which nothing should be lit.
std::vector<float> bleedThrough(const MomentsTwin& twin, double bleeding)
{
  constexpr double unit = 0.3;
  std::vector<double> receivers;
  for (const double k : { 0.05, 0.1, 0.25, 0.5, 1.0, 2.0 })
  {
    receivers.push_back(0.05 + unit * (1.0 + k));
  }
  return estimate(twin, bleeding, { { 0.05, 0.5 }, { 0.05 + unit, 0.5 } }, receivers);
}

TEST_P(MomentsGlsl, bleedThroughTwoCastersAsChebyshevSays)
{
  const bool variance = std::string(this->GetParam().name) == "variance";
  const std::vector<float> all = bleedThrough(this->GetParam(), 0.0);
  const std::vector<float> cut = bleedThrough(this->GetParam(), 0.3);
  const std::vector<double> expected = { 0.4525, 0.4098, 0.3077, 0.2, 0.1, 0.0385 };
  const std::vector<double> expectedCut = { 0.218, 0.157, 0.011, 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    if (variance)
    {
      EXPECT_NEAR(all[i], expected[i], 0.01);
      EXPECT_NEAR(cut[i], expectedCut[i], 0.01);
    }
    else
    {
      EXPECT_LT(all[i], expected[i]);
      EXPECT_LE(cut[i], expectedCut[i]);
    }
    this->RecordProperty("bleed" + std::to_string(i), std::to_string(all[i]));
  }
  if (std::string(this->GetParam().name) == "moments")
  {
    EXPECT_LE(*std::max_element(all.begin(), all.end()), 0.01f); // two depths and the receiver's
  }
}

/// Three layers of random moments; values between -1 and 1.
std::vector<glm::vec4> randomMap(int size, int layers)
{
  std::mt19937 random(11);
  std::vector<glm::vec4> map(static_cast<std::size_t>(size * size * layers));
  for (glm::vec4& texel : map)
  {
    for (int channel = 0; channel < 4; ++channel)
    {
      texel[channel] = static_cast<float>(random() / 2147483648.0 - 1.0);
    }
  }
  return map;
}

TEST_F(OnGpu, boxBlurIsTheMeanOverTheBox)
{
  constexpr int layers = 3;
  const glm::vec4 empty(1.0f, 0.5f, -1.0f, 0.25f);
  for (const int size : { 16, 67 })
  {
    const std::vector<glm::vec4> map = randomMap(size, layers);
    for (const int width : { 2, 3, 8, 31, 32 })
    {
      GlTexture texture;
      glBindTexture(GL_TEXTURE_2D_ARRAY, texture.create());
      glTexImage3D(
        GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32F, size, size, layers, 0, GL_RGBA, GL_FLOAT, map.data());
      glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      ShaderLibrary library;
      BoxBlur blur;
      blur.allocate({ GL_RGBA32F, GL_RGBA, 4 }, size);
      blur.apply(texture.name(), layers, width, empty, library);
      glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
      std::vector<glm::vec4> blurred(map.size());
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
        glm::dvec4 sum(0.0);
        for (int y = at.y - width / 2; y < at.y - width / 2 + width; ++y)
        {
          for (int x = at.x - width / 2; x < at.x - width / 2 + width; ++x)
          {
            const bool inside = x >= 0 && y >= 0 && x < size && y < size;
            const auto index = static_cast<std::size_t>((at.z * size + y) * size + x);
            sum += glm::dvec4(inside ? map[index] : empty);
          }
        }
        const glm::vec4 answer =
          blurred[static_cast<std::size_t>((at.z * size + at.y) * size + at.x)];
        for (int channel = 0; channel < 4; ++channel)
        {
          worst = std::max(worst, std::abs(answer[channel] - sum[channel] / (width * width)));
        }
      }
      EXPECT_LE(worst, 1e-6) << "size " << size << ", width " << width;
    }
  }
}

/// A map and its summed-area table.
struct Summed
{
  Summed(int sizeTexels, int layerCount, std::vector<glm::vec4> texels, const glm::vec4& largest,
    double widestTexels, int channels = 4)
    : size(sizeTexels)
    , map(std::move(texels))
  {
    GlTexture texture;
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.create());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA32F, size, size, layerCount, 0, GL_RGBA, GL_FLOAT,
      this->map.data());
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    ShaderLibrary library;
    this->table.allocate(channels, size, layerCount);
    this->table.setUnits(largest, widestTexels);
    for (int layer = 0; layer < layerCount; ++layer)
    {
      this->table.sum(texture.name(), layer, layer, library);
    }
  }

  const glm::vec4& at(int x, int y, int layer) const
  {
    const bool inside = x >= 0 && y >= 0 && x < size && y < size;
    return inside ? this->map[static_cast<std::size_t>((layer * size + y) * size + x)] : empty;
  }

  /// The mean over a rectangle, by all of its texels.
  glm::dvec4 mean(const glm::dvec2& lower, const glm::dvec2& upper, int layer) const
  {
    const auto covered = [](double from, double to, int texel)
    { return std::max(std::min(to, texel + 1.0) - std::max(from, double(texel)), 0.0); };
    glm::dvec4 sum(0.0);
    for (int y = int(std::floor(lower.y)); y < upper.y; ++y)
    {
      for (int x = int(std::floor(lower.x)); x < upper.x; ++x)
      {
        sum += covered(lower.x, upper.x, x) * covered(lower.y, upper.y, y) *
          glm::dvec4(this->at(x, y, layer));
      }
    }
    return sum / ((upper.x - lower.x) * (upper.y - lower.y));
  }

  /// By the table, around each place (x, y), over a rectangle of these sides.
  std::vector<glm::vec4> means(
    const std::vector<glm::vec4>& places, const glm::vec2& sides, int layer) const
  {
    const std::string half =
      "vec2(" + std::to_string(0.5f * sides.x) + ", " + std::to_string(0.5f * sides.y) + ")";
    return compute(ShaderLibrary::source("shadowtech/moment_map/summed_area.glsl") +
        "vec4 answer(vec4 place) { return meanOver_LIGHT(place.xy - " + half + ", place.xy + " +
        half + ", " + std::to_string(layer) + "); }\n",
      places, this->table.uniforms(empty));
  }

  inline static const glm::vec4 empty{ 1.0f, 0.5f, -1.0f, 0.25f };
  int size;
  std::vector<glm::vec4> map;
  SummedAreaTable table;
};

/// At sixteenths of texels, between two coordinates.
std::vector<glm::vec4> randomPlacesBetween(int count, double lower, double upper)
{
  std::mt19937 random(5);
  const auto coordinate = [&]
  { return std::round(16.0 * (lower + (upper - lower) * (random() / 4294967296.0))) / 16.0; };
  std::vector<glm::vec4> places;
  for (int i = 0; i < count; ++i)
  {
    const double x = coordinate();
    places.emplace_back(x, coordinate(), 0.0, 0.0);
  }
  return places;
}

/// Of any place and any sides, also beyond the layer.
TEST_F(OnGpu, summedAreaTableIsTheMeanOverARectangle)
{
  constexpr int layers = 3;
  const glm::vec4 largest(1.0f, 2.0f, 4.0f, 8.0f);
  for (const int size : { 16, 67, 256 })
  {
    std::vector<glm::vec4> map = randomMap(size, layers);
    for (glm::vec4& texel : map)
    {
      texel *= largest;
    }
    const Summed summed(size, layers, map, largest, 40.0);
    for (const glm::vec2& sides :
      { glm::vec2(1.0f), { 3.0f, 3.0f }, { 1.5f, 9.25f }, { 32.0f, 32.0f }, { 40.0f, 8.0f } })
    {
      const std::vector<glm::vec4> places = randomPlacesBetween(300, -3.0, size + 3.0);
      for (int layer = 0; layer < layers; ++layer)
      {
        const std::vector<glm::vec4> answers = summed.means(places, sides, layer);
        double worst = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
          const glm::dvec2 place(places[i]);
          const glm::dvec2 half = 0.5 * glm::dvec2(sides);
          const glm::dvec4 expected = summed.mean(place - half, place + half, layer);
          for (int channel = 0; channel < 4; ++channel)
          {
            worst = std::max(
              worst, std::abs(answers[i][channel] - expected[channel]) / double(largest[channel]));
          }
        }
        EXPECT_LE(worst, 2e-6) << "size " << size << ", sides " << sides.x << " " << sides.y;
      }
    }
  }
}

/// Sums over a map of 1024, of which floats would lose a thousandth: a plane, whose texels are all
/// rounded the same way, and a noisy slope.
TEST_F(OnGpu, summedAreaTableOfALargeMapLosesNoDigits)
{
  constexpr int size = 1024;
  std::mt19937 random(9);
  std::vector<glm::vec4> map;
  for (int i = 0; i < size * size; ++i)
  {
    const double slope = 0.6 + 0.2 * (i % size + 2.0 * (i / size)) / size;
    const double depth = 0.1 * (random() / 4294967296.0) + 0.5;
    map.emplace_back(0.8123457, 0.65990554, slope * depth, 0.7);
  }
  for (const int width : { 1, 3, 9, 32, 128 })
  {
    const glm::vec4 largest(1.0f, 2.0f, 4.0f, 8.0f);
    const Summed summed(size, 1, map, largest, width);
    const std::vector<glm::vec4> places = randomPlacesBetween(200, width, size - width);
    const std::vector<glm::vec4> answers = summed.means(places, glm::vec2(float(width)), 0);
    double worst = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const glm::dvec2 place(places[i]);
      const glm::dvec4 expected = summed.mean(place - 0.5 * width, place + 0.5 * width, 0);
      for (int channel = 0; channel < 4; ++channel)
      {
        worst =
          std::max(worst, std::abs(answers[i][channel] - expected[channel]) / expected[channel]);
      }
    }
    // Row 23 of the literature's table asks for 1e-4.
    EXPECT_LE(worst, 1e-6) << "width " << width;
    this->RecordProperty("worst" + std::to_string(width), std::to_string(worst * 1e9) + "e-9");
  }
}

} // namespace
} // namespace gnomon::test
