// Lights with textures in frames: coloured visibility against known values and rays, and the
// support of techniques and routes.

#include "PassScene.h"
#include "Scene.h"

#include "lights/LightManager.h"
#include "lights/vtkGnomonAreaLight.h"
#include "plugin/vtkGnomonLightSamplingPass.h"
#include "plugin/vtkGnomonPropKeys.h"
#include "shadowtech/Registry.h"

#include <vtkActorCollection.h>
#include <vtkCollectionRange.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkLightCollection.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace gnomon::test;
using gnomon::LightChannel;
using gnomon::VisibilityImages;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{

/// Techniques that support textures.
const std::vector<const char*> seeing = { "raytraced", "penumbra", "montecarlo", "sampled",
  "coherence" };

using Colour = glm::dvec3;
constexpr Colour red(1.0, 0.0, 0.0);
constexpr Colour green(0.0, 1.0, 0.0);
constexpr Colour blue(0.0, 0.0, 1.0);
constexpr Colour white(1.0);
constexpr Colour black(0.0);

/// The left half red, the right half blue.
vtkSmartPointer<vtkImageData> makeRedAndBlue()
{
  return makeImage(2, 1, [](int x, int) { return x == 0 ? red : blue; });
}
vtkSmartPointer<vtkImageData> makeChecker(int side)
{
  return makeImage(side, side, [](int x, int y) { return (x + y) % 2 == 0 ? white : black; });
}

class LightTextures : public PassTest
{
protected:
  LightTextures()
  {
    this->lamp->SetPosition(0.0, 0.0, 10.0);
    this->lamp->SetFocalPoint(0.0, 0.0, 0.0);
    this->lamp->SetConeAngle(50.0);
    this->lamp->SetExponent(0.0);
    this->lamp->SetShapeToRectangle();
    this->lamp->SetWidth(2.0);
    this->lamp->SetHeight(2.0);
    this->scene.renderer->AddLight(this->lamp);
    this->scene.pass->SetSetting("light_samples", "256");
    this->scene.pass->SetSetting("mc_rays", "10");
    this->scene.pass->SetSetting("mc_filter", "0");
    this->scene.lookDown(1.2);
  }

  /// Add a plate halfway to the lamp. It hides the part of the lamp on one side of its middle from
  /// the origin.
  void addPlate(const glm::dvec3& lower, const glm::dvec3& upper)
  {
    this->scene.addBox(lower + glm::dvec3(0.0, 0.0, 5.0), upper + glm::dvec3(0.0, 0.0, 5.001));
  }
  void addFloor()
  {
    this->floor = this->scene.addFloor(6.0);
    vtkGnomonPropKeys::SetCasts(this->floor, false);
  }

  /// A box and a sphere over a floor that casts, under a large lamp.
  void buildScene()
  {
    this->scene.addFloor(4.0);
    this->scene.addBox({ -0.7, -0.7, 0.0 }, { 0.7, 0.7, 1.0 });
    this->scene.addSphere({ 1.3, 0.8, 1.4 }, 0.5);
    this->scene.lookFrom({ 2.0, -8.0, 7.0 });
    this->lamp->SetPosition(-2.0, -2.5, 6.0);
  }

  const VisibilityImages& draw(const std::string& technique)
  {
    this->scene.pass->SetTechnique(technique.c_str());
    return drawKept(this->scene);
  }

  /// Expect visibility to equal `expected` at the places of all pixels of the floor.
  void expectFloor(const std::string& technique,
    const std::function<Colour(const glm::dvec3&)>& expected, double mean, double most)
  {
    const VisibilityImages& kept = this->draw(technique);
    ASSERT_THAT(kept.sceneIndices, ElementsAre(0, 0, 0));
    ASSERT_THAT(
      kept.channels, ElementsAre(LightChannel::Red, LightChannel::Green, LightChannel::Blue));
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      double sum = 0.0;
      double worst = 0.0;
      double count = 0.0;
      for (std::size_t i = 0; i < kept.coverage.size(); ++i)
      {
        const glm::dvec3 place = positionOf(kept, i);
        if (kept.coverage[i] > 0.0f && std::abs(place.z) < 1e-4)
        {
          const double off =
            std::abs(kept.visibility[channel][i] - expected(place)[static_cast<int>(channel)]);
          sum += off;
          worst = std::max(worst, off);
          ++count;
        }
      }
      EXPECT_GT(count, 0.4 * static_cast<double>(kept.coverage.size()));
      EXPECT_LT(sum / count, mean) << technique << ", channel " << channel;
      EXPECT_LT(worst, most) << technique << ", channel " << channel;
    }
  }

  PassScene scene{ 48, 36 };
  vtkNew<vtkGnomonAreaLight> lamp;
  vtkActor* floor = nullptr;
};

//------------------------------------------------------------------------------
TEST_F(LightTextures, haveTheirMeanWhereNothingHidesThem)
{
  this->addFloor();
  this->scene.pass->SetSetting("mc_classify", "off"); // bounds would decide all without rays
  for (const bool disk : { false, true })
  {
    disk ? this->lamp->SetShapeToDisk() : this->lamp->SetShapeToRectangle();
    for (const int side : { 2, 5, 8 })
    {
      this->lamp->SetTexture(makeChecker(side));
      double mean = side % 2 == 0 ? 0.5 : 13.0 / 25.0;
      if (disk && side == 5)
      {
        mean = 0.48284; // of a disk, by 3 million points
      }
      for (const gnomon::TechniqueEntry& technique : gnomon::registry())
      {
        this->expectFloor(
          technique.name,
          [&](const glm::dvec3&) {
            return Colour{ mean, mean, mean };
          },
          1e-3, 1e-3);
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, areSeenHalfByHalf)
{
  this->addFloor();
  this->addPlate({ -8.0, -8.0, 0.0 }, { 0.0, 8.0, 0.0 });
  this->lamp->SetTexture(makeRedAndBlue());
  // From x, the part of the lamp beyond -x is visible. Looking up, the picture's right is -x.
  const auto expected = [](const glm::dvec3& place)
  {
    return Colour{ 0.5 * std::clamp(1.0 + place.x, 0.0, 1.0), 0.0,
      0.5 * std::clamp(place.x, 0.0, 1.0) };
  };
  this->expectFloor("raytraced", expected, 0.003, 0.03);
  this->expectFloor("penumbra", expected, 0.003, 0.03);
  this->expectFloor("sampled", expected, 0.003, 0.03);
  this->expectFloor("montecarlo", expected, 0.01, 0.1);
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, standUpright)
{
  this->addFloor();
  this->addPlate({ -8.0, -8.0, 0.0 }, { 8.0, 0.0, 0.0 });
  this->lamp->SetTexture(makeImage(1, 2, [](int, int y) { return y == 0 ? green : red; }));
  const auto expected = [](const glm::dvec3& place)
  {
    return Colour{ 0.5 * std::clamp(1.0 + place.y, 0.0, 1.0), 0.5 * std::clamp(place.y, 0.0, 1.0),
      0.0 };
  };
  for (const char* technique : { "raytraced", "penumbra", "sampled" })
  {
    this->expectFloor(technique, expected, 0.003, 0.03);
  }
  this->expectFloor("montecarlo", expected, 0.01, 0.1);
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, giveWayWithTheirColoursBehindTheReceiver)
{
  // The lowest quarter of a lamp beside the floor (green) is below it. The highest quarter (red)
  // counts twice there.
  this->addFloor();
  this->lamp->SetPosition(-5.0, 0.0, 0.5);
  this->lamp->SetFocalPoint(0.0, 0.0, 0.5);
  this->lamp->SetUp(0.0, 0.0, 1.0);
  this->lamp->SetTexture(
    makeImage(1, 4, [](int, int y) { return y == 0 ? green
                                       : y == 3    ? red
                                                   : blue; }));
  for (const char* technique : seeing)
  {
    this->expectFloor(
      technique,
      [](const glm::dvec3&) {
        return Colour{ 0.5, 0.0, 0.5 };
      },
      0.02, 0.2);
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, giveWayWhereTheyAreCutBetweenTheRim)
{
  // If a lamp like that above stands on its corner, only that corner is below the floor. There may
  // be no rim point in it.
  this->addFloor();
  this->lamp->SetPosition(-5.0, 0.0, 1.3);
  this->lamp->SetFocalPoint(0.0, 0.0, 1.3);
  this->lamp->SetTexture(
    makeImage(16, 16, [](int x, int y) { return x + y < 6 || x - y > 12 ? green : blue; }));
  for (int turn = 0; turn < 4; ++turn)
  {
    this->lamp->SetUp(0.0, turn % 2 == 0 ? 1.0 : -1.0, turn < 2 ? 1.0 : -1.0);
    const VisibilityImages truth = this->draw("raytraced");
    EXPECT_EQ(this->draw("coherence").visibility, truth.visibility) << turn;
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, areFilteredAsLightIsWithout)
{
  this->buildScene();
  this->scene.pass->SetSetting("mc_rays", "3");
  this->scene.pass->SetSetting("mc_filter", "5");
  const VisibilityImages plain = this->draw("montecarlo");
  this->lamp->SetTexture(makeImage(1, 1, [](int, int) { return Colour{ 0.2, 0.6, 0.0 }; }));
  const VisibilityImages& kept = this->draw("montecarlo");
  for (std::size_t i = 0; i < plain.coverage.size(); ++i)
  {
    ASSERT_NEAR(kept.visibility[0][i], 0.2 * plain.visibility[0][i], 1e-5);
    ASSERT_NEAR(kept.visibility[1][i], 0.6 * plain.visibility[0][i], 1e-5);
    ASSERT_EQ(kept.visibility[2][i], 0.0f);
  }
}

//------------------------------------------------------------------------------
/// A light with a texture and no size is hard, coloured by the texture's mean.
TEST_F(LightTextures, ofPointsStandBesideOtherHardLights)
{
  this->addFloor();
  this->addPlate({ -0.5, -0.5, 0.0 }, { 0.5, 0.5, 0.0 });
  this->lamp->SetTexture(makeRedAndBlue());
  this->lamp->SetWidth(0.0);
  this->lamp->SetHeight(0.0);
  this->scene.addSun({ 0.3, 0.0, -1.0 })->SetIntensity(0.3);
  this->scene.addSun({ -0.3, 0.2, -1.0 })->SetIntensity(0.3);
  this->scene.pass->SetTechnique("raytraced");
  const Picture picture = this->scene.render();
  EXPECT_EQ(this->scene.report().route, "image");
  EXPECT_GT(picture.at(5, 5).r, picture.at(5, 5).g + 20) << "the texture's mean has no green";
  const VisibilityImages& kept = drawKept(this->scene);
  ASSERT_EQ(kept.visibility.size(), 5u) << "three channels, and two lights of one";
  EXPECT_THAT(kept.visibility[0], testing::Contains(0.0f)) << "the plate's shadow";
  EXPECT_THAT(kept.visibility[0], testing::Contains(0.5f)) << "the mean of red";
  EXPECT_THAT(kept.visibility[1], testing::Each(0.0f)) << "of green";
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, ofWhiteAreNone)
{
  this->buildScene();
  this->scene.pass->SetSetting("light_samples", "16");
  for (const bool disk : { false, true })
  {
    disk ? this->lamp->SetShapeToDisk() : this->lamp->SetShapeToRectangle();
    for (const gnomon::TechniqueEntry& technique : gnomon::registry())
    {
      for (const bool keeps : { false, true })
      {
        this->scene.pass->SetTechnique(technique.name.c_str());
        this->scene.pass->SetKeepVisibility(keeps);
        this->lamp->SetTexture(nullptr);
        const Picture plain = this->scene.render();
        const VisibilityImages kept = this->scene.pass->GetVisibility();
        this->lamp->SetTexture(makeImage(3, 2, [](int, int) { return white; }));
        EXPECT_TRUE(this->scene.render() == plain) << technique.name;
        for (std::size_t channel = 0; keeps && channel < 3; ++channel)
        {
          EXPECT_EQ(this->scene.pass->GetVisibility().visibility.at(channel), kept.visibility.at(0))
            << technique.name;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, showWhatRaysShow)
{
  this->buildScene();
  for (const char* kind : { "rectangle", "disk", "sun" })
  {
    const bool sun = kind == std::string("sun");
    kind == std::string("disk") ? this->lamp->SetShapeToDisk() : this->lamp->SetShapeToRectangle();
    this->lamp->SetPositional(!sun);
    this->lamp->SetWidth(sun ? 14.0 : 2.0); // degrees
    this->lamp->SetHeight(sun ? 10.0 : 2.0);
    this->lamp->SetRadius(1.0);
    this->lamp->SetTexture(makeImage(3, 3,
      [](int x, int y) {
        return Colour{ 0.4 * x, 1.0 - 0.3 * y, x == y ? 1.0 : 0.1 };
      }));
    const VisibilityImages truth = this->draw("raytraced");
    const auto meanOff = [&](const char* technique)
    {
      const VisibilityImages& kept = this->draw(technique);
      double sum = 0.0;
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        for (std::size_t i = 0; i < kept.coverage.size(); ++i)
        {
          sum += std::abs(kept.visibility[channel][i] - truth.visibility[channel][i]);
        }
      }
      return sum / (3.0 * static_cast<double>(kept.coverage.size()));
    };
    EXPECT_EQ(meanOff("penumbra"), 0.0) << kind;
    EXPECT_LT(meanOff("coherence"), 0.001) << kind;
    EXPECT_LT(meanOff("sampled"), 0.003) << kind;
    EXPECT_LT(meanOff("montecarlo"), 0.003) << kind;
    EXPECT_THAT(this->scene.report().notes, testing::Not(testing::Contains(HasSubstr("even"))));
    meanOff("pcss");
    EXPECT_THAT(this->scene.report().notes,
      testing::Contains("light 0: 'pcss' shows an even light of its texture's mean colour"));
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, colourThePicture)
{
  this->addFloor();
  this->scene.pass->SetSetting("light_samples", "16");
  this->addPlate({ -8.0, -8.0, 0.0 }, { -0.9, 8.0, 0.0 });
  this->lamp->SetTexture(makeImage(2, 1,
    [](int x, int) {
      return x == 0 ? Colour{ 1.0, 0.4, 0.2 } : Colour{ 0.6, 0.4, 0.0 };
    }));
  this->lamp->SetColor(1.0, 0.5, 1.0);
  // Lit, times the light's colour and nearly N.L = 1.
  const glm::dvec3 lit = 255.0 * glm::dvec3(0.8, 0.2, 0.1);
  const auto at = [&](double x)
  {
    const Picture picture = this->scene.render();
    const double pixel = 2.4 / picture.height;
    return glm::dvec3(
      picture.at(static_cast<int>(x / pixel + 0.5 * picture.width), picture.height / 2));
  };
  for (const gnomon::TechniqueEntry& technique : gnomon::registry())
  {
    for (const bool keeps : { false, true })
    {
      const std::string what = technique.name + (keeps ? ", by layers" : "");
      this->scene.pass->SetTechnique(technique.name.c_str());
      this->scene.pass->SetKeepVisibility(keeps);
      vtkGnomonPropKeys::SetReceives(this->floor, true);
      this->lamp->SetShadowAttenuation(1.0f);
      EXPECT_LT(glm::distance(at(1.0), lit), 6.0) << what;
      vtkGnomonPropKeys::SetReceives(this->floor, false);
      EXPECT_LT(glm::distance(at(1.0), lit), 6.0) << what << ", what shows no shadows";
    }
  }
  // Half a shadow leaves half of the light.
  this->scene.pass->SetTechnique("raytraced");
  this->addPlate({ -8.0, -8.0, 0.1 }, { 8.0, 8.0, 0.1 });
  this->scene.lookFrom({ 0.0, -8.0, 3.0 }); // from below the plate
  vtkGnomonPropKeys::SetReceives(this->floor, true);
  EXPECT_EQ(this->scene.render().at(24, 18), glm::ivec3(0));
  this->lamp->SetShadowAttenuation(0.5f);
  EXPECT_LT(glm::distance(glm::dvec3(this->scene.render().at(24, 18)), 0.5 * lit), 4.0);
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, colourTranslucentSurfaces)
{
  this->addFloor();
  this->lamp->SetTexture(makeImage(1, 1, [](int, int) { return Colour{ 1.0, 0.6, 0.2 }; }));
  this->floor->GetProperty()->SetOpacity(0.999);
  for (const char* technique : seeing)
  {
    this->scene.pass->SetTechnique(technique);
    const glm::ivec3 pixel = this->scene.render().at(24, 18);
    EXPECT_NEAR(pixel.g, 0.6 * pixel.r, 2.0) << technique;
    EXPECT_NEAR(pixel.b, 0.2 * pixel.r, 2.0) << technique;
    EXPECT_GT(pixel.r, 200) << technique;
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, takeTheirOwnLayersOnly)
{
  this->buildScene();
  this->lamp->SetTexture(makeRedAndBlue());
  for (const char* technique : seeing)
  {
    const VisibilityImages alone = this->draw(technique);
    vtkLight* const first = this->scene.addSun({ 0.3, 0.2, -1.0 });
    this->scene.renderer->RemoveLight(this->lamp);
    const VisibilityImages sun = this->draw(technique);
    this->scene.renderer->AddLight(this->lamp);
    vtkLight* const last = this->scene.addSun({ 0.3, 0.2, -1.0 });
    const VisibilityImages& all = this->draw(technique);
    EXPECT_THAT(all.sceneIndices, ElementsAre(0, 1, 1, 1, 2));
    ASSERT_EQ(all.classes.size(), 5u);
    EXPECT_EQ(all.visibility[0], sun.visibility[0]) << technique;
    EXPECT_EQ(all.visibility[4], sun.visibility[0]) << technique;
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      EXPECT_EQ(all.visibility[1 + channel], alone.visibility[channel]) << technique;
    }
    this->scene.renderer->RemoveLight(first);
    this->scene.renderer->RemoveLight(last);
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, addUpInThePicture)
{
  this->buildScene();
  this->lamp->SetTexture(makeRedAndBlue());
  this->lamp->SetIntensity(0.5);
  for (const char* technique : { "raytraced", "nsm" })
  {
    this->scene.pass->SetTechnique(technique);
    this->scene.pass->SetKeepVisibility(true);
    const Picture alone = this->scene.render();
    this->scene.renderer->RemoveLight(this->lamp);
    this->scene.addSun({ 0.3, 0.2, -1.0 })->SetIntensity(0.3);
    const Picture sun = this->scene.render();
    this->scene.renderer->AddLight(this->lamp);
    this->scene.addSun({ 0.3, 0.2, -1.0 })->SetIntensity(0.3);
    const Picture all = this->scene.render();
    Picture sum = alone;
    for (std::size_t i = 0; i < sum.rgb.size(); ++i)
    {
      sum.rgb[i] = static_cast<unsigned char>(std::min(255, sum.rgb[i] + 2 * sun.rgb[i]));
    }
    EXPECT_EQ(differingPixels(sum, all, 3), 0u) << technique;
    this->scene.renderer->RemoveAllLights();
    this->scene.renderer->AddLight(this->lamp);
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, areSeenToChange)
{
  this->buildScene();
  const auto texture = makeChecker(4);
  this->lamp->SetTexture(texture);
  for (const char* technique : seeing)
  {
    const VisibilityImages before = this->draw(technique);
    EXPECT_EQ(this->draw(technique).visibility, before.visibility) << technique;
    texture->SetScalarComponentFromDouble(1, 2, 0, 0, 90.0);
    texture->GetPointData()->GetScalars()->Modified();
    EXPECT_NE(this->draw(technique).visibility[0], before.visibility[0]) << technique;
    EXPECT_EQ(this->draw(technique).visibility[1], before.visibility[1]) << technique;
    texture->SetScalarComponentFromDouble(1, 2, 0, 0, 0.0);
    texture->GetPointData()->GetScalars()->Modified();
    EXPECT_EQ(this->draw(technique).visibility, before.visibility) << technique;
    this->lamp->SetTexture(nullptr);
    EXPECT_EQ(this->draw(technique).visibility.size(), 1u) << technique;
    this->lamp->SetTexture(texture);
    EXPECT_EQ(this->draw(technique).visibility, before.visibility) << technique;
    // The darkest grey: its points count like those of no texture.
    this->lamp->SetTexture(nullptr);
    this->draw(technique);
    const double grey = 1.0 / 255.0;
    this->lamp->SetTexture(makeImage(1, 1, [&](int, int) { return Colour{ grey, grey, grey }; }));
    const VisibilityImages& dark = this->draw(technique);
    EXPECT_EQ(dark.visibility[2], dark.visibility[0]) << technique;
    this->lamp->SetTexture(texture);
  }
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, areRefined)
{
  this->buildScene();
  this->lamp->SetTexture(makeChecker(3));
  this->scene.pass->SetSetting("light_samples", "25");
  const VisibilityImages whole = this->draw("sampled");
  this->scene.pass->SetSetting("light_seed", "1");
  EXPECT_NE(this->draw("sampled").visibility, whole.visibility);
  this->scene.pass->SetSetting("light_seed", "0");
  this->scene.pass->SetSetting("progressive", "4");
  this->scene.pass->SetSetting("batch", "3");
  int frames = 0;
  do
  {
    this->draw("sampled");
    ++frames;
  } while (this->scene.pass->GetProgress() < 1.0 && frames < 50);
  EXPECT_EQ(frames, 7);
  EXPECT_EQ(this->scene.pass->GetVisibility().visibility, whole.visibility);
}

//------------------------------------------------------------------------------
/// The colour in the middle does not matter.
TEST_F(LightTextures, areRefinedFromTheHardShadow)
{
  this->buildScene();
  this->lamp->SetTexture(
    makeImage(3, 3, [](int x, int y) { return x == 1 && y == 1 ? black : white; }));
  const VisibilityImages hard = this->draw("nsm");
  this->scene.pass->SetSetting("progressive", "4");
  const VisibilityImages& begun = this->draw("sampled");
  EXPECT_EQ(this->scene.pass->GetProgress(), 0.0);
  EXPECT_EQ(this->scene.report().lights.at(0).lightSamples, 1);
  std::size_t different = 0;
  for (std::size_t i = 0; i < hard.coverage.size(); ++i)
  {
    different += std::abs(begun.visibility[1][i] - hard.visibility[1][i]) > 1e-6;
  }
  EXPECT_LT(different, 10u); // the maps' layouts differ
}

//------------------------------------------------------------------------------
/// On a matt floor under a window, shading from all points equals rays to all of them. Only the
/// cosines differ: they are not those of the window's centre.
TEST_F(PassTest, aWindowsPointsShadeAMattFloorAsRaysSeeIt)
{
  const auto renderer = gnomon::tool::makeRenderer(gnomon::tool::loadScene("soft-window"), 1.0);
  for (vtkActor* actor : vtk::Range(renderer->GetActors()))
  {
    actor->GetProperty()->SetAmbient(0.0);
    actor->GetProperty()->SetSpecular(0.0);
    actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  }
  vtkNew<vtkGnomonEGLRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(100, 100);
  window->AddRenderer(renderer);
  auto* lamp = vtkGnomonAreaLight::SafeDownCast(renderer->GetLights()->GetItemAsObject(0));
  lamp->SetIntensity(1.0); // nothing is then clipped
  const auto draw = [&](vtkRenderPass* pass)
  {
    renderer->SetPass(pass);
    window->Render();
    return readPicture(window);
  };
  vtkNew<vtkGnomonShadowPass> shadows;
  shadows->SmoothTerminatorsOff();
  shadows->SetTechnique("raytraced");
  shadows->SetSetting("light_samples", "1024");
  shadows->KeepVisibilityOn();
  const Picture seen = draw(shadows);
  const VisibilityImages kept = shadows->GetVisibility();
  shadows->KeepVisibilityOff();
  vtkNew<vtkGnomonLightSamplingPass> sampling;
  sampling->SetSamples(256);
  sampling->SetDelegatePass(shadows);
  const Picture shaded = draw(sampling);
  const gnomon::ShadowLight light = gnomon::LightManager().collectAreas(renderer, {}).lights.at(0);
  const std::vector<glm::dvec3> rim = gnomon::rimOf(*light.area, 32);
  lamp->SetTexture(nullptr);
  const Picture even = draw(sampling);

  int floor = 0;
  int wrong = 0;
  int unlikeEven = 0;
  for (int y = 0; y < seen.height; ++y)
  {
    for (int x = 0; x < seen.width; ++x)
    {
      const auto pixel =
        static_cast<std::size_t>(seen.height - 1 - y) * static_cast<std::size_t>(seen.width) +
        static_cast<std::size_t>(x);
      const glm::dvec3 place = positionOf(kept, pixel);
      if (kept.coverage[pixel] == 0.0f || std::abs(place.y) > 1e-4)
      {
        continue;
      }
      ++floor;
      const glm::dvec3 toCentre = light.positionWorld - place;
      const double cosine = glm::normalize(toCentre).y;
      double off = 0.0;
      for (const glm::dvec3& offset : rim)
      {
        off = std::max(off, std::abs(glm::normalize(toCentre + offset).y / cosine - 1.0));
      }
      for (int channel = 0; channel < 3; ++channel)
      {
        const int rays = seen.at(x, y)[channel];
        // Besides the cosines, the two sets of points differ.
        wrong += std::abs(shaded.at(x, y)[channel] - rays) > off * rays + 3.0;
        unlikeEven += std::abs(even.at(x, y)[channel] - rays) > off * rays + 3.0;
      }
    }
  }
  EXPECT_GT(floor, 3000);
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(unlikeEven, floor);
}

//------------------------------------------------------------------------------
TEST_F(LightTextures, mayHaveColoursThatFewPointsFind)
{
  // One texel of many is lit, far from the centre.
  this->addFloor();
  this->lamp->SetTexture(
    makeImage(31, 31, [](int x, int y) { return x == 3 && y == 7 ? white : black; }));
  for (const char* count : { "1", "4" })
  {
    this->scene.pass->SetSetting("light_samples", count);
    this->scene.pass->SetSetting("mc_rays", count);
    for (const char* technique : seeing)
    {
      const VisibilityImages& kept = this->draw(technique);
      const double mean = 1.0 / (31.0 * 31.0);
      for (const float v : kept.visibility[0])
      {
        EXPECT_TRUE(v == 0.0f || std::abs(v - mean) < 1e-6) << technique << ": " << v;
      }
    }
  }
}

} // namespace
