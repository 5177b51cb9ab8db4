#include "view/ViewState.h"

#include "Files.h"
#include "SceneFile.h"

#include "shadowtech/Registry.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon::tool
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 5> showNames = { "technique", "truth", "error", "classes",
  "texels" };
constexpr NumberRange lightSize{ 0.0, 1e30 };
constexpr std::size_t largestFileBytes = 1 << 20;

double radiusSetting(const SceneLight& light)
{
  const auto said = light.settings.find("light_radius");
  return said == light.settings.end() ? 0.0 : std::stod(said->second);
}

std::array<int, 2> readPair(const JsonValue& value, int low, int high)
{
  const std::vector<JsonValue> numbers = value.elements();
  if (numbers.size() != 2)
  {
    value.fail("two numbers");
  }
  return { numbers[0].integer(low, high), numbers[1].integer(low, high) };
}

void describe(JsonMembers& members, LightPlace& light)
{
  members.add("position", light.position, numbersIn<3>(anyCoordinate), true);
  members.add("target", light.target, numbersIn<3>(anyCoordinate), true);
  members.add("size", light.size, numberIn(lightSize), true);
  members.refuseOthers();
  if (light.position == light.target)
  {
    members.place("target").fail("a target that is not the position");
  }
}

std::vector<LightPlace> readLights(const JsonValue& value, std::size_t expected)
{
  std::vector<LightPlace> lights;
  for (const JsonValue& entry : value.elements())
  {
    JsonMembers members(entry);
    describe(members, lights.emplace_back());
  }
  if (lights.size() != expected)
  {
    value.refuse("has " + std::to_string(lights.size()) + " lights, expected the scene's " +
      std::to_string(expected));
  }
  return lights;
}

/// Read or write a state, which is of its scene already.
void describe(JsonMembers& members, ViewState& state)
{
  members.add("scene", state.scene, &JsonValue::text, true);
  members.add("size", state.size,
    [](const JsonValue& value)
    {
      const std::array<int, 2> sides = readPair(value, 1, largestSidePixels);
      return PictureSize{ sides[0], sides[1] };
    });
  members.addObject("camera", state.camera,
    [](JsonMembers& ofCamera, SceneCamera& camera) { describe(ofCamera, camera, false); });
  members.add("lights", state.lights,
    [&](const JsonValue& value) { return readLights(value, state.lights.size()); });
  const int lastLight = std::max(0, static_cast<int>(state.lights.size()) - 1);
  members.add("light", state.light, integerIn(0, lastLight));
  members.add("technique", state.technique,
    [&](const JsonValue& value)
    {
      const std::string technique = value.text();
      value.refuseOnError([&] { parseTechnique(technique); });
      return technique;
    });
  members.add("map_size", state.mapSizeTexels, integerIn(16, 16384));
  members.add("truth_samples", state.truthSamples, integerIn(1, 65536));
  members.add("show", state.show,
    [](const JsonValue& value)
    {
      const std::string name = value.choice({ showNames.begin(), showNames.end() });
      return static_cast<Show>(
        std::find(showNames.begin(), showNames.end(), name) - showNames.begin());
    });
  for (const auto& [name, member] : { std::pair("handle", &ViewState::handle),
         { "frusta", &ViewState::frusta }, { "help", &ViewState::help } })
  {
    members.add(name, state.*member, &JsonValue::boolean);
  }
  members.add("probe", state.probe,
    [](const JsonValue& value) { return readPair(value, 0, largestSidePixels - 1); });
  members.add("sun", state.sun,
    [](const JsonValue& value) { return parseSunTime(value.text(), value.source() + ": sun"); });
  if (members.reads() || !state.surfaces.empty())
  {
    members.add("surfaces", state.surfaces, oneOf({ "wireframe", "surface" }));
  }
  members.add("stereo", state.stereo, &JsonValue::boolean);
  members.refuseOthers();
}

} // namespace

///@{
/// How nlohmann::json writes members of a state.
static void to_json(Json& json, Show show)
{
  json = nameOf(show);
}
static void to_json(Json& json, const SunTime& sun)
{
  json = textOf(sun);
}
static void to_json(Json& json, const PictureSize& size)
{
  json = { size.width, size.height };
}
static void to_json(Json& json, const LightPlace& light)
{
  json = { { "position", light.position }, { "target", light.target }, { "size", light.size } };
}
///@}

std::string nameOf(Show show)
{
  return showNames[static_cast<std::size_t>(show)];
}

LightPlace placeOf(const SceneLight& light)
{
  const double size = !light.area ? radiusSetting(light)
    : light.area->rectangle       ? 0.5 * light.area->width
                                  : light.area->radius;
  return { light.position, light.target, size };
}

void place(SceneLight& light, const LightPlace& place)
{
  light.position = place.position;
  light.target = place.target;
  if (place.size == placeOf(light).size)
  {
    return;
  }
  if (!light.area)
  {
    light.settings["light_radius"] = Json(place.size).dump();
  }
  else if (!light.area->rectangle)
  {
    light.area->radius = place.size;
  }
  else
  {
    const double proportion = light.area->height / light.area->width;
    light.area->width = 2.0 * place.size;
    light.area->height = proportion * light.area->width;
  }
}

ViewState initialState(const std::string& name, const Scene& scene)
{
  ViewState state;
  state.scene = name;
  state.camera = scene.camera;
  std::transform(scene.lights.begin(), scene.lights.end(), std::back_inserter(state.lights),
    [](const SceneLight& light) { return placeOf(light); });
  return state;
}

VariantSpec variantOf(const ViewState& state)
{
  VariantSpec spec = parseTechnique(state.technique);
  spec.mapSizeTexels = estimatorOf(settingsOf(spec)).info.bakesMap() ? state.mapSizeTexels : 0;
  return spec;
}

std::string textOf(const ViewState& state)
{
  Json json;
  JsonMembers members(json);
  ViewState written = state;
  describe(members, written);
  return json.dump(2) + "\n";
}

ViewState parseState(const std::string& text, const std::string& source, const Scene& scene)
{
  const nlohmann::json document = parseJson(text, source);
  JsonMembers members(JsonValue(source, document));
  ViewState state = initialState("", scene);
  describe(members, state);
  return state;
}

std::pair<ViewState, Scene> readView(const std::string& path)
{
  const std::string text = readWholeFile(path, largestFileBytes);
  const nlohmann::json document = parseJson(text, path);
  Scene scene = loadScene(JsonValue(path, document).member("scene").text());
  ViewState state = parseState(text, path, scene);
  return { std::move(state), std::move(scene) };
}

} // namespace gnomon::tool
