#include "Commands.h"

#include "Errors.h"
#include "ImageDifference.h"
#include "ImageFile.h"
#include "MeshBuilder.h"
#include "Progress.h"
#include "SampleFiles.h"
#include "SceneFraming.h"
#include "TestFiles.h"

#include "view/View.h"
#include "view/ViewKeys.h"
#include "view/ViewState.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <numeric>
#include <set>
#include <thread>

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
    writeBytes(this->folder / "model.obj", sampleFile("model.obj"));
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

int darkest(const Picture& picture)
{
  return *std::min_element(picture.rgb.begin(), picture.rgb.end());
}

/// True if the white background shows in the middle of the lowest row.
bool showsBackgroundBelow(const Picture& picture)
{
  const auto pixel = picture.rgb.end() - 3 * (picture.width / 2);
  return std::all_of(pixel, pixel + 3, [](unsigned char value) { return value == 255; });
}

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

TEST_F(RenderCommand, ShowsAModelOnAGroundUnderAKeyLightAndALittleAmbient)
{
  const Picture picture = this->pictureOf(this->model);
  EXPECT_FALSE(showsBackgroundBelow(picture));
  EXPECT_GT(darkest(picture), 20);
  EXPECT_LT(darkest(picture), 80);
}

TEST_F(RenderCommand, PlacesTheKeyLightOfModelsForTheCamera)
{
  // From each side, half of the model's visible pixels are lit.
  for (const char* const position : { "3,5,7", "-3,5,7", "3,5,-7", "-7,5,-3" })
  {
    const ChannelImage image = this->visibilityOf(
      this->model, std::string("--camera position=") + position + ";target=0,1,0");
    int lit = 0;
    int onModel = 0;
    int inShadow = 0;
    for (std::size_t i = 0; i < image.channels.at("coverage").size(); ++i)
    {
      const bool isLit = image.channels.at("visibility.0")[i] > 0.0f;
      const bool isModel = image.channels.at("position.Y")[i] > 0.0f;
      if (image.channels.at("coverage")[i] == 1.0f)
      {
        onModel += isModel;
        lit += isModel && isLit;
        inShadow += !isModel && !isLit;
      }
    }
    EXPECT_GT(onModel, 100) << position;
    EXPECT_GE(2 * lit, onModel) << position;
    EXPECT_GT(inShadow, 10) << position;
  }
}

TEST_F(RenderCommand, GroundIsThereIfAskedFor)
{
  EXPECT_TRUE(showsBackgroundBelow(this->pictureOf(this->model, "--no-ground")));
  EXPECT_TRUE(showsBackgroundBelow(this->pictureOf(this->sceneFile())));
  EXPECT_FALSE(showsBackgroundBelow(this->pictureOf(this->sceneFile(), "--ground")));
  this->scene["ground"] = true;
  EXPECT_FALSE(showsBackgroundBelow(this->pictureOf(this->sceneFile())));
  EXPECT_TRUE(showsBackgroundBelow(this->pictureOf(this->sceneFile(), "--no-ground")));
}

TEST_F(RenderCommand, AmbientIsTheShareOfColourInShadow)
{
  // The darkest colour is the ground's blue, 0.72.
  EXPECT_EQ(darkest(this->pictureOf(this->model, "--ambient 0")), 0);
  EXPECT_NEAR(darkest(this->pictureOf(this->model, "--ambient 0.5")), 0.5 * 0.72 * 255, 1.0);
  this->scene["ambient"] = 0.5; // of 0.8, the colour of models
  EXPECT_NEAR(darkest(this->pictureOf(this->sceneFile())), 0.5 * 0.8 * 255, 1.0);
}

TEST_F(RenderCommand, TheSkyBrightensShadows)
{
  const int black = darkest(this->pictureOf(this->model, "--ambient 0"));
  const int even = darkest(this->pictureOf(this->model, "--ambient 0 --sky 0.5"));
  const int dome = darkest(this->pictureOf(this->model, "--ambient 0 --sky 0.5 --sky-model dome"));
  EXPECT_EQ(black, 0);
  EXPECT_GT(even, 20);
  EXPECT_LE(dome, even);

  this->scene["ambient"] = 0;
  this->scene["ground"] = true;
  const Picture dark = this->pictureOf(this->sceneFile());
  this->scene["sky"] = 0.5;
  EXPECT_NE(darkest(this->pictureOf(this->sceneFile())), darkest(dark));
  EXPECT_EQ(this->pictureOf(this->sceneFile(), "--sky 0").rgb, dark.rgb);
}

TEST_F(RenderCommand, GlassLeavesTranslucentModelsTheirLight)
{
  writeBytes(this->folder / "glass.mtl", "newmtl glass\nKd 0.5 0.5 0.5\nd 0.25\n");
  writeBytes(this->folder / "pane.obj",
    "mtllib glass.mtl\nv -1 0 0\nv 1 0 0\nv 1 2 1\nv -1 2 1\nvt 0 0\nusemtl glass\n"
    "f 1/1 2/1 3/1 4/1\n");
  const std::string pane = this->folder / "pane.obj";
  const std::string options = "--ambient 0 --technique raytraced";
  EXPECT_EQ(darkest(this->pictureOf(pane, options)), 0);
  EXPECT_GT(darkest(this->pictureOf(pane, options + " --glass")), 40);
}

TEST_F(RenderCommand, VolumesCastIfAsked)
{
  const auto seenOf = [this](const std::string& options)
  {
    const ChannelImage image = this->visibilityOf("props", options);
    const std::vector<float>& seen = image.channels.at("visibility.0");
    return std::accumulate(seen.begin(), seen.end(), 0.0);
  };
  const std::string options = "--technique raytraced";
  EXPECT_LT(seenOf(options + " --volumes"), seenOf(options) - 1.0);
}

TEST_F(RenderCommand, TellsHowPixelsWereDecided)
{
  const ChannelImage image = this->visibilityOf("cube",
    "--technique silhouette --classes " + this->folder / "classes.png" + " --stats " +
      this->folder / "stats.json");
  EXPECT_EQ(readPicture(this->folder / "classes.png").width, 64);
  const nlohmann::json stats = nlohmann::json::parse(readBytes(this->folder / "stats.json"));
  const nlohmann::json& light = stats.at("lights").at(0);
  EXPECT_GT(light.at("classes").at("lit for certain").get<int>(), 500);
  EXPECT_EQ(image.header.at("light.0.rays"), light.at("rays").dump());
  EXPECT_EQ(image.header.at("light.0.traced_pixels"), light.at("traced_pixels").dump());
  int pixels = 0;
  for (const auto& [name, count] : light.at("classes").items())
  {
    EXPECT_EQ(image.header.at("light.0.pixels." + name), count.dump()) << name;
    pixels += count.get<int>();
  }
  EXPECT_EQ(pixels, 64 * 64);
}

TEST_F(RenderCommand, ParallelCameraShowsSizesAsTheyAre)
{
  // The picture is 4 high: the pyramid, 2 wide where it stands, takes half of a row there.
  const std::string camera = "--no-ground --camera position=0,1,10;target=0,1,0";
  const std::vector<float> coverage =
    this->visibilityOf(this->model, camera + ";parallel_scale=2").channels.at("coverage");
  const auto row = coverage.begin() + 64 * 47;
  EXPECT_NEAR(std::count(row, row + 64, 1.0f), 32, 1);
  EXPECT_EQ(std::count(row + 64, coverage.end(), 1.0f), 0);

  // --parallel keeps the size of what the camera looks at: half a height is 2 at a distance of 10.
  EXPECT_EQ(
    this->visibilityOf(this->model, camera + ";fov=22.61986495 --parallel").channels.at("coverage"),
    coverage);
  this->scene["camera"] = { { "position", { 0, 1, 10 } }, { "target", { 0, 1, 0 } },
    { "parallel_scale", 2 } };
  EXPECT_EQ(this->visibilityOf(this->sceneFile()).channels.at("coverage"), coverage);
}

/// The picture's file is a pipe that is full until the reader begins, so the work takes that long.
TEST_F(RenderCommand, SaysAfterTwoSecondsWhatItDoes)
{
  const std::string pipe = this->folder / "pipe.png";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(fcntl(reader, F_SETPIPE_SZ, 4096), 4096);
  std::future<std::size_t> reading = std::async(std::launch::async,
    [reader]
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(2600));
      fcntl(reader, F_SETFL, 0); // waits for more
      char buffer[4096];
      std::size_t bytes = 0;
      for (ssize_t count = 0; (count = read(reader, buffer, sizeof(buffer))) > 0;)
      {
        bytes += static_cast<std::size_t>(count);
      }
      return bytes;
    });
  testing::internal::CaptureStderr();
  this->render("primitives", "--technique raytraced --size 256x256 -o " + pipe);
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_GT(reading.get(), 4096u);
  close(reader);
  EXPECT_EQ(said.rfind("gnomon: ", 0), 0u) << said;
  EXPECT_NE(said.find(" s\n"), std::string::npos) << said;
}

TEST_F(RenderCommand, DrawsASettingsFileOfTheViewer)
{
  const Scene scene = loadScene("cube");
  ViewState state = initialState("cube", scene);
  state.size = { 64, 48 };
  state.show = Show::Error;
  state.technique = "nsm";
  state.mapSizeTexels = 64;
  const std::string file = this->folder / "view.json";
  writeBytes(file, textOf(state));
  const std::string out = this->folder / "out.png";
  this->render("--settings " + file, "-o " + out);
  const Picture picture = readPicture(out);
  EXPECT_EQ(picture.rgb, drawWithoutScreen(state, scene).rgb);
  EXPECT_EQ(picture.width, 64);

  // A lamp that refuses the technique has another one, and the picture says so.
  const Scene room = loadScene("room");
  ViewState refused = initialState("room", room);
  refused.size = { 320, 240 };
  refused.technique = "nsm";
  const Picture plain = drawWithoutScreen(refused, room);
  refused.technique = "lispsm";
  refused.frusta = true;
  EXPECT_NE(drawWithoutScreen(refused, room).rgb, plain.rgb);

  EXPECT_THROW(this->render("", "-o " + out), BadInput);
  EXPECT_THROW(this->render("cube --settings " + file, "-o " + out), BadInput);
  EXPECT_THROW(this->render("--settings " + file, "--size 9x9 -o " + out), CLI::ParseError);
  writeBytes(file, "{}");
  EXPECT_THROW(this->render("--settings " + file, "-o " + out), BadInput);
}

using testing::HasSubstr;

SceneLight lightOf(SceneLight::Type type)
{
  SceneLight light;
  light.type = type;
  light.position = { { 1.0, 2.0, 3.0 } };
  return light;
}

/// A scene without surfaces, under a sun and a rectangle.
Scene lightsScene()
{
  Scene scene;
  scene.name = "lights";
  scene.lights = { lightOf(SceneLight::Type::Directional), lightOf(SceneLight::Type::Point) };
  scene.lights[1].area = SceneLight::Area{};
  scene.lights[1].area->rectangle = true;
  scene.lights[1].area->width = 2.0;
  scene.lights[1].area->height = 0.5;
  return scene;
}

/// A state in which nothing is as by default.
ViewState unusualState()
{
  ViewState state = initialState("lights", lightsScene());
  state.size = { 123, 45 };
  state.camera.position = { { 0.1, 1.0 / 3.0, -7e-9 } };
  state.camera.parallelScale = 0.7;
  state.lights[0].position = { { 0.1, 0.2, 0.3 } };
  state.lights[1].size = 0.3;
  state.light = 1;
  state.technique = "pcf:kernel=box:kernel_size=5";
  state.mapSizeTexels = 256;
  state.truthSamples = 7;
  state.show = Show::Error;
  state.handle = false;
  state.frusta = state.help = state.stereo = true;
  state.probe = { { 12, 34 } };
  state.sun = parseSunTime("2025-03-01T06:30-03:30,-33.9,18.4", "here");
  state.surfaces = "wireframe";
  return state;
}

/// The message of a state's text with another value.
std::string refusalOf(const std::string& key, const nlohmann::json& value)
{
  nlohmann::json json = nlohmann::json::parse(textOf(unusualState()));
  json[key] = value;
  return messageOf<BadInput>([&] { parseState(json.dump(), "file.json", lightsScene()); });
}

TEST(ViewState, ComesBackFromItsTextToTheLastBit)
{
  const std::string text = textOf(unusualState());
  EXPECT_EQ(textOf(parseState(text, "file.json", lightsScene())), text);
  // Every member is in the text: none is as in a new viewer.
  const nlohmann::json json = nlohmann::json::parse(text);
  const nlohmann::json plain = nlohmann::json::parse(textOf(initialState("lights", lightsScene())));
  for (const auto& [key, value] : json.items())
  {
    EXPECT_TRUE(key == "scene" || !plain.contains(key) || plain[key] != value) << key;
  }
  EXPECT_EQ(json.size(), 16u);
}

TEST(ViewState, RefusesWhatItCannotShowAndNamesThePlace)
{
  EXPECT_EQ(refusalOf("map_size", 512), "(nothing was thrown)");
  EXPECT_THAT(refusalOf("technique", "magic"), HasSubstr("file.json: technique: "));
  EXPECT_THAT(refusalOf("technique", "nsm:kernel=box"), HasSubstr("kernel"));
  EXPECT_THAT(refusalOf("show", "all"), HasSubstr("expected one of: technique, truth"));
  EXPECT_THAT(refusalOf("lights", nlohmann::json::array()), HasSubstr("expected the scene's 2"));
  EXPECT_THAT(refusalOf("light", 2), HasSubstr("light"));
  EXPECT_THAT(refusalOf("size", { 0, 5 }), HasSubstr("size"));
  EXPECT_THAT(refusalOf("surfaces", "points"), HasSubstr("wireframe"));
  EXPECT_THAT(refusalOf("sun", "noon"), HasSubstr("2024-06-21T12:00+02:00,48.1,11.6"));
  EXPECT_THAT(refusalOf("colour", "red"), HasSubstr("colour"));
}

TEST(ViewState, LightsGrowInTheirProportions)
{
  Scene scene = lightsScene();
  ViewState state = initialState("lights", scene);
  state.light = 1;
  EXPECT_EQ(state.lights[1].size, 1.0);
  resizeLight(state, scene, 1);
  place(scene.lights[1], state.lights[1]);
  EXPECT_DOUBLE_EQ(scene.lights[1].area->width, 2.5);
  EXPECT_DOUBLE_EQ(scene.lights[1].area->height, 0.625);

  state.light = 0; // a sun: from a point to half a degree and back
  for (int i = 0; i < 5; ++i)
  {
    resizeLight(state, scene, 1);
  }
  place(scene.lights[0], state.lights[0]);
  EXPECT_DOUBLE_EQ(std::stod(scene.lights[0].settings.at("light_radius")), state.lights[0].size);
  EXPECT_GT(state.lights[0].size, 0.5);
  resizeLight(state, scene, -5);
  EXPECT_EQ(state.lights[0].size, 0.0);
  resizeLight(state, scene, 100);
  EXPECT_LE(state.lights[0].size, 90.0);
}

TEST(SunTime, GoesOverTheEndsOfDaysMonthsAndYears)
{
  const auto after = [](const char* time, int minutes)
  {
    SunTime sun = parseSunTime(std::string(time) + "+01:00,0,0", "here");
    sun.clock += 60 * minutes;
    return sun.time().substr(0, 16);
  };
  EXPECT_EQ(after("2024-02-28T23:30", 60), "2024-02-29T00:30");
  EXPECT_EQ(after("2023-02-28T23:30", 60), "2023-03-01T00:30");
  EXPECT_EQ(after("2024-12-31T23:00", 90), "2025-01-01T00:30");
  EXPECT_EQ(after("2025-01-01T00:00", -30), "2024-12-31T23:30");
  EXPECT_EQ(after("2100-03-01T12:00", -1440), "2100-02-28T12:00");
  EXPECT_EQ(after("2024-06-21T12:00", -7 * 1440), "2024-06-14T12:00");
}

TEST(ViewKeys, EachIsThereOnceAndLeavesVtksAlone)
{
  std::set<char> codes;
  for (const ViewKey& key : viewKeys())
  {
    EXPECT_TRUE(codes.insert(key.code).second) << key.name;
    EXPECT_TRUE(!key.ofVtk || key.code != saveKey);
    // The keys of vtkInteractorStyle::OnChar() and vtkInteractorStyleSwitch.
    const bool vtks = std::string("mqefurwsp3ljtca").find(key.code) != std::string::npos;
    EXPECT_EQ(key.ofVtk, vtks) << key.name;
    EXPECT_THAT(helpText(unusualState()), HasSubstr(" " + key.name + " "));
    const std::string row = "| `" + key.name + "` | " + key.help + (vtks ? " (VTK) |" : " |");
    EXPECT_THAT(keysAsMarkdown(), HasSubstr(row));
  }
  EXPECT_EQ(findKey('\0'), nullptr);
}

TEST(ViewKeys, TheHelpSaysTheStates)
{
  ViewState state = unusualState();
  EXPECT_THAT(helpText(state), HasSubstr("pcf:kernel=box:kernel_size=5\n"));
  EXPECT_THAT(helpText(state), HasSubstr("error\n"));
  EXPECT_THAT(helpText(state), HasSubstr("2025-03-01T06:30-03:30\n"));
}

/// The depths of a model, seen along -z from height 2 with 90 degrees between the upper and the
/// lower border.
DepthRange depthsOf(const SceneModel& model, double aspect)
{
  Scene scene;
  scene.models = { model };
  scene.camera = makeCamera({ 0.0, 2.0, 0.0 }, { 0.0, 2.0, -1.0 }, 90.0);
  return visibleDepths(scene, aspect);
}

SceneModel makeBox(const Vec3& low, const Vec3& high)
{
  MeshBuilder mesh;
  mesh.addBox(low, high);
  return makeModel("box", mesh.build(), { 1.0, 1.0, 1.0 });
}

TEST(VisibleDepths, AreOfWhatIsInThePicture)
{
  const SceneModel ground = makePlane(origin, 200.0);
  // At 45 degrees to the right of the view it begins at depth 3, at depth 1 it is out of a square
  // picture, but not of one three times as wide as high.
  const SceneModel beside = makeBox({ 3.0, 1.0, -10.0 }, { 4.0, 3.0, 5.0 });
  SceneModel moved = makeBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
  moved.matrix = { 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 2, -8, 0, 0, 0, 1 };
  struct Case
  {
    const char* name;
    const SceneModel& model;
    double aspect, nearest, farthest;
  };
  for (const Case& of : { Case{ "from the lower border", ground, 1.0, 2.0, 100.0 },
         Case{ "beside a square", beside, 1.0, 3.0, 10.0 }, Case{ "wide", beside, 3.0, 1.0, 10.0 },
         Case{ "by a matrix", moved, 1.0, 6.0, 10.0 } })
  {
    const DepthRange depths = depthsOf(of.model, of.aspect);
    EXPECT_NEAR(depths.nearest, of.nearest, 1e-6) << of.name;
    EXPECT_NEAR(depths.farthest, of.farthest, 1e-7 * of.farthest) << of.name;
  }
  const DepthRange none = depthsOf(makeBox({ -1.0, 1.0, 2.0 }, { 1.0, 3.0, 3.0 }), 1.0);
  EXPECT_LT(none.farthest, none.nearest) << "behind the eye";
}

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::MatchesRegex;

/// Return the messages of work of 200 ms: a busy machine may wake its thread late.
std::string said(bool isTerminal, milliseconds silence)
{
  const TestFolder folder;
  const std::string path = folder / "said";
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  {
    std::ofstream stream(path, std::ios::app);
    Progress progress("reading", file, isTerminal, silence);
    progress.begin("rendering", 0.4);
    std::this_thread::sleep_for(milliseconds(200));
    progress.print("a note", stream);
  }
  close(file);
  return readBytes(path);
}

TEST(Progress, IsSilentAboutShortWork)
{
  EXPECT_EQ(said(false, milliseconds(10000)), "a note\n");
  EXPECT_EQ(said(true, milliseconds(10000)), "a note\n");
}

TEST(Progress, WritesLinesIntoALogAndOverItsLineOnATerminal)
{
  EXPECT_THAT(said(false, milliseconds(20)),
    MatchesRegex("(gnomon: rendering, 40 %, 0 s\n)+a note\n(gnomon: rendering, 40 %, 0 s\n)*"));
  EXPECT_THAT(said(true, milliseconds(20)),
    testing::AllOf(
      HasSubstr("gnomon: rendering, 40 %, 0 s\r\x1b[K"), HasSubstr("\r\x1b[Ka note\n")));
}

} // namespace
} // namespace gnomon::tool
