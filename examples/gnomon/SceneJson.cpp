#include "SceneJson.h"

#include "Vec3.h"
#include "lights/ShadowSettings.h"
#include "shadowtech/Registry.h"

namespace gnomon::tool
{

namespace
{

constexpr NumberRange colorChannel{ 0.0, 1.0 };
constexpr NumberRange lightIntensity{ 0.0, 1e6 };
constexpr NumberRange coneAngleDegrees{ 0.01, 89.9 };
constexpr NumberRange fieldOfViewDegrees{ 0.01, 179.0 };
constexpr NumberRange extent{ 1e-6, 1e12 };
constexpr int smallestMapTexels = 16;
constexpr int largestMapTexels = 16384;

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

/// The way from a position to the target at `value`, which must lie elsewhere.
Vec3 readTarget(const JsonValue& value, const Vec3& position)
{
  const Vec3 target = readPoint(value);
  if (length(target - position) == 0.0)
  {
    value.fail("a target that is not the position");
  }
  return target;
}

/// An up direction, y by default, which must not be parallel to the way from position to target.
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

/// A setting of a light's shadows, as text.
std::string readSetting(const JsonValue& value, const Setting& setting)
{
  if (const auto* range = std::get_if<IntegerSetting>(&setting.values))
  {
    return std::to_string(value.integer(range->smallest, range->largest));
  }
  if (const auto* reals = std::get_if<RealSetting>(&setting.values))
  {
    ShadowSettings scratch;
    scratch.*reals->member = value.number({ reals->smallest, reals->largest });
    return setting.get(scratch);
  }
  const std::string text = value.text();
  if (!takes(setting, text))
  {
    value.fail(expectedBy(setting));
  }
  return text;
}

/// Refuses keys that a light of this kind does not have.
void requireLight(const JsonValue& value, std::vector<std::string> known)
{
  known.insert(known.end(), { "type", "color", "intensity" });
  for (const Setting& setting : shadowSettings())
  {
    known.push_back(setting.name);
  }
  value.requireObject(known);
}

/// What all kinds of light share.
void readCommon(const JsonValue& value, SceneLight& light)
{
  if (const JsonValue color = value.member("color"); color.present())
  {
    light.color = color.numbers<3>(colorChannel);
  }
  if (const JsonValue intensity = value.member("intensity"); intensity.present())
  {
    light.intensity = intensity.number(lightIntensity);
  }
  for (const Setting& setting : shadowSettings())
  {
    if (const JsonValue wished = value.member(setting.name); wished.present())
    {
      light.settings[setting.name] = readSetting(wished, setting);
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
  if (const JsonValue angle = value.member("cone_angle"); angle.present())
  {
    light.coneAngleDegrees = angle.number(coneAngleDegrees);
  }
  readCommon(value, light);
  return light;
}

SceneLight readPointLight(const JsonValue& value)
{
  requireLight(value, { "position" });
  SceneLight light;
  light.type = SceneLight::Type::Point;
  light.position = readPoint(value.member("position"));
  light.target = light.position + Vec3{ { 0.0, -1.0, 0.0 } }; // of no meaning
  readCommon(value, light);
  return light;
}

/// Checks an area light. It lies along x = normalize(cross(target - position, up)) and cross(x,
/// target - position), so up must not be parallel to its axis.
void checkArea(const JsonValue& value)
{
  requireLight(value, { "position", "target", "up", "width", "height", "shape" });
  SceneLight light;
  light.position = readPoint(value.member("position"));
  light.target = readTarget(value.member("target"), light.position);
  readUp(value.member("up"), Vec3{ { 0.0, 1.0, 0.0 } }, light.target - light.position);
  value.member("width").number(extent);
  value.member("height").number(extent);
  if (const JsonValue shape = value.member("shape"); shape.present())
  {
    const std::string name = shape.text();
    if (name != "rectangle" && name != "ellipse")
    {
      shape.fail("one of: rectangle, ellipse");
    }
  }
  readCommon(value, light);
}

} // namespace

//------------------------------------------------------------------------------
std::optional<SceneLight> readLight(const JsonValue& value, FileLights fileLights)
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
  checkArea(value);
  if (fileLights == FileLights::Use)
  {
    kind.refuse(type + " lights are not supported yet, expected one of: directional, spot, point");
  }
  return std::nullopt;
}

//------------------------------------------------------------------------------
SceneCamera readCamera(const JsonValue& value, const std::optional<SceneCamera>& defaults)
{
  value.requireObject({ "position", "target", "up", "fov" });
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
  if (const JsonValue fov = value.member("fov"); fov.present())
  {
    camera.fovDegrees = fov.number(fieldOfViewDegrees);
  }
  return camera;
}

} // namespace gnomon::tool
