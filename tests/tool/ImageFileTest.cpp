#include "ImageFile.h"

#include "Errors.h"
#include "SyntheticResults.h"
#include "TestFiles.h"

#include "plugin/vtkGnomonEGLRenderWindow.h"

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

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

TEST(ImageFile, AnotherEndingIsRefused)
{
  const TestFolder folder;
  const Picture picture = noisePicture(2, 2);
  for (const char* name : { "a.jpg", "a", ".png" })
  {
    const std::string message = messageOf<BadInput>([&] { writePicture(picture, folder / name); });
    EXPECT_NE(message.find("ends in .png or .exr"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  }
}

TEST(ImageFile, PathsThatCannotBeWrittenAreRefused)
{
  const TestFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  for (const char* name : { "missing/a.png", "missing/a.exr", "folder.png" })
  {
    const std::string message =
      messageOf<BadInput>([&] { writePicture(noisePicture(2, 2), folder / name); });
    EXPECT_NE(message.find(folder / name), std::string::npos) << message;
    EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
  }
}

TEST(ImageFile, AFullDiskIsAFailure)
{
  if (!std::filesystem::exists("/dev/full"))
  {
    GTEST_SKIP() << "needs /dev/full";
  }
  const TestFolder folder;
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
  vtkNew<vtkGnomonEGLRenderWindow> window;
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

TEST(ImageFile, VisibilityOfALightWithATextureHasThreeChannels)
{
  const TestFolder folder;
  VisibilityImages images = floorTruth();
  images.sceneIndices = { 0, 2, 2, 2 };
  for (const LightChannel channel : { LightChannel::Red, LightChannel::Green, LightChannel::Blue })
  {
    images.channels.push_back(channel);
    images.visibility.emplace_back(
      images.coverage.size(), 0.25f * static_cast<float>(images.channels.size()));
  }
  const std::string path = folder / "visibility.exr";
  writeVisibility(images, path, {});
  const ChannelImage read = readChannels(path);
  EXPECT_EQ(read.channels.at("visibility.0"), images.visibility[0]);
  EXPECT_EQ(read.channels.at("visibility.2.R"), images.visibility[1]);
  EXPECT_EQ(read.channels.at("visibility.2.G"), images.visibility[2]);
  EXPECT_EQ(read.channels.at("visibility.2.B"), images.visibility[3]);
}

TEST(ImageFile, VisibilityComesBackAsWritten)
{
  const TestFolder folder;
  VisibilityImages images = floorTruth();
  images.origin = { { 4e6 + 0.125, -1.0 / 3.0, 5e-7 } };
  images.visibility.push_back(std::vector<float>(images.coverage.size(), 0.25f));
  images.sceneIndices = { 0, 2 };
  images.channels.push_back(LightChannel::All);
  images.positionX[5] = 1.0f / 3.0f;
  const std::string path = folder / "visibility.exr";
  writeVisibility(images, path, { { "technique", "nsm" }, { "stage maps", "8.25 ms" } });

  const ChannelImage read = readChannels(path);
  EXPECT_EQ(read.width, images.width);
  EXPECT_EQ(read.height, images.height);
  EXPECT_EQ(read.origin, images.origin);
  EXPECT_EQ(read.header.at("technique"), "nsm");
  EXPECT_EQ(read.header.at("stage maps"), "8.25 ms");
  EXPECT_EQ(read.channels.size(), 9u);
  EXPECT_EQ(read.channels.at("visibility.0"), images.visibility[0]);
  EXPECT_EQ(read.channels.at("visibility.2"), images.visibility[1]);
  EXPECT_EQ(read.channels.at("position.X"), images.positionX);
  EXPECT_EQ(read.channels.at("position.Y"), images.positionY);
  EXPECT_EQ(read.channels.at("position.Z"), images.positionZ);
  EXPECT_EQ(read.channels.at("normal.X"), images.normalX);
  EXPECT_EQ(read.channels.at("normal.Y"), images.normalY);
  EXPECT_EQ(read.channels.at("normal.Z"), images.normalZ);
  EXPECT_EQ(read.channels.at("coverage"), images.coverage);
}

TEST(ImageFile, VisibilityWithAPlaneMissingIsRefused)
{
  const TestFolder folder;
  VisibilityImages images = floorTruth();
  images.normalZ.pop_back();
  EXPECT_THROW(writeVisibility(images, folder / "v.exr", {}), std::invalid_argument);
}

/// Every way to break a file must end in BadInput with the file's name.
class BrokenFile : public ::testing::TestWithParam<const char*>
{
protected:
  std::string path() const { return this->folder / (std::string("image") + GetParam()); }
  void expectBadInput(const std::string& what) const
  {
    const std::string message = messageOf<BadInput>([this] { readPicture(this->path()); });
    EXPECT_NE(message.find(this->path()), std::string::npos) << what << ": " << message;
  }

  TestFolder folder;
};

TEST_P(BrokenFile, MissingEmptyOrAFolder)
{
  expectBadInput("missing");
  writeBytes(path(), "");
  expectBadInput("empty");
  std::filesystem::remove(path());
  std::filesystem::create_directory(path());
  expectBadInput("folder");
}

TEST_P(BrokenFile, TruncatedAnywhere)
{
  writePicture(noisePicture(64, 64), path());
  const std::string whole = readBytes(path());
  ASSERT_NO_THROW(readPicture(path()));
  // Up to the last byte of the pixels: a PNG is readable without its last 12, the end mark.
  for (std::size_t length = 1; length < whole.size() - 13; length += 1 + length / 8)
  {
    writeBytes(path(), whole.substr(0, length));
    expectBadInput("first " + std::to_string(length) + " of " + std::to_string(whole.size()));
  }
  writeBytes(path(), whole.substr(0, whole.size() - 14));
  expectBadInput("the last bytes missing");
}

TEST_P(BrokenFile, Garbage)
{
  std::string garbage;
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i)
  {
    garbage += static_cast<char>(random() & 255u);
  }
  writeBytes(path(), garbage);
  expectBadInput("noise");

  writePicture(noisePicture(64, 64), path());
  const std::string whole = readBytes(path());
  writeBytes(path(), whole.substr(0, 8) + garbage);
  expectBadInput("noise after the signature");
}

TEST_P(BrokenFile, DamagedBytesNeverCrash)
{
  writePicture(noisePicture(24, 24), path());
  const std::string whole = readBytes(path());
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial)
  {
    std::string damaged = whole;
    for (int i = 0; i < 4; ++i)
    {
      // Headers more often than pixels.
      const std::size_t limit =
        trial % 2 ? damaged.size() : std::min<std::size_t>(400, damaged.size());
      damaged[random() % limit] = static_cast<char>(random() & 255u);
    }
    writeBytes(path(), damaged);
    try
    {
      const Picture picture = readPicture(path());
      EXPECT_EQ(picture.rgb.size(), 3 * picture.pixelCount());
    }
    catch (const BadInput&)
    {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, BrokenFile, ::testing::Values(".png", ".exr"),
  [](const auto& format) { return std::string(format.param).substr(1); });

} // namespace
} // namespace gnomon::tool
