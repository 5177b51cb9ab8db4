#include "view/ViewState.h"

#include "Errors.h"
#include "Files.h"
#include "SceneJson.h"

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

/// Return the value of the setting `light_radius`.
double radiusSetting(const SceneLight& light)
{
  const auto said = light.settings.find("light_radius");
  return said == light.settings.end() ? 0.0 : std::stod(said->second);
}

Show readShow(const JsonValue& value)
{
  const std::string name = value.text();
  const auto found = std::find(showNames.begin(), showNames.end(), name);
  if (found == showNames.end())
  {
    value.fail("one of: technique, truth, error, classes, texels");
  }
  return static_cast<Show>(found - showNames.begin());
}

std::vector<LightPlace> readLights(const JsonValue& value, const Scene& scene)
{
  std::vector<LightPlace> lights;
  for (const JsonValue& entry : value.elements())
  {
    entry.requireObject({ "position", "target", "size" });
    LightPlace& light = lights.emplace_back();
    light.position = entry.member("position").numbers<3>(anyCoordinate);
    light.target = entry.member("target").numbers<3>(anyCoordinate);
    light.size = entry.member("size").number(lightSize);
    if (light.position == light.target)
    {
      entry.member("target").fail("a target that is not the position");
    }
  }
  if (lights.size() != scene.lights.size())
  {
    value.refuse("has " + std::to_string(lights.size()) + " lights, expected the scene's " +
      std::to_string(scene.lights.size()));
  }
  return lights;
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

} // namespace

//------------------------------------------------------------------------------
std::string nameOf(Show show)
{
  return showNames[static_cast<std::size_t>(show)];
}

//------------------------------------------------------------------------------
LightPlace placeOf(const SceneLight& light)
{
  const double size = !light.area ? radiusSetting(light)
    : light.area->rectangle       ? 0.5 * light.area->width
                                  : light.area->radius;
  return { light.position, light.target, size };
}

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
ViewState initialState(const std::string& name, const Scene& scene)
{
  ViewState state;
  state.scene = name;
  state.camera = scene.camera;
  std::transform(scene.lights.begin(), scene.lights.end(), std::back_inserter(state.lights),
    [](const SceneLight& light) { return placeOf(light); });
  return state;
}

//------------------------------------------------------------------------------
VariantSpec variantOf(const ViewState& state)
{
  VariantSpec spec = parseTechnique(state.technique);
  spec.mapSizeTexels = estimatorOf(settingsOf(spec)).info.bakesMap() ? state.mapSizeTexels : 0;
  return spec;
}

//------------------------------------------------------------------------------
std::string textOf(const ViewState& state)
{
  Json json;
  json["scene"] = state.scene;
  json["size"] = { state.size.width, state.size.height };
  json["camera"] = toJson(state.camera);
  json["lights"] = Json::array();
  for (const LightPlace& light : state.lights)
  {
    json["lights"].push_back(
      { { "position", light.position }, { "target", light.target }, { "size", light.size } });
  }
  json["light"] = state.light;
  json["technique"] = state.technique;
  json["map_size"] = state.mapSizeTexels;
  json["truth_samples"] = state.truthSamples;
  json["show"] = nameOf(state.show);
  json["handle"] = state.handle;
  json["frusta"] = state.frusta;
  json["help"] = state.help;
  if (state.probe)
  {
    json["probe"] = *state.probe;
  }
  if (state.sun)
  {
    json["sun"] = textOf(*state.sun);
  }
  if (!state.surfaces.empty())
  {
    json["surfaces"] = state.surfaces;
  }
  json["stereo"] = state.stereo;
  return json.dump(2) + "\n";
}

//------------------------------------------------------------------------------
ViewState parseState(const std::string& text, const std::string& source, const Scene& scene)
{
  const nlohmann::json document = parseJson(text, source);
  const JsonValue root(source, document);
  root.requireObject({ "scene", "size", "camera", "lights", "light", "technique", "map_size",
    "truth_samples", "show", "handle", "frusta", "help", "probe", "sun", "surfaces", "stereo" });
  ViewState state = initialState(root.member("scene").text(), scene);
  // A missing member takes a new viewer's default.
  const auto read = [&root](const char* name, const auto& take)
  {
    if (const JsonValue value = root.member(name); value.present())
    {
      take(value);
    }
  };
  read("size",
    [&](const JsonValue& value)
    {
      const std::array<int, 2> size = readPair(value, 1, largestSidePixels);
      state.size = { size[0], size[1] };
    });
  read("camera", [&](const JsonValue& value) { state.camera = readCamera(value, state.camera); });
  read("lights", [&](const JsonValue& value) { state.lights = readLights(value, scene); });
  const int lastLight = std::max(0, static_cast<int>(state.lights.size()) - 1);
  read("light",
    [&](const JsonValue& value)
    { state.light = static_cast<std::size_t>(value.integer(0, lastLight)); });
  read("technique",
    [&](const JsonValue& value)
    {
      state.technique = value.text();
      try
      {
        variantOf(state);
      }
      catch (const BadInput& error)
      {
        value.refuse(error.what());
      }
    });
  read("map_size", [&](const JsonValue& value) { state.mapSizeTexels = value.integer(16, 16384); });
  read(
    "truth_samples", [&](const JsonValue& value) { state.truthSamples = value.integer(1, 65536); });
  read("show", [&](const JsonValue& value) { state.show = readShow(value); });
  read("handle", [&](const JsonValue& value) { state.handle = value.boolean(); });
  read("frusta", [&](const JsonValue& value) { state.frusta = value.boolean(); });
  read("help", [&](const JsonValue& value) { state.help = value.boolean(); });
  read("probe",
    [&](const JsonValue& value) { state.probe = readPair(value, 0, largestSidePixels - 1); });
  read("sun",
    [&](const JsonValue& value) { state.sun = parseSunTime(value.text(), source + ": sun"); });
  read("surfaces",
    [&](const JsonValue& value)
    {
      state.surfaces = value.text();
      if (state.surfaces != "wireframe" && state.surfaces != "surface")
      {
        value.fail("one of: wireframe, surface");
      }
    });
  read("stereo", [&](const JsonValue& value) { state.stereo = value.boolean(); });
  return state;
}

//------------------------------------------------------------------------------
std::pair<ViewState, Scene> readView(const std::string& path)
{
  const std::string text = readWholeFile(path, largestFileBytes);
  const nlohmann::json document = parseJson(text, path);
  Scene scene = loadScene(JsonValue(path, document).member("scene").text());
  ViewState state = parseState(text, path, scene);
  return { std::move(state), std::move(scene) };
}

} // namespace gnomon::tool
