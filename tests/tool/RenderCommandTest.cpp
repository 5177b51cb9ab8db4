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

//------------------------------------------------------------------------------
TEST_F(RenderCommand, RefusesWhatMakesNoSense)
{
  this->scene["lights"] = { { { "type", "point" }, { "position", { 3, 4, 5 } },
    { "technique", "tsm" } } };
  const std::string scene = this->sceneFile();
  const std::string lamp = " --light point:position=3,4,5";
  struct Case
  {
    std::string file;
    std::string options;
    std::vector<std::string> named; ///< by the message
  };
  const std::vector<Case> cases = {
    { "cube", lamp + " --technique pssm", { "light 0", "pssm", "point light" } },
    { "cube", lamp + lamp + ";technique=lispsm", { "light 1", "lispsm" } },
    { scene, "", { "light 0", "tsm" } },
    { "cube", "--technique silhouette --map-samples 4",
      { "light 0", "silhouette", "map_samples" } },
  };
  for (const Case& wrong : cases)
  {
    std::string message = messageOf<BadInput>(
      [&]
      {
        try
        {
          this->pictureOf(wrong.file, wrong.options);
        }
        catch (const CLI::ValidationError& error) // main() gives it the same exit code
        {
          throw BadInput(error.what());
        }
      });
    for (const std::string& name : wrong.named)
    {
      EXPECT_NE(message.find(name), std::string::npos) << wrong.options << ": " << message;
    }
    EXPECT_FALSE(std::filesystem::exists(this->folder / "out.png")) << wrong.options;
  }
}

} // namespace
} // namespace gnomon::tool
