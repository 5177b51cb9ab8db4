// pcf_estimator.glsl against a twin: which texels each kernel reads, with which weights.

#include "lights/ShadowSettings.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/pcf/Pcf.h"
#include "shadowtech/pcf/PoissonDisc.h"

#include "SyntheticScene.h"
#include "vtkGnomonEGLRenderWindow.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

namespace gnomon::test
{
namespace
{

constexpr int mapSize = 64;

/// Whether a texel holds a caster that hides the points below.
using Map = std::function<bool(const glm::ivec2&)>;

/// What the shader answers at places of a map of a directional light, on a plane across it.
std::vector<float> runGlsl(
  const ShadowLight& light, const Map& map, const std::vector<glm::dvec2>& places)
{
  const LightViews views =
    fitLightViews(light, glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, mapSize);
  const LightView& view = views.views.front();
  const glm::dmat4 centredFromClip = glm::inverse(view.clipFromCentred());
  std::vector<glm::vec4> points;
  for (const glm::dvec2& place : places)
  {
    points.emplace_back(
      centredFromClip * glm::dvec4(2.0 * place / double(mapSize) - 1.0, 0.5, 1.0));
  }
  points.resize((points.size() + 63) / 64 * 64);
  std::vector<float> depths;
  for (int y = 0; y < mapSize; ++y)
  {
    for (int x = 0; x < mapSize; ++x)
    {
      depths.push_back(map({ x, y }) ? 0.25f : 1.0f);
    }
  }

  ShaderLibrary library;
  const std::string source = numberedForLight(Pcf().visibilityGlsl(light) + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { float outputs[]; };
uniform vec3 normal;
void main()
{
  uint i = gl_GlobalInvocationID.x;
  outputs[i] = visibility_LIGHT(inputs[i].xyz, normal);
}
)",
    0);
  const GLuint program = library.program({ { GL_COMPUTE_SHADER, source } });
  GlTexture texture;
  glBindTexture(GL_TEXTURE_2D_ARRAY, texture.create());
  glTexImage3D(
    GL_TEXTURE_2D_ARRAY, 0, GL_R32F, mapSize, mapSize, 1, 0, GL_RED, GL_FLOAT, depths.data());
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  GlBuffer buffers[2];
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0].create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec4)),
    points.data(), GL_STATIC_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1].create());
  std::vector<float> outputs(points.size());
  const auto bytes = static_cast<GLsizeiptr>(outputs.size() * sizeof(float));
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
  glUseProgram(program);
  std::vector<Uniform> uniforms = lightViewsUniforms(views, mapSize, glm::dmat4(1.0));
  uniforms.push_back({ "depthMap_LIGHT", TextureBinding{ GL_TEXTURE_2D_ARRAY, texture.name() } });
  uniforms.push_back({ "depthSlacks_LIGHT", glm::vec2(1e-6, 0.0) });
  uniforms.push_back({ "normal", glm::vec3(-light.directionWorld) });
  ShaderLibrary::setUniforms(program, uniforms, 0, 0);
  glDispatchCompute(static_cast<GLuint>(points.size() / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, outputs.data());
  glUseProgram(0);
  outputs.resize(places.size());
  return outputs;
}

ShadowLight filteredSun(const char* kernel, int texels)
{
  ShadowLight light;
  light.directionWorld = { 0.0, 0.0, -1.0 };
  findSetting("kernel")->set(light, kernel);
  light.kernelTexels = texels;
  return light;
}

/// Places whose kernels stay inside the map. Exact in float, so that both sides round alike.
std::vector<glm::dvec2> randomPlaces(int texels)
{
  std::mt19937 random(5);
  const double margin = 0.5 * texels + 2.0;
  std::vector<glm::dvec2> places;
  for (int i = 0; i < 2000; ++i)
  {
    const auto coordinate = [&]
    { return margin + (mapSize - 2.0 * margin) * (random() / 4294967296.0); };
    const double x = coordinate();
    places.emplace_back(x, coordinate());
  }
  return places;
}

/// A map of which about half is covered, in texels that have nothing to do with their neighbours.
bool scattered(const glm::ivec2& texel)
{
  const auto bits = static_cast<unsigned>(texel.x * 73 + texel.y * 1009);
  return (bits * 2654435761u) >> 31u != 0u;
}

/// The part of a texel that a square of side `width` around a place covers.
double covered(const glm::ivec2& texel, const glm::dvec2& place, double width)
{
  const glm::dvec2 lower = glm::max(glm::dvec2(texel), place - 0.5 * width);
  const glm::dvec2 upper = glm::min(glm::dvec2(texel) + 1.0, place + 0.5 * width);
  const glm::dvec2 size = glm::max(upper - lower, 0.0);
  return size.x * size.y;
}

/// The lit share of a map around a place, with a weight per texel.
template <typename Weight>
double litShare(const Map& map, const Weight& weight)
{
  double lit = 0.0;
  double all = 0.0;
  for (int y = 0; y < mapSize; ++y)
  {
    for (int x = 0; x < mapSize; ++x)
    {
      const double share = weight(glm::ivec2(x, y));
      lit += map({ x, y }) ? 0.0 : share;
      all += share;
    }
  }
  return lit / all;
}

class PcfGlsl : public testing::Test
{
protected:
  void SetUp() override
  {
    this->window_->Initialize();
    this->window_->MakeCurrent();
  }
  vtkNew<vtkGnomonEGLRenderWindow> window_;
};

TEST_F(PcfGlsl, bilinearWeighsTexelsByHowFarASquareCoversThem)
{
  // Size 1 is the bilinear filter of four comparisons.
  for (const int texels : { 1, 2, 3, 4, 7 })
  {
    const std::vector<glm::dvec2> places = randomPlaces(texels);
    const std::vector<float> values = runGlsl(filteredSun("bilinear", texels), scattered, places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double expected = litShare(
        scattered, [&](const glm::ivec2& texel) { return covered(texel, places[i], texels); });
      ASSERT_NEAR(values[i], expected, 1e-4) << texels << " texels, place " << i;
    }
  }
}

TEST_F(PcfGlsl, boxCountsTheNearestTexels)
{
  for (const int texels : { 1, 2, 3, 5, 8 })
  {
    const std::vector<glm::dvec2> places = randomPlaces(texels);
    const std::vector<float> values = runGlsl(filteredSun("box", texels), scattered, places);
    std::size_t different = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double half = 0.5 * texels;
      const double expected = litShare(scattered,
        [&](const glm::ivec2& texel)
        {
          const glm::dvec2 away = glm::abs(glm::dvec2(texel) + 0.5 - places[i]);
          return away.x <= half && away.y <= half ? 1.0 : 0.0;
        });
      different += std::abs(values[i] - expected) < 1e-6 ? 0 : 1;
    }
    // Of places within rounding of a texel's border, the twin may take the other texel.
    EXPECT_LE(different, 2u) << texels << " texels";
  }
}

/// The twin of noise_LIGHT.
double noise(const glm::ivec2& cell)
{
  auto bits = static_cast<unsigned>(cell.x) + 65536u * static_cast<unsigned>(cell.y);
  bits = (bits ^ (bits >> 16u)) * 0x7feb352du;
  bits = (bits ^ (bits >> 15u)) * 0x846ca68bu;
  bits ^= bits >> 16u;
  return (bits >> 8u) / 16777216.0;
}

TEST_F(PcfGlsl, poissonReadsATurnedDisc)
{
  for (const int texels : { 1, 4, 9 })
  {
    const std::vector<glm::dvec2> places = randomPlaces(texels);
    const std::vector<float> values = runGlsl(filteredSun("poisson", texels), scattered, places);
    std::size_t different = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double angle = glm::radians(360.0 * noise(glm::ivec2(4.0 * places[i])));
      const glm::dvec2 axis = 0.5 * texels * glm::dvec2(std::cos(angle), std::sin(angle));
      double lit = 0.0;
      for (const glm::dvec2& point : poissonDisc())
      {
        const glm::dvec2 at = places[i] + point.x * axis + point.y * glm::dvec2(-axis.y, axis.x);
        lit += scattered(glm::ivec2(glm::floor(at))) ? 0.0 : 1.0 / poissonPoints;
      }
      different += std::abs(values[i] - lit) < 1e-6 ? 0 : 1;
    }
    EXPECT_LE(different, places.size() / 100) << texels << " texels"; // rounding at texels' borders
  }
}

TEST_F(PcfGlsl, anEdgeHasAsManyLevelsAsTheKernelAllows)
{
  const Map halfPlane = [](const glm::ivec2& texel) { return texel.x >= mapSize / 2; };
  const auto levels = [&](const char* kernel, int texels)
  {
    const std::vector<float> values =
      runGlsl(filteredSun(kernel, texels), halfPlane, randomPlaces(texels));
    return std::set<float>(values.begin(), values.end()).size();
  };
  for (const int texels : { 1, 3, 5, 11 })
  {
    EXPECT_EQ(levels("box", texels), static_cast<std::size_t>(texels) + 1);
  }
  EXPECT_GT(levels("bilinear", 3), 10 * levels("box", 3));
}

TEST_F(PcfGlsl, theMapsEndIsReadAgainWhereAKernelIsWider)
{
  // The whole border is covered, as no view would have it.
  const Map everywhere = [](const glm::ivec2&) { return true; };
  const Map nowhere = [](const glm::ivec2&) { return false; };
  const std::vector<glm::dvec2> places = { { 0.5, 0.5 }, { 63.9, 0.1 }, { 63.5, 63.5 } };
  for (const char* kernel : { "bilinear", "box", "poisson" })
  {
    const ShadowLight light = filteredSun(kernel, 32);
    EXPECT_EQ(runGlsl(light, everywhere, places), std::vector<float>(3, 0.0f)) << kernel;
    EXPECT_EQ(runGlsl(light, nowhere, places), std::vector<float>(3, 1.0f)) << kernel;
  }
}

TEST(PoissonDisc, isEvenlyScattered)
{
  const auto& points = poissonDisc();
  double least = 2.0;
  glm::dvec2 middle(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LE(glm::length(points[i]), 1.0);
    middle += points[i] / static_cast<double>(points.size());
    for (std::size_t j = 0; j < i; ++j)
    {
      least = std::min(least, glm::distance(points[i], points[j]));
    }
  }
  EXPECT_GE(least, 0.8 * 0.476);
  EXPECT_LT(glm::length(middle), 0.1);
}

TEST_F(PcfGlsl, turningTheDiscKeepsTheMean)
{
  // Half of the plane is dark: the mean along the edge is one half, whatever the angles.
  const Map halfPlane = [](const glm::ivec2& texel) { return texel.x >= mapSize / 2; };
  std::vector<glm::dvec2> places;
  for (int y = 0; y < 4 * 40; ++y)
  {
    for (int x = 0; x < 4 * 12; ++x)
    {
      places.emplace_back(mapSize / 2 - 6 + (x + 0.5) / 4.0, 12.0 + (y + 0.5) / 4.0);
    }
  }
  const std::vector<float> values = runGlsl(filteredSun("poisson", 8), halfPlane, places);
  double mean = 0.0;
  for (const float value : values)
  {
    mean += value / static_cast<double>(values.size());
  }
  EXPECT_NEAR(mean, 0.5, 0.01);
}

} // namespace
} // namespace gnomon::test
