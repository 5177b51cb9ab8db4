#include "Comparison.h"
#include "PictureVisibility.h"

#include "SyntheticResults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

constexpr std::int64_t coveredPixels = 40 * 25;

TEST(Comparison, HasTheErrorsThatAreMade)
{
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  struct Case
  {
    const char* name;
    std::function<void(std::vector<float>& visibility)> change;
    std::int64_t falseLight, falseShadow, between;
    double meanAbsolute;
  };
  // Pixels 0 and 1 are in the shadow, 20 and 21 in the light.
  const std::vector<Case> cases = {
    { "truth", [](std::vector<float>&) {}, 0, 0, 0, 0.0 },
    { "a half is blur", [](std::vector<float>& v) { v.assign(v.size(), 0.5f); }, 0, 0,
      coveredPixels, 0.5 },
    { "more is wrong",
      [](std::vector<float>& v) { v[0] = 0.51f, v[1] = 0.49f, v[20] = 0.49f, v[21] = 0.51f; }, 1, 1,
      4, 0.002 },
    { "NaN", [](std::vector<float>& v) { v[0] = nan; }, 0, 1, 0, 0.001 },
    { "lit", [](std::vector<float>& v) { v.assign(v.size(), 1.0f); }, 500, 0, 0, 0.5 },
  };
  for (const Case& of : cases)
  {
    VisibilityImages technique = floorTruth();
    of.change(technique.visibility[0]);
    const VisibilityError error = measureError(technique, floorTruth(), { lightFromAbove() });
    EXPECT_EQ(error.facingPixels, coveredPixels) << of.name;
    EXPECT_EQ(error.falseLight, of.falseLight) << of.name;
    EXPECT_EQ(error.falseShadow, of.falseShadow) << of.name;
    EXPECT_EQ(error.betweenPixels, of.between) << of.name;
    EXPECT_NEAR(error.meanAbsolute, of.meanAbsolute, 1e-4) << of.name;
    EXPECT_GE(error.rootMeanSquare, error.meanAbsolute - 1e-9) << of.name;
  }
}

TEST(Comparison, AHundredFlippedPixelsAreAHundredWrongPixels)
{
  VisibilityImages flipped = floorTruth();
  flipHundredPixels(flipped);
  flipped.visibility[0].back() = 0.0f; // background
  const VisibilityError error = measureError(flipped, floorTruth(), { lightFromAbove() });
  const auto& [verdicts, differences] = std::tie(error.verdicts, error.differences);
  EXPECT_EQ(error.falseLight, 60);
  EXPECT_EQ(error.falseShadow, 40);
  EXPECT_EQ(error.share(error.wrongPixels()), 0.1);
  EXPECT_DOUBLE_EQ(error.rootMeanSquare, std::sqrt(0.1));
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::FalseLight), 60);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::FalseShadow), 40);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::Right), 900);
  EXPECT_EQ(std::count(differences.begin(), differences.end(), 1.0f), 100);
}

TEST(Comparison, CountsPixelsThatFaceTheLight)
{
  VisibilityImages turned = floorTruth();
  turned.normalY[0] = -1.0f;
  turned.normalX[1] = 1.0f, turned.normalY[1] = 0.0f; // exactly along the light
  turned.coverage[2] = 0.5f;
  EXPECT_EQ(measureError(turned, turned, { lightFromAbove() }).facingPixels, coveredPixels - 3);

  // World coordinates are far from zero.
  SceneLight spot;
  spot.type = SceneLight::Type::Spot;
  spot.position = { { 1e6 + 20.0, 2e6 + 10.0, 3e6 + 10.0 } };
  spot.target = { { 1e6 + 20.0, 2e6, 3e6 + 10.0 } };
  spot.coneAngleDegrees = 30.0;
  SceneLight boxed = lightFromAbove();
  boxed.position = { { 1e6 + 20.0, 2e6 + 5.0, 3e6 + 10.0 } };
  boxed.target = spot.target;
  boxed.box = SceneLight::Box{ 9.0, 5.0, 6.0, { { 0.0, 0.0, 1.0 } } };
  SceneLight lamp = spot;
  lamp.type = SceneLight::Type::Point;
  SceneLight below = lamp;
  below.position[1] = 2e6 - 1.0;
  const VisibilityImages truth = floorTruth();
  const auto facing = [&](const SceneLight& light, int x, int y)
  { return facingPixels(truth, light)[static_cast<std::size_t>(y * truth.width + x)] != 0; };
  for (int x = 0; x < truth.width; ++x)
  {
    for (int y = 0; y < truth.height; y += 3)
    {
      const bool isInCone = std::hypot(x - 20.0, y - 10.0) <= 10.0 / std::sqrt(3.0);
      const bool isInBox = std::abs(x - 20.0) <= 4.5 && std::abs(y - 10.0) <= 2.5;
      EXPECT_EQ(facing(spot, x, y), isInCone) << x << ", " << y;
      EXPECT_EQ(facing(boxed, x, y), isInBox) << x << ", " << y;
      EXPECT_EQ(facing(lamp, x, y), y < 25) << x << ", " << y;
      EXPECT_FALSE(facing(below, x, y)) << x << ", " << y;
    }
  }
  boxed.box->depth = 4.0;
  EXPECT_EQ(measureError(truth, truth, { boxed }).facingPixels, 0);
}

TEST(Comparison, EveryLightAndChannelCounts)
{
  VisibilityImages truth = floorTruth();
  truth.visibility.resize(3, truth.visibility[0]);
  truth.sceneIndices = { 0, 0, 2 };
  truth.channels = { LightChannel::Red, LightChannel::Green, LightChannel::All };
  VisibilityImages technique = truth;
  technique.visibility[1][0] = 0.6f;
  technique.visibility[2][20] = 0.0f;
  const std::vector<SceneLight> lights(3, lightFromAbove());
  const VisibilityError error = measureError(technique, truth, lights);
  EXPECT_EQ(error.facingPixels, 3 * coveredPixels);
  EXPECT_EQ(error.falseLight, 1);
  EXPECT_EQ(error.falseShadow, 1);

  technique.visibility[0].pop_back();
  EXPECT_THROW(measureError(technique, truth, lights), std::invalid_argument);
  EXPECT_THROW(measureError(floorTruth(), truth, lights), std::invalid_argument);
}

TEST(PictureVisibility, IsTheQuotientOfTheBrightestUsefulExposure)
{
  const auto grey = [](const std::vector<unsigned char>& values)
  {
    Picture picture{ static_cast<int>(values.size()), 1, {} };
    for (unsigned char value : values)
    {
      picture.rgb.insert(picture.rgb.end(), 3, value);
    }
    return picture;
  };
  // Bright and lit; bright and half dark; faint and half dark; no light; too bright a shadow.
  std::vector<float> found =
    visibilityFromPictures({ grey({ 200, 200, 1, 0, 100 }), grey({ 255, 255, 20, 0, 255 }) },
      { grey({ 200, 100, 1, 0, 120 }), grey({ 255, 255, 10, 0, 255 }) }, 0);
  EXPECT_TRUE(std::isnan(found.at(3)));
  found[3] = 0.0f;
  EXPECT_EQ(found, (std::vector<float>{ 1.0f, 0.5f, 0.5f, 0.0f, 1.0f }));
}

} // namespace
} // namespace gnomon::tool
