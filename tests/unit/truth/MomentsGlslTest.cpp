// The moments of a depth in GLSL, and sums of them. FiltersTest has the pictures.

#include "EstimatorGlsl.h"

#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/moment_map/MomentEstimators.h"
#include "shadowtech/moment_map/SummedAreaTable.h"

#include <algorithm>
#include <cmath>

namespace gnomon::test
{

/// Powers are means over two depths. Exponentials spread by their slope, up to their size.
TEST_F(GlslTest, momentsOfADepthAreMeansOverItsSpread)
{
  std::vector<glm::vec2> inputs;
  for (const float depth : { 1.0f, -1.0f, -0.6f, 0.0f, 0.8f })
  {
    for (const float spread : { 0.0f, 1e-3f, 0.01f, 0.1f, 1.0f })
    {
      inputs.emplace_back(depth, spread);
    }
  }
  ShaderLibrary library;
  for (const MomentEstimator& estimator :
    { variance(), fourMoments(), singleExponential(), exponential() })
  {
    const auto answers = runCompute<glm::vec4>(library,
      computeGlsl(ShaderLibrary::source(estimator.momentsFile), "vec2", "vec4",
        "result[i] = momentsOf(given[i].x, given[i].y);\n"),
      inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i)
    {
      const double depth = inputs[i].x;
      const double spread = inputs[i].y;
      const auto power = [&](int n)
      { return 0.5 * (std::pow(depth - spread, n) + std::pow(depth + spread, n)); };
      const double positive = std::exp(exponentPositive * depth);
      const double negative = -std::exp(-exponentNegative * depth);
      const auto squared = [&](double exponent)
      { return std::pow(std::min(exponent * spread, 1.0), 2); };
      const std::string& name = estimator.info.name;
      const glm::dvec4 expected = name == "single_exponential"
        ? glm::dvec4(positive * (1.0 + 0.5 * squared(exponentPositive)), 0.0, 0.0, 0.0)
        : name == "exponential"
        ? glm::dvec4(positive, positive * positive * (1.0 + squared(exponentPositive)), negative,
            negative * negative * (1.0 + squared(exponentNegative)))
        : glm::dvec4(power(1), power(2), power(3), power(4));
      for (int channel = 0; channel < estimator.count; ++channel)
      {
        const double tolerance = 1e-6 + 1e-4 * std::abs(expected[channel]);
        EXPECT_NEAR(answers[i][channel], expected[channel], tolerance) << name << channel;
        EXPECT_TRUE(i > 0 || std::abs(estimator.empty[channel] - expected[channel]) <= tolerance)
          << "without casters, depth 1";
      }
    }
  }
}

/// The mean over any rectangle of a large map is its texels' value, if they are alike and so all
/// rounded the same way. Floats would lose a thousandth of it.
TEST_F(GlslTest, summedAreaTablesOfLargeMapsLoseNoDigits)
{
  constexpr int size = 1024;
  const glm::vec4 value(0.8123457f, 0.65990554f, 0.3f, 0.7f);
  const std::vector<glm::vec4> texels(size * size, value);
  GlTexture texture;
  fillTexture(texture, GL_RGBA, { size, size, 1 }, texels.data());
  ShaderLibrary library;
  for (const float width : { 1.0f, 9.0f, 128.0f })
  {
    SummedAreaTable table;
    table.allocate(4, size, 1);
    table.setUnits({ 1.0f, 2.0f, 4.0f, 8.0f }, width);
    table.sum(texture.name(), 0, 0, library);
    std::vector<glm::vec4> rectangles; // lower corners and upper ones
    for (int i = 0; i < 200; ++i)
    {
      const glm::vec2 lower(4.4375f * i, 880.0f - 4.1875f * i); // float-exact sixteenths
      rectangles.emplace_back(lower, lower + width);
    }
    const auto means = runCompute<glm::vec4>(library,
      computeGlsl(ShaderLibrary::source("shadowtech/moment_map/summed_area.glsl"), "vec4", "vec4",
        "result[i] = meanOver_LIGHT(given[i].xy, given[i].zw, 0);\n"),
      rectangles, table.uniforms(glm::vec4(0.0f)));
    for (const glm::vec4& mean : means)
    {
      const glm::vec4 off = glm::abs(mean / value - 1.0f);
      ASSERT_LT(std::max({ off.x, off.y, off.z, off.w }), 1e-6f) << width;
    }
  }
}

} // namespace gnomon::test
