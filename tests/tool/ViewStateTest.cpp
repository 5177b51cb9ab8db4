#include "view/ViewState.h"
#include "Errors.h"
#include "SampleFiles.h"
#include "TestFiles.h"
#include "view/ViewKeys.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include <set>

using testing::HasSubstr;

namespace gnomon::tool
{
namespace
{

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

} // namespace

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

} // namespace gnomon::tool
