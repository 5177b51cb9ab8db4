#include "ImageFile.h"

#include "Commands.h"
#include "Comparison.h"
#include "Errors.h"
#include "ImageDifference.h"
#include "PictureVisibility.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include "plugin/vtkGnomonOffScreenWindow.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>

namespace gnomon::tool
{
namespace
{

Picture noisePicture(int width, int height)
{
  Picture picture;
  picture.width = width;
  picture.height = height;
  std::mt19937 random(7);
  for (std::size_t i = 0; i < 3 * picture.pixelCount(); ++i)
  {
    picture.rgb.push_back(static_cast<unsigned char>(random() & 255u));
  }
  return picture;
}

TEST(ImageFile, PicturesComeBackAsWritten)
{
  const TestFolder folder;
  const Picture picture = noisePicture(31, 17);
  for (const char* name : { "a.png", "a.exr", "A.PNG" })
  {
    writePicture(picture, folder / name);
    const Picture read = readPicture(folder / name);
    EXPECT_EQ(read.width, 31);
    EXPECT_EQ(read.height, 17);
    EXPECT_EQ(read.rgb, picture.rgb) << name;
  }
}

TEST(ImageFile, PathsThatCannotBeWrittenAreRefused)
{
  const TestFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  for (const auto& [name, expected] : std::map<std::string, std::string>{
         { "a.jpg", "ends in .png or .exr" }, { "a", "ends in .png or .exr" },
         { ".png", "ends in .png or .exr" }, { "missing/a.png", "cannot be written" },
         { "missing/a.exr", "cannot be written" }, { "folder.png", "cannot be written" } })
  {
    const std::string message =
      messageOf<BadInput>([&] { writePicture(noisePicture(2, 2), folder / name); });
    EXPECT_NE(message.find(folder / name), std::string::npos) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
  for (const char* name : { "a.png", "a.exr" })
  {
    std::filesystem::create_symlink("/dev/full", folder / name);
    EXPECT_THROW(writePicture(noisePicture(200, 200), folder / name), Failure) << name;
  }
}

TEST(ImageFile, CaptureHasItsTopRowFirst)
{
  vtkNew<vtkRenderer> renderer;
  renderer->GradientBackgroundOn();
  renderer->SetBackground(0.0, 0.0, 1.0);  // bottom
  renderer->SetBackground2(1.0, 0.0, 0.0); // top
  const auto window = makeOffScreenWindow();
  window->SetSize(40, 30);
  window->AddRenderer(renderer);
  window->Render();
  const Picture picture = capture(window);
  ASSERT_EQ(picture.width, 40);
  ASSERT_EQ(picture.height, 30);
  EXPECT_GT(picture.rgb[0], 200);
  EXPECT_LT(picture.rgb[2], 50);
  const std::size_t last = 3 * (picture.pixelCount() - 1);
  EXPECT_LT(picture.rgb[last], 50);
  EXPECT_GT(picture.rgb[last + 2], 200);
}

/// A light with a texture has three channels.
TEST(ImageFile, VisibilityComesBackAsWritten)
{
  const TestFolder folder;
  VisibilityImages images = floorTruth();
  images.origin = { { 4e6 + 0.125, -1.0 / 3.0, 5e-7 } };
  images.positionX[5] = 1.0f / 3.0f;
  images.sceneIndices = { 0, 2, 2, 2 };
  for (const LightChannel channel : { LightChannel::Red, LightChannel::Green, LightChannel::Blue })
  {
    images.channels.push_back(channel);
    images.visibility.emplace_back(
      images.coverage.size(), 0.25f * static_cast<float>(images.channels.size()));
  }
  const std::string path = folder / "visibility.exr";
  writeVisibility(images, path, { { "technique", "nsm" }, { "stage maps", "8.25 ms" } });

  const ChannelImage read = readChannels(path);
  EXPECT_EQ(read.width, images.width);
  EXPECT_EQ(read.height, images.height);
  EXPECT_EQ(read.origin, images.origin);
  EXPECT_EQ(read.header.at("technique"), "nsm");
  EXPECT_EQ(read.header.at("stage maps"), "8.25 ms");
  const std::map<std::string, std::vector<float>> expected = {
    { "visibility.0", images.visibility[0] }, { "visibility.2.R", images.visibility[1] },
    { "visibility.2.G", images.visibility[2] }, { "visibility.2.B", images.visibility[3] },
    { "position.X", images.positionX }, { "position.Y", images.positionY },
    { "position.Z", images.positionZ }, { "normal.X", images.normalX },
    { "normal.Y", images.normalY }, { "normal.Z", images.normalZ }, { "coverage", images.coverage }
  };
  EXPECT_EQ(read.channels, expected);
}

TEST(ImageFile, VisibilityWithAPlaneMissingIsRefused)
{
  const TestFolder folder;
  VisibilityImages images = floorTruth();
  images.normalZ.pop_back();
  EXPECT_THROW(writeVisibility(images, folder / "v.exr", {}), std::invalid_argument);
}

/// Every way to break a file ends in BadInput with the file's name.
TEST(ImageFile, BrokenFilesAreRefused)
{
  const TestFolder folder;
  std::mt19937 random(1);
  std::string garbage(5000, '\0');
  std::generate(garbage.begin(), garbage.end(), [&] { return static_cast<char>(random() & 255u); });
  for (const char* name : { "a.png", "a.exr" })
  {
    const std::string path = folder / name;
    const auto refuses = [&](const std::string& bytes)
    {
      writeBytes(path, bytes);
      return messageOf<BadInput>([&] { readPicture(path); }).find(path) != std::string::npos;
    };
    EXPECT_NE(messageOf<BadInput>([&] { readPicture(path); }).find(path), std::string::npos);
    writePicture(noisePicture(64, 64), path);
    const std::string whole = readBytes(path);
    ASSERT_NO_THROW(readPicture(path));
    EXPECT_TRUE(refuses(garbage));
    EXPECT_TRUE(refuses(whole.substr(0, 8) + garbage));
    // Up to the last byte of the pixels: a PNG is readable without its last 12, the end mark.
    for (std::size_t length = 0; length < whole.size() - 13; length += 1 + length / 8)
    {
      EXPECT_TRUE(refuses(whole.substr(0, length))) << name << ": the first " << length;
    }
    EXPECT_TRUE(refuses(whole.substr(0, whole.size() - 14)));

    for (int trial = 0; trial < 200; ++trial)
    {
      std::string damaged = whole;
      for (int i = 0; i < 4; ++i)
      {
        // Headers more often than pixels.
        damaged[random() % (trial % 2 ? damaged.size() : 400)] = static_cast<char>(random() & 255u);
      }
      writeBytes(path, damaged);
      try
      {
        const Picture picture = readPicture(path);
        EXPECT_EQ(picture.rgb.size(), 3 * picture.pixelCount());
      }
      catch (const BadInput&)
      {
      }
    }
    std::filesystem::remove(path);
    std::filesystem::create_directory(path);
    EXPECT_NE(messageOf<BadInput>([&] { readPicture(path); }).find(path), std::string::npos);
  }
}

using testing::AllOf;
using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

ChannelImage imageOf(const std::vector<float>& a, const std::vector<float>& b)
{
  ChannelImage image;
  image.width = static_cast<int>(a.size()) / 2;
  image.height = 2;
  image.channels = { { "a", a }, { "b", b } };
  return image;
}

TEST(ImageDifference, CountsPixelsAndShowsThem)
{
  const ChannelImage zero = imageOf({ 0, 0, 0, 0, 0, 0, 0, 0 }, { 0, 0, 0, 0, 0, 0, 0, 0 });
  // Within the tolerance; beyond it in both channels; the largest.
  const ImageDifference found = compareImages(zero, "one",
    imageOf({ 0, 0.5f, 0.75f, 0, 0, 0, 0, 0 }, { 0, 0, 0.75f, 0, 0, 0, 1.5f, 0 }), "other", 0.5);
  EXPECT_EQ(found.differingPixels, 2);
  EXPECT_EQ(found.text,
    "2 of 8 pixels differ by more than 0.5; largest difference 1.5 in channel b at pixel (2, 1), "
    "counted from the top left");
  const std::vector<unsigned char> black = { 0, 0, 0 }, grey = { 80, 80, 80 },
                                   yellow = { 255, 255, 0 };
  const auto pixel = [&](const Picture& picture, std::size_t i)
  { return std::vector<unsigned char>(&picture.rgb[3 * i], &picture.rgb[3 * i] + 3); };
  EXPECT_EQ(pixel(found.picture, 0), black);
  EXPECT_EQ(pixel(found.picture, 1), grey);
  EXPECT_EQ(pixel(found.picture, 2), (std::vector<unsigned char>{ 255, 167, 0 }));
  EXPECT_EQ(pixel(found.picture, 6), yellow);

  const ImageDifference infinite = compareImages(imageOf({ nan, nan, infinity, infinity }, {}),
    "one", imageOf({ nan, 0, infinity, -infinity }, {}), "other", 1e30);
  EXPECT_EQ(infinite.differingPixels, 3) << "equal infinities do not differ, NaN always does";
  EXPECT_THAT(infinite.text, HasSubstr("largest difference nan in channel a at pixel (0, 0)"));
  EXPECT_EQ(pixel(infinite.picture, 0), (std::vector<unsigned char>{ 255, 0, 255 }));
  EXPECT_EQ(pixel(infinite.picture, 2), black);
}

TEST(ImageDifference, OtherSizesOrChannelsAreRefusedByName)
{
  const ChannelImage one = imageOf({ 0, 0 }, { 0, 0 });
  ChannelImage other = one;
  other.channels = { { "a", { 0, 0 } }, { "c", { 0, 0 } } };
  EXPECT_THAT(messageOf<BadInput>([&] { compareImages(one, "one", other, "other", 0.0); }),
    AllOf(
      HasSubstr("one has 1 x 2 pixels with a, b"), HasSubstr("other has 1 x 2 pixels with a, c")));
  const ChannelImage wide = imageOf({ 0, 0, 0, 0 }, { 0, 0, 0, 0 });
  EXPECT_THAT(messageOf<BadInput>([&] { compareImages(one, "one", wide, "other", 0.0); }),
    HasSubstr("other has 2 x 2"));
}

/// `gnomon diff` on two pictures of 8 x 8 pixels, of which 3 differ by 10.
TEST(DiffCommand, ComparesWithTolerances)
{
  const TestFolder folder;
  const std::string a = folder / "a.png";
  const std::string b = folder / "b.png";
  Picture picture{ 8, 8, std::vector<unsigned char>(3 * 64, 100) };
  writePicture(picture, a);
  writePicture(picture, folder / "a.exr");
  for (std::size_t i : { 0u, 10u, 63u })
  {
    picture.rgb[3 * i + 1] = 110;
  }
  writePicture(picture, b);
  const auto run = [&](const std::string& options)
  {
    CLI::App app("gnomon");
    addDiffCommand(app);
    testing::internal::CaptureStdout();
    std::string outcome = "passes";
    try
    {
      app.parse("diff " + a + " " + options);
    }
    catch (const Failure&)
    {
      outcome = "fails";
    }
    catch (const BadInput&)
    {
      outcome = "bad input";
    }
    catch (const CLI::ParseError&)
    {
      outcome = "bad option";
    }
    return outcome + ": " + testing::internal::GetCapturedStdout();
  };
  const std::string difference = folder / "difference.png";
  for (const auto& [options, outcome] : { std::pair(a, "passes: 0 of 64 pixels differ"),
         { b,
           "fails: 3 of 64 pixels differ by more than 0; largest difference 10 in channel G at "
           "pixel (0, 0)" },
         { b + " --max-pixels 2", "fails: 3" }, { b + " --max-pixels 3", "passes: 3" },
         { b + " --max-difference 9.5", "fails: 3" }, { b + " --max-difference 10", "passes: 0" },
         { b + " -o " + difference, "fails: 3" }, { folder / "missing.png", "bad input" },
         { folder / "a.exr", "bad input" }, { b + " --max-difference nan", "bad input" },
         { b + " --max-difference -1", "bad option" }, { b + " --max-pixels -1", "bad option" },
         { "", "bad option" } })
  {
    EXPECT_THAT(run(options), testing::StartsWith(outcome)) << options;
  }
  EXPECT_EQ(readPicture(difference).rgb[0], 255);
}

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
