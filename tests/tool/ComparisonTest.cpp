#include "Comparison.h"

#include "PictureVisibility.h"
#include "SyntheticResults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

constexpr std::int64_t coveredPixels = 40 * 25;

TEST(Comparison, TheTruthHasNoError)
{
  const VisibilityError error = measureError(floorTruth(), floorTruth(), { lightFromAbove() });
  EXPECT_EQ(error.facingPixels, coveredPixels);
  EXPECT_EQ(error.wrongPixels(), 0);
  EXPECT_EQ(error.betweenPixels, 0);
  EXPECT_EQ(error.meanAbsolute, 0.0);
  EXPECT_EQ(error.rootMeanSquare, 0.0);
}

TEST(Comparison, AHundredFlippedPixelsAreAHundredWrongPixels)
{
  VisibilityImages flipped = floorTruth();
  flipHundredPixels(flipped);
  std::vector<PixelVerdict> verdicts;
  const VisibilityError error =
    measureError(flipped, floorTruth(), { lightFromAbove() }, &verdicts);
  EXPECT_EQ(error.wrongPixels(), 100);
  EXPECT_EQ(error.falseLight, 60);
  EXPECT_EQ(error.falseShadow, 40);
  EXPECT_EQ(error.share(error.wrongPixels()), 0.1);
  EXPECT_DOUBLE_EQ(error.meanAbsolute, 0.1);
  EXPECT_DOUBLE_EQ(error.rootMeanSquare, std::sqrt(0.1));
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::FalseLight), 60);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::FalseShadow), 40);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::Right), 900);
  EXPECT_EQ(std::count(verdicts.begin(), verdicts.end(), PixelVerdict::NotCounted), 200);
}

TEST(Comparison, HalfAVisibilityIsBlurAndNotWrong)
{
  VisibilityImages blurred = floorTruth();
  blurred.visibility[0].assign(blurred.visibility[0].size(), 0.5f);
  const VisibilityError error = measureError(blurred, floorTruth(), { lightFromAbove() });
  EXPECT_EQ(error.wrongPixels(), 0);
  EXPECT_EQ(error.betweenPixels, coveredPixels);
  EXPECT_DOUBLE_EQ(error.meanAbsolute, 0.5);
  EXPECT_DOUBLE_EQ(error.rootMeanSquare, 0.5);
}

TEST(Comparison, MoreThanHalfIsWrong)
{
  VisibilityImages blurred = floorTruth();
  blurred.visibility[0][0] = 0.51f; // in the shadow
  blurred.visibility[0][1] = 0.49f;
  blurred.visibility[0][20] = 0.49f; // in the light
  blurred.visibility[0][21] = 0.51f;
  const VisibilityError error = measureError(blurred, floorTruth(), { lightFromAbove() });
  EXPECT_EQ(error.falseLight, 1);
  EXPECT_EQ(error.falseShadow, 1);
}

TEST(Comparison, NotANumberIsAFalseShadow)
{
  VisibilityImages broken = floorTruth();
  broken.visibility[0][0] = std::numeric_limits<float>::quiet_NaN();
  const VisibilityError error = measureError(broken, floorTruth(), { lightFromAbove() });
  EXPECT_EQ(error.falseShadow, 1);
  EXPECT_TRUE(std::isfinite(error.meanAbsolute));
}

TEST(Comparison, PixelsThatTurnAwayDoNotCount)
{
  VisibilityImages truth = floorTruth();
  truth.normalY[0] = -1.0f;                      // turned away
  truth.normalX[1] = 1.0f, truth.normalY[1] = 0; // exactly along the light: N.L = 0
  truth.coverage[2] = 0.5f;                      // partly covered
  EXPECT_EQ(measureError(truth, truth, { lightFromAbove() }).facingPixels, coveredPixels - 3);

  SceneLight fromBelow = lightFromAbove();
  fromBelow.position = { { 0.0, -1.0, 0.0 } };
  EXPECT_EQ(measureError(truth, truth, { fromBelow }).facingPixels, 1);
}

TEST(Comparison, PixelsOutsideASpotLightsConeDoNotCount)
{
  const VisibilityImages truth = floorTruth();
  SceneLight spot;
  spot.type = SceneLight::Type::Spot;
  // Ten units above the floor's pixel (20, 10), in world coordinates: far away from zero.
  spot.position = { { 1e6 + 20.0, 2e6 + 10.0, 3e6 + 10.0 } };
  spot.target = { { 1e6 + 20.0, 2e6, 3e6 + 10.0 } };
  spot.coneAngleDegrees = 30.0;
  const std::vector<unsigned char> facing = facingPixels(truth, spot);
  const double radius = 10.0 * std::tan(30.0 / 180.0 * std::acos(-1.0));
  for (int y = 0; y < truth.height; ++y)
  {
    for (int x = 0; x < truth.width; ++x)
    {
      const bool inside = std::hypot(x - 20.0, y - 10.0) <= radius;
      EXPECT_EQ(facing[static_cast<std::size_t>(y * truth.width + x)], inside) << x << ", " << y;
    }
  }
}

TEST(Comparison, PixelsOutsideALightsBoxDoNotCount)
{
  const VisibilityImages truth = floorTruth();
  SceneLight sun = lightFromAbove();
  sun.position = { { 1e6 + 20.0, 2e6 + 5.0, 3e6 + 10.0 } };
  sun.target = { { 1e6 + 20.0, 2e6, 3e6 + 10.0 } };
  sun.box = SceneLight::Box{ 9.0, 5.0, 6.0, { { 0.0, 0.0, 1.0 } } };
  const std::vector<unsigned char> facing = facingPixels(truth, sun);
  for (int y = 0; y < truth.height; ++y)
  {
    for (int x = 0; x < truth.width; ++x)
    {
      const bool inside = std::abs(x - 20.0) <= 4.5 && std::abs(y - 10.0) <= 2.5;
      EXPECT_EQ(facing[static_cast<std::size_t>(y * truth.width + x)], inside) << x << ", " << y;
    }
  }
  sun.box->depth = 4.0;
  EXPECT_EQ(measureError(truth, truth, { sun }).facingPixels, 0);
}

TEST(Comparison, PointLightsAreFacedFromAllSides)
{
  const VisibilityImages truth = floorTruth();
  SceneLight lamp;
  lamp.type = SceneLight::Type::Point;
  lamp.position = { { 1e6 + 20.0, 2e6 + 1.0, 3e6 + 10.0 } };
  EXPECT_EQ(measureError(truth, truth, { lamp }).facingPixels, coveredPixels);
  lamp.position[1] = 2e6 - 1.0;
  EXPECT_EQ(measureError(truth, truth, { lamp }).facingPixels, 0);
}

TEST(Comparison, EveryLightCountsOnItsOwn)
{
  VisibilityImages truth = floorTruth();
  truth.visibility.push_back(std::vector<float>(truth.coverage.size(), 1.0f));
  truth.sceneIndices = { 0, 2 };
  VisibilityImages technique = truth;
  technique.visibility[1][0] = 0.0f;
  const std::vector<SceneLight> lights(3, lightFromAbove());
  const VisibilityError error = measureError(technique, truth, lights);
  EXPECT_EQ(error.facingPixels, 2 * coveredPixels);
  EXPECT_EQ(error.falseShadow, 1);
}

TEST(Comparison, ALightWithATextureCountsByChannel)
{
  VisibilityImages truth = floorTruth();
  truth.visibility.resize(3, truth.visibility[0]);
  truth.sceneIndices = { 0, 0, 0 };
  truth.channels = { LightChannel::Red, LightChannel::Green, LightChannel::Blue };
  VisibilityImages technique = truth;
  for (float& v : technique.visibility[1])
  {
    v += 0.3f;
  }
  technique.visibility[2][0] = 0.6f;
  const VisibilityError error = measureError(technique, truth, { lightFromAbove() });
  EXPECT_EQ(error.facingPixels, 3 * coveredPixels);
  EXPECT_EQ(error.falseLight, 1);
  EXPECT_NEAR(error.meanAbsolute, 0.1, 0.001);
}

TEST(Comparison, ImagesThatDoNotMatchAreRefused)
{
  const VisibilityImages truth = floorTruth();
  VisibilityImages other = truth;
  other.width = 30;
  other.height = 40;
  EXPECT_THROW(measureError(other, truth, { lightFromAbove() }), std::invalid_argument);
  other = truth;
  other.sceneIndices = { 1 };
  EXPECT_THROW(measureError(other, truth, { lightFromAbove() }), std::invalid_argument);
  other = truth;
  other.channels = { LightChannel::Red };
  EXPECT_THROW(measureError(other, truth, { lightFromAbove() }), std::invalid_argument);
  other = truth;
  other.visibility[0].pop_back();
  EXPECT_THROW(measureError(other, truth, { lightFromAbove() }), std::invalid_argument);
}

TEST(Comparison, TheErrorPictureHasItsColours)
{
  const Picture picture = greyPicture(5, 1);
  const std::vector<PixelVerdict> verdicts = { PixelVerdict::FalseLight, PixelVerdict::FalseShadow,
    PixelVerdict::Right, PixelVerdict::Right, PixelVerdict::FalseLight };
  const std::vector<unsigned char> traced = { 0, 0, 0, 1, 1 };
  const Picture errors = errorPicture(picture, verdicts, &traced);
  const auto red = [&errors](std::size_t i) { return errors.rgb[3 * i]; };
  const auto green = [&errors](std::size_t i) { return errors.rgb[3 * i + 1]; };
  const auto blue = [&errors](std::size_t i) { return errors.rgb[3 * i + 2]; };
  EXPECT_TRUE(blue(0) == 255 && red(0) < 100);
  EXPECT_TRUE(red(1) == 255 && blue(1) < 100);
  EXPECT_TRUE(red(2) == green(2) && green(2) == blue(2) && red(2) < 100);
  EXPECT_TRUE(red(3) > green(3) + 50 && blue(3) > green(3) + 50);
  EXPECT_TRUE(blue(4) == 255 && red(4) < 100); // wrong comes before traced
}

TEST(PictureVisibility, IsTheQuotientOfTheBrightestUsefulExposure)
{
  const auto grey = [](const std::vector<unsigned char>& values)
  {
    Picture picture;
    picture.width = static_cast<int>(values.size());
    picture.height = 1;
    for (unsigned char value : values)
    {
      picture.rgb.insert(picture.rgb.end(), 3, value);
    }
    return picture;
  };
  // Pixels: bright and lit; bright and half dark; faint and half dark; no light; too bright a
  // shadow.
  const std::vector<ExposedPair> exposures = {
    { grey({ 200, 200, 1, 0, 100 }), grey({ 200, 100, 1, 0, 120 }) },
    { grey({ 255, 255, 20, 0, 255 }), grey({ 255, 255, 10, 0, 255 }) },
  };
  std::vector<float> found = visibilityFromPictures(exposures, 0);
  ASSERT_EQ(found.size(), 5u);
  EXPECT_TRUE(std::isnan(found[3]));
  found[3] = 0.0f;
  const std::vector<float> expected = { 1.0f, 0.5f, 0.5f, 0.0f, 1.0f };
  EXPECT_EQ(found, expected);
}

} // namespace
} // namespace gnomon::tool
