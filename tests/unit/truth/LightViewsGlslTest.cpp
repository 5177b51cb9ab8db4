// light_views.glsl against its twins in lights/.

#include "shadowtech/base/LightViewsGlsl.h"

#include "lights/LightSpace.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/ShadowRay.h"

#include "SyntheticScene.h"
#include "vtkGnomonEGLRenderWindow.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <random>

namespace gnomon::test
{
namespace
{

/// Runs light_views.glsl for a light on points of its own space, and returns for each three vec4:
/// the point in its face, with the face; texel, view, and whether the point is in the light's
/// reach; of a cube texel and view of who looks around.
std::vector<glm::vec4> runLightViews(
  const ShadowLight& light, const LightViews& views, int size, const std::vector<glm::vec4>& points)
{
  ShaderLibrary library;
  const std::string source = numberedForLight(lightViewsDefines(light) +
      ShaderLibrary::source("shadowtech/base/light_views.glsl") +
      R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };
void main()
{
  uint i = gl_GlobalInvocationID.x;
  vec3 p = inputs[i].xyz;
  int face = cubeFaceOf(p);
  ViewPoint point;
  bool found = findView_LIGHT(p, -p, point);
  bool inBox = true;
#if VIEWS_BOX_LIGHT
  inBox = insideBox(p, lightBox_LIGHT);
#endif
  outputs[3u * i] = vec4(cubeFaceFromLight(face, p), float(face));
  outputs[3u * i + 1u] =
    vec4(point.texel, found ? float(point.view) : -1.0, inBox ? 1.0 : 0.0);
#if VIEWS_CUBE_LIGHT
  found = findFace_LIGHT(p, -p, point);
  outputs[3u * i + 2u] = vec4(point.texel, found ? float(point.view) : -1.0, float(point.face));
#endif
}
)",
    0);
  const GLuint program = library.program({ { GL_COMPUTE_SHADER, source } });
  GlBuffer buffers[2];
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0].create());
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec4)),
    points.data(), GL_STATIC_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1].create());
  std::vector<glm::vec4> outputs(3 * points.size());
  const auto bytes = static_cast<GLsizeiptr>(outputs.size() * sizeof(glm::vec4));
  glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, nullptr, GL_DYNAMIC_READ);
  glUseProgram(program);
  ShaderLibrary::setUniforms(program, lightViewsUniforms(views, size, {}), 0, 0);
  glDispatchCompute(static_cast<GLuint>(points.size() / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, outputs.data());
  glUseProgram(0);
  return outputs;
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
    // Some of them exactly on the borders of faces.
    point = i % 10 == 0 ? glm::vec3(point.x, point.x, point.z) : point;
    point = i % 10 == 1 ? glm::vec3(point.x, -point.z, point.z) : point;
    points.emplace_back(point, 1.0f);
  }
  return points;
}

TEST(LightViewsGlsl, FindsTheViewsThatTheMathematicsMade)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();

  constexpr int size = 64;
  const ShadowLight light = pointLight({ 0.0, 0.0, 0.0 });
  // Nothing above the light and to its left, so that there are faces without a view.
  const LightViews views =
    fitLightViews(light, glm::dvec3(0.0), { { 0.1, -1.0, -1.0 }, { 1.0, 1.0, -0.9 } }, size);
  ASSERT_GT(views.views.size(), 1u);
  ASSERT_LT(views.views.size(), 6u);
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<glm::vec4> outputs = runLightViews(light, views, size, points);
  std::size_t found = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 point(points[i]);
    const int face = cubeFaceOf(point);
    EXPECT_EQ(outputs[3 * i], glm::vec4(cubeFaceFromLight(face) * point, face));

    const int view = views.viewOfFace[static_cast<std::size_t>(face)];
    glm::dvec2 texel(-1.0);
    if (view != LightViews::noView)
    {
      const glm::dvec4 clip =
        views.views[static_cast<std::size_t>(view)].clipFromCentred() * glm::dvec4(point, 1.0);
      texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(size);
      EXPECT_NEAR(outputs[3 * i + 1].x, texel.x, 1e-4 * (1.0 + std::abs(texel.x)));
      EXPECT_NEAR(outputs[3 * i + 1].y, texel.y, 1e-4 * (1.0 + std::abs(texel.y)));
    }
    const bool inside = glm::all(glm::greaterThanEqual(texel, glm::dvec2(0.0))) &&
      glm::all(glm::lessThan(texel, glm::dvec2(size)));
    EXPECT_EQ(outputs[3 * i + 1].z, inside ? static_cast<float>(view) : -1.0f);
    found += inside ? 1 : 0;

    // Who looks around has a place for every point, on a map or beside one.
    const int around = view == LightViews::noView ? 0 : view;
    const glm::dvec2 place =
      mapped(texelFromAcross(views.views[static_cast<std::size_t>(around)], size),
        views.views[static_cast<std::size_t>(around)].rays.across(cubeFaceFromLight(face) * point));
    EXPECT_EQ(outputs[3 * i + 2].z, static_cast<float>(around));
    EXPECT_EQ(outputs[3 * i + 2].w, static_cast<float>(face));
    EXPECT_NEAR(outputs[3 * i + 2].x, place.x, 1e-4 * (1.0 + std::abs(place.x)));
    EXPECT_NEAR(outputs[3 * i + 2].y, place.y, 1e-4 * (1.0 + std::abs(place.y)));
  }
  EXPECT_GT(found, 500u);
  EXPECT_LT(found, 5000u);
}

TEST(LightViewsGlsl, WhoLooksAroundFindsNothingWhereThereAreNoCasters)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();
  const ShadowLight light = pointLight({ 0.0, 0.0, 0.0 });
  const LightViews views = fitLightViews(light, glm::dvec3(0.0), Bounds(), 64);
  ASSERT_TRUE(views.views.empty());
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<glm::vec4> outputs = runLightViews(light, views, 64, points);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_EQ(outputs[3 * i + 2].z, -1.0f);
  }
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

TEST(LightViewsGlsl, FindsTheFirstSplitThatHoldsAPointAndItsBorder)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();

  constexpr int size = 64;
  ShadowLight light;
  const LightViews views = fittedViews(light, Projection::Splits, size);
  ASSERT_EQ(views.views.size(), 4u);
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<glm::vec4> outputs = runLightViews(light, views, size, points);
  std::array<int, 5> found{};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    int expected = -1;
    glm::dvec2 texel(-1.0);
    bool close = false; // to a border, where float may see it on either side
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
    EXPECT_EQ(outputs[3 * i + 1].z, static_cast<float>(expected));
    if (expected >= 0)
    {
      EXPECT_NEAR(outputs[3 * i + 1].x, texel.x, 1e-3);
      EXPECT_NEAR(outputs[3 * i + 1].y, texel.y, 1e-3);
    }
    ++found[static_cast<std::size_t>(expected + 1)];
  }
  for (const int count : found)
  {
    EXPECT_GT(count, 20);
  }
}

TEST(LightViewsGlsl, FindsTexelsOfAWarpedView)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();

  constexpr int size = 64;
  for (const Projection projection : { Projection::Lispsm, Projection::Trapezoid })
  {
    ShadowLight light;
    const LightViews views = fittedViews(light, projection, size);
    ASSERT_EQ(views.views.size(), 1u);
    ASSERT_TRUE(views.views[0].warped());
    const glm::dmat3 matrix = texelFromAcross(views.views[0], size);
    const std::vector<glm::vec4> points = randomPoints();
    const std::vector<glm::vec4> outputs = runLightViews(light, views, size, points);
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
      EXPECT_EQ(outputs[3 * i + 1].z, seen ? 0.0f : -1.0f);
      if (seen)
      {
        EXPECT_NEAR(outputs[3 * i + 1].x, texel.x, 1e-3);
        EXPECT_NEAR(outputs[3 * i + 1].y, texel.y, 1e-3);
        ++found;
      }
    }
    EXPECT_GT(found, 500u);
    EXPECT_LT(found, 6000u);
  }
}

TEST(LightViewsGlsl, AgreesOnWhatLiesInABox)
{
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->Initialize();
  window->MakeCurrent();

  const ShadowLight light = boxLight({ 0.0, 1.0, -0.5 }, { 0.0, 0.0, 0.0 }, { 1.1, 1.3, 0.7 });
  const LightViews views =
    fitLightViews(light, glm::dvec3(0.0), { glm::dvec3(-1.0), glm::dvec3(1.0) }, 64);
  const ShadowRayLight rayLight(light, glm::dvec3(0.0));
  const std::vector<glm::vec4> points = randomPoints();
  const std::vector<glm::vec4> outputs = runLightViews(light, views, 64, points);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool expected = insideBox(glm::vec3(points[i]), rayLight.box);
    EXPECT_EQ(outputs[3 * i + 1].w != 0.0f, expected);
    inside += expected ? 1 : 0;
  }
  EXPECT_GT(inside, 500u);
  EXPECT_LT(inside, 5000u);
}

} // namespace
} // namespace gnomon::test
