// Estimators whose views have their last fit in a texture, against the same with the fit in the
// views.

#include "../lights/ViewPoints.h"
#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include "lights/SettingsTable.h"
#include "shadowtech/Registry.h"
#include "shadowtech/base/CasterDrawing.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/LightViewsGlsl.h"
#include "shadowtech/base/OccluderBuffers.h"
#include "shadowtech/base/ScreenPass.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/fitting/ReceiverFit.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>

namespace gnomon::test
{
namespace
{

constexpr int fittedSide = 128;

/// An estimator with its settings.
struct Way
{
  const char* name;
  std::map<std::string, std::string> settings;
};

std::ostream& operator<<(std::ostream& stream, const Way& way)
{
  return stream << way.name;
}

/// Return a fit that is narrow along one axis, and different for each view.
MapFit fitOf(std::size_t view)
{
  const double step = static_cast<double>(view);
  return { { 1.25 + 0.5 * step, 2.5 - 0.25 * step }, { 0.125 * step - 0.25, 0.5 } };
}

/// Views that await a fit, and the same views with the fit applied.
struct BothViews
{
  LightViews awaiting;
  LightViews fitted;
  /// The GPU's result for `awaiting`, as ReceiverFit stores it.
  GlTexture found;
};

void makeBoth(ShadowLight light, const Occluders& occluders, const CameraView& camera,
  int borderTexels, BothViews& both)
{
  light.fittedToReceivers = true;
  both.awaiting = fitLightViews(light,
    { occluders.frame.centre, occluders.allCentred, occluders.allCentred,
      { fittedSide, borderTexels }, camera });
  both.fitted = both.awaiting;
  both.fitted.awaitFit = false;
  const std::size_t count = both.awaiting.views.size();
  std::vector<glm::vec4> rows(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const MapFit fit = fitOf(i);
    LightView& view = both.fitted.views[i];
    if (!view.warps.empty())
    {
      ASSERT_EQ(count, 1u);
      view.mapFromAcross = view.warps.at(15);
      view.warps.clear();
      const std::vector<glm::vec4> chosen =
        chosenWarpRows(both.awaiting.views[i], view.mapFromAcross, fittedSide);
      rows.insert(rows.end(), chosen.begin(), chosen.end());
    }
    view.mapFromAcross = fit.matrix() * view.mapFromAcross;
    rows[i] = glm::vec4(fit.scale, fit.offset);
    rows[count + i] = glm::vec4(fit.scale, 0.5 * fittedSide * (fit.offset + 1.0 - fit.scale));
  }
  ASSERT_GT(count, 0u);
  fillTexture(both.found, GL_RGBA, { count, rows.size() / count, 0 }, rows.data());
}

Occluders floorAndBoxes()
{
  return makeOccluders({ { makePlane(6.0) }, { makeBox({ -0.5, -0.5, 1.0 }, { 0.5, 0.5, 2.0 }) },
    { makeBox({ 1.0, -2.0, 0.0 }, { 1.3, -1.0, 0.8 }) } });
}

CameraView cameraAbove()
{
  return { glm::lookAt(glm::dvec3(-1.0, -5.0, 3.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0)),
    glm::perspective(glm::radians(60.0), 1.3, 0.5, 50.0) };
}

/// Return lights whose views have all layouts.
std::vector<ShadowLight> lightsOfAllLayouts()
{
  std::vector<ShadowLight> result;
  for (const char* projection : { "uniform", "lispsm", "tsm", "pssm" })
  {
    for (ShadowLight light : { directionalLight({ 0.7, 0.2, -1.0 }),
           spotLight({ -3.0, 1.0, 5.0 }, glm::dvec3(0.0), 45.0) })
    {
      findSetting("projection")->set(light, projection);
      result.push_back(light);
    }
  }
  result.push_back(pointLight({ -0.9, 0.4, 3.0 }));
  for (ShadowLight& light : result)
  {
    light.technique = "nsm"; // replaced by the way's estimator
    light.fit = ViewFit::Frame;
    light.splits = 3;
    light.mapSizeTexels = fittedSide;
  }
  return result;
}

class FittedViews : public GlslTestOf<Way>
{
protected:
  /// Bake, then compute visibility.
  /// @return per point of the floor and the box, in view coordinates
  std::vector<float> visibility(const ShadowLight& light, const LightViews& views,
    const Occluders& occluders, const TextureBinding& viewFits, const glm::dmat4& centredFromView)
  {
    ShaderLibrary library;
    OccluderBuffers buffers;
    buffers.update(occluders);
    const AnyTechnique made = estimatorOf(light).create();
    const auto& technique = std::get<std::unique_ptr<PointwiseTechnique>>(made);
    technique->bake({ light, views, occluders, buffers, library, viewFits });

    const glm::dmat4 viewFromCentred = glm::inverse(centredFromView);
    std::vector<glm::vec4> inputs;
    for (std::size_t i = 0; i < points; ++i)
    {
      const double x = -3.0 + 6.0 * std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
      const double y = -3.0 + 6.0 * std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      const bool above = std::max(std::abs(x), std::abs(y)) < 0.5;
      const glm::dvec3 centred = glm::dvec3(x, y, above ? 2.0 : 0.0) - occluders.frame.centre;
      inputs.emplace_back(viewFromCentred * glm::dvec4(centred, 1.0));
    }
    const std::vector<float> outputs = visibilityAt(*technique, light, library, std::move(inputs),
      glm::vec3(glm::dmat3(viewFromCentred) * glm::dvec3(0.0, 0.0, 1.0)),
      technique->uniforms({ centredFromView, { 0.0, 0.05 } }));
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return outputs;
  }

  static constexpr std::size_t points = 64 * 256;
};

using Settings = std::map<std::string, std::string>;
INSTANTIATE_TEST_SUITE_P(Estimators, FittedViews,
  testing::Values(Way{ "compare", {} }, Way{ "euclidean", { { "metric", "euclidean" } } },
    Way{ "second", { { "depth", "second" } } }, Way{ "midpoint", { { "depth", "midpoint" } } },
    Way{ "biased", { { "bias_constant", "0.01" }, { "bias_slope", "2" } } },
    Way{ "bilinear", { { "estimator", "pcf" }, { "kernel_size", "5" } } },
    Way{ "castano", { { "estimator", "pcf" }, { "kernel", "castano" } } },
    Way{ "poisson", { { "estimator", "pcf" }, { "kernel", "poisson" }, { "kernel_size", "9" } } },
    Way{ "box", { { "estimator", "pcf" }, { "kernel", "box" }, { "kernel_size", "7" } } },
    Way{ "width", { { "estimator", "pcf" }, { "kernel_width", "0.3" } } },
    Way{ "adaptive", { { "estimator", "adaptive" }, { "kernel_size", "6" } } },
    Way{ "variance", { { "estimator", "variance" } } },
    Way{
      "variance_sat", { { "estimator", "variance" }, { "blur", "sat" }, { "kernel_size", "7" } } },
    Way{ "moments_sat", { { "estimator", "moments" }, { "blur", "sat" }, { "kernel_size", "4" } } },
    Way{ "mip_maps", { { "estimator", "moments" }, { "mip_maps", "on" } } },
    Way{ "single_exponential", { { "estimator", "single_exponential" }, { "kernel_size", "5" } } },
    Way{ "exponential", { { "estimator", "exponential" }, { "kernel_size", "5" } } },
    Way{ "moments", { { "estimator", "moments" } } }),
  byName);

TEST_P(FittedViews, matchViewsWithTheFitApplied)
{
  const Occluders occluders = floorAndBoxes();
  const CameraView camera = cameraAbove();
  const glm::dmat4 centredFromView = glm::inverse(camera.viewFromCentred);
  for (ShadowLight light : lightsOfAllLayouts())
  {
    SCOPED_TRACE(findSetting("projection")->get(light) + ", kind " +
      std::to_string(static_cast<int>(light.kind)));
    for (const auto& [name, value] : GetParam().settings)
    {
      findSetting(name)->set(light, value);
    }
    const MapReach reach = baseOf(estimatorOf(light).create()).mapReach(light);
    BothViews both;
    ASSERT_NO_FATAL_FAILURE(makeBoth(light, occluders, camera, reach.borderTexels(20.0), both));
    light.fittedToReceivers = true;
    const std::vector<float> byTexture = this->visibility(
      light, both.awaiting, occluders, { GL_TEXTURE_2D, both.found.name() }, centredFromView);
    light.fittedToReceivers = false;
    const std::vector<float> byView =
      this->visibility(light, both.fitted, occluders, {}, centredFromView);
    const std::size_t dark =
      countBelow(byView.size(), [&](std::size_t i) { return byView[i] < 0.5f; });
    const std::size_t differing = countBelow(
      byView.size(), [&](std::size_t i) { return std::abs(byView[i] - byTexture[i]) > 0.02f; });
    EXPECT_GT(dark, points / 100);
    EXPECT_LT(dark, points / 2);
    // A point on the border of texels, or a disc that the place turns, may round either way.
    EXPECT_LE(differing, points / 500);
  }
}

/// Values of caster_map.glsl at the casters' fragments. They determine how far casters are pushed
/// back, which shadows show too little of.
class FittedCasters : public GlslTest
{
protected:
  static std::vector<glm::vec4> drawn(const char* shown, const ShadowLight& light,
    const LightViews& views, const Occluders& occluders, const TextureBinding& viewFits)
  {
    ShaderLibrary library;
    OccluderBuffers buffers;
    buffers.update(occluders);
    GlTexture picture;
    GlFramebuffer framebuffer;
    fillTexture(picture, GL_RGBA, { fittedSide, fittedSide, 0 }, nullptr);
    std::vector<glm::vec4> result(static_cast<std::size_t>(fittedSide) * fittedSide);
    const GlStateGuard guard;
    const glm::vec4 nothing(0.0f);
    beginCasters(framebuffer.create(), fittedSide);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture.name(), 0);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glClearBufferfv(GL_COLOR, 0, &nothing.x);
    drawCasters(0, { light, views, occluders, buffers, library, viewFits },
      { ShaderLibrary::source("shadowtech/base/caster_map.glsl") +
          "out vec4 shown;\nvoid main()\n{\n" + shown + "}\n",
        {} });
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, fittedSide, fittedSide, GL_RGBA, GL_FLOAT, result.data());
    return result;
  }
};

TEST_F(FittedCasters, matchViewsWithTheFitApplied)
{
  const Occluders occluders = floorAndBoxes();
  for (ShadowLight light : lightsOfAllLayouts())
  {
    SCOPED_TRACE(findSetting("projection")->get(light) + ", kind " +
      std::to_string(static_cast<int>(light.kind)));
    BothViews both;
    ASSERT_NO_FATAL_FAILURE(makeBoth(light, occluders, cameraAbove(), 1, both));
    for (const char* shown : { "shown = vec4(across(), 0.0, 1.0);\n",
           "mat2 jacobian = texelJacobian(); shown = vec4(jacobian[0], jacobian[1]);\n",
           "shown = vec4(texelScale(), 1.0);\n" })
    {
      SCOPED_TRACE(shown);
      const std::vector<glm::vec4> byTexture =
        this->drawn(shown, light, both.awaiting, occluders, { GL_TEXTURE_2D, both.found.name() });
      const std::vector<glm::vec4> byView = this->drawn(shown, light, both.fitted, occluders, {});
      glm::vec4 largest(0.0f);
      for (const glm::vec4& value : byView)
      {
        largest = glm::max(largest, glm::abs(value));
      }
      const glm::vec4 most(1e-4f * std::max({ largest.x, largest.y, largest.z }));
      const std::size_t differing = countBelow(byView.size(),
        [&](std::size_t i)
        { return !glm::all(glm::lessThanEqual(glm::abs(byTexture[i] - byView[i]), most)); });
      const std::size_t covered =
        countBelow(byView.size(), [&](std::size_t i) { return byView[i] != glm::vec4(0.0f); });
      EXPECT_GT(covered, byView.size() / 4);
      EXPECT_LE(differing, byView.size() / 500); // where a caster's edge takes another texel
    }
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// The number of a map's texels that shaders compute for a pixel, against the pixel's corners on the
// map.

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
