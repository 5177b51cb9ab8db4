#include "Commands.h"
#include "Errors.h"
#include "ImageDifference.h"
#include "TestFiles.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>

#include <limits>

namespace gnomon::tool
{
namespace
{

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

} // namespace
} // namespace gnomon::tool
