// The reduction over the receivers and the resulting fit, against their twins on the CPU.

#include "shadowtech/fitting/ReceiverFit.h"

#include "lights/Bounds.h"
#include "lights/LightSpace.h"
#include "lights/Splits.h"
#include "shadowtech/base/Gl.h"
#include "shadowtech/base/GlState.h"
#include "shadowtech/base/ShaderLibrary.h"
#include "shadowtech/base/ShadowRay.h"

#include "../lights/ViewPoints.h"
#include "EstimatorGlsl.h"
#include "RandomScenes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gnomon::test
{
namespace
{

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float infiniteFloat = std::numeric_limits<float>::infinity();

/// The receivers' images, as the receivers stage renders them.
struct Image
{
  Image(int w, int h)
    : width(w)
    , height(h)
    , fragments(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), glm::vec4(0.0f))
    , points(fragments.size(), glm::vec4(0.0f))
  {
  }
  void set(std::size_t pixel, const glm::vec3& position, const glm::vec3& normal)
  {
    this->fragments[pixel] = glm::vec4(1.0f, 0.0f, normal.x, normal.y);
    this->points[pixel] = glm::vec4(position, normal.z);
  }
  glm::vec3 normal(std::size_t pixel) const
  {
    return { this->fragments[pixel].z, this->fragments[pixel].w, this->points[pixel].w };
  }

  int width;
  int height;
  std::vector<glm::vec4> fragments;
  std::vector<glm::vec4> points;
};

/// Add invalid pixels, as drivers may leave them. None of them may count.
void addDebris(Image& image, std::mt19937& random)
{
  for (std::size_t i = 0; image.points.size() > 1 && i <= image.points.size() / 8; ++i)
  {
    const std::size_t pixel = random() % image.points.size();
    glm::vec4 &fragment = image.fragments[pixel], &point = image.points[pixel];
    const int axis = static_cast<int>(i / 6 % 3);
    const float infinite = i % 12 < 6 ? infiniteFloat : -infiniteFloat;
    switch (i % 6)
    {
      case 0: // background
        fragment.x = 0.0f;
        point = glm::vec4(1e9f);
        break;
      case 1: // a surface that shows no shadows
        fragment.x = -3.0f;
        break;
      case 2:
        point[axis] = notANumber;
        break;
      case 3:
        point[axis] = infinite;
        break;
      case 4:
        fragment.z = i % 12 < 6 ? notANumber : infiniteFloat;
        break;
      default:
        image.set(pixel, point, { 0.0f, 0.0f, 1.0f }); // turned away from the light
        break;
    }
  }
}

class ReceiverFitTest : public GlslTest
{
protected:
  ~ReceiverFitTest() override { EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)); }

  void compute(ReceiverFit& fit, const ShadowLight& light, const LightViews& views,
    const Image& image, const glm::dmat4& centredFromView = glm::dmat4(1.0))
  {
    GlTexture fragments;
    GlTexture points;
    const glm::ivec2 size(image.width, image.height);
    fillTexture(fragments, GL_RGBA, { size, 0 }, image.fragments.data());
    fillTexture(points, GL_RGBA, { size, 0 }, image.points.data());
    fit.compute(light, views, { fragments.name(), points.name(), size.x, size.y }, centredFromView,
      this->library_);
  }

  ShaderLibrary library_;
};

/// A sun whose map's texels before the fit are the x and y of view coordinates, exactly. Values
/// computed from a position equal the position.
struct ExactSun
{
  static constexpr int side = 1024;

  ExactSun()
  {
    this->light.fittedToReceivers = true;
    this->light.mapSizeTexels = side;
    this->light.projection = Projection::Uniform;
    LightView view;
    view.mapFromAcross = { 2.0 / side, 0.0, 0.0, 0.0, 2.0 / side, 0.0, -1.0, -1.0, 1.0 };
    this->views.awaitFit = true;
    this->views.borderTexels = 0;
    this->views.views = { view };
  }

  /// True if the CPU counts a pixel.
  static bool counts(const Image& image, std::size_t pixel)
  {
    const glm::vec3 p = image.points[pixel];
    const glm::vec3 n = image.normal(pixel);
    return image.fragments[pixel].x > 0.0f && std::isfinite(p.x + p.y + p.z) &&
      std::isfinite(n.x + n.y + n.z) && n.z < 0.0f && p.x >= 0.0f && p.x <= side && p.y >= 0.0f &&
      p.y <= side;
  }
  static Bounds bounds(const Image& image)
  {
    Bounds result;
    for (std::size_t i = 0; i < image.points.size(); ++i)
    {
      if (counts(image, i))
      {
        result.add(glm::dvec3(image.points[i]));
      }
    }
    return result;
  }

  ShadowLight light = directionalLight({ 0.0, 0.0, 1.0 });
  LightViews views;
};

Image randomImage(int width, int height, std::mt19937& random)
{
  std::uniform_real_distribution<float> onMap(0.0f, static_cast<float>(ExactSun::side));
  std::normal_distribution<float> depth(0.0f, 1e6f);
  Image image(width, height);
  for (std::size_t i = 0; i < image.points.size(); ++i)
  {
    image.set(i, { onMap(random), onMap(random), depth(random) }, { 0.0f, 0.0f, -1.0f });
  }
  return image;
}

/// A ground of 200 x 200 seen from 2 above its middle, and the receiver of each pixel.
struct Ground
{
  Ground(const glm::dvec3& direction, int width, int height)
    : image(width, height)
  {
    const glm::dvec3 eye(0.0, 0.0, 2.0);
    const glm::dvec3 up =
      std::abs(direction.z) > 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    this->camera.viewFromCentred = glm::lookAt(eye, eye + direction, up);
    this->camera.clipFromView = glm::perspective(glm::radians(50.0), 1.0, 0.1, 1000.0);
    const glm::dvec3 normalView =
      glm::dmat3(this->camera.viewFromCentred) * glm::dvec3(0.0, 0.0, 1.0);
    for (int i = 0; i < width * height; ++i)
    {
      const glm::dvec2 pixel(i % width, i / width);
      const glm::dvec3 point = seenAt(this->camera,
        2.0 * (pixel + 0.5) / glm::dvec2(width, height) - 1.0, { 0.0, 0.0, 1.0, 0.0 });
      const glm::dvec3 inView(this->camera.viewFromCentred * glm::dvec4(point, 1.0));
      if (inView.z < 0.0 && std::max(std::abs(point.x), std::abs(point.y)) < 100.0)
      {
        this->image.set(static_cast<std::size_t>(i), inView, normalView);
      }
    }
  }

  LightViews views(const ShadowLight& light) const
  {
    const Bounds scene{ { -100.0, -100.0, 0.0 }, { 100.0, 100.0, 5.0 } };
    return fitLightViews(
      light, { glm::dvec3(0.0), scene, scene, { light.mapSizeTexels, 1 }, this->camera });
  }

  CameraView camera;
  Image image;
};

ShadowLight lightThatChoosesWarp(ShadowLight light)
{
  light.fittedToReceivers = true;
  light.fit = ViewFit::Frame;
  light.projection = Projection::Lispsm;
  light.mapSizeTexels = 512;
  return light;
}

/// Return a buffer's contents.
template <typename Number>
std::vector<Number> readBuffer(GLuint buffer)
{
  const GlStateGuard guard;
  const StorageBindingsGuard bindings;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  GLint bytes = 0;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
  glGetBufferParameteriv(GL_SHADER_STORAGE_BUFFER, GL_BUFFER_SIZE, &bytes);
  std::vector<Number> result(static_cast<std::size_t>(bytes) / sizeof(Number));
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, result.data());
  return result;
}

/// Return the bounds of the receivers in each view, after the last compute().
std::vector<Bounds> readBounds(const ReceiverFit& fit)
{
  const std::vector<std::uint32_t> keys = readBuffer<std::uint32_t>(fit.bounds());
  // Twin of ofKey() in bounds_buffer.glsl.
  const auto number = [](std::uint32_t key)
  {
    const std::uint32_t bits = (key & 0x80000000u) ? key & 0x7fffffffu : ~key;
    return static_cast<double>(glm::uintBitsToFloat(bits));
  };
  constexpr std::size_t keysOfBox = 6;
  std::vector<Bounds> result(keys.size() / keysOfBox - 1); // the last box holds distances
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    const std::uint32_t* box = &keys[keysOfBox * i];
    if (box[0] != 0xffffffffu)
    {
      result[i].lower = { number(box[0]), number(box[1]), number(box[2]) };
      result[i].upper = { -number(box[3]), -number(box[4]), -number(box[5]) };
    }
  }
  return result;
}

/// The texture of the fits; a row has a texel for each view.
struct FitTexels
{
  explicit FitTexels(const ReceiverFit& fit)
  {
    const GlStateGuard guard;
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, fit.fits().texture);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &this->views);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &this->rows);
    this->texels.resize(static_cast<std::size_t>(this->views * this->rows));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, this->texels.data());
  }
  const glm::vec4& at(int row, int view) const
  {
    return this->texels.at(static_cast<std::size_t>(row * this->views + view));
  }

  GLint views = 0;
  GLint rows = 0;
  std::vector<glm::vec4> texels;
};

std::vector<MapFit> readFits(const ReceiverFit& fit)
{
  const FitTexels texels(fit);
  std::vector<MapFit> result;
  for (int view = 0; view < texels.views; ++view)
  {
    const glm::dvec4 last(texels.at(0, view));
    result.push_back({ { last.x, last.y }, { last.z, last.w } });
  }
  return result;
}

/// Return the chosen warp, from the view's uniform map to its own, in device coordinates; the
/// identity if there was no choice.
glm::dmat3 readWarp(const ReceiverFit& fit)
{
  const FitTexels texels(fit);
  constexpr int chosenRows = 11; // fit_rows.glsl
  glm::dmat3 result(1.0);
  for (int column = 0; column < 3 && texels.rows == chosenRows; ++column)
  {
    result[column] = glm::dvec3(texels.at(chosenRows - 3 + column, 0));
  }
  return result;
}

void expectBounds(const Bounds& bounds, const Bounds& expected)
{
  EXPECT_EQ(bounds.lower, expected.lower);
  EXPECT_EQ(bounds.upper, expected.upper);
}

} // namespace

TEST_F(ReceiverFitTest, boundsMatchBruteForceOnImagesOfAnySize)
{
  const ExactSun sun;
  ReceiverFit fit;
  std::mt19937 random(41);
  for (const glm::ivec2& size : { glm::ivec2(1, 1), { 3, 7 }, { 1, 129 }, { 65, 1 }, { 64, 128 },
         { 640, 480 }, { 1023, 769 }, { 2048, 2048 } })
  {
    SCOPED_TRACE(std::to_string(size.x) + " x " + std::to_string(size.y));
    Image image = randomImage(size.x, size.y, random);
    this->compute(fit, sun.light, sun.views, image);
    expectBounds(readBounds(fit).at(0), ExactSun::bounds(image));
    addDebris(image, random);
    this->compute(fit, sun.light, sun.views, image);
    expectBounds(readBounds(fit).at(0), ExactSun::bounds(image));
  }
}

TEST_F(ReceiverFitTest, withoutReceiversNothingIsOnTheMap)
{
  const ExactSun sun;
  ReceiverFit fit;
  std::mt19937 random(43);
  Image background(37, 21);
  Image broken = randomImage(37, 21, random);
  Image away = broken;
  for (std::size_t i = 0; i < broken.points.size(); ++i)
  {
    broken.points[i].y = i % 2 == 0 ? notANumber : infiniteFloat;
    away.points[i].w = 1.0f;
  }
  for (const Image* image : { &background, &broken, &away })
  {
    this->compute(fit, sun.light, sun.views, *image);
    EXPECT_TRUE(readBounds(fit).at(0).empty());
    const MapFit last = readFits(fit).at(0);
    for (const double map : { -1.0, 0.0, 1.0 })
    {
      EXPECT_GT(last.scale.x * map + last.offset.x, 1.0);
      EXPECT_GT(last.scale.y * map + last.offset.y, 1.0);
    }
  }
}

TEST_F(ReceiverFitTest, fitsMatchTheCpus)
{
  ExactSun sun;
  ReceiverFit fit;
  std::mt19937 random(44);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < 200; ++i)
  {
    sun.light.snap = i % 2 == 0;
    sun.views.borderTexels = i % 5;
    // Parts lie beyond the map; some extents are a point or a line.
    const glm::vec2 corner = (1.2f * glm::vec2(unit(random), unit(random)) - 0.1f) * 1024.0f;
    const glm::vec2 extent = std::pow(10.0f, -5.0f * unit(random)) * 1024.0f *
      glm::vec2(i % 7 == 0 ? 0.0f : unit(random), unit(random));
    Image image(2, 1);
    image.set(0, glm::vec3(corner, 1.0f), { 0.0f, 0.0f, -1.0f });
    image.set(1, glm::vec3(corner + extent, 2.0f), { 0.0f, 0.0f, -1.0f });
    this->compute(fit, sun.light, sun.views, image);

    const MapTexels texels{ ExactSun::side, sun.views.borderTexels };
    Rectangle seen;
    for (const glm::vec4& point : image.points)
    {
      const glm::dvec2 map = glm::dvec2(point) / (0.5 * ExactSun::side) - 1.0;
      if (glm::all(glm::lessThanEqual(glm::abs(map), texels.covered().upper)))
      {
        seen.add(map);
      }
    }
    const auto expected = sun.light.snap ? fitSnappedTo(seen, texels, texels.covered())
                                         : fitTo(seen, texels, texels.covered());
    const MapFit last = readFits(fit).at(0);
    if (!expected)
    {
      EXPECT_EQ(last.scale, glm::dvec2(0.0));
      continue;
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      // A centre is rounded to 2^-24 of the map; the scale is rounded more if the extent is small.
      const double scale = expected->scale[axis];
      const double tolerance = 1e-6 * (1.0 + scale * (sun.light.snap ? 0.0 : scale));
      EXPECT_NEAR(
        last.scale[axis], scale, 1e-6 * scale + (sun.light.snap ? 0.0 : 1e-6 * scale * scale));
      // Snapping may round the other way, to the next texel.
      EXPECT_NEAR(last.offset[axis], expected->offset[axis],
        tolerance + (sun.light.snap ? 2.0 / ExactSun::side + 2e-6 * scale : 0.0));
    }
  }
}

TEST_F(ReceiverFitTest, distancesSplitTheReceivers)
{
  ExactSun sun;
  sun.light.projection = Projection::Splits;
  sun.views.layout = ViewLayout::Splits;
  ReceiverFit fit;
  std::mt19937 random(45);
  std::uniform_real_distribution<float> onMap(0.0f, 1024.0f);
  std::uniform_real_distribution<float> logarithm(0.0f, 3.0f);
  for (const int splits : { 1, 2, 4, 8 })
  {
    for (const double lambda : { 0.0, 0.5, 1.0 })
    {
      sun.light.splits = splits;
      sun.light.splitLambda = lambda;
      sun.views.views.resize(static_cast<std::size_t>(splits), sun.views.views[0]);
      Image image(317, 201);
      Bounds all;
      for (std::size_t i = 0; i < image.points.size(); ++i)
      {
        // The camera looks along -z.
        image.set(i, { onMap(random), onMap(random), -std::pow(10.0f, logarithm(random)) },
          { 0.0f, 0.0f, -1.0f });
        all.add(glm::dvec3(image.points[i]));
      }
      this->compute(fit, sun.light, sun.views, image);
      const std::vector<double> distances =
        splitDistances({ -all.upper.z, -all.lower.z }, splits, lambda);
      std::vector<Bounds> expected(static_cast<std::size_t>(splits));
      for (const glm::vec4& point : image.points)
      {
        std::size_t split = 0;
        while (split + 1 < expected.size() && -point.z >= distances[split + 1])
        {
          ++split;
        }
        expected[split].add(glm::dvec3(point));
      }
      const std::vector<Bounds> bounds = readBounds(fit);
      ASSERT_EQ(bounds.size(), expected.size());
      EXPECT_EQ(bounds.front().upper.z, all.upper.z);
      EXPECT_EQ(bounds.back().lower.z, all.lower.z);
      for (std::size_t i = 0; i < expected.size(); ++i)
      {
        // Points next to a split may go to either side.
        EXPECT_NEAR(bounds[i].lower.x, expected[i].lower.x, 4.0);
        EXPECT_NEAR(bounds[i].upper.y, expected[i].upper.y, 4.0);
        EXPECT_NEAR(bounds[i].lower.z, expected[i].lower.z, -2e-3 * expected[i].lower.z);
        EXPECT_NEAR(bounds[i].upper.z, expected[i].upper.z, -2e-3 * expected[i].upper.z);
      }
    }
  }
}

TEST_F(ReceiverFitTest, boundsOfAllKindsOfLight)
{
  const Bounds scene{ glm::dvec3(-1.0, -0.8, -0.6), glm::dvec3(1.0, 0.9, 0.7) };
  const Bounds receivers{ glm::dvec3(-1.5), glm::dvec3(1.5) };
  const glm::dvec3 below(0.1, -0.05, -3.0);
  std::vector<ShadowLight> lights = { directionalLight({ 1.0, 0.4, -1.5 }),
    boxLight({ 0.0, 0.1, -1.0 }, { 0.0, 0.0, 0.7 }, { 1.1, 1.3, 2.2 }),
    spotLight({ 0.3, 0.2, 3.0 }, below, 12.0), spotLight({ 0.1, 0.0, 0.9 }, below, 80.0),
    pointLight({ 0.1, -0.1, 0.05 }) };
  Random random(46);
  const glm::dmat4 viewFromCentred =
    glm::lookAt(glm::dvec3(3.0, -4.0, 2.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
  // Sees all of it.
  const CameraView camera{ viewFromCentred, glm::ortho(-9.0, 9.0, -9.0, 9.0, -9.0, 9.0) };
  const glm::dmat4 centredFromView = glm::inverse(viewFromCentred);
  std::size_t viewsSeen = 0;
  for (ShadowLight& light : lights)
  {
    SCOPED_TRACE("light " + std::to_string(&light - lights.data()));
    light.fittedToReceivers = true;
    light.projection = Projection::Uniform;
    light.mapSizeTexels = 512;
    light.fit = ViewFit::Frame;
    const LightViews views =
      fitLightViews(light, { glm::dvec3(0.0), scene, receivers, { 512, 1 }, camera });
    ASSERT_FALSE(views.views.empty());
    Image image(200, 150);
    for (std::size_t i = 0; i < image.points.size(); ++i)
    {
      const glm::dvec3 p = inCube(random, 1.5);
      image.set(i, glm::dvec3(viewFromCentred * glm::dvec4(p, 1.0)),
        glm::dmat3(viewFromCentred) * unitVector(random));
    }
    ReceiverFit fit;
    this->compute(fit, light, views, image, centredFromView);

    const ShadowRayLight rayLight(light, glm::dvec3(0.0));
    const MapTexels texels{ 512, views.borderTexels };
    const double outermost = texels.covered().upper.x;
    std::vector<Bounds> expected(static_cast<std::size_t>(mostViews(light)));
    for (std::size_t i = 0; i < image.points.size(); ++i)
    {
      const glm::dvec3 p(centredFromView * glm::dvec4(glm::dvec3(image.points[i]), 1.0));
      const glm::dvec3 n = glm::dmat3(centredFromView) * glm::dvec3(image.normal(i));
      const bool reached = visitShadowRays(
        rayLight, [&](const auto& rayFrom, float) { return rayFrom(p, n, 0.0f).traced; });
      const LightView* const view = viewOf(views, p);
      if (!reached || !view)
      {
        continue;
      }
      const glm::dvec3 pView(view->rays.viewFromCentred * glm::dvec4(p, 1.0));
      const glm::dvec2 map = mapped(view->mapFromAcross, view->rays.across(pView));
      if (glm::all(glm::lessThanEqual(glm::abs(map), glm::dvec2(outermost))))
      {
        expected[static_cast<std::size_t>(view - views.views.data())].add(
          glm::dvec3((map + 1.0) * 256.0, pView.z));
      }
    }
    const std::vector<Bounds> bounds = readBounds(fit);
    ASSERT_EQ(bounds.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      ASSERT_EQ(bounds[i].empty(), expected[i].empty()) << "view " << i;
      if (expected[i].empty())
      {
        continue;
      }
      ++viewsSeen;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double tolerance = axis < 2 ? 512e-4 : 1e-4 * (1.0 + std::abs(expected[i].upper.z));
        EXPECT_NEAR(bounds[i].lower[axis], expected[i].lower[axis], tolerance) << "view " << i;
        EXPECT_NEAR(bounds[i].upper[axis], expected[i].upper[axis], tolerance) << "view " << i;
      }
    }
  }
  EXPECT_GE(viewsSeen, 12u);
}

TEST_F(ReceiverFitTest, choosesTheWarpWithTheSmallestMeanTexel)
{
  std::mt19937 random(47);
  std::size_t warped = 0;
  std::size_t uniform = 0;
  for (const glm::dvec3& direction :
    { glm::dvec3(0.0, 1.0, -0.1), { 0.3, 1.0, -0.5 }, { 0.02, 0.01, -1.0 } })
  {
    for (const ShadowLight& kind : { directionalLight({ 1.0, -0.2, -0.5 }),
           directionalLight({ 0.1, 0.2, -1.0 }), directionalLight({ 0.0, 1.0, -0.12 }),
           spotLight({ -20.0, 30.0, 40.0 }, { 5.0, 30.0, 0.0 }, 50.0) })
    {
      const ShadowLight light = lightThatChoosesWarp(kind);
      Ground ground(direction, 257, 190);
      addDebris(ground.image, random);
      const LightViews views = ground.views(light);
      ASSERT_EQ(views.views.size(), 1u);
      const LightView& view = views.views.front();
      ASSERT_EQ(view.warps.size(), 20u);
      ReceiverFit fit;
      this->compute(fit, light, views, ground.image, glm::inverse(ground.camera.viewFromCentred));

      std::vector<float> sides = readBuffer<float>(fit.texelSides());
      ASSERT_EQ(sides.size(), view.warps.size());
      std::size_t nearest = 0;
      std::vector<double> distances;
      for (const glm::dmat3& warp : view.warps)
      {
        const glm::dmat3 difference = readWarp(fit) - warp * glm::inverse(view.mapFromAcross);
        distances.push_back(
          glm::length(difference[0]) + glm::length(difference[1]) + glm::length(difference[2]));
        nearest = distances.back() < distances[nearest] ? distances.size() - 1 : nearest;
      }
      EXPECT_LT(distances[nearest], 1e-4);
      sides.front() *= static_cast<float>(largestSideShare);
      const float least = *std::min_element(sides.begin(), sides.end());
      EXPECT_GT(least, 0.0f);
      EXPECT_LE(sides[nearest], 1.001f * least) << "warp " << nearest;
      ++(nearest > 0 ? warped : uniform);
    }
  }
  EXPECT_GE(warped, 4u);
  EXPECT_GE(uniform, 3u);
}

TEST_F(ReceiverFitTest, warpIsUniformInDegenerateViews)
{
  const ShadowLight light = lightThatChoosesWarp(directionalLight({ 1.0, -0.2, -0.5 }));
  const auto expectUniform = [&](
                               const Ground& ground, const ShadowLight& shining, const Image& image)
  {
    const LightViews views = ground.views(shining);
    EXPECT_EQ(views.views.size(), 1u);
    ReceiverFit fit;
    this->compute(fit, shining, views, image, glm::inverse(ground.camera.viewFromCentred));
    const glm::dmat3 difference = readWarp(fit) - glm::dmat3(1.0);
    for (int column = 0; column < 3; ++column)
    {
      EXPECT_LT(glm::length(difference[column]), 1e-6);
    }
  };
  Ground ground({ 0.0, 1.0, -0.1 }, 64, 64);
  expectUniform(ground, light, Image(64, 64)); // background
  Image broken = ground.image;
  for (glm::vec4& point : broken.points)
  {
    point.x = notANumber;
  }
  expectUniform(ground, light, broken);
  Image single(1, 1);
  single.set(0, ground.image.points[64 * 8 + 32], ground.image.normal(64 * 8 + 32));
  expectUniform(ground, light, single);
  // Light along the view.
  const glm::dvec3 ahead =
    -glm::dvec3(glm::transpose(glm::dmat3(ground.camera.viewFromCentred))[2]);
  expectUniform(ground, lightThatChoosesWarp(directionalLight(ahead)), ground.image);
  ground.camera.clipFromView = glm::ortho(-20.0, 20.0, -20.0, 20.0, 0.1, 300.0);
  expectUniform(ground, light, ground.image);
}

} // namespace gnomon::test
