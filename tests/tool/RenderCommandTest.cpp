#include "Commands.h"
#include "Errors.h"
#include "ImageDifference.h"
#include "ImageFile.h"
#include "SampleFiles.h"
#include "TestFiles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::tool
{
namespace
{

/// A folder with model.obj (SampleFiles.h), what `gnomon render` makes of it, and scene files.
class RenderCommand : public ::testing::Test
{
protected:
  RenderCommand()
  {
    writeBytes(this->folder / "model.obj", sampleObj());
    this->scene["models"] = { { { "file", "model.obj" } } };
  }

  /// `gnomon render FILE` with these options.
  void render(const std::string& file, const std::string& options)
  {
    CLI::App app;
    addRenderCommand(app);
    app.parse("render " + file + " " + options);
  }
  /// Of 64 x 64 pixels.
  Picture pictureOf(const std::string& file, const std::string& options = "")
  {
    this->render(file, options + " --size 64x64 -o " + this->folder / "out.png");
    return readPicture(this->folder / "out.png");
  }
  ChannelImage visibilityOf(const std::string& file, const std::string& options = "")
  {
    this->pictureOf(file, options + " --visibility " + this->folder / "out.exr");
    return readChannels(this->folder / "out.exr");
  }
  /// Writes the scene file.
  std::string sceneFile()
  {
    writeBytes(this->folder / "scene.json", this->scene.dump());
    return this->folder / "scene.json";
  }

  TestFolder folder;
  std::string model = folder / "model.obj";
  nlohmann::json scene;
};

//------------------------------------------------------------------------------
TEST_F(RenderCommand, VisibilityWithoutCastingLightsHoldsTheReceivers)
{
  ChannelImage lit = this->visibilityOf("cube");
  ASSERT_EQ(lit.channels.erase("visibility.0"), 1u);
  const ChannelImage dark =
    this->visibilityOf("cube", "--light directional:direction=-1,-2,-1;intensity=0");
  EXPECT_EQ(dark.channels, lit.channels);
  EXPECT_EQ(compareImages(dark, "a", dark, "b", 0.0).differingPixels, 0);

  this->scene["lights"] = nlohmann::json::array();
  const ChannelImage none = this->visibilityOf(this->sceneFile());
  EXPECT_EQ(none.channels.count("visibility.0"), 0u);
  const std::vector<float>& coverage = none.channels.at("coverage");
  EXPECT_GT(std::count(coverage.begin(), coverage.end(), 1.0f), 500);
}

} // namespace
} // namespace gnomon::tool
