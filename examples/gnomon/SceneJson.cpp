#include "SceneJson.h"

#include "Errors.h"
#include "TextureFile.h"
#include "Vec3.h"
#include "lights/SettingsTable.h"

namespace gnomon::tool
{

namespace
{

constexpr NumberRange lightIntensity{ 0.0, 1e6 };
constexpr NumberRange coneAngleDegrees{ 0.01, 89.9 };
constexpr NumberRange fieldOfViewDegrees{ 0.01, 179.0 };
constexpr NumberRange extent{ 1e-30, 1e30 };

Vec3 readPoint(const JsonValue& value)
{
  return value.numbers<3>(anyCoordinate);
}

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
  const Vec3 target = readPoint(value);
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
    if (value.present())
    {
      value.fail("an up direction that is not parallel to the view");
    }
    value.refuse("missing, and the default [0, 1, 0] is parallel to the view, expected another "
                 "up direction");
  }
  return up;
}

/// Read a setting of a light's shadows, as text.
std::string readSetting(const JsonValue& value, const Setting& setting)
{
  if (const auto* range = std::get_if<IntegerSetting>(&setting.values))
  {
    return std::to_string(value.integer(range->smallest, range->largest));
  }
  if (const auto* reals = std::get_if<RealSetting>(&setting.values))
  {
    ShadowSettings scratch;
    setting.write(scratch, value.number({ reals->smallest, reals->largest }));
    return setting.get(scratch);
  }
  const std::string text = value.text();
  if (ShadowSettings scratch; !setting.set(scratch, text))
  {
    value.fail(setting.expected());
  }
  return text;
}

/// Refuse keys that a light of this kind does not have.
void requireLight(const JsonValue& value, std::vector<std::string> known)
{
  known.insert(known.end(), { "type", "color", "intensity" });
  for (const Setting* setting : shadowSettings())
  {
    known.push_back(setting->name);
  }
  value.requireObject(known);
}

/// Read the keys that all kinds of light share.
void readCommon(const JsonValue& value, SceneLight& light)
{
  light.color = value.member("color").numbersOr(light.color, colorChannel);
  light.intensity = value.member("intensity").numberOr(light.intensity, lightIntensity);
  for (const Setting* setting : shadowSettings())
  {
    if (const JsonValue wished = value.member(setting->name); wished.present())
    {
      light.settings[setting->name] = readSetting(wished, *setting);
    }
  }
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

SceneLight readDirectional(const JsonValue& value)
{
  requireLight(value, { "direction", "box" });
  SceneLight light;
  light.type = SceneLight::Type::Directional;
  light.target = Vec3{ { 0.0, 0.0, 0.0 } };
  const Vec3 travel = normalized(readDirection(value.member("direction")));
  light.position = -travel;
  if (const JsonValue box = value.member("box"); box.present())
  {
    light.box = readBox(box, travel);
    light.position = readPoint(box.member("position"));
    light.target = light.position + travel;
  }
  readCommon(value, light);
  return light;
}

SceneLight readSpot(const JsonValue& value)
{
  requireLight(value, { "position", "target", "cone_angle" });
  SceneLight light;
  light.type = SceneLight::Type::Spot;
  light.position = readPoint(value.member("position"));
  light.target = readTarget(value.member("target"), light.position);
  light.coneAngleDegrees =
    value.member("cone_angle").numberOr(light.coneAngleDegrees, coneAngleDegrees);
  readCommon(value, light);
  return light;
}

SceneLight readPointLight(const JsonValue& value)
{
  requireLight(value, { "position" });
  SceneLight light;
  light.type = SceneLight::Type::Point;
  light.position = readPoint(value.member("position"));
  light.target = light.position + Vec3{ { 0.0, -1.0, 0.0 } }; // arbitrary
  readCommon(value, light);
  return light;
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
    try
    {
      area.texture = readImage((folder / texture.text()).string());
    }
    catch (const BadInput& error)
    {
      texture.refuse(error.what());
    }
  }
  const std::vector<const char*> sizesOfOther = area.rectangle
    ? std::vector<const char*>{ "radius" }
    : std::vector<const char*>{ "width", "height" };
  for (const char* size : sizesOfOther)
  {
    if (const JsonValue surplus = value.member(size); surplus.present())
    {
      surplus.refuse("means nothing for a " + name);
    }
  }
  const JsonValue up = value.member("up");
  if (area.rectangle)
  {
    area.width = value.member("width").number(extent);
    area.height = value.member("height").number(extent);
  }
  else
  {
    area.radius = value.member("radius").number(extent);
    if (!area.texture && up.present())
    {
      up.refuse("means nothing for a disk without texture");
    }
  }
  if (area.rectangle || area.texture)
  {
    area.up = readUp(up, area.up, travel);
  }
  return area;
}

/// Read a light with an area around its position, which shines in all directions or as a spot
/// light.
SceneLight readAreaLight(const JsonValue& value, const std::filesystem::path& folder)
{
  requireLight(value,
    { "position", "target", "cone_angle", "shape", "radius", "width", "height", "up", "texture" });
  SceneLight light;
  light.type = SceneLight::Type::Point;
  light.position = readPoint(value.member("position"));
  light.target = readTarget(value.member("target"), light.position);
  if (const JsonValue angle = value.member("cone_angle"); angle.present())
  {
    light.type = SceneLight::Type::Spot;
    light.coneAngleDegrees = angle.number(coneAngleDegrees);
  }
  light.area = readArea(value, light.target - light.position, folder);
  readCommon(value, light);
  return light;
}

} // namespace

//------------------------------------------------------------------------------
SceneLight readLight(const JsonValue& value, const std::filesystem::path& folder)
{
  const JsonValue kind = value.member("type");
  const std::string type = kind.text();
  if (type == "directional")
  {
    return readDirectional(value);
  }
  if (type == "spot")
  {
    return readSpot(value);
  }
  if (type == "point")
  {
    return readPointLight(value);
  }
  if (type != "area")
  {
    kind.fail("one of: directional, spot, point, area");
  }
  return readAreaLight(value, folder);
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
    camera.position = readPoint(position);
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
  if (camera.parallelScale)
  {
    json["parallel_scale"] = *camera.parallelScale;
  }
  else
  {
    json["fov"] = camera.fovDegrees;
  }
  return json;
}

} // namespace gnomon::tool
