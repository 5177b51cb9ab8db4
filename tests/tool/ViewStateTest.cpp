#include "view/ViewState.h"

#include "Errors.h"
#include "MeshBuilder.h"
#include "Progress.h"
#include "SampleFiles.h"
#include "SceneFraming.h"
#include "TestFiles.h"

#include "view/ViewKeys.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace gnomon::tool
{
namespace
{

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
