// `montecarlo` in frames: against known penumbrae, against rays to the same points of the light,
// and what its settings change.

#include "PassScene.h"

#include "lights/vtkGnomonAreaLight.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/base/Gl.h"

#include <vtkMatrix4x4.h>
#include <vtkPlaneSource.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon::test;
using gnomon::VisibilityImages;

namespace
{

using SettingList = std::vector<std::pair<const char*, const char*>>;

struct Errors
{
  double meanAbsolute = 0.0;
  std::size_t wrong = 0; ///< pixels that are off by more than a half
};

Errors errorsOf(const std::vector<float>& visibility, const std::vector<float>& truth)
{
  Errors errors;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    const double off = std::abs(static_cast<double>(visibility[i]) - truth[i]);
    errors.meanAbsolute += off / static_cast<double>(truth.size());
    errors.wrong += off > 0.5 ? 1 : 0;
  }
  return errors;
}

std::size_t differing(const std::vector<float>& a, const std::vector<float>& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += a[i] != b[i] ? 1 : 0;
  }
  return count;
}

/// Whether a light's classes are those of its pixels, as many as are counted, and a decision is
/// what its class says.
void expectClassesOfPixels(
  const VisibilityImages& kept, const std::vector<gnomon::ClassCount>& counted)
{
  std::vector<std::int64_t> pixels(counted.size(), 0);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
  {
    const std::size_t pixelClass = kept.classes[0].ofPixels[i];
    ++pixels.at(pixelClass);
    const float v = kept.visibility[0][i];
    switch (pixelClass)
    {
      case 0: // no receiver
        wrong += kept.coverage[i] != 0.0f ? 1 : 0;
        break;
      case 1: // turned away
      case 3: // in shadow by bounds
        wrong += v != 0.0f ? 1 : 0;
        break;
      case 2: // lit by bounds
        wrong += v != 1.0f ? 1 : 0;
        break;
      default:
        break;
    }
  }
  EXPECT_EQ(wrong, 0u);
  for (std::size_t i = 0; i < counted.size(); ++i)
  {
    EXPECT_EQ(pixels[i], counted[i].pixels) << counted[i].name;
    EXPECT_EQ(counted[i].name, kept.classes[0].classes.at(i).name);
  }
}

class MonteCarlo : public PassTest
{
protected:
  /// A box and a sphere over a floor, under a lamp.
  void buildScene()
  {
    this->floor = this->scene.addFloor(4.0);
    this->scene.addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
    this->scene.addSphere({ 1.3, 0.8, 1.4 }, 0.5);
    this->scene.lookFrom({ 2.0, -8.0, 7.0 });
    this->lamp->SetPosition(-2.0, -2.5, 6.0);
    this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
    this->lamp->SetConeAngle(50.0);
    this->lamp->SetShapeToRectangle();
    this->lamp->SetWidth(1.0);
    this->lamp->SetHeight(1.0);
  }

  /// A plate that ends at x = 0 over a floor that casts nothing, seen from above, whose shadow ends
  /// around x = 1.
  void buildHalfPlane()
  {
    this->floor = this->scene.addFloor(6.0);
    vtkGnomonPropKeys::SetCasts(this->floor, false);
    this->scene.addBox({ -8.0, -8.0, 2.0 }, { 0.0, 8.0, 2.001 });
    this->scene.lookDown(0.5, 1.0, 0.0);
    this->lamp->SetPosition(-4.0, 0.0, 10.0);
    this->lamp->SetFocalPoint(-4.0, 0.0, 0.0);
    this->lamp->SetConeAngle(60.0);
    this->lamp->SetShapeToRectangle();
    this->lamp->SetWidth(2.0);
    this->lamp->SetHeight(2.0);
  }
  /// The visible share of that lamp: its side is 2, at height 10, the plate's 2.
  static double halfPlaneAt(double x) { return std::clamp(0.5 + 2.0 * (x - 1.0), 0.0, 1.0); }
  /// By how much the pixels in its penumbra are off.
  static double rmsOfHalfPlane(const VisibilityImages& kept)
  {
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
    {
      const double expected = halfPlaneAt(positionOf(kept, i).x);
      if (expected > 0.0 && expected < 1.0)
      {
        squares += std::pow(kept.visibility[0][i] - expected, 2.0);
        count += 1.0;
      }
    }
    return std::sqrt(squares / count);
  }

  const VisibilityImages& draw(const char* technique, const SettingList& settings)
  {
    this->scene.pass->SetTechnique(technique);
    for (const auto& [name, value] : settings)
    {
      this->scene.pass->SetSetting(name, value);
    }
    return drawKept(this->scene);
  }
  std::vector<float> visibility(const char* technique, const SettingList& settings)
  {
    return this->draw(technique, settings).visibility.at(0);
  }
  /// Of rays to the same points.
  std::vector<float> truth()
  {
    return this->visibility(
      "raytraced", { { "light_sampling", "jittered" }, { "light_samples", "9" } });
  }

  PassScene scene{ 160, 120 };
  vtkNew<vtkGnomonAreaLight> lamp;
  vtkActor* floor = nullptr;
};

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, hasThePenumbraOfAHalfPlane)
{
  this->buildHalfPlane();
  this->scene.renderer->AddLight(this->lamp);
  double before = 1.0;
  for (const int rays : { 1, 2, 3, 4, 8 })
  {
    const VisibilityImages& kept = this->draw(
      "montecarlo", { { "mc_rays", std::to_string(rays).c_str() }, { "mc_filter", "0" } });
    EXPECT_EQ(this->scene.report().lights[0].lightSamples, rays * rays);
    // Of the pixels in the penumbra: how visibility rises across it.
    double count = 0.0;
    double sumX = 0.0;
    double sumV = 0.0;
    double sumXX = 0.0;
    double sumXV = 0.0;
    for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
    {
      const double x = positionOf(kept, i).x;
      const double expected = halfPlaneAt(x);
      const double v = kept.visibility[0][i];
      if (expected <= 0.0 || expected >= 1.0)
      {
        EXPECT_NEAR(v, expected, 1.0 / rays) << x; // a texel's width
        continue;
      }
      count += 1.0;
      sumX += x;
      sumV += v;
      sumXX += x * x;
      sumXV += x * v;
    }
    ASSERT_GT(count, 2000.0);
    const double slope = (count * sumXV - sumX * sumV) / (count * sumXX - sumX * sumX);
    EXPECT_NEAR(slope, 2.0, 0.1) << rays << " x " << rays << " rays: the width within 5 %";
    EXPECT_NEAR(sumV / count, halfPlaneAt(sumX / count), 0.01) << rays;
    const double rms = rmsOfHalfPlane(kept);
    // What a line across the light makes jittered rays err by.
    const double expected = std::sqrt(1.0 / (6.0 * rays * rays * rays));
    EXPECT_NEAR(rms, expected, 0.05 * expected) << rays;
    EXPECT_LT(rms, before);
    before = rms;
    EXPECT_LE(rms, rays == 2 ? 0.15 : rays == 3 ? 0.082 : 1.0) << "specified: " << rays;
  }
  // Without the grid, as `raytraced` can have them: sqrt(1 / 54) is expected, and 0.135 specified.
  const double random = rmsOfHalfPlane(
    this->draw("raytraced", { { "light_sampling", "random" }, { "light_samples", "9" } }));
  EXPECT_NEAR(random, 0.135, 0.05 * 0.135);
}

//------------------------------------------------------------------------------
/// Visibility column by column, each of which has its own distance from the edge: an error that
/// cancels over the penumbra shows.
TEST_F(MonteCarlo, hasTheProfileOfAHalfPlane)
{
  this->buildHalfPlane();
  this->scene.window->SetSize(64, 600);
  this->scene.lookDown(2.6, 1.0, 0.0);
  this->scene.renderer->AddLight(this->lamp);
  for (const bool ofMany : { false, true })
  {
    if (ofMany)
    {
      // A caster outside of the picture, with its shadow: the plate no longer ends where its map
      // does, but within a texel. Half of one, 8e-3 across the plate, moves the shadow by a quarter
      // more, and visibility by 0.02.
      this->scene.addBox({ 3.0, 5.0, 1.0 }, { 4.1, 6.0, 1.001 });
    }
    const VisibilityImages& kept = this->draw("montecarlo", { { "mc_filter", "0" } });
    int across = 0;
    const std::vector<double> profile = columnMeans(kept);
    for (std::size_t column = 0; column < profile.size(); ++column)
    {
      const double expected = halfPlaneAt(positionOf(kept, column).x);
      EXPECT_NEAR(profile[column], expected, ofMany ? 0.02 : 0.01) << "column " << column;
      across += expected > 0.0 && expected < 1.0 ? 1 : 0;
    }
    EXPECT_GT(across, 50);
  }
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, agreesWithRaysToTheSamePointsOfAllLights)
{
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  const auto expectAgreement = [&](const std::string& what)
  {
    const std::vector<float> truth = this->truth();
    const Errors errors = errorsOf(this->visibility("montecarlo", { { "mc_filter", "0" } }), truth);
    EXPECT_GT(
      std::count_if(truth.begin(), truth.end(), [](float v) { return v > 0.0f && v < 1.0f; }), 200)
      << what;
    EXPECT_LT(errors.meanAbsolute, 0.004) << what;
    EXPECT_LT(errors.wrong, truth.size() / 1000) << what;
  };
  expectAgreement("a rectangle");
  this->lamp->SetShapeToDisk();
  this->lamp->SetRadius(0.6);
  expectAgreement("a disk");
  this->lamp->SetConeAngle(70.0);
  expectAgreement("a disk of a wide cone");
  this->lamp->SetConeAngle(allDirections);
  expectAgreement("a ball or disk of a point light");
  this->lamp->PositionalOff();
  this->lamp->SetRadius(12.0);
  expectAgreement("a sun");
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, decidesByBoundsWhatRaysWouldSay)
{
  this->buildScene();
  this->scene.addBox({ -3.5, 0.0, 1.0 }, { -1.5, 3.0, 2.0 });
  vtkGnomonPropKeys::SetCasts(this->floor, false);
  this->scene.renderer->AddLight(this->lamp);
  for (const char* layers : { "peeled", "near_far", "near" })
  {
    const SettingList settings = { { "mc_filter", "0" }, { "mc_layers", layers } };
    this->draw("montecarlo", settings);
    this->scene.pass->SetSetting("mc_classify", "off");
    const std::vector<float> searched = this->visibility("montecarlo", {});
    std::int64_t searches = 0;
    for (const char* classify : { "off", "pixels", "rays" })
    {
      const VisibilityImages& kept = this->draw("montecarlo", { { "mc_classify", classify } });
      // Rounding moves the ends of rays that are cut elsewhere.
      EXPECT_LE(differing(kept.visibility[0], searched), searched.size() / 10000) << classify;
      const auto& classes = this->scene.report().lights[0].classes;
      ASSERT_EQ(classes.size(), 6u);
      expectClassesOfPixels(kept, classes);
      const bool off = classify == std::string("off");
      EXPECT_EQ(classes[2].pixels > 0, !off) << "lit by bounds";
      EXPECT_EQ(classes[3].pixels > 0, !off) << "in shadow by bounds";
      EXPECT_TRUE(off || classes[5].pixels < searches) << "each saves searches";
      searches = classes[5].pixels;
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, findsTheSameInBothHierarchies)
{
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  const auto difference = [&]
  {
    const std::vector<float> mips = this->visibility("montecarlo", { { "mc_pyramid", "mips" } });
    const std::size_t bytes = this->scene.report().bytesMaps;
    const std::vector<float> nBuffer =
      this->visibility("montecarlo", { { "mc_pyramid", "nbuffer" } });
    EXPECT_GT(this->scene.report().bytesMaps, bytes);
    return errorsOf(mips, nBuffer).meanAbsolute;
  };
  for (const char* size : { "256", "300", "1024" })
  {
    this->scene.pass->SetSetting("map_size", size);
    this->scene.pass->SetSetting("mc_filter", "0");
    EXPECT_LT(difference(), 2e-5) << size;
    // Bounds that decide a ray say where it is blocked as nearly as they know, which the filter
    // goes by.
    this->scene.pass->SetSetting("mc_filter", "5");
    EXPECT_LT(difference(), 2e-4) << size;
  }
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, ofASmallLightIsTheHardShadow)
{
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  this->lamp->SetWidth(1e-4);
  this->lamp->SetHeight(1e-4);
  const std::vector<float> truth = this->truth();
  const Errors small = errorsOf(this->visibility("montecarlo", {}), truth);
  EXPECT_LE(small.wrong, truth.size() / 200);
  // And that of a map, filtered or not: hardly a pixel at an edge takes another value.
  for (const char* mapSize : { "512", "1024" })
  {
    const std::vector<float> hard = this->visibility("nsm", { { "map_size", mapSize } });
    for (const char* filter : { "0", "5" })
    {
      const std::vector<float> seen = this->visibility("montecarlo", { { "mc_filter", filter } });
      std::size_t others = 0;
      for (std::size_t i = 0; i < seen.size(); ++i)
      {
        others += std::abs(seen[i] - hard[i]) > 0.01f ? 1 : 0;
      }
      EXPECT_LE(others, 5u) << mapSize << ", filter " << filter;
    }
  }
  this->lamp->SetWidth(0.0);
  this->lamp->SetHeight(0.0);
  const std::vector<float> point = this->visibility("montecarlo", {});
  EXPECT_EQ(this->scene.report().lights[0].lightSamples, 1);
  EXPECT_EQ(
    std::count_if(point.begin(), point.end(), [](float v) { return v > 0.0f && v < 1.0f; }), 0);
  EXPECT_LE(errorsOf(point, truth).wrong, truth.size() / 200);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, shadowsBeginAtTheirCasters)
{
  // Along the side of a low box that the lamp does not see, the floor is dark but for two texels.
  this->scene.addFloor(4.0);
  this->scene.addBox({ -1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.2 });
  this->scene.lookDown(0.2, 0.1, 0.0);
  this->lamp->SetPosition(-6.0, 0.0, 8.0);
  this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
  this->lamp->SetConeAngle(25.0);
  this->lamp->SetShapeToDisk();
  this->lamp->SetRadius(0.01);
  this->scene.renderer->AddLight(this->lamp);
  const VisibilityImages& kept =
    this->draw("montecarlo", { { "mc_filter", "0" }, { "map_size", "512" } });
  const double texel = 2.0 * 10.0 * std::tan(25.0 * 3.14159265 / 180.0) / 512.0; // at most
  std::size_t lit = 0;
  std::size_t beside = 0;
  for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
  {
    const glm::dvec3 at = positionOf(kept, i);
    if (std::abs(at.z) < 1e-3 && at.x > 2.0 * texel && at.x < 0.15 - 2.0 * texel)
    {
      ++beside;
      lit += kept.visibility[0][i] > 0.0f ? 1 : 0;
    }
  }
  EXPECT_GT(beside, 1000u);
  EXPECT_EQ(lit, 0u);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, bodiesAreSolidAlongTheLight)
{
  // Rays enter a tower by one side and leave it by another, neither of which a sun from straight
  // above sees.
  this->scene.addFloor(2.0);
  this->scene.addBox({ -0.1, -0.1, 0.0 }, { 0.1, 0.1, 4.0 });
  this->scene.lookFrom({ 0.0, -4.0, 3.0 });
  this->scene.addSun({ 0.0, 0.0, -1.0 });
  const SettingList settings = { { "light_radius", "12" }, { "mc_filter", "0" } };
  this->draw("montecarlo", settings);
  const std::vector<float> truth = this->truth();
  const VisibilityImages& kept = this->draw("montecarlo", {});
  // On the floor: whether sides that are parallel to the light face it, rounding decides.
  std::vector<float> onFloor;
  std::vector<float> truthOnFloor;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    if (truth[i] < 1.0f && std::abs(positionOf(kept, i).z) < 1e-3)
    {
      onFloor.push_back(kept.visibility[0][i]);
      truthOnFloor.push_back(truth[i]);
    }
  }
  EXPECT_GT(onFloor.size(), 300u);
  EXPECT_LT(errorsOf(onFloor, truthOnFloor).meanAbsolute, 0.01);
}

//------------------------------------------------------------------------------
/// The points that rays begin at are drawn on the GPU, in view coordinates. Those of the CPU's
/// receivers, which they are compared with, are the camera's rays' hits (ReceiversTest.cpp).
TEST_F(MonteCarlo, raysBeginWhereTheCamerasRaysEnd)
{
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  const VisibilityImages& kept = this->draw("montecarlo", {});
  const vtkMatrix4x4* const view =
    this->scene.renderer->GetActiveCamera()->GetViewTransformMatrix();
  /// The greatest distance of a pixel's point in an image from its receiver, over that from the
  /// camera.
  const auto worstOf = [&](const std::vector<glm::vec4>& points)
  {
    double worst = 0.0;
    int compared = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::size_t row = 119 - i / 160; // OpenGL's first row is the bottom one
      const std::size_t pixel = row * 160 + i % 160;
      if (kept.coverage[pixel] == 0.0f)
      {
        continue;
      }
      const glm::dvec4 world(positionOf(kept, pixel), 1.0);
      glm::dvec3 expected(0.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int k = 0; k < 4; ++k)
        {
          expected[axis] += view->GetElement(axis, k) * world[k];
        }
      }
      const double off = glm::distance(glm::dvec3(points[i]), expected) / glm::length(expected);
      if (!(off <= worst)) // nor is it a number
      {
        worst = off;
      }
      ++compared;
    }
    EXPECT_GT(compared, 1000);
    return worst;
  };
  // The image of points is the one of the context's that has them; there is one alone.
  this->scene.window->MakeCurrent();
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  double best = 1.0;
  for (GLuint name = 1; name < 2000; ++name)
  {
    if (glIsTexture(name) == GL_FALSE)
    {
      continue;
    }
    glBindTexture(GL_TEXTURE_2D, name);
    GLint form[3] = { 0, 0, 0 };
    if (glGetError() == GL_NO_ERROR) // else it is not of this kind
    {
      glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &form[0]);
      glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &form[1]);
      glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &form[2]);
    }
    if (form[0] == 160 && form[1] == 120 && form[2] == GL_RGBA32F)
    {
      std::vector<glm::vec4> points(160 * 120);
      glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, points.data());
      best = std::min(best, worstOf(points));
    }
  }
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  EXPECT_LT(best, 1e-4);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, pointsBehindTheReceiverGiveWay)
{
  // Half of the lamp is below the floor, and what is above it is hidden behind a wall that stands
  // on nothing.
  this->scene.addFloor(6.0);
  this->scene.addBox({ -2.2, -4.0, 0.05 }, { -2.0, 4.0, 4.0 });
  this->scene.lookFrom({ 1.0, -8.0, 7.0 });
  this->lamp->SetPosition(-5.0, 0.0, 0.4);
  this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
  this->lamp->SetConeAngle(40.0);
  this->lamp->SetShapeToDisk();
  this->lamp->SetRadius(1.0);
  this->scene.renderer->AddLight(this->lamp);
  const std::vector<float> truth = this->truth();
  const Errors errors = errorsOf(this->visibility("montecarlo", { { "mc_filter", "0" } }), truth);
  EXPECT_LT(errors.meanAbsolute, 0.01);
}

//------------------------------------------------------------------------------
/// Of meshes with triangles of a texel's size, the middle of a receiver's texel may be in a
/// triangle that rises from its own.
TEST_F(MonteCarlo, smoothMeshesHaveNoDarkSpecks)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2.0, -2.0, 0.0);
  plane->SetPoint1(2.0, -2.0, 0.0);
  plane->SetPoint2(-2.0, 2.0, 0.0);
  plane->SetResolution(120, 120);
  plane->Update();
  vtkPolyData* const hills = plane->GetOutput();
  for (vtkIdType i = 0; i < hills->GetNumberOfPoints(); ++i)
  {
    double point[3];
    hills->GetPoint(i, point);
    point[2] = 0.03 * std::sin(7.0 * point[0]) * std::sin(5.0 * point[1]);
    hills->GetPoints()->SetPoint(i, point);
  }
  this->scene.add(hills);
  this->scene.lookDown(2.0, 0.0, 0.0);
  for (const double turn : { 0.0, 0.3 }) // of the mesh's rows to the map's
  {
    this->scene.renderer->RemoveAllLights();
    this->scene.addSun(glm::dvec3(turn, 0.1, -2.0));
    for (const char* size : { "64", "128", "256" })
    {
      const std::vector<float> seen = this->visibility(
        "montecarlo", { { "mc_filter", "0" }, { "light_radius", "1" }, { "map_size", size } });
      // Without it 8 to 107, with it one in two of the pictures.
      EXPECT_LE(std::count_if(seen.begin(), seen.end(), [](float v) { return v < 1.0f; }), 2)
        << size << " texels, " << turn;
      EXPECT_EQ(this->scene.report().lights[0].classes.at(1).pixels, 0); // none is turned away
    }
  }
}

//------------------------------------------------------------------------------
/// The foot of a sheet lies in texels whose centres may see the ground before it. What that lets
/// through is at most as wide as a texel, and half of that on the mean.
TEST_F(MonteCarlo, sheetsThatStandOnTheGroundLeakATexelAtMost)
{
  this->scene.addFloor(4.0);
  vtkNew<vtkPlaneSource> sheet; // over the line x = y / 3, which crosses the map's rows anywhere
  sheet->SetOrigin(-0.5, -1.5, 0.0);
  sheet->SetPoint1(0.5, 1.5, 0.0);
  sheet->SetPoint2(-0.5, -1.5, 1.0);
  this->scene.add(sheet);
  this->scene.lookDown(0.2, 0.1, 0.0);
  for (const double slope : { 0.5, 1.0, 2.0 })
  {
    this->scene.renderer->RemoveAllLights();
    this->scene.addSun(glm::dvec3(1.0, 0.0, -slope));
    for (const int mapSize : { 256, 512, 1024 })
    {
      this->scene.pass->SetMapSize(mapSize);
      const VisibilityImages& kept =
        this->draw("montecarlo", { { "mc_filter", "0" }, { "light_radius", "0.1" } });
      const double texel = 8.0 / mapSize; // along the sun, as long as a row on the floor, or longer
      double lit = 0.0;
      double farthest = 0.0;
      std::size_t looked = 0;
      for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
      {
        const glm::dvec3 at = positionOf(kept, i);
        const double behind = at.x - at.y / 3.0;
        if (std::abs(at.z) < 1e-6 && behind > 0.0 && behind < 0.9 / slope)
        {
          ++looked;
          lit += kept.visibility[0][i];
          farthest = std::max(farthest, kept.visibility[0][i] > 0.0f ? behind : 0.0);
        }
      }
      const double mean = lit / 120.0 * (0.4 / 120.0); // of the picture's rows
      EXPECT_GT(looked, 1000u);
      EXPECT_GT(farthest, 0.0) << "light that no longer leaks: say so in montecarlo.md";
      EXPECT_LT(farthest, texel) << slope << ", map " << mapSize;
      EXPECT_LT(mean, 0.6 * texel) << slope << ", map " << mapSize;
    }
  }
}

//------------------------------------------------------------------------------
/// Of Curtis' thesis, figure 4.2: a box whose length lies along the light, of which a map sees the
/// upper end only.
TEST_F(MonteCarlo, elongatedBoxesShadeWhatIsBelowThem)
{
  this->scene.addFloor(7.0);
  this->scene.addBox({ -0.7, -0.7, 0.6 }, { 0.7, 0.7, 6.0 });
  this->scene.lookFrom({ 4.5, -10.5, 5.5 }, { 0.5, 0.0, 1.6 });
  this->scene.window->SetSize(80, 60);
  this->lamp->SetPosition(-0.3, -0.4, 14.0);
  this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
  this->lamp->SetConeAngle(40.0);
  this->lamp->SetShapeToRectangle();
  this->lamp->SetWidth(3.0);
  this->lamp->SetHeight(3.0);
  this->scene.renderer->AddLight(this->lamp);
  const std::vector<float> truth =
    this->visibility("raytraced", { { "light_sampling", "sobol" }, { "light_samples", "4096" } });
  /// Mean visibility of the floor below the box, and that of `truth`.
  const auto below = [&](const VisibilityImages& kept)
  {
    glm::dvec2 sums(0.0);
    double count = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      const glm::dvec3 at = positionOf(kept, i);
      if (std::abs(at.z) < 1e-3 && std::abs(at.x) < 1.1 && std::abs(at.y) < 1.1)
      {
        sums += glm::dvec2(kept.visibility[0][i], truth[i]);
        count += 1.0;
      }
    }
    EXPECT_GT(count, 40.0);
    return sums / count;
  };
  const VisibilityImages& kept = this->draw("montecarlo", {});
  EXPECT_LT(errorsOf(kept.visibility[0], truth).meanAbsolute, 0.02);
  const glm::dvec2 found = below(kept);
  EXPECT_NEAR(found.x, found.y, 0.05);
  // Whoever takes the upper end for endless has it darker.
  const glm::dvec2 endless = below(this->draw("montecarlo", { { "mc_layers", "near" } }));
  EXPECT_GT(endless.y - endless.x, 0.05);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, turnedAwayPixelsAndOnlyTheyAreDarkWithoutRays)
{
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  for (const char* layers : { "peeled", "near_far" })
  {
    const VisibilityImages& kept =
      this->draw("montecarlo", { { "mc_filter", "0" }, { "mc_layers", layers } });
    std::size_t turned = 0;
    for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
    {
      const std::uint8_t pixelClass = kept.classes[0].ofPixels[i];
      if (pixelClass == 0)
      {
        continue;
      }
      const double cosine = cosineTowards(kept, i, this->lamp);
      if (std::abs(cosine) > 1e-5)
      {
        ASSERT_EQ(pixelClass == 1, cosine < 0.0) << i;
      }
      turned += pixelClass == 1 ? 1 : 0;
      if (pixelClass == 1)
      {
        ASSERT_EQ(kept.visibility[0][i], 0.0f) << i;
      }
    }
    EXPECT_GT(turned, 100u);
    EXPECT_EQ(static_cast<std::int64_t>(turned), this->scene.report().lights[0].classes[1].pixels);
  }
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, filterTakesNoiseOffAndLeavesWhatHasNone)
{
  this->buildScene();
  vtkGnomonPropKeys::SetCasts(this->floor, false);
  this->scene.renderer->AddLight(this->lamp);
  const std::vector<float> truth =
    this->visibility("raytraced", { { "light_sampling", "sobol" }, { "light_samples", "1024" } });
  const VisibilityImages& noisy = this->draw("montecarlo", { { "mc_filter", "0" } });
  const std::vector<float> unfiltered = noisy.visibility[0];
  const std::vector<std::uint8_t> classes = noisy.classes[0].ofPixels;
  const std::vector<float> filtered = this->visibility("montecarlo", { { "mc_filter", "2" } });
  EXPECT_LT(errorsOf(filtered, truth).meanAbsolute, errorsOf(unfiltered, truth).meanAbsolute);
  // Pixels far from all that rays decided are the same bit for bit.
  std::size_t left = 0;
  for (int y = 2; y < 118; ++y)
  {
    for (int x = 2; x < 158; ++x)
    {
      bool byBounds = true;
      for (int dy = -2; dy <= 2; ++dy)
      {
        for (int dx = -2; dx <= 2; ++dx)
        {
          byBounds &= classes[static_cast<std::size_t>((y + dy) * 160 + x + dx)] < 4;
        }
      }
      const auto pixel = static_cast<std::size_t>(y * 160 + x);
      if (byBounds)
      {
        ++left;
        ASSERT_EQ(filtered[pixel], unfiltered[pixel]) << x << ", " << y;
      }
      if (classes[pixel] < 2)
      {
        ASSERT_EQ(filtered[pixel], unfiltered[pixel]) << "turned away: " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(left, 5000u);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, oneLayerHasOuterPenumbraeOnly)
{
  this->buildHalfPlane();
  this->scene.renderer->AddLight(this->lamp);
  // What is behind the first surface is in its shadow, wherever rays go from there. From the eye
  // behind the light, 0.816 above it, that is x < 0.907, of which the lamp lights what is above
  // 0.75.
  const VisibilityImages& kept =
    this->draw("montecarlo", { { "mc_layers", "near" }, { "mc_filter", "0" } });
  std::size_t inside = 0;
  std::size_t outer = 0;
  for (std::size_t i = 0; i < kept.visibility[0].size(); ++i)
  {
    const double x = positionOf(kept, i).x;
    const float v = kept.visibility[0][i];
    if (std::abs(positionOf(kept, i).z) < 1e-3 && x > 0.77 && x < 0.89)
    {
      ++inside;
      EXPECT_EQ(v, 0.0f) << x;
    }
    outer += x > 1.0 && x < 1.2 && v > 0.0f && v < 1.0f ? 1 : 0;
  }
  EXPECT_GT(inside, 300u);
  EXPECT_GT(outer, 500u);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, pureReceiversLeaveTheLayersAlone)
{
  // Between the nearest and the farthest surface all is solid: over a floor that casts, everything
  // down to it.
  this->buildScene();
  this->scene.renderer->AddLight(this->lamp);
  const std::vector<float> truth = this->truth();
  const SettingList nearFar = { { "mc_layers", "near_far" }, { "mc_filter", "0" } };
  const double casting = errorsOf(this->visibility("montecarlo", nearFar), truth).meanAbsolute;
  vtkGnomonPropKeys::SetCasts(this->floor, false);
  const double pure = errorsOf(this->visibility("montecarlo", nearFar), truth).meanAbsolute;
  EXPECT_LT(pure, 0.02);
  EXPECT_LT(pure, 0.6 * casting);
}

//------------------------------------------------------------------------------
TEST_F(MonteCarlo, eyeLayerEmptiesWhatTheCameraSeesToBeEmpty)
{
  // Two plates and a wall that joins them: a C that opens towards the camera and the lamp. Two
  // layers hold it for a solid body.
  this->floor = this->scene.addFloor(4.0);
  vtkGnomonPropKeys::SetCasts(this->floor, false);
  this->scene.addBox({ -1.2, -1.0, 0.1 }, { 1.2, 1.0, 0.3 });
  this->scene.addBox({ -1.2, 0.8, 0.3 }, { 1.2, 1.0, 2.0 });
  this->scene.addBox({ -1.2, -1.0, 2.0 }, { 1.2, 1.0, 2.2 });
  this->scene.lookFrom({ 0.7, -8.0, 3.2 }, { 0.0, 0.0, 0.8 });
  this->lamp->SetPosition(0.0, -5.5, 6.0);
  this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
  this->lamp->SetConeAngle(35.0);
  this->lamp->SetShapeToRectangle();
  this->lamp->SetWidth(2.0);
  this->lamp->SetHeight(2.0);
  this->scene.renderer->AddLight(this->lamp);
  const std::vector<float> truth =
    this->visibility("raytraced", { { "light_sampling", "sobol" }, { "light_samples", "1024" } });
  /// Of what the camera sees inside of the C.
  const auto errorWithin = [&](const char* layers)
  {
    const VisibilityImages& kept = this->draw(
      "montecarlo", { { "mc_search", "linear" }, { "mc_filter", "0" }, { "mc_layers", layers } });
    std::vector<float> within;
    std::vector<float> truthWithin;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
    {
      const glm::dvec3 at = positionOf(kept, i);
      if (kept.coverage[i] != 0.0f && std::abs(at.x) < 1.19 && at.y > -0.99 && at.y < 0.81 &&
        at.z > 0.29 && at.z < 2.01)
      {
        within.push_back(kept.visibility[0][i]);
        truthWithin.push_back(truth[i]);
        lit += truth[i] > 0.5f ? 1 : 0;
      }
    }
    EXPECT_GT(within.size(), 2000u);
    EXPECT_GT(lit, within.size() / 4) << "the lamp shines into it";
    const double error = errorsOf(within, truthWithin).meanAbsolute;
    RecordProperty(layers, std::to_string(error));
    return error;
  };
  const double two = errorWithin("near_far");
  EXPECT_LT(errorWithin("eye"), 0.5 * two);
}

} // namespace
