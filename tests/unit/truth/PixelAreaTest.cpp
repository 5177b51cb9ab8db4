// The number of a map's texels that shaders compute for a pixel, against the pixel's corners on the
// map.

#include "../lights/ViewPoints.h"

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "lights/SettingsTable.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

namespace gnomon::test
{
namespace
{

constexpr glm::ivec2 pictureSize(1000, 700);
constexpr int areaSide = 256;

/// Outputs that number in place of a visibility.
class TexelsOfPixel : public PointwiseTechnique
{
public:
  std::string visibilityGlsl(const ShadowLight& light) const override
  {
    return lightViewsDefines(light, true) +
      ShaderLibrary::source("shadowtech/base/map_visibility.glsl") +
      "float estimate_LIGHT(ViewPoint point, float slack) { return texelsOfPixel_LIGHT(point); }\n";
  }
  std::vector<Uniform> uniforms(const ReceiverSpace&) const override { return {}; }
};

/// Return the number of texels that a quadrangle of points covers on a view's map.
double texelsOf(const LightView& view, const std::array<glm::dvec3, 4>& corners)
{
  const glm::dmat3 texels = texelFromAcross(view, areaSide);
  std::array<glm::dvec2, 4> places;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const glm::dvec3 p(view.rays.viewFromCentred * glm::dvec4(corners[i], 1.0));
    places[i] = mapped(texels, view.rays.across(p));
  }
  const glm::dvec2 a = places[2] - places[0];
  const glm::dvec2 b = places[3] - places[1];
  return 0.5 * std::abs(a.x * b.y - a.y * b.x);
}

using PixelArea = GlslTest;

TEST_F(PixelArea, isThatOfItsCornersOnTheMap)
{
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, -0.3, 1.0));
  for (const bool parallel : { false, true })
  {
    const CameraView camera{ glm::lookAt(glm::dvec3(-1.0, -6.0, 4.0), glm::dvec3(0.0),
                               glm::dvec3(0.0, 0.0, 1.0)),
      parallel ? glm::ortho(-2.0, 2.0, -1.4, 1.4, 0.5, 50.0)
               : glm::perspective(glm::radians(30.0), 1.4, 0.5, 50.0) };
    for (const char* projection : { "uniform", "lispsm", "tsm" })
    {
      std::vector<ShadowLight> lights = { directionalLight({ 0.7, 0.2, -1.0 }),
        spotLight({ -3.0, 1.0, 5.0 }, glm::dvec3(0.0), 50.0) };
      if (std::string(projection) == "uniform")
      {
        lights.push_back(pointLight({ -0.9, 0.4, 3.0 }));
      }
      for (ShadowLight& light : lights)
      {
        SCOPED_TRACE(std::string(projection) + ", kind " +
          std::to_string(static_cast<int>(light.kind)) + (parallel ? ", parallel" : ""));
        findSetting("projection")->set(light, projection);
        light.mapSizeTexels = areaSide;
        const Bounds scene{ { -5.0, -5.0, -2.5 }, { 5.0, 5.0, 2.8 } };
        const LightViews views =
          fitLightViews(light, { glm::dvec3(0.0), scene, scene, { areaSide, 2 }, camera });
        ASSERT_FALSE(views.views.empty());

        std::mt19937 random(3);
        std::vector<glm::vec4> pointsView;
        std::vector<double> expected;
        for (int i = 0; i < 500; ++i)
        {
          const auto below = [&](int end) { return double(random() % unsigned(end)); };
          const double x = below(pictureSize.x);
          const glm::dvec2 pixel(x, below(pictureSize.y));
          const auto seen = [&](double across, double up)
          {
            const glm::dvec2 place = pixel + glm::dvec2(across, up);
            return seenAt(
              camera, 2.0 * place / glm::dvec2(pictureSize) - 1.0, glm::dvec4(normal, 0.0));
          };
          const glm::dvec3 middle = seen(0.5, 0.5);
          if (const LightView* const view = viewOf(views, middle))
          {
            pointsView.emplace_back(camera.viewFromCentred * glm::dvec4(middle, 1.0));
            expected.push_back(
              texelsOf(*view, { seen(0.0, 0.0), seen(1.0, 0.0), seen(1.0, 1.0), seen(0.0, 1.0) }));
          }
        }
        const ReceiverSpace space{ glm::inverse(camera.viewFromCentred),
          camera.pixelSide(pictureSize) };
        std::vector<Uniform> uniforms = lightViewsUniforms(views, areaSide, space);
        uniforms.push_back(depthSlacks());
        ShaderLibrary library;
        const std::vector<float> answers = visibilityAt(TexelsOfPixel(), light, library, pointsView,
          glm::vec3(glm::dmat3(camera.viewFromCentred) * normal), uniforms);
        std::size_t reached = 0;
        for (std::size_t i = 0; i < answers.size(); ++i)
        {
          if (answers[i] > 0.0f && answers[i] < 1.0f) // 0: beside the cone; 1: off the map
          {
            ++reached;
            EXPECT_NEAR(answers[i] / expected[i], 1.0, 0.02) << i;
          }
        }
        EXPECT_GT(reached, 300u);
      }
    }
  }
}

// The view that light_views.glsl finds for a point, where several may hold it.

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

// Invalid shaders: errors that name the shader and the reason, and a library that still works.

using testing::AllOf;
using testing::HasSubstr;

/// Match a call that fails with an error like this.
template <typename Matcher>
auto fails(const Matcher& error)
{
  return testing::ThrowsMessage<ShaderError>(error);
}

using ShaderLibraryTest = GlslTest;

TEST_F(ShaderLibraryTest, saysWhatDoesNotCompileEachTimeThatItIsAskedFor)
{
  ShaderLibrary library;
  const auto broken = [&]
  { ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = MISSING;\n}\n", { "GIVEN 3" }); };
  for (int attempt = 0; attempt < 2; ++attempt)
  {
    EXPECT_THAT(broken,
      fails(AllOf(HasSubstr("a shader does not compile"), HasSubstr("MISSING"),
        HasSubstr("#define GIVEN 3"))));
  }
  EXPECT_EQ(library.compiles(), 0);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  ScreenPass::use(library, "out float v;\nvoid main()\n{\n  v = 1.0;\n}\n");
  EXPECT_EQ(library.compiles(), 1);
}

TEST_F(ShaderLibraryTest, saysWhatDoesNotLink)
{
  ShaderLibrary library;
  const auto broken = [&]
  {
    ScreenPass::use(
      library, "float missing();\nout float v;\nvoid main()\n{\n  v = missing();\n}\n");
  };
  EXPECT_THAT(broken, fails(AllOf(HasSubstr("a program does not link"), HasSubstr("missing"))));
  EXPECT_EQ(library.compiles(), 0);
}

TEST_F(ShaderLibraryTest, namesASourceThatIsNotThere)
{
  EXPECT_THAT([] { ShaderLibrary::source("shadowtech/none.glsl"); },
    fails(HasSubstr("shadowtech/none.glsl")));
}

} // namespace
} // namespace gnomon::test
