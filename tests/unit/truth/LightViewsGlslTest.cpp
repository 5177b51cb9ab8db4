// Compare light_views.glsl with its twins in lights/.

#include "shadowtech/base/LightViewsGlsl.h"

#include "lights/LightSpace.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/ShadowRay.h"

#include "EstimatorGlsl.h"
#include "SyntheticScene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <random>

namespace gnomon::test
{
namespace
{

using LightViewsGlsl = GlslTest;

/// The results of light_views.glsl for a point.
struct FoundView
{
  glm::vec4 inFace;    ///< the point in its face, with the face
  glm::vec4 seen;      ///< texel, view, and if the light reaches the point
  glm::vec4 onCubeMap; ///< texel, view and face of a lookup on the whole cube
};

/// Run light_views.glsl for a light on points of its own space.
std::vector<FoundView> runLightViews(
  const ShadowLight& light, const LightViews& views, int size, const std::vector<glm::vec4>& points)
{
  ShaderLibrary library;
  const std::string declarations = lightViewsDefines(light) +
    ShaderLibrary::source("shadowtech/base/light_views.glsl") +
    "struct FoundView { vec4 inFace; vec4 seen; vec4 onCubeMap; };\n";
  return runCompute<FoundView>(library, computeGlsl(declarations, "vec4", "FoundView", R"(
  vec3 p = given[i].xyz;
  int face = cubeFaceOf(p);
  ViewPoint point;
  bool inBox = true;
#if VIEWS_BOX_LIGHT
  inBox = insideBox(p, lightBox_LIGHT);
#endif
  bool found = findView_LIGHT(p, -p, point);
  result[i].inFace = vec4(cubeFaceFromLight(face, p), float(face));
  result[i].seen = vec4(point.texel, found ? float(point.view) : -1.0, inBox ? 1.0 : 0.0);
#if VIEWS_CUBE_LIGHT
  found = findFace_LIGHT(p, -p, point);
  result[i].onCubeMap = vec4(point.texel, found ? float(point.view) : -1.0, float(point.face));
#endif
)"),
    points, lightViewsUniforms(views, size, {}));
}

std::vector<glm::vec4> randomPoints()
{
  std::mt19937 random(8);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<glm::vec4> points;
  for (int i = 0; i < 6400; ++i)
  {
    const float x = uniform(random);
    const float y = uniform(random);
    glm::vec3 point(x, y, uniform(random));
    // Some points lie exactly on the borders of faces.
    point = i % 10 == 0 ? glm::vec3(point.x, point.x, point.z) : point;
    point = i % 10 == 1 ? glm::vec3(point.x, -point.z, point.z) : point;
    points.emplace_back(point, 1.0f);
  }
  return points;
}

TEST_F(LightViewsGlsl, FindsTheViewsThatTheMathematicsMade)
{
  constexpr int size = 64;
  const ShadowLight light = pointLight({ 0.0, 0.0, 0.0 });
  // No casters above the light and to its left, so some faces have no view.
  const LightViews views = fitLightViews(
    light, { glm::dvec3(0.0), { { 0.1, -1.0, -1.0 }, { 1.0, 1.0, -0.9 } }, {}, { size, 1 }, {} });
  ASSERT_GT(views.views.size(), 1u);
  ASSERT_LT(views.views.size(), 6u);
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<FoundView> outputs = runLightViews(light, views, size, points);
  std::size_t found = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 point(points[i]);
    const int face = cubeFaceOf(point);
    EXPECT_EQ(outputs[i].inFace, glm::vec4(cubeFaceFromLight(face) * point, face));

    const int view = views.viewOfFace[static_cast<std::size_t>(face)];
    glm::dvec2 texel(-1.0);
    if (view != LightViews::noView)
    {
      const glm::dvec4 clip =
        views.views[static_cast<std::size_t>(view)].clipFromCentred() * glm::dvec4(point, 1.0);
      texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(size);
      EXPECT_NEAR(outputs[i].seen.x, texel.x, 1e-4 * (1.0 + std::abs(texel.x)));
      EXPECT_NEAR(outputs[i].seen.y, texel.y, 1e-4 * (1.0 + std::abs(texel.y)));
    }
    const bool inside = glm::all(glm::greaterThanEqual(texel, glm::dvec2(0.0))) &&
      glm::all(glm::lessThan(texel, glm::dvec2(size)));
    EXPECT_EQ(outputs[i].seen.z, inside ? static_cast<float>(view) : -1.0f);
    found += inside ? 1 : 0;

    // A lookup on the whole cube has a place for every point, on a map or beside one.
    const int around = view == LightViews::noView ? 0 : view;
    const glm::dvec2 place =
      mapped(texelFromAcross(views.views[static_cast<std::size_t>(around)], size),
        views.views[static_cast<std::size_t>(around)].rays.across(cubeFaceFromLight(face) * point));
    EXPECT_EQ(outputs[i].onCubeMap.z, static_cast<float>(around));
    EXPECT_EQ(outputs[i].onCubeMap.w, static_cast<float>(face));
    EXPECT_NEAR(outputs[i].onCubeMap.x, place.x, 1e-4 * (1.0 + std::abs(place.x)));
    EXPECT_NEAR(outputs[i].onCubeMap.y, place.y, 1e-4 * (1.0 + std::abs(place.y)));
  }
  EXPECT_GT(found, 500u);
  EXPECT_LT(found, 5000u);
}

/// A sun over a floor that a camera looks along.
LightViews fittedViews(ShadowLight& light, Projection projection, int size)
{
  light = ShadowLight();
  light.directionWorld = { 0.0, -1.0, 0.0 };
  light.projection = projection;
  ViewFitting fitting;
  fitting.castersCentred = { glm::dvec3(-1.0, -0.2, -1.0), glm::dvec3(1.0, 0.1, 1.0) };
  fitting.receiversCentred = fitting.castersCentred;
  fitting.texels = { size, 2 };
  CameraView camera;
  camera.viewFromCentred =
    glm::lookAt(glm::dvec3(0.3, 0.3, 1.2), glm::dvec3(0.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
  camera.clipFromView = glm::perspective(glm::radians(60.0), 1.3, 0.05, 50.0);
  fitting.camera = camera;
  return fitLightViews(light, fitting);
}

TEST_F(LightViewsGlsl, FindsTheFirstSplitThatHoldsAPointAndItsBorder)
{
  constexpr int size = 64;
  ShadowLight light;
  const LightViews views = fittedViews(light, Projection::Splits, size);
  ASSERT_EQ(views.views.size(), 4u);
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<FoundView> outputs = runLightViews(light, views, size, points);
  std::array<int, 5> found{};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    int expected = -1;
    glm::dvec2 texel(-1.0);
    bool close = false; // close to a border, where float may decide either side
    for (int view = 0; view < 4 && expected < 0; ++view)
    {
      const glm::dmat3 matrix = texelFromAcross(views.views[static_cast<std::size_t>(view)], size);
      texel = mapped(matrix, glm::dvec2(points[i]));
      const double border = view < 3 ? views.borderTexels : 0.0;
      const glm::dvec2 inside = glm::min(texel, static_cast<double>(size) - texel) - border;
      const double least = std::min(inside.x, inside.y);
      close = close || std::abs(least) < 1e-3;
      expected = least >= 0.0 ? view : -1;
    }
    if (close)
    {
      continue;
    }
    EXPECT_EQ(outputs[i].seen.z, static_cast<float>(expected));
    if (expected >= 0)
    {
      EXPECT_NEAR(outputs[i].seen.x, texel.x, 1e-3);
      EXPECT_NEAR(outputs[i].seen.y, texel.y, 1e-3);
    }
    ++found[static_cast<std::size_t>(expected + 1)];
  }
  for (const int count : found)
  {
    EXPECT_GT(count, 20);
  }
}

TEST_F(LightViewsGlsl, FindsTexelsOfAWarpedView)
{
  constexpr int size = 64;
  for (const Projection projection : { Projection::Lispsm, Projection::Trapezoid })
  {
    ShadowLight light;
    const LightViews views = fittedViews(light, projection, size);
    ASSERT_EQ(views.views.size(), 1u);
    ASSERT_TRUE(views.views[0].warped());
    const glm::dmat3 matrix = texelFromAcross(views.views[0], size);
    const std::vector<glm::vec4> points = randomPoints();
    const std::vector<FoundView> outputs = runLightViews(light, views, size, points);
    std::size_t found = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const glm::dvec3 image = matrix * glm::dvec3(glm::dvec2(points[i]), 1.0);
      const glm::dvec2 texel = glm::dvec2(image) / image.z;
      const glm::dvec2 inside = glm::min(texel, static_cast<double>(size) - texel);
      const double least = std::min(inside.x, inside.y);
      if (std::abs(least) < 1e-3 || std::abs(image.z) < 1e-3)
      {
        continue;
      }
      const bool seen = image.z > 0.0 && least > 0.0;
      EXPECT_EQ(outputs[i].seen.z, seen ? 0.0f : -1.0f);
      if (seen)
      {
        EXPECT_NEAR(outputs[i].seen.x, texel.x, 1e-3);
        EXPECT_NEAR(outputs[i].seen.y, texel.y, 1e-3);
        ++found;
      }
    }
    EXPECT_GT(found, 500u);
    EXPECT_LT(found, 6000u);
  }
}

TEST_F(LightViewsGlsl, AgreesOnWhatLiesInABox)
{
  const ShadowLight light = boxLight({ 0.0, 1.0, -0.5 }, { 0.0, 0.0, 0.0 }, { 1.1, 1.3, 0.7 });
  const LightViews views = fitLightViews(
    light, { glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, {}, { 64, 1 }, {} });
  const ShadowRayLight rayLight(light, glm::dvec3(0.0));
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<FoundView> outputs = runLightViews(light, views, 64, points);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool expected = insideBox(glm::vec3(points[i]), rayLight.box);
    EXPECT_EQ(outputs[i].seen.w != 0.0f, expected);
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 500u);
  EXPECT_LT(inside, 5000u);
}

} // namespace
} // namespace gnomon::test
