#include "view/ViewKeys.h"

#include "Errors.h"
#include "Vec3.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::tool
{
namespace
{

using Change = std::function<void(ViewState&, const Scene&, const ViewChoices&)>;

std::string onOff(bool on)
{
  return on ? "on" : "off";
}

/// Return the technique `steps` further in the list; the first one if the state's is not listed.
Change takeTechnique(int steps)
{
  return [steps](ViewState& state, const Scene&, const ViewChoices& choices)
  {
    const auto& all = choices.techniques;
    const auto now = std::find(all.begin(), all.end(), state.technique);
    const auto count = static_cast<std::ptrdiff_t>(all.size());
    const std::ptrdiff_t next = now == all.end() ? 0 : (now - all.begin() + steps + count) % count;
    state.technique = all[static_cast<std::size_t>(next)];
  };
}

/// Toggle between this and the technique.
Change toggleShow(Show show)
{
  return [show](ViewState& state, const Scene&, const ViewChoices&)
  { state.show = state.show == show ? Show::Technique : show; };
}

Change toggle(bool ViewState::*member)
{
  return [member](ViewState& state, const Scene&, const ViewChoices&)
  { state.*member = !(state.*member); };
}

Change scaleMap(bool larger)
{
  return [larger](ViewState& state, const Scene&, const ViewChoices&)
  {
    state.mapSizeTexels =
      std::clamp(larger ? 2 * state.mapSizeTexels : state.mapSizeTexels / 2, 64, 8192);
  };
}

/// Move the sun. A scene without a sun stays as it is.
Change moveSun(int minutes)
{
  return [minutes](ViewState& state, const Scene& scene, const ViewChoices&)
  {
    // The first sun without --sun: Munich, at noon in summer.
    SunTime sun = state.sun ? *state.sun : parseSunTime("2024-06-21T12:00+02:00,48.1,11.6", "");
    sun.clock += state.sun ? 60 * minutes : 0;
    if (sunOf(scene))
    {
      placeSun(state, scene, sun);
    }
  };
}

std::string saysShow(const ViewState& state)
{
  return nameOf(state.show);
}

std::string saysSun(const ViewState& state)
{
  return state.sun ? state.sun->time() : "";
}

ViewKey ofVtk(char code, std::string help)
{
  return { code, std::string(1, code), std::move(help), true, nullptr, nullptr };
}

std::vector<ViewKey> makeKeys()
{
  const auto says = [](bool ViewState::*member)
  { return [member](const ViewState& state) { return onOff(state.*member); }; };
  const auto shows = [](Show show)
  { return [show](const ViewState& state) { return onOff(state.show == show); }; };
  const auto surfaces = [](const char* name)
  { return [name](ViewState& state, const Scene&, const ViewChoices&) { state.surfaces = name; }; };
  const auto saysWireframe = [](bool wireframe)
  {
    return [wireframe](const ViewState& state)
    { return onOff((state.surfaces == "wireframe") == wireframe); };
  };
  return {
    { '[', "[", "the technique before", false, takeTechnique(-1), nullptr },
    { ']', "]", "the next technique", false, takeTechnique(1),
      [](const ViewState& state) { return state.technique; } },
    { ' ', "space", "technique, truth, error", false,
      [](ViewState& state, const Scene&, const ViewChoices&)
      {
        state.show = state.show == Show::Technique ? Show::Truth
          : state.show == Show::Truth              ? Show::Error
                                                   : Show::Technique;
      },
      saysShow },
    { 'k', "k", "classes: how each pixel was decided", false, toggleShow(Show::Classes),
      shows(Show::Classes) },
    { 'x', "x", "texels of the map beside pixels", false, toggleShow(Show::Texels),
      shows(Show::Texels) },
    { '-', "-", "map half as large", false, scaleMap(false), nullptr },
    { '+', "+", "map twice as large", false, scaleMap(true),
      [](const ViewState& state) { return std::to_string(state.mapSizeTexels); } },
    { 'v', "v", "what the light's map holds, its splits", false, toggle(&ViewState::frusta),
      says(&ViewState::frusta) },
    { 'i', "i", "what reaches the pixel under the cursor", false,
      [](ViewState& state, const Scene&, const ViewChoices&)
      {
        state.probe = state.probe
          ? std::nullopt
          : std::optional<std::array<int, 2>>({ state.size.width / 2, state.size.height / 2 });
      },
      [](const ViewState& state) { return onOff(state.probe.has_value()); } },
    { 'n', "n", "the next light", false,
      [](ViewState& state, const Scene&, const ViewChoices&)
      { state.light = state.lights.empty() ? 0 : (state.light + 1) % state.lights.size(); },
      [](const ViewState& state) { return std::to_string(state.light); } },
    { 'd', "d", "the light's handle: drag it, wheel for size", false, toggle(&ViewState::handle),
      says(&ViewState::handle) },
    { ',', ",", "sun half an hour earlier", false, moveSun(-30), nullptr },
    { '.', ".", "sun half an hour later", false, moveSun(30), saysSun },
    { '<', "<", "sun a week earlier", false, moveSun(-7 * 24 * 60), nullptr },
    { '>', ">", "sun a week later", false, moveSun(7 * 24 * 60), nullptr },
    { saveKey, "g", "save picture and settings", false, nullptr, nullptr },
    { 'h', "h", "these keys", false, toggle(&ViewState::help), says(&ViewState::help) },
    ofVtk('r', "all of the scene"),
    ofVtk('f', "fly to the point under the cursor"),
    ofVtk('p', "outline the prop under the cursor"),
    { 'w', "w", "wireframe", true, surfaces("wireframe"), saysWireframe(true) },
    { 's', "s", "surfaces", true, surfaces("surface"), saysWireframe(false) },
    { '3', "3", "stereo", true, nullptr, says(&ViewState::stereo) },
    ofVtk('j', "joystick: the camera moves on"),
    ofVtk('t', "trackball: the camera follows the mouse"),
    ofVtk('c', "the mouse moves the camera"),
    ofVtk('a', "the mouse moves props, which is not saved"),
    ofVtk('e', "end, as q"),
  };
}

/// "key   what it does   state"
std::string lineOf(const ViewKey& key, const ViewState& state)
{
  char line[160];
  const std::string says = key.says ? key.says(state) : "";
  std::snprintf(line, sizeof line, " %-5s  %-43s %s", key.name.c_str(), key.help.c_str(),
    says.substr(0, 40).c_str());
  std::string text = line;
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

} // namespace

const std::vector<ViewKey>& viewKeys()
{
  static const std::vector<ViewKey> keys = makeKeys();
  return keys;
}

const ViewKey* findKey(char code)
{
  const auto& keys = viewKeys();
  const auto found =
    std::find_if(keys.begin(), keys.end(), [code](const ViewKey& key) { return key.code == code; });
  return found == keys.end() ? nullptr : &*found;
}

std::string helpText(const ViewState& state)
{
  std::string text;
  for (const ViewKey& key : viewKeys())
  {
    text += lineOf(key, state);
  }
  return text;
}

std::string keysAsMarkdown()
{
  std::string text = "| key | what it does |\n|---|---|\n";
  for (const ViewKey& key : viewKeys())
  {
    text += "| `" + key.name + "` | " + key.help + (key.ofVtk ? " (VTK)" : "") + " |\n";
  }
  return text;
}

void resizeLight(ViewState& state, const Scene& scene, int steps)
{
  if (state.light >= state.lights.size())
  {
    return;
  }
  constexpr double factor = 1.25;
  const SceneLight& source = scene.lights[state.light];
  LightPlace& light = state.lights[state.light];
  // A smaller light is a point, and a point grows to this size.
  const double smallest = source.type == SceneLight::Type::Directional && !source.area
    ? 0.25
    : 0.005 * length(light.target - light.position);
  constexpr double largestDegrees = 90.0;
  const double size = steps > 0 ? std::max(light.size * std::pow(factor, steps), smallest)
                                : light.size * std::pow(factor, steps);
  light.size = source.area ? std::max(size, smallest) : size < smallest ? 0.0 : size;
  if (source.type == SceneLight::Type::Directional)
  {
    light.size = std::min(light.size, largestDegrees);
  }
}

std::optional<std::size_t> sunOf(const Scene& scene)
{
  const auto found = std::find_if(scene.lights.begin(), scene.lights.end(),
    [](const SceneLight& light)
    { return light.type == SceneLight::Type::Directional && !light.box; });
  return found == scene.lights.end()
    ? std::nullopt
    : std::optional(static_cast<std::size_t>(found - scene.lights.begin()));
}

void placeSun(ViewState& state, const Scene& scene, const SunTime& sun)
{
  const std::optional<std::size_t> found = sunOf(scene);
  if (!found)
  {
    throw BadInput("--sun: " + scene.name + " has no directional light, expected one");
  }
  state.sun = sun;
  LightPlace& light = state.lights[*found];
  light.position = light.target + placeOf(sun).towards;
}

} // namespace gnomon::tool
