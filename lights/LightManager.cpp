#include "lights/LightManager.h"

#include "lights/OSPRayRadius.h"
#include "lights/SettingsTable.h"
#include "vtkGnomonAreaLight.h"
#include "vtkGnomonLightKeys.h"
#include "vtkGnomonShadowSettings.h"

#include <vtkCollection.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationIntegerKey.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace gnomon
{
namespace
{

/// Return the light's kind. As in VTK, a positional light is a spot light only if its cone's half
/// angle is below 90 degrees.
LightKind kindOf(vtkLight* light)
{
  if (!light->GetPositional())
  {
    return LightKind::Directional;
  }
  return light->GetConeAngle() < 90.0 ? LightKind::Spot : LightKind::Point;
}

bool isFinite(const glm::dvec3& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// True if an up direction is not along the light. Below a millionth of a right angle, rounding
/// would rotate the shape.
bool isAcross(const glm::dvec3& up, const glm::dvec3& travel)
{
  return glm::length(glm::cross(up, travel)) > 1e-6 * glm::length(up) * glm::length(travel);
}

/// Return a directional light's box, if it has one. The light's transform rotates the up direction.
std::optional<LightBox> readBox(vtkLight* light)
{
  vtkInformation* keys = light->GetInformation();
  vtkInformationDoubleVectorKey* key = vtkGnomonLightKeys::BOX();
  if (light->GetPositional() || keys->Length(key) != 6)
  {
    return std::nullopt;
  }
  const double* numbers = keys->Get(key);
  LightBox box{ numbers[0], numbers[1], numbers[2], { numbers[3], numbers[4], numbers[5] } };
  glm::dvec3 up = box.upWorld;
  light->TransformVector(&up.x, &box.upWorld.x);
  return box;
}

/// Return a light's radius from OSPRay's key; 0 without the key.
double ospRayRadius(vtkLight* light)
{
  vtkInformationDoubleKey* key = ospRayRadiusKey();
  vtkInformation* keys = light->GetInformation();
  return key && keys->Has(key) ? keys->Get(key) : 0.0;
}

/// Return the key of lights that stand for a point of an area light.
vtkInformationIntegerKey* pointKey()
{
  static auto* const key =
    vtkInformationIntegerKey::MakeKey("IS_POINT_OF_AREA", "vtkGnomonLightKeys");
  return key;
}

/// A light's size, in the units of vtkGnomonAreaLight.
struct AreaSize
{
  LightArea::Shape shape = LightArea::Shape::Disk;
  glm::dvec2 size{ 0.0 }; ///< width and height, or twice the radius
  glm::dvec3 up{ 0.0 };   ///< of vtkGnomonAreaLight, in the light's own coordinates
};

/// Return the size of a round light from OSPRay's radius. A directional light's OSPRay radius is
/// already the whole angle.
AreaSize roundSize(vtkLight* light, double radius, LightArea::Shape shape)
{
  return { shape, glm::dvec2(light->GetPositional() ? 2.0 * radius : radius) };
}

AreaSize readAreaSize(vtkLight* light, const ShadowSettings& settings)
{
  const LightArea::Shape round =
    kindOf(light) == LightKind::Point ? LightArea::Shape::Ball : LightArea::Shape::Disk;
  if (settings.lightRadius > 0.0)
  {
    return roundSize(light, settings.lightRadius, round);
  }
  auto* area = vtkGnomonAreaLight::SafeDownCast(light);
  if (!area)
  {
    return roundSize(light, ospRayRadius(light), round);
  }
  AreaSize size = area->GetShape() == vtkGnomonAreaLight::DISK
    ? roundSize(light, area->GetRadius(), LightArea::Shape::Disk)
    : AreaSize{ LightArea::Shape::Rectangle, { area->GetWidth(), area->GetHeight() } };
  size.up = glm::make_vec3(area->GetUp());
  return size;
}

/// A light's area, and the distribution of its colour.
struct LitArea
{
  std::optional<LightArea> area;
  std::optional<PlacedTexture> texture;
};

/// Return a light's area and placed texture; no area for a point light.
/// @param texture null: all points emit alike
/// @param reason to skip the light; set if its numbers give no valid area
LitArea readArea(vtkLight* light, const ShadowSettings& settings,
  const std::shared_ptr<const LightTexture>& texture, std::string& reason)
{
  const auto skip = [&](const char* why)
  {
    reason = why;
    return LitArea();
  };
  if (texture && settings.lightRadius > 0.0)
  {
    return skip("its texture lies on its own area, which 'light_radius' replaces");
  }
  const AreaSize wished = readAreaSize(light, settings);
  if (!std::isfinite(wished.size.x) || !std::isfinite(wished.size.y))
  {
    return skip("its area is not finite");
  }
  const glm::dvec2 size = glm::max(wished.size, glm::dvec2(0.0));
  if (size == glm::dvec2(0.0) && !texture)
  {
    return {};
  }
  const double longest = std::max(size.x, size.y);
  if (!light->GetPositional() && longest >= 180.0)
  {
    return skip("it fills 180 degrees or more");
  }
  const glm::dvec2 half = light->GetPositional() ? 0.5 * size : glm::tan(glm::radians(0.5 * size));
  if (wished.shape == LightArea::Shape::Ball)
  {
    return { ballArea(half.x), std::nullopt };
  }
  const glm::dvec3 position = glm::make_vec3(light->GetTransformedPosition());
  const glm::dvec3 focalPoint = glm::make_vec3(light->GetTransformedFocalPoint());
  const double distance = glm::distance(position, focalPoint);
  if (!(distance > 0.0) || !std::isfinite(distance))
  {
    return skip("its position and focal point give no direction");
  }
  const glm::dvec3 travel = (focalPoint - position) / distance;
  const bool isDisk = wished.shape == LightArea::Shape::Disk;
  if (isDisk && !texture)
  {
    return { diskArea(travel, half.x), std::nullopt };
  }
  glm::dvec3 up = wished.up;
  glm::dvec3 upWorld;
  light->TransformVector(&up.x, &upWorld.x);
  if (!isFinite(upWorld))
  {
    return skip("its area's up direction is not finite");
  }
  if (!isAcross(upWorld, travel))
  {
    return skip("its area has its up direction along the light");
  }
  LitArea lit;
  if (size != glm::dvec2(0.0))
  {
    lit.area = isDisk ? diskArea(travel, half.x) : rectangleArea(travel, upWorld, half);
  }
  if (texture)
  {
    lit.texture = placeTexture(texture, wished.shape, travel, upWorld, half);
  }
  return lit;
}

/// Return a light's settings.
/// @param reason to skip the light; set if it is empty and a setting has an invalid value, which
/// SetSetting would have refused
ShadowSettings readSettings(vtkLight* light, const ShadowSettings& defaults, std::string& reason)
{
  ShadowSettings settings = defaults;
  settings.named.reset(); // by the pass: the light's own names follow
  if (const vtkGnomonShadowSettings* const own = vtkGnomonLightKeys::GetSettings(light))
  {
    own->CopySetValues(settings);
  }
  if (!light->GetInformation()->Has(vtkGnomonLightKeys::SETTINGS()))
  {
    return settings; // as of most lights
  }
  for (const Setting* setting : shadowSettings())
  {
    const char* const text = vtkGnomonLightKeys::GetSetting(light, setting->name.c_str());
    if (text && !setting->set(settings, text) && reason.empty())
    {
      reason =
        "its setting '" + setting->name + "' is '" + text + "', expected " + setting->expected();
    }
  }
  return settings;
}

/// Return why this light gives no light; empty if it does.
std::string whyDark(vtkLight* light)
{
  if (!light->GetSwitch())
  {
    return "switched off";
  }
  const double* colour = light->GetDiffuseColor();
  const double* highlight = light->GetSpecularColor();
  if (light->GetIntensity() == 0.0 ||
    (colour[0] == 0.0 && colour[1] == 0.0 && colour[2] == 0.0 && highlight[0] == 0.0 &&
      highlight[1] == 0.0 && highlight[2] == 0.0))
  {
    return "gives no light";
  }
  return {};
}

/// Return why this light is to cast no shadow; empty if it is to cast one.
std::string whyWithoutShadow(vtkLight* light)
{
  vtkInformation* keys = light->GetInformation();
  if (keys->Has(vtkGnomonLightKeys::CASTS()) && !keys->Get(vtkGnomonLightKeys::CASTS()))
  {
    return "marked as not casting";
  }
  if (std::isnan(light->GetShadowAttenuation()))
  {
    return "its shadow attenuation is not a number";
  }
  if (light->GetShadowAttenuation() <= 0.0f)
  {
    return "its shadow attenuation is 0";
  }
  return {};
}

/// Call visit(light) for a renderer's lights, in their order.
template <typename Visit>
void visitLights(vtkRenderer* renderer, const Visit& visit)
{
  vtkLightCollection* const lights = renderer->GetLights();
  vtkCollectionSimpleIterator iterator;
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    visit(light);
  }
}

/// Intensity times the luminance of the colour (ITU-R BT.709).
double brightnessOf(vtkLight* light)
{
  const glm::dvec3 colour = glm::make_vec3(light->GetDiffuseColor());
  return light->GetIntensity() * glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// The choice of a renderer's lights (Casting).
class CastingChoice
{
public:
  CastingChoice(vtkRenderer* renderer, Casting casting)
    : casting_(casting)
  {
    visitLights(renderer,
      [&](vtkLight* light)
      {
        if (!whyDark(light).empty())
        {
          return;
        }
        const bool isHead = isHeadlight(light) && !hasKey(light);
        (isHead ? this->headlights_ : this->others_) += 1;
        if (!isHead && this->isRival(light) && whyWithoutShadow(light).empty() &&
          (!this->brightest_ || brightnessOf(light) > brightnessOf(this->brightest_)))
        {
          this->brightest_ = light;
        }
      });
  }

  bool onlyHeadlights() const { return this->headlights_ > 0 && this->others_ == 0; }

  /// Return why a light that gives light is to cast no shadow; empty if it is to cast one.
  std::string whyNot(vtkLight* light) const
  {
    const std::string own = whyWithoutShadow(light);
    if (!own.empty() || hasKey(light))
    {
      return own;
    }
    if (isHeadlight(light))
    {
      return this->headlights_ + this->others_ == 1 ? "a headlight, and the only light"
                                                    : "a headlight";
    }
    return !this->isRival(light) || light == this->brightest_ ? ""
      : this->casting_ == Casting::Auto
      ? "it follows the camera, as does a brighter light that casts"
      : "a brighter light casts";
  }

private:
  static bool hasKey(vtkLight* light)
  {
    return light->GetInformation()->Has(vtkGnomonLightKeys::CASTS()) != 0;
  }
  /// True if a light casts only as the brightest one.
  bool isRival(vtkLight* light) const
  {
    return this->casting_ == Casting::Brightest ||
      (this->casting_ == Casting::Auto && light->LightTypeIsCameraLight());
  }

  Casting casting_;
  vtkLight* brightest_ = nullptr;
  int headlights_ = 0; ///< which give light, and have no key
  int others_ = 0;     ///< which give light
};

/// Return why this light has no valid place and direction; empty if it has.
std::string whyWithoutPlace(vtkLight* light)
{
  if (light->GetPositional() && !(light->GetConeAngle() > 0.0))
  {
    return "its cone is empty";
  }
  const glm::dvec3 position = glm::make_vec3(light->GetTransformedPosition());
  const glm::dvec3 focalPoint = glm::make_vec3(light->GetTransformedFocalPoint());
  if (kindOf(light) == LightKind::Point)
  {
    return isFinite(position) ? "" : "its position is not finite";
  }
  const glm::dvec3 travel = focalPoint - position;
  const double distance2 = glm::dot(travel, travel);
  if (!(distance2 > 0.0) || !std::isfinite(distance2))
  {
    return "its position and focal point give no direction";
  }
  const int boxNumbers = light->GetInformation()->Length(vtkGnomonLightKeys::BOX());
  if (boxNumbers != 0 && boxNumbers != 6 && !light->GetPositional())
  {
    return "its box has " + std::to_string(boxNumbers) + " numbers instead of 6";
  }
  if (const std::optional<LightBox> box = readBox(light))
  {
    const glm::dvec3 size(box->width, box->height, box->depth);
    if (!isFinite(size) || !isFinite(box->upWorld))
    {
      return "its box is not finite";
    }
    if (!glm::all(glm::greaterThan(size, glm::dvec3(0.0))))
    {
      return "its box is empty";
    }
    if (!isAcross(box->upWorld, travel))
    {
      return "its box has its up direction along the light";
    }
  }
  return {};
}

ShadowLight readLight(vtkLight* light, const ShadowSettings& settings, LitArea lit)
{
  ShadowLight result;
  static_cast<ShadowSettings&>(result) = settings;
  result.kind = kindOf(light);
  result.positionWorld = glm::make_vec3(light->GetTransformedPosition());
  if (result.kind != LightKind::Point) // which may lack one
  {
    result.directionWorld =
      glm::normalize(glm::make_vec3(light->GetTransformedFocalPoint()) - result.positionWorld);
  }
  result.coneAngleDegrees = result.kind == LightKind::Spot ? light->GetConeAngle() : 0.0;
  result.box = readBox(light);
  result.area = lit.area;
  result.texture = std::move(lit.texture);
  result.strength = glm::clamp(static_cast<double>(light->GetShadowAttenuation()), 0.0, 1.0);
  const double* const colour = light->GetDiffuseColor();
  const double* const highlight = light->GetSpecularColor();
  result.intensity = std::abs(light->GetIntensity()) *
    std::max(*std::max_element(colour, colour + 3), *std::max_element(highlight, highlight + 3));
  result.attenuation = glm::make_vec3(light->GetAttenuationValues());
  result.isHeadlight = isHeadlight(light);
  result.isPointOfArea = light->GetInformation()->Has(pointKey());
  return result;
}

} // namespace

bool isHeadlight(vtkLight* light)
{
  // In a camera light's coordinates the camera is at (0, 0, 1) and looks along -z.
  constexpr double rounding = 1e-12;
  const glm::dvec3 position = glm::make_vec3(light->GetPosition());
  const glm::dvec3 travel = glm::normalize(glm::make_vec3(light->GetFocalPoint()) - position);
  const bool isAtCamera = light->GetPositional()
    ? glm::distance(position, { 0.0, 0.0, 1.0 }) < rounding
    : travel.z < -1.0 + rounding;
  return light->LightTypeIsHeadlight() || (light->LightTypeIsCameraLight() && isAtCamera);
}

LightSet LightManager::collect(
  vtkRenderer* renderer, const ShadowSettings& defaults, Casting casting)
{
  const CastingChoice choice(renderer, casting);
  LightSet set = this->read(renderer, defaults,
    [&choice](vtkLight* light, bool)
    {
      const std::string dark = whyDark(light);
      return std::optional(dark.empty() ? choice.whyNot(light) : dark);
    });
  set.headlightIsAlone = choice.onlyHeadlights();
  return set;
}

LightSet LightManager::collectAreas(vtkRenderer* renderer, const ShadowSettings& defaults)
{
  return this->read(renderer, defaults,
    [](vtkLight* light, bool isArea)
    { return isArea && whyDark(light).empty() ? std::optional(std::string()) : std::nullopt; });
}

LightSet LightManager::read(
  vtkRenderer* renderer, const ShadowSettings& defaults, const WhyNot& whyNot)
{
  LightSet set;
  ReadTextures textures;
  int sceneIndex = 0;
  int shaderIndex = 0;
  const auto readOne = [&](vtkLight* light)
  {
    std::string reason = whyWithoutPlace(light);
    const ShadowSettings settings = readSettings(light, defaults, reason);
    const std::shared_ptr<const LightTexture> texture = this->textureOf(light, textures, reason);
    std::string reasonOfArea;
    LitArea lit = readArea(light, settings, texture, reasonOfArea);
    const bool isArea = !reasonOfArea.empty() || (lit.area && lit.area->radius() > 0.0);
    const std::optional<std::string> why = whyNot(light, isArea);
    reason = why && !why->empty() ? *why : reason.empty() ? reasonOfArea : reason;
    if (why && reason.empty())
    {
      set.lights.push_back(readLight(light, settings, std::move(lit)));
      set.lights.back().sceneIndex = sceneIndex;
      set.lights.back().shaderIndex = shaderIndex;
    }
    else if (why)
    {
      set.skipped.push_back({ sceneIndex, reason });
    }
    ++sceneIndex;
    // VTK numbers lightColorN over all lights that are switched on, including those that cast none.
    shaderIndex += light->GetSwitch() ? 1 : 0;
  };
  visitLights(renderer, readOne);
  this->textures_ = std::move(textures);
  return set;
}

void LightManager::makePoint(vtkLight* light)
{
  vtkGnomonLightKeys::SetSetting(light, "light_radius", "0"); // overrides the pass
  for (const SettingsTable* table : { &lightSampleSettings(), &lightSeedSettings() })
  {
    for (const Setting& setting : table->settings)
    {
      vtkGnomonLightKeys::SetSetting(light, setting.name.c_str(), nullptr);
    }
  }
  if (auto* key = ospRayRadiusKey())
  {
    light->GetInformation()->Remove(key);
  }
  light->GetInformation()->Set(pointKey(), 1);
}

/// Return a light's texture; null without one.
/// @param current receives the texture, read or cached
/// @param reason to skip the light; set if it is empty and the image is not a valid texture
std::shared_ptr<const LightTexture> LightManager::textureOf(
  vtkLight* light, ReadTextures& current, std::string& reason)
{
  auto* area = vtkGnomonAreaLight::SafeDownCast(light);
  vtkImageData* const image = area ? area->GetTexture() : nullptr;
  if (!image)
  {
    return nullptr;
  }
  const auto [place, isFirst] = current.try_emplace(image);
  ReadTexture& read = place->second;
  if (const auto before = this->textures_.find(image); isFirst && before != this->textures_.end())
  {
    read = before->second;
  }
  if (read.modified != image->GetMTime())
  {
    read = {};
    read.modified = image->GetMTime();
    read.texture = readLightTexture(image, read.reason);
  }
  reason = reason.empty() ? read.reason : reason;
  return read.texture;
}

vtkMTimeType changeTime(vtkLight* light)
{
  auto* const area = vtkGnomonAreaLight::SafeDownCast(light);
  vtkMTimeType time = light->GetMTime();
  for (vtkObject* const part :
    std::initializer_list<vtkObject*>{ light->GetTransformMatrix(), light->GetInformation(),
      vtkGnomonLightKeys::GetSettings(light), area ? area->GetTexture() : nullptr })
  {
    time = std::max(time, part ? part->GetMTime() : 0);
  }
  return time;
}

std::optional<ShadowLight> readPlace(vtkLight* light, std::string& reason)
{
  reason = whyWithoutPlace(light);
  return reason.empty() ? std::optional(readLight(light, {}, {})) : std::nullopt;
}

} // namespace gnomon
