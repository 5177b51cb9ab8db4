// Lights with textures in frames: coloured visibility against known values and rays, and the
// support of techniques and routes.

#include "AreaLights.h"
#include "Scene.h"

#include "lights/LightManager.h"
#include "plugin/vtkGnomonLightSamplingPass.h"

#include <vtkDataArray.h>

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

vtkSmartPointer<vtkImageData> makeRedAndBlue()
{
  return makeImage(2, 1, [](int x, int) { return x == 0 ? red : blue; });
}
vtkSmartPointer<vtkImageData> makeChecker(int side)
{
  return makeImage(side, side, [](int x, int y) { return (x + y) % 2 == 0 ? white : black; });
}

struct LightTextures : PassTest
{
  LightTextures()
  {
    aim(this->lamp, { 0.0, 0.0, 10.0 });
    this->lamp->SetConeAngle(50.0);
    this->lamp->SetExponent(0.0);
    this->lamp->SetShapeToRectangle();
    this->lamp->SetWidth(2.0);
    this->lamp->SetHeight(2.0);
    this->scene.renderer->AddLight(this->lamp);
    this->scene.choose("light_samples=256 mc_rays=10 mc_filter=0");
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

  const VisibilityImages& draw(const std::string& technique)
  {
    return drawKept(this->scene, technique.c_str());
  }

  /// Expect visibility to equal `expected` at the places of all pixels of the floor.
  void expectFloor(const std::string& technique,
    const std::function<Colour(const glm::dvec3&)>& expected, double mean, double most)
  {
    const VisibilityImages& kept = this->draw(technique);
    ASSERT_THAT(kept.sceneIndices, ElementsAre(0, 0, 0));
    ASSERT_THAT(
      kept.channels, ElementsAre(LightChannel::Red, LightChannel::Green, LightChannel::Blue));
    const auto isFloor = [&](std::size_t i) { return std::abs(positionOf(kept, i).z) < 1e-4; };
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      std::vector<float> exact = kept.visibility[channel];
      for (std::size_t i = 0; i < exact.size(); ++i)
      {
        const Colour share = expected(positionOf(kept, i));
        exact[i] = isFloor(i) ? static_cast<float>(share[static_cast<int>(channel)]) : exact[i];
      }
      EXPECT_LT(
        meanDifferenceWhere(kept.visibility[channel], exact, exact.size() * 2 / 5, isFloor), mean)
        << technique << ", channel " << channel;
      EXPECT_LT(largestDifference(kept.visibility[channel], exact), most)
        << technique << ", channel " << channel;
    }
  }

  PassScene scene{ 48, 36 };
  vtkNew<vtkGnomonAreaLight> lamp;
  vtkActor* floor = nullptr;
};

TEST_F(LightTextures, haveTheirMeanWhereNothingHidesThem)
{
  this->addFloor();
  this->scene.set("mc_classify", "off"); // bounds would decide all without rays
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

/// From x, the part of a lamp beyond -x is visible past the plate. Looking up, the picture's right
/// is -x and its top +y. A sun whose slopes end at 0.2 is seen alike.
TEST_F(LightTextures, areSeenHalfByHalf)
{
  this->addFloor();
  for (const auto& [sun, axis] : { std::pair(false, 0), { false, 1 }, { true, 0 }, { true, 1 } })
  {
    this->lamp->SetPositional(!sun);
    this->lamp->SetWidth(sun ? 2.0 * glm::degrees(std::atan(0.2)) : 2.0);
    this->lamp->SetHeight(this->lamp->GetWidth());
    glm::dvec3 end(8.0, 8.0, 0.0);
    end[axis] = 0.0;
    this->addPlate({ -8.0, -8.0, 0.0 }, end);
    this->lamp->SetTexture(makeImage(axis == 0 ? 2 : 1, axis == 0 ? 1 : 2,
      [axis = axis](int x, int y) { return (axis == 0 ? x == 0 : y == 1) ? red : blue; }));
    const auto expected = [axis = axis](const glm::dvec3& place)
    {
      return Colour{ 0.5 * std::clamp(1.0 + place[axis], 0.0, 1.0), 0.0,
        0.5 * std::clamp(place[axis], 0.0, 1.0) };
    };
    for (const char* technique : { "raytraced", "penumbra", "sampled" })
    {
      this->expectFloor(technique, expected, 0.003, 0.03);
    }
    this->expectFloor("montecarlo", expected, 0.01, 0.1);
    this->scene.renderer->RemoveActor(this->scene.renderer->GetActors()->GetLastActor());
  }
}

TEST_F(LightTextures, showWhatRaysShow)
{
  this->scene.renderer->RemoveLight(this->lamp);
  this->scene.addThings();
  for (const AreaLight& area : areaLights())
  {
    if (!area.isTextured)
    {
      continue;
    }
    SCOPED_TRACE(area.name);
    vtkLight* light = area.add(this->scene);
    const VisibilityImages truth = this->draw("raytraced");
    const auto meanOff = [&](const char* technique)
    {
      const VisibilityImages& kept = this->draw(technique);
      double sum = 0.0;
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        sum += meanDifference(kept.visibility[channel], truth.visibility[channel]) / 3.0;
      }
      return sum;
    };
    EXPECT_EQ(meanOff("penumbra"), 0.0);
    EXPECT_LT(meanOff("coherence"), 0.001);
    EXPECT_LT(meanOff("sampled"), 0.003);
    EXPECT_LT(meanOff("montecarlo"), 0.003);
    EXPECT_THAT(this->scene.report().notes, testing::Not(testing::Contains(HasSubstr("even"))));
    meanOff("pcss");
    EXPECT_THAT(this->scene.report().notes,
      testing::Contains("light 0: 'pcss' shows an even light of its texture's mean colour"));
    this->scene.renderer->RemoveLight(light);
  }
}

TEST_F(LightTextures, giveWayWithTheirColoursBehindTheReceiver)
{
  // The lowest quarter of a lamp beside the floor (green) is below it. The highest quarter (red)
  // counts twice there.
  this->addFloor();
  aim(this->lamp, { -5.0, 0.0, 0.5 }, { 0.0, 0.0, 0.5 });
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
  const Picture picture = this->scene.render("raytraced");
  EXPECT_EQ(this->scene.report().route, "image");
  EXPECT_GT(picture.at(5, 5).r, picture.at(5, 5).g + 20) << "the texture's mean has no green";
  const VisibilityImages& kept = drawKept(this->scene);
  ASSERT_EQ(kept.visibility.size(), 5u) << "three channels, and two lights of one";
  EXPECT_THAT(kept.visibility[0], testing::Contains(0.0f)) << "the plate's shadow";
  EXPECT_THAT(kept.visibility[0], testing::Contains(0.5f)) << "the mean of red";
  EXPECT_THAT(kept.visibility[1], testing::Each(0.0f)) << "of green";
}

TEST_F(LightTextures, colourThePicture)
{
  this->addFloor();
  this->scene.set("light_samples", "16");
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

TEST_F(LightTextures, colourTranslucentSurfaces)
{
  this->addFloor();
  this->lamp->SetTexture(makeImage(1, 1, [](int, int) { return Colour{ 1.0, 0.6, 0.2 }; }));
  this->floor->GetProperty()->SetOpacity(0.999);
  for (const char* technique : seeing)
  {
    const glm::ivec3 pixel = this->scene.render(technique).at(24, 18);
    EXPECT_NEAR(pixel.g, 0.6 * pixel.r, 2.0) << technique;
    EXPECT_NEAR(pixel.b, 0.2 * pixel.r, 2.0) << technique;
    EXPECT_GT(pixel.r, 200) << technique;
  }
}

TEST_F(LightTextures, mayHaveColoursThatFewPointsFind)
{
  // One texel of many is lit, far from the centre.
  this->addFloor();
  this->lamp->SetTexture(
    makeImage(31, 31, [](int x, int y) { return x == 3 && y == 7 ? white : black; }));
  for (const char* count : { "1", "4" })
  {
    this->scene.set("light_samples", count);
    this->scene.set("mc_rays", count);
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
