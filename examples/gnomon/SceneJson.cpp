#include "SceneJson.h"

#include "Errors.h"
#include "TextureFile.h"
#include "Vec3.h"
#include "lights/SettingsTable.h"

#include <map>

namespace gnomon::tool
{

namespace
{

constexpr NumberRange lightIntensity{ 0.0, 1e6 };
constexpr NumberRange coneAngleDegrees{ 0.01, 89.9 };
constexpr NumberRange fieldOfViewDegrees{ 0.01, 179.0 };
constexpr NumberRange extent{ 1e-30, 1e30 };

Vec3 readDirection(const JsonValue& value)
{
  const Vec3 direction = value.numbers<3>(anyCoordinate);
  if (length(direction) == 0.0)
  {
    value.fail("a direction that is not zero");
  }
  return direction;
}

/// Read a target, which must differ from the position.
Vec3 readTarget(const JsonValue& value, const Vec3& position)
{
  const Vec3 target = value.numbers<3>(anyCoordinate);
  if (length(target - position) == 0.0)
  {
    value.fail("a target that is not the position");
  }
  return target;
}

/// Read an up direction, which must not be parallel to the direction from position to target.
/// Default: y.
Vec3 readUp(const JsonValue& value, const Vec3& defaultUp, const Vec3& forward)
{
  const Vec3 up = value.present() ? readDirection(value) : defaultUp;
  constexpr double smallestSine = 1e-6;
  if (length(cross(normalized(forward), normalized(up))) < smallestSine)
  {
    value.present() ? value.fail("an up direction that is not parallel to the view")
                    : value.refuse("missing, and the default [0, 1, 0] is parallel to the view, "
                                   "expected another up direction");
  }
  return up;
}

/// Read a setting of a light's shadows, as text.
std::string readSetting(const JsonValue& value, const Setting& setting)
{
  ShadowSettings scratch;
  if (const auto* range = std::get_if<IntegerSetting>(&setting.values))
  {
    return std::to_string(value.integer(range->smallest, range->largest));
  }
  if (const auto* reals = std::get_if<RealSetting>(&setting.values))
  {
    setting.write(scratch, value.number({ reals->smallest, reals->largest }));
    return setting.get(scratch);
  }
  const std::string text = value.text();
  if (!setting.set(scratch, text))
  {
    value.fail(setting.expected());
  }
  return text;
}

SceneLight::Box readBox(const JsonValue& value, const Vec3& travel)
{
  value.requireObject({ "position", "up", "width", "height", "depth" });
  SceneLight::Box box;
  box.width = value.member("width").number(extent);
  box.height = value.member("height").number(extent);
  box.depth = value.member("depth").number(extent);
  box.up = readUp(value.member("up"), box.up, travel);
  return box;
}

/// Read the area of an area light. A rectangle's width lies along cross(travel, up), its height
/// across that.
SceneLight::Area readArea(
  const JsonValue& value, const Vec3& travel, const std::filesystem::path& folder)
{
  SceneLight::Area area;
  const JsonValue shape = value.member("shape");
  const std::string name = shape.present() ? shape.text() : "rectangle";
  if (name != "rectangle" && name != "disk")
  {
    shape.fail("one of: rectangle, disk");
  }
  area.rectangle = name == "rectangle";
  if (const JsonValue texture = value.member("texture"); texture.present())
  {
    texture.refuseOnError([&] { area.texture = readImage((folder / texture.text()).string()); });
  }
  const auto refuseSurplus = [&](const char* key, const std::string& of)
  {
    if (const JsonValue surplus = value.member(key); surplus.present())
    {
      surplus.refuse("means nothing for a " + of);
    }
  };
  if (area.rectangle)
  {
    refuseSurplus("radius", name);
    area.width = value.member("width").number(extent);
    area.height = value.member("height").number(extent);
  }
  else
  {
    refuseSurplus("width", name);
    refuseSurplus("height", name);
    area.radius = value.member("radius").number(extent);
  }
  if (area.rectangle || area.texture)
  {
    area.up = readUp(value.member("up"), area.up, travel);
  }
  else
  {
    refuseSurplus("up", "disk without texture");
  }
  return area;
}

} // namespace

//------------------------------------------------------------------------------
SceneLight readLight(const JsonValue& value, const std::filesystem::path& folder)
{
  static const std::map<std::string, std::vector<std::string>> keys = {
    { "area",
      { "position", "target", "cone_angle", "shape", "radius", "width", "height", "up",
        "texture" } },
    { "directional", { "direction", "box" } },
    { "point", { "position" } },
    { "spot", { "position", "target", "cone_angle" } },
  };
  const JsonValue kind = value.member("type");
  const auto found = keys.find(kind.text());
  if (found == keys.end())
  {
    kind.fail("one of: directional, spot, point, area");
  }
  const auto& [type, ownKeys] = *found;
  std::vector<std::string> known = ownKeys;
  known.insert(known.end(), { "type", "color", "intensity" });
  SceneLight light;
  for (const Setting* setting : shadowSettings())
  {
    known.push_back(setting->name);
    if (const JsonValue wished = value.member(setting->name); wished.present())
    {
      light.settings[setting->name] = readSetting(wished, *setting);
    }
  }
  value.requireObject(known);
  light.color = value.member("color").numbersOr(light.color, colorChannel);
  light.intensity = value.member("intensity").numberOr(light.intensity, lightIntensity);

  if (type == "directional")
  {
    const Vec3 travel = normalized(readDirection(value.member("direction")));
    light.position = -travel;
    if (const JsonValue box = value.member("box"); box.present())
    {
      light.box = readBox(box, travel);
      light.position = box.member("position").numbers<3>(anyCoordinate);
      light.target = light.position + travel;
    }
    return light;
  }
  light.type = SceneLight::Type::Point;
  light.position = value.member("position").numbers<3>(anyCoordinate);
  light.target = type == "point" ? light.position - Vec3{ 0.0, 1.0, 0.0 } // arbitrary
                                 : readTarget(value.member("target"), light.position);
  const JsonValue angle = value.member("cone_angle");
  if (type == "spot" || angle.present())
  {
    light.type = SceneLight::Type::Spot;
    light.coneAngleDegrees = angle.numberOr(light.coneAngleDegrees, coneAngleDegrees);
  }
  if (type == "area")
  {
    light.area = readArea(value, light.target - light.position, folder);
  }
  return light;
}

//------------------------------------------------------------------------------
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults)
{
  value.requireObject({ "position", "target", "up", "fov", "parallel_scale" });
  SceneCamera camera = defaults.value_or(SceneCamera{});
  const JsonValue position = value.member("position");
  const JsonValue target = value.member("target");
  if (position.present() || !defaults)
  {
    camera.position = position.numbers<3>(anyCoordinate);
  }
  if (target.present() || !defaults)
  {
    camera.target = readTarget(target, camera.position);
  }
  else if (length(camera.target - camera.position) == 0.0)
  {
    position.fail("a position that is not the scene's target");
  }
  camera.up = readUp(value.member("up"), camera.up, camera.target - camera.position);
  const JsonValue angle = value.member("fov");
  const JsonValue scale = value.member("parallel_scale");
  if (angle.present() && scale.present())
  {
    angle.refuse("means nothing for a parallel camera, which \"parallel_scale\" makes");
  }
  if (angle.present())
  {
    camera.fovDegrees = angle.number(fieldOfViewDegrees);
    camera.parallelScale.reset();
  }
  else if (scale.present())
  {
    camera.parallelScale = scale.number(extent);
  }
  return camera;
}

//------------------------------------------------------------------------------
nlohmann::ordered_json toJson(const SceneCamera& camera)
{
  nlohmann::ordered_json json = { { "position", camera.position }, { "target", camera.target },
    { "up", camera.up } };
  camera.parallelScale ? json["parallel_scale"] = *camera.parallelScale
                       : json["fov"] = camera.fovDegrees;
  return json;
}

} // namespace gnomon::tool
