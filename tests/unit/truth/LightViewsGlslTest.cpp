// The view that light_views.glsl finds for a point, where several may hold it.

#include "EstimatorGlsl.h"

#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <random>

namespace gnomon::test
{

/// A sun over a floor that a camera looks along.
TEST_F(GlslTest, splitsOfPointsAreTheFirstThatHoldThemAndTheirBorder)
{
  constexpr int size = 64;
  ShadowLight light;
  light.directionWorld = { 0.0, -1.0, 0.0 };
  light.projection = Projection::Splits;
  const Bounds floor{ { -1.0, -0.2, -1.0 }, { 1.0, 0.1, 1.0 } };
  const CameraView camera{ glm::lookAt(
                             glm::dvec3(0.3, 0.3, 1.2), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)),
    glm::perspective(glm::radians(60.0), 1.3, 0.05, 50.0) };
  const LightViews views =
    fitLightViews(light, { glm::dvec3(0.0), floor, floor, { size, 2 }, camera });
  ASSERT_EQ(views.views.size(), 4u);

  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(-1.1f, 1.1f); // some beside all maps
  std::vector<glm::vec4> points;
  for (int i = 0; i < 6400; ++i)
  {
    const float x = uniform(random);
    points.emplace_back(x, uniform(random), 0.5f, 1.0f);
  }
  ShaderLibrary library;
  const auto found = runCompute<glm::vec4>(library,
    computeGlsl(
      lightViewsDefines(light) + ShaderLibrary::source("shadowtech/base/light_views.glsl"), "vec4",
      "vec4",
      "ViewPoint point;\nbool found = findView_LIGHT(given[i].xyz, -given[i].xyz, point);\n"
      "result[i] = vec4(point.texel, found ? float(point.view) : -1.0, 0.0);\n"),
    points, lightViewsUniforms(views, size, {}));
  std::array<int, 5> counts{};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    int expected = -1;
    glm::dvec2 texel(-1.0);
    bool close = false; // to a border, where float may decide either side
    for (int view = 0; view < 4 && expected < 0; ++view)
    {
      texel = mapped(
        texelFromAcross(views.views[static_cast<std::size_t>(view)], size), glm::dvec2(points[i]));
      const glm::dvec2 inside = glm::min(texel, static_cast<double>(size) - texel);
      const double least = std::min(inside.x, inside.y) - (view < 3 ? views.borderTexels : 0.0);
      close = close || std::abs(least) < 1e-3;
      expected = least >= 0.0 ? view : -1;
    }
    EXPECT_TRUE(close || found[i].z == static_cast<float>(expected)) << i;
    EXPECT_TRUE(close || expected < 0 || glm::distance(glm::dvec2(found[i]), texel) < 1e-3) << i;
    ++counts[static_cast<std::size_t>(expected + 1)];
  }
  EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 20);
}

} // namespace gnomon::test
