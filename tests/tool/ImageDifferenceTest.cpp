#include "ImageDifference.h"
#include "Commands.h"
#include "Errors.h"
#include "TestFiles.h"

#include <CLI/CLI.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::tool
{
namespace
{

ChannelImage flatImage(int width, int height, float value)
{
  ChannelImage image;
  image.width = width;
  image.height = height;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.channels["a"].assign(count, value);
  image.channels["b"].assign(count, value);
  return image;
}

TEST(ImageDifference, CountsPixelsAndFindsTheLargest)
{
  const ChannelImage one = flatImage(10, 5, 1.0f);
  ChannelImage other = one;
  other.channels["a"][3] = 1.5f;   // exactly the tolerance: does not differ
  other.channels["a"][12] = 1.75f; // differs in both channels: one pixel
  other.channels["b"][12] = 2.5f;
  other.channels["b"][49] = 0.0f;
  const ImageDifference difference = compareImages(one, "one", other, "other", 0.5);
  EXPECT_EQ(difference.differingPixels, 2);
  EXPECT_EQ(difference.largest, 1.5);
  EXPECT_EQ(difference.largestX, 2);
  EXPECT_EQ(difference.largestY, 1);
  EXPECT_EQ(difference.largestChannel, "b");
  EXPECT_EQ(describe(difference, 0.5),
    "2 of 50 pixels differ by more than 0.5; largest difference 1.5 in channel b at pixel (2, 1), "
    "counted from the top left");
}

TEST(ImageDifference, NanAlwaysDiffersAndEqualInfinitiesDoNot)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  ChannelImage one = flatImage(4, 1, 0.0f);
  one.channels["a"] = { nan, nan, infinity, infinity };
  ChannelImage other = one;
  other.channels["a"] = { nan, 0.0f, infinity, -infinity };
  const ImageDifference difference = compareImages(one, "one", other, "other", 1e30);
  EXPECT_EQ(difference.differingPixels, 3);
  EXPECT_TRUE(std::isnan(difference.largest));
  EXPECT_EQ(difference.largestX, 0);
}

TEST(ImageDifference, OtherSizesOrChannelsAreRefusedByName)
{
  const ChannelImage one = flatImage(10, 5, 1.0f);
  std::string message = messageOf<BadInput>(
    [&] { compareImages(one, "one.exr", flatImage(10, 6, 1.0f), "other.exr", 0.0); });
  EXPECT_NE(message.find("one.exr has 10 x 5"), std::string::npos) << message;
  EXPECT_NE(message.find("other.exr has 10 x 6"), std::string::npos) << message;

  ChannelImage other = one;
  other.channels.erase("b");
  other.channels["c"] = one.channels.at("b");
  message = messageOf<BadInput>([&] { compareImages(one, "one.exr", other, "other.exr", 0.0); });
  EXPECT_NE(message.find("one.exr has a, b"), std::string::npos) << message;
  EXPECT_NE(message.find("other.exr has a, c"), std::string::npos) << message;
}

TEST(ImageDifference, ThePictureShowsWhatDiffers)
{
  const ChannelImage one = flatImage(4, 1, 0.0f);
  ChannelImage other = one;
  other.channels["a"] = { 0.0f, 0.5f, 2.0f, std::numeric_limits<float>::quiet_NaN() };
  const Picture picture = differencePicture(compareImages(one, "one", other, "other", 1.0), 1.0);
  const std::vector<unsigned char> expected = { 0, 0, 0, 80, 80, 80, 255, 255, 0, 255, 0, 255 };
  EXPECT_EQ(picture.rgb, expected);
}

/// `gnomon diff` on two pictures of 8 x 8 pixels, of which 3 differ by 10.
class DiffCommand : public ::testing::Test
{
protected:
  DiffCommand()
  {
    Picture picture;
    picture.width = 8;
    picture.height = 8;
    picture.rgb.assign(3 * picture.pixelCount(), 100);
    writePicture(picture, this->a);
    writePicture(picture, this->folder / "a.exr");
    for (std::size_t i : { 0u, 10u, 63u })
    {
      picture.rgb[3 * i + 1] = 110;
    }
    writePicture(picture, this->b);
    picture.width = 4;
    picture.height = 16;
    writePicture(picture, this->folder / "tall.png");
  }

  void run(std::vector<std::string> arguments) const
  {
    CLI::App app("gnomon");
    addDiffCommand(app);
    arguments.insert(arguments.begin(), "diff");
    std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes vectors
    ::testing::internal::CaptureStdout();
    try
    {
      app.parse(arguments);
    }
    catch (...)
    {
      this->output = ::testing::internal::GetCapturedStdout();
      throw;
    }
    this->output = ::testing::internal::GetCapturedStdout();
  }

  TestFolder folder;
  std::string a = this->folder / "a.png";
  std::string b = this->folder / "b.png";
  mutable std::string output;
};

TEST_F(DiffCommand, EqualImagesPass)
{
  EXPECT_NO_THROW(this->run({ this->a, this->a }));
  EXPECT_NE(this->output.find("0 of 64 pixels differ"), std::string::npos) << this->output;
}

TEST_F(DiffCommand, MorePixelsThanAllowedFail)
{
  EXPECT_THROW(this->run({ this->a, this->b }), Failure);
  EXPECT_NE(this->output.find("3 of 64 pixels differ"), std::string::npos) << this->output;
  EXPECT_NE(
    this->output.find("largest difference 10 in channel G at pixel (0, 0)"), std::string::npos)
    << this->output;
  EXPECT_THROW(this->run({ this->a, this->b, "--max-pixels", "2" }), Failure);
  EXPECT_THROW(this->run({ this->a, this->b, "--max-difference", "9.5" }), Failure);
}

TEST_F(DiffCommand, BothTolerancesAllow)
{
  EXPECT_NO_THROW(this->run({ this->a, this->b, "--max-pixels", "3" }));
  EXPECT_NO_THROW(this->run({ this->a, this->b, "--max-difference", "10" }));
}

TEST_F(DiffCommand, WritesThePictureWhetherItPassesOrNot)
{
  const std::string path = this->folder / "difference.png";
  EXPECT_THROW(this->run({ this->a, this->b, "-o", path }), Failure);
  const Picture picture = readPicture(path);
  EXPECT_EQ(picture.width, 8);
  EXPECT_EQ(picture.rgb[0], 255);
  EXPECT_EQ(picture.rgb[3], 0);
}

TEST_F(DiffCommand, BadInputIsNamed)
{
  EXPECT_THROW(this->run({ this->a, this->folder / "missing.png" }), BadInput);
  EXPECT_THROW(this->run({ this->a, this->folder / "tall.png" }), BadInput);
  EXPECT_THROW(this->run({ this->a, this->folder / "a.exr" }), BadInput);
  EXPECT_THROW(this->run({ this->a, this->b, "--max-difference", "nan" }), BadInput);
  EXPECT_THROW(this->run({ this->a, this->b, "--max-difference", "-1" }), CLI::ParseError);
  EXPECT_THROW(this->run({ this->a, this->b, "--max-pixels", "-1" }), CLI::ParseError);
  EXPECT_THROW(this->run({ this->a }), CLI::ParseError);
}

} // namespace
} // namespace gnomon::tool
