// `sampled`: soft shadows by one map for each of many points of the light.

#include "HalfPlane.h"
#include "PassScene.h"

#include "lights/LightSamples.h"
#include "lights/vtkGnomonAreaLight.h"
#include "lights/vtkGnomonLightKeys.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/base/Gl.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCollectionRange.h>
#include <vtkHardwareSelector.h>
#include <vtkPlaneSource.h>
#include <vtkSelection.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon::test;
using gnomon::LightReport;
using gnomon::VisibilityImages;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

namespace
{

/// Adds a light to a scene.
using AddSampledLight = std::function<void(PassScene&)>;

AddSampledLight rectangle(
  const glm::dvec3& place, const glm::dvec3& target, double size, double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    vtkNew<vtkGnomonAreaLight> light;
    light->SetPosition(place.x, place.y, place.z);
    light->SetFocalPoint(target.x, target.y, target.z);
    light->SetConeAngle(coneAngleDegrees);
    light->SetShapeToRectangle();
    light->SetWidth(size);
    light->SetHeight(0.6 * size);
    scene.renderer->AddLight(light);
  };
}

AddSampledLight lamp(const glm::dvec3& place, const char* radius, double coneAngleDegrees)
{
  return [=](PassScene& scene)
  {
    vtkGnomonLightKeys::SetSetting(
      scene.addSpot(place, { place.x, place.y, 0.0 }, coneAngleDegrees), "light_radius", radius);
  };
}

AddSampledLight sun(const glm::dvec3& direction, const char* degrees)
{
  return [=](PassScene& scene)
  { vtkGnomonLightKeys::SetSetting(scene.addSun(direction), "light_radius", degrees); };
}

AddSampledLight sunInABox(const glm::dvec3& direction, const char* degrees, const glm::dvec3& box)
{
  return [=](PassScene& scene)
  {
    vtkLight* light = scene.addSun(2.0 * direction);
    vtkGnomonLightKeys::SetSetting(light, "light_radius", degrees);
    const double up[3] = { 0.3, 1.0, 0.0 };
    vtkGnomonLightKeys::SetBox(light, box.x, box.y, box.z, up);
  };
}

void set(PassScene& scene, const char* setting, int value)
{
  scene.pass->SetSetting(setting, std::to_string(value).c_str());
}

std::vector<float> visibilityOf(PassScene& scene)
{
  return drawKept(scene).visibility.at(0);
}

std::vector<float> visibilityBy(PassScene& scene, const char* technique)
{
  scene.pass->SetTechnique(technique);
  std::vector<float> visibility = visibilityOf(scene);
  scene.pass->SetTechnique("sampled");
  return visibility;
}

struct SampledLight
{
  const char* name;
  AddSampledLight add;
  /// The visible share of the light from (x, 0, 0), past the edge x = 0, z = 2 of a half plane at x
  /// < 0.
  std::function<double(double x)> exact = {};
};

/// Prints the name for the tests' names.
std::ostream& operator<<(std::ostream& stream, const SampledLight& named)
{
  return stream << named.name;
}
std::string nameOfSampledLight(const testing::TestParamInfo<SampledLight>& info)
{
  return info.param.name;
}

//------------------------------------------------------------------------------
// Half plane over plane
//------------------------------------------------------------------------------

constexpr double edgeHeight = 2.0;

std::vector<SampledLight> penumbras()
{
  const double height = 10.0;
  const glm::dvec3 place(0.0, 0.0, height);
  const LampPastEdge lampPastEdge{ edgeHeight, height, 1.0 };
  const SunPastEdge sunPastEdge{ edgeHeight, std::tan(glm::radians(5.0)) };
  return {
    { "square", rectangle(place, {}, 2.0, 30.0), [=](double x) { return lampPastEdge.square(x); } },
    { "disk", lamp(place, "1", 30.0), [=](double x) { return lampPastEdge.disk(x); } },
    { "ball", lamp(place, "1", allDirections), [=](double x) { return lampPastEdge.ball(x); } },
    { "sun", sun({ 0.0, 0.0, -1.0 }, "10"), [=](double x) { return sunPastEdge.disk(x); } },
  };
}

class SampledPenumbras : public testing::TestWithParam<SampledLight>
{
};

INSTANTIATE_TEST_SUITE_P(
  OfHalfPlane, SampledPenumbras, testing::ValuesIn(penumbras()), nameOfSampledLight);

/// The error of a penumbra against geometry.
struct PenumbraError
{
  std::size_t pixels = 0;    ///< pixels that see a part of the light
  double width = 0.0;        ///< the sum of v (1 - v)
  double exactWidth = 0.0;   ///< the same sum for geometry
  double offBy = 0.0;        ///< sum over all pixels, those beside the penumbra, too
  double offBySquared = 0.0; ///< sum of squares over those that see part of the light
  double mostOff = 0.0;

  double rootMeanSquare() const
  {
    return std::sqrt(this->offBySquared / static_cast<double>(this->pixels));
  }
};

/// Half a plane over a plane.
PenumbraError errorOfHalfPlane(
  const SampledLight& light, int mapSize, int samples = 256, const char* fit = "off")
{
  PassScene scene(160, 120);
  scene.addFloor(2.0);
  vtkNew<vtkPlaneSource> halfPlane;
  halfPlane->SetOrigin(-2.0, -2.0, edgeHeight);
  halfPlane->SetPoint1(0.0, -2.0, edgeHeight);
  halfPlane->SetPoint2(-2.0, 2.0, edgeHeight);
  scene.add(halfPlane);
  light.add(scene);
  scene.lookFrom({ 0.0, -1.2, 1.2 }); // from below the half plane
  scene.renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  scene.pass->SetTechnique("sampled");
  scene.pass->SetMapSize(mapSize);
  set(scene, "light_samples", samples);
  scene.pass->SetSetting("fit", fit);
  const VisibilityImages& kept = drawKept(scene);
  PenumbraError error;
  for (std::size_t i = 0; i < kept.coverage.size(); ++i)
  {
    const glm::dvec3 position = positionOf(kept, i);
    if (kept.coverage[i] == 0.0f || position.z > 0.1 || std::abs(position.y) > 0.7)
    {
      continue;
    }
    const double seen = kept.visibility[0][i];
    const double exact = light.exact(position.x);
    if (exact > 0.0 && exact < 1.0)
    {
      ++error.pixels;
      error.offBySquared += (seen - exact) * (seen - exact);
    }
    error.width += seen * (1.0 - seen);
    error.exactWidth += exact * (1.0 - exact);
    error.offBy += std::abs(seen - exact);
    error.mostOff = std::max(error.mostOff, std::abs(seen - exact));
  }
  return error;
}

//------------------------------------------------------------------------------
TEST_P(SampledPenumbras, areThoseOfGeometry)
{
  struct Case
  {
    int mapSize;
    double width; ///< the largest error, as a share
    double mostOff;
  };
  // Unless moved, the texels of all small maps would lie alike before the edge. The edge is no axis
  // of the light's samples.
  for (const auto& [mapSize, width, mostOff] : { Case{ 1024, 0.01, 0.02 }, { 64, 0.03, 0.04 } })
  {
    const PenumbraError error = errorOfHalfPlane(GetParam(), mapSize);
    EXPECT_GT(error.pixels, 500u) << mapSize;
    EXPECT_NEAR(error.width, error.exactWidth, width * error.exactWidth) << mapSize;
    EXPECT_LT(error.offBy, 0.01 * static_cast<double>(error.pixels)) << mapSize;
    EXPECT_LT(error.mostOff, mostOff) << mapSize;
  }
}

//------------------------------------------------------------------------------
/// Errors fall at least as those of random points, until the maps' texels limit them.
TEST_P(SampledPenumbras, errHalfAsMuchByFourTimesThePoints)
{
  double previous = 1.0;
  for (const int samples : { 8, 32, 128, 512 })
  {
    const double error = errorOfHalfPlane(GetParam(), 512, samples, "frame").rootMeanSquare();
    EXPECT_LT(error, 0.5 * previous) << samples;
    previous = error;
  }
  EXPECT_LT(previous, 1.5 / 255.0);
}

//------------------------------------------------------------------------------
// A box, a sphere and a sheet over a floor
//------------------------------------------------------------------------------

void addSampledThings(PassScene& scene)
{
  scene.addFloor(4.0);
  scene.addBox({ -0.9, -0.7, 0.0 }, { 0.3, 0.5, 1.0 });
  scene.addSphere({ 1.3, 0.8, 0.9 }, 0.6);
  vtkNew<vtkPlaneSource> sheet;
  sheet->SetOrigin(-1.0, 1.2, 1.0);
  sheet->SetPoint1(1.0, 1.4, 1.3);
  sheet->SetPoint2(-1.0, 2.2, 1.6);
  scene.add(sheet);
  scene.lookFrom({ 2.0, -8.0, 7.0 });
}

const glm::dvec3 slantingDown(0.7, 0.5, -2.0);

std::vector<SampledLight> allSampledLights()
{
  const glm::dvec3 above(-2.0, -2.5, 6.0);
  return {
    { "sun", sun(slantingDown, "6") },
    { "sunInABox", sunInABox(slantingDown, "12", { 4.0, 3.0, 9.0 }) },
    // The near face cuts the sphere and the sheet.
    { "sunInALowBox", sunInABox({ 0.1, 0.1, -0.5 }, "20", { 5.0, 5.0, 2.0 }) },
    { "rectangle", rectangle(above, {}, 1.0, 35.0) },
    { "wideRectangle", rectangle(above, {}, 1.5, 75.0) },
    { "rectangleInTheScene", rectangle({ -1.5, -1.5, 1.2 }, { 0.5, 0.5, 0.0 }, 0.4, 50.0) },
    { "disk", lamp(above, "0.4", 40.0) },
    { "ball", lamp({ -1.5, -1.5, 3.0 }, "0.3", allDirections) },
    { "flatPoint", rectangle(above, {}, 1.0, allDirections) },
  };
}

class SampledLights
  : public PassTest
  , public testing::WithParamInterface<SampledLight>
{
protected:
  SampledLights()
  {
    addSampledThings(this->scene);
    GetParam().add(this->scene);
    this->scene.pass->SetTechnique("sampled");
  }

  PassScene scene{ 140, 100 };
};

INSTANTIATE_TEST_SUITE_P(
  Lights, SampledLights, testing::ValuesIn(allSampledLights()), nameOfSampledLight);

//------------------------------------------------------------------------------
TEST_P(SampledLights, showWhatRaysShow)
{
  set(this->scene, "light_samples", 1024);
  const std::vector<float> truth = visibilityBy(this->scene, "raytraced");
  EXPECT_GT(
    std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0f && v < 1.0f; }), 100);
  set(this->scene, "light_samples", 128);
  const std::vector<float> seen = visibilityOf(this->scene);
  EXPECT_LT(meanVisibilityDifference(seen, truth), 0.003);
  EXPECT_EQ(this->scene.report().lights[0].lightSamples, 128);
  // Also with views fitted to the camera.
  this->scene.pass->SetSetting("fit", "frame");
  EXPECT_LT(meanVisibilityDifference(visibilityOf(this->scene), truth), 0.003);
}

//------------------------------------------------------------------------------
TEST_P(SampledLights, showTheSameInBatchesOfAnySize)
{
  set(this->scene, "light_samples", 13);
  const std::vector<float> seen = visibilityOf(this->scene);
  for (const int batch : { 1, 3, 5 })
  {
    set(this->scene, "batch", batch);
    set(this->scene, "light_seed", batch); // nothing is then reused
    visibilityOf(this->scene);
    set(this->scene, "light_seed", 0);
    EXPECT_EQ(visibilityOf(this->scene), seen) << batch;
    EXPECT_EQ(this->scene.report().mapBakes, 13);
  }
}

//------------------------------------------------------------------------------
TEST_P(SampledLights, ofNoSizeShowTheHardShadow)
{
  set(this->scene, "light_samples", 1);
  EXPECT_EQ(visibilityOf(this->scene), visibilityBy(this->scene, "nsm"));
  EXPECT_EQ(this->scene.report().lights[0].lightSamples, 1);
}

//------------------------------------------------------------------------------
class Sampled : public PassTest
{
protected:
  void renderFrames(int frames)
  {
    for (int frame = 0; frame < frames; ++frame)
    {
      this->scene.render();
    }
  }

  Sampled()
  {
    addSampledThings(this->scene);
    this->light->SetPosition(-2.0, -2.5, 6.0);
    this->light->SetFocalPoint(0.0, 0.0, 0.0);
    this->light->SetConeAngle(50.0);
    this->scene.renderer->AddLight(this->light);
    this->scene.pass->SetTechnique("sampled");
    set(this->scene, "light_samples", 32);
  }

  const LightReport& report() const { return this->scene.report().lights[0]; }

  PassScene scene{ 140, 100 };
  vtkNew<vtkGnomonAreaLight> light;
};

//------------------------------------------------------------------------------
TEST_F(Sampled, takesBoundedMemory)
{
  const std::size_t map = 64 * 64 * 4;
  const std::size_t images = 2 * 140 * 100 * 4;
  set(this->scene, "map_size", 64);
  const auto expectMaps = [&](std::size_t maps, int samples)
  {
    set(this->scene, "light_samples", samples);
    this->scene.render();
    EXPECT_EQ(this->scene.report().bytesMaps, maps * map + images);
    EXPECT_EQ(this->report().lightSamples, samples);
  };
  expectMaps(9, 64);
  expectMaps(9, 256);
  set(this->scene, "batch", 2);
  expectMaps(3, 255);
}

//------------------------------------------------------------------------------
/// OpenGL guarantees 1,024 uniform components, where hardware stores each array element as a vector
/// of four, and 16 textures. Nine lights that see all around must fit into these.
TEST_F(Sampled, batchesFitIntoTheUniformsThatOpenGlPromises)
{
  this->light->SetConeAngle(allDirections);
  this->light->SetPosition(0.3, -0.6, 1.5); // among the casters, so all faces see some
  this->light->SetShapeToRectangle();
  const auto image = makeImage(2, 2, [](int, int) { return glm::dvec3(0.8); });
  for (const bool textured : { false, true })
  {
    this->light->SetTexture(textured ? image.Get() : nullptr);
    this->scene.render();
    EXPECT_EQ(this->scene.report().mapBakes, textured ? 32 : 33);
    int programs = 0;
    for (GLuint program = 1; program < 1000; ++program)
    {
      if (!glIsProgram(program) || glGetUniformLocation(program, "batchShine") < 0)
      {
        continue;
      }
      ++programs;
      int components = 0;
      int textures = 0;
      GLint uniforms = 0;
      glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &uniforms);
      for (GLint i = 0; i < uniforms; ++i)
      {
        GLint size = 0;
        GLenum type = GL_NONE;
        GLchar name[64];
        glGetActiveUniform(
          program, static_cast<GLuint>(i), sizeof(name), nullptr, &size, &type, name);
        const bool isTexture = type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_ARRAY;
        const int vectors = type == GL_FLOAT_MAT4 ? 4 : type == GL_FLOAT_MAT3 ? 3 : 1;
        textures += isTexture ? size : 0;
        components += isTexture ? 0 : 4 * vectors * size;
      }
      EXPECT_LE(components, 1024) << textured;
      EXPECT_LE(textures, 16) << textured;
      EXPECT_GT(components, 9 * 4 * (4 + 6)) << "all lights' matrices and views";
    }
    EXPECT_GE(programs, 1);
  }
}

//------------------------------------------------------------------------------
TEST_F(Sampled, refinesFromTheHardShadowToTheWhole)
{
  for (const int samples : { 32, 33 })
  {
    set(this->scene, "progressive", 0);
    set(this->scene, "light_samples", samples);
    const std::vector<float> whole = visibilityOf(this->scene);
    const std::vector<float> hard = visibilityBy(this->scene, "nsm");
    set(this->scene, "progressive", 7);
    EXPECT_EQ(visibilityOf(this->scene), hard) << "another technique was between";
    EXPECT_EQ(this->report().lightSamples, 1);
    EXPECT_EQ(this->scene.pass->GetProgress(), 0.0);
    double progress = 0.0;
    double distance = meanVisibilityDifference(hard, whole);
    int frames = 0;
    while (progress < 1.0)
    {
      ASSERT_LT(frames++, 10);
      const std::vector<float> seen = visibilityOf(this->scene);
      EXPECT_EQ(this->report().lightSamples, std::min(samples, 8 * frames - samples % 2));
      EXPECT_GT(this->scene.pass->GetProgress(), progress);
      progress = this->scene.pass->GetProgress();
      EXPECT_LT(meanVisibilityDifference(seen, whole), distance);
      distance = meanVisibilityDifference(seen, whole);
    }
    EXPECT_EQ(distance, 0.0);
    EXPECT_EQ(visibilityOf(this->scene), whole);
    EXPECT_EQ(this->scene.report().mapBakes, 0);
    this->light->SetRadius(0.0);
    EXPECT_EQ(visibilityOf(this->scene), hard) << "without size";
    this->light->SetRadius(0.5);
  }
}

//------------------------------------------------------------------------------
/// True if a pixel differs from one of the eight around it.
bool hasEdgeBeside(const std::vector<float>& image, int width, std::size_t pixel)
{
  const int height = static_cast<int>(image.size()) / width;
  const int x = static_cast<int>(pixel) % width;
  const int y = static_cast<int>(pixel) / width;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row)
  {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column)
    {
      if (image[static_cast<std::size_t>(row * width + column)] != image[pixel])
      {
        return true;
      }
    }
  }
  return false;
}

/// With the very same 128 points of a disk, a frame adds the result of rays to its 8 points, except
/// at the edges of their shadows. There a pixel may differ by as many points as have an edge beside
/// it. Pixels are larger than texels.
TEST_F(Sampled, showsWhatRaysToItsPointsShowButAtEdges)
{
  constexpr std::size_t frames = 16;
  const glm::dvec3 place(-2.0, -2.5, 6.0);
  gnomon::ShadowLight disk;
  disk.kind = gnomon::LightKind::Spot;
  disk.positionWorld = place;
  disk.directionWorld = glm::normalize(-place);
  disk.area = gnomon::diskArea(disk.directionWorld, 1.0);
  disk.lightSamples = 8 * frames;
  this->scene.window->SetSize(80, 60);
  this->scene.lookFrom({ 2.0, -8.0, 7.0 }, { 1.0, 0.6, 0.2 });
  this->scene.renderer->GetActiveCamera()->SetViewAngle(10.0);
  this->scene.pass->SetMapSize(512);
  this->scene.pass->SetSetting("fit", "frame");

  // Per frame: the number of its points that see a pixel, and that have an edge beside the pixel.
  const std::size_t pixels = 80 * 60;
  std::vector<std::vector<int>> seeing(frames, std::vector<int>(pixels, 0));
  std::vector<std::vector<int>> edges = seeing;
  const std::vector<glm::dvec3> points = gnomon::pairedLightSamples(disk);
  ASSERT_EQ(points.size(), 8 * frames);
  this->light->SetRadius(0.0);
  this->scene.pass->SetTechnique("raytraced");
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const glm::dvec3 at = place + points[k];
    this->light->SetPosition(at.x, at.y, at.z);
    this->light->SetFocalPoint(points[k].x, points[k].y, points[k].z);
    const std::vector<float> hard = visibilityOf(this->scene);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      seeing[k / 8][i] += hard[i] == 1.0f ? 1 : 0;
      edges[k / 8][i] += hasEdgeBeside(hard, 80, i) ? 1 : 0;
    }
  }
  this->light->SetPosition(place.x, place.y, place.z);
  this->light->SetFocalPoint(0.0, 0.0, 0.0);
  this->light->SetRadius(1.0);
  this->scene.pass->SetTechnique("sampled");
  set(this->scene, "light_samples", disk.lightSamples);
  set(this->scene, "progressive", 8);
  const VisibilityImages kept = drawKept(this->scene); // the hard shadow
  int compared = 0;
  int elsewhere = 0;
  int elsewhereOfOthers = 0; // against the points of another frame
  std::vector<float> before(pixels, 0.0f);
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    const std::vector<float> seen = visibilityOf(this->scene);
    ASSERT_EQ(this->report().lightSamples, 8 * (static_cast<int>(frame) + 1));
    for (std::size_t i = 0; i < pixels; ++i)
    {
      // If all of the light is in front of the receiver, no point replaces another.
      const glm::dvec3 normal(kept.normalX[i], kept.normalY[i], kept.normalZ[i]);
      if (kept.coverage[i] == 0.0f || glm::dot(normal, place - positionOf(kept, i)) <= 1.0)
      {
        continue;
      }
      const auto added = static_cast<int>(
        std::lround(8.0 * (static_cast<double>(frame + 1) * seen[i] - frame * before[i])));
      const auto differsFrom = [&](std::size_t group)
      { return std::abs(added - seeing[group][i]) > edges[group][i]; };
      ++compared;
      elsewhere += differsFrom(frame) ? 1 : 0;
      elsewhereOfOthers += differsFrom((frame + frames / 2) % frames) ? 1 : 0;
    }
    before = seen;
  }
  EXPECT_GT(compared, 50000);
  EXPECT_LE(elsewhere, compared / 50000); // edges of shapes narrower than a pixel
  EXPECT_GT(elsewhereOfOthers, 250);
}

//------------------------------------------------------------------------------
TEST_F(Sampled, staysHardWhileTheCameraMovesAndRefinesWhenItStops)
{
  const auto at = [&](double x)
  {
    this->scene.lookFrom({ x, -8.0, 7.0 });
    return visibilityOf(this->scene);
  };
  const double way[] = { 2.0, 1.8, 1.5, 1.0 };
  this->scene.pass->SetTechnique("nsm");
  std::vector<std::vector<float>> hard;
  for (const double x : way)
  {
    hard.push_back(at(x));
  }
  this->scene.pass->SetTechnique("sampled");
  const std::vector<float> whole = at(way[3]);
  set(this->scene, "progressive", 16);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(at(way[i]), hard[static_cast<std::size_t>(i)]) << i;
    EXPECT_EQ(this->scene.report().mapBakes, 0) << i; // the centre's map is reused
  }
  at(way[3]);
  EXPECT_EQ(at(way[3]), whole);
}

//------------------------------------------------------------------------------
TEST_F(Sampled, refinesAnewWhenSomethingChanges)
{
  set(this->scene, "progressive", 16);
  vtkActor* box = this->scene.addBox({ 1.0, -2.0, 0.0 }, { 1.5, -1.5, 1.0 });
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "camera",
      [&] {
        this->scene.lookFrom({ 2.1, -8.0, 7.0 });
      } },
    { "light", [&] { this->light->SetPosition(-2.0, -2.6, 6.0); } },
    { "size", [&] { this->light->SetRadius(0.8); } },
    { "shape", [&] { this->light->SetShapeToRectangle(); } },
    { "caster", [&] { box->SetPosition(0.1, 0.0, 0.0); } },
    { "casting", [&] { vtkGnomonPropKeys::SetCasts(box, false); } },
    { "receiving", [&] { vtkGnomonPropKeys::SetReceives(box, false); } },
    { "visible", [&] { box->VisibilityOff(); } },
    { "samples", [&] { set(this->scene, "light_samples", 48); } },
    { "seed", [&] { set(this->scene, "light_seed", 3); } },
    { "map", [&] { set(this->scene, "map_size", 256); } },
    { "window", [&] { this->scene.window->SetSize(120, 90); } },
  };
  for (const auto& [what, change] : changes)
  {
    this->renderFrames(5);
    EXPECT_EQ(this->scene.pass->GetProgress(), 1.0) << what;
    change();
    this->scene.render();
    EXPECT_EQ(this->scene.pass->GetProgress(), 0.0) << what;
    this->scene.render();
    EXPECT_GT(this->scene.pass->GetProgress(), 0.3) << what;
  }
  // The centre's map is reused for all cameras.
  this->scene.lookFrom({ 2.0, -8.0, 7.0 });
  this->scene.render();
  EXPECT_EQ(this->scene.report().mapBakes, 0);
}

//------------------------------------------------------------------------------
TEST_F(Sampled, tellsOfProgress)
{
  constexpr double end = 2.0;
  std::vector<double> told;
  listenToProgress(this->scene.pass, told);
  this->renderFrames(3);
  EXPECT_TRUE(told.empty()) << "in one frame";
  set(this->scene, "progressive", 16);
  this->renderFrames(3);
  EXPECT_TRUE(told.empty()) << "all is there already";
  this->light->SetRadius(0.6);
  this->renderFrames(6);
  EXPECT_EQ(told, (std::vector<double>{ 0.0, 0.5, 1.0, end }));
  told.clear();
  this->light->SetRadius(0.7);
  this->renderFrames(2);
  this->light->SetRadius(0.8); // before the refinement ends
  this->renderFrames(6);
  EXPECT_EQ(told, (std::vector<double>{ 0.0, 0.5, 0.0, 0.5, 1.0, end }));
}

//------------------------------------------------------------------------------
TEST_F(Sampled, refinesOnAcrossSelectionsAndTexts)
{
  vtkNew<vtkTextActor> text;
  this->scene.renderer->AddViewProp(text);
  set(this->scene, "progressive", 16);
  for (const double progress : { 0.0, 0.5, 1.0, 1.0 })
  {
    text->SetInput(("frame " + std::to_string(progress)).c_str());
    this->scene.render();
    EXPECT_EQ(this->scene.pass->GetProgress(), progress);
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->scene.renderer);
    selector->SetArea(0, 0, 20, 20);
    vtkSmartPointer<vtkSelection>::Take(selector->Select());
    EXPECT_EQ(this->scene.pass->GetProgress(), progress) << "after a selection";
  }
}

//------------------------------------------------------------------------------
TEST_F(Sampled, takesAllPointsAtOnceWhereThePassDrawsSeveralViews)
{
  set(this->scene, "progressive", 16);
  const auto saysWhy = Contains(HasSubstr("renders several"));
  this->scene.render();
  EXPECT_EQ(this->scene.pass->GetProgress(), 0.0);
  EXPECT_THAT(this->scene.report().notes, Not(saysWhy));

  vtkNew<vtkRenderer> other;
  other->SetPass(this->scene.pass);
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  other->SetActiveCamera(this->scene.renderer->GetActiveCamera());
  for (vtkActor* actor : vtk::Range(this->scene.renderer->GetActors()))
  {
    other->AddActor(actor);
  }
  other->AddLight(this->light);
  this->scene.window->AddRenderer(other);
  for (int frame = 0; frame < 3; ++frame)
  {
    this->scene.window->Render();
    EXPECT_EQ(this->scene.pass->GetProgress(), 1.0);
    EXPECT_EQ(this->report().lightSamples, 32);
    EXPECT_THAT(this->scene.report().notes, saysWhy);
  }
  this->scene.window->RemoveRenderer(other);

  this->scene.window->StereoCapableWindowOn();
  this->scene.window->SetStereoTypeToAnaglyph();
  this->scene.window->StereoRenderOn();
  this->scene.window->Render();
  EXPECT_EQ(this->scene.pass->GetProgress(), 1.0);
  EXPECT_THAT(this->scene.report().notes, saysWhy);
}

//------------------------------------------------------------------------------
TEST_F(Sampled, refinesEachLight)
{
  vtkLight* other = this->scene.addSun({ -1.0, 0.5, -1.5 });
  vtkGnomonLightKeys::SetSetting(other, "light_radius", "5");
  set(this->scene, "progressive", 16);
  vtkGnomonLightKeys::SetSetting(other, "progressive", "8");
  const double expected[] = { 0.0, 0.25, 0.5, 0.75, 1.0, 1.0 };
  for (const double progress : expected)
  {
    this->scene.render();
    EXPECT_EQ(this->scene.pass->GetProgress(), progress);
  }
  // Only the changed light starts again.
  other->SetIntensity(0.5);
  this->light->SetRadius(0.4);
  this->scene.render();
  EXPECT_EQ(this->scene.report().lights[0].progress, 0.0);
  EXPECT_EQ(this->scene.report().lights[1].progress, 1.0);
}

//------------------------------------------------------------------------------
/// Unoccluded receivers are lit in every frame, by lights of any size above the floor, in it and
/// cut by it.
TEST(SampledFloor, isNoCasterOnItself)
{
  PassScene scene(60, 40);
  scene.addFloor(4.0);
  scene.lookFrom({ 2.0, -6.0, 5.0 });
  vtkNew<vtkGnomonAreaLight> light;
  scene.renderer->AddLight(light);
  set(scene, "map_size", 128);
  set(scene, "light_samples", 9);
  set(scene, "progressive", 4);
  // If the light is flat, large and near, rounding lets receivers face no point but the centre.
  for (const double height : { 3.0, 0.001, 0.0, -0.1 })
  {
    for (const bool flat : { false, true })
    {
      light->SetPosition(0.5, 0.2, height);
      light->SetFocalPoint(flat ? 0.5 : 0.4, flat ? 0.2 : 1.2, flat ? height - 1.0 : height);
      for (const auto& [cone, size] :
        { std::pair(90.0, 0.3), { 90.0, 1e4 }, { 30.0, 0.3 }, { 30.0, 1e4 } })
      {
        light->SetConeAngle(cone);
        light->SetRadius(size);
        const std::vector<float> plain = visibilityBy(scene, "nsm");
        for (int frame = 0; frame < 4; ++frame)
        {
          EXPECT_EQ(visibilityOf(scene), plain)
            << height << " " << flat << " " << cone << " " << size;
        }
        EXPECT_EQ(scene.pass->GetProgress(), 1.0);
      }
    }
  }
}

} // namespace
