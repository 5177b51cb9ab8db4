#include "ImageFile.h"

#include "Errors.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include "plugin/vtkGnomonOffScreenWindow.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

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

} // namespace
} // namespace gnomon::tool
