#include "vtkGnomonLightKeys.h"

#include "lights/SettingsTable.h"
#include "vtkGnomonShadowSettings.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>

vtkStandardNewMacro(vtkGnomonLightKeys);
vtkInformationKeyMacro(vtkGnomonLightKeys, CASTS, Integer);
vtkInformationKeyMacro(vtkGnomonLightKeys, SETTINGS, StringVector);
vtkInformationKeyMacro(vtkGnomonLightKeys, BOX, DoubleVector);
vtkInformationKeyRestrictedMacro(vtkGnomonLightKeys, OBJECT, ObjectBase, "vtkGnomonShadowSettings");

namespace
{

/// Return a light's keys. Without a light, report an error and return empty keys of no light.
vtkSmartPointer<vtkInformation> keysOf(vtkLight* light)
{
  if (light)
  {
    return light->GetInformation();
  }
  vtkErrorWithObjectMacro(light, "vtkGnomonLightKeys needs a light, not null.");
  return vtkSmartPointer<vtkInformation>::New();
}

/// Why this thread's last SetSetting() was refused.
std::string& settingError()
{
  thread_local std::string error;
  return error;
}

} // namespace

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetSettings(vtkLight* light, vtkGnomonShadowSettings* settings)
{
  keysOf(light)->Set(OBJECT(), settings);
}

//------------------------------------------------------------------------------
vtkGnomonShadowSettings* vtkGnomonLightKeys::GetSettings(vtkLight* light)
{
  return vtkGnomonShadowSettings::SafeDownCast(keysOf(light)->Get(OBJECT()));
}

//------------------------------------------------------------------------------
bool vtkGnomonLightKeys::GetCasts(vtkLight* light)
{
  const auto keys = keysOf(light);
  return !keys->Has(CASTS()) || keys->Get(CASTS()) != 0;
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetCasts(vtkLight* light, bool casts)
{
  keysOf(light)->Set(CASTS(), casts ? 1 : 0);
}

//------------------------------------------------------------------------------
bool vtkGnomonLightKeys::SetSetting(vtkLight* light, const char* name, const char* value)
{
  const std::string text = value ? value : "";
  vtkNew<vtkGnomonNamedSettings> scratch;
  const bool isRemoved = text.empty() && gnomon::findSetting(name ? name : "");
  if (!isRemoved && !scratch->TrySetting(name, text.c_str()))
  {
    settingError() = scratch->GetSettingError();
    vtkErrorWithObjectMacro(light, << settingError() << ".");
    return false;
  }
  settingError().clear();
  const auto keys = keysOf(light);
  std::vector<std::string> pairs;
  for (int i = 0; i + 1 < keys->Length(SETTINGS()); i += 2)
  {
    const std::string other = keys->Get(SETTINGS(), i);
    if (other != name)
    {
      pairs.insert(pairs.end(), { other, keys->Get(SETTINGS(), i + 1) });
    }
  }
  if (!text.empty())
  {
    pairs.insert(pairs.end(), { name, text });
  }
  keys->Remove(SETTINGS());
  for (const std::string& part : pairs)
  {
    keys->Append(SETTINGS(), part.c_str());
  }
  return light != nullptr;
}

//------------------------------------------------------------------------------
bool vtkGnomonLightKeys::SetSetting(vtkLight* light, const char* name, double number)
{
  return SetSetting(light, name, gnomon::textOfNumber(name ? name : "", number).c_str());
}

//------------------------------------------------------------------------------
std::string vtkGnomonLightKeys::GetSettingError()
{
  return settingError();
}

//------------------------------------------------------------------------------
const char* vtkGnomonLightKeys::GetSetting(vtkLight* light, const char* name)
{
  const auto keys = keysOf(light);
  for (int i = 0; i + 1 < keys->Length(SETTINGS()); i += 2)
  {
    if (std::string(keys->Get(SETTINGS(), i)) == (name ? name : ""))
    {
      return keys->Get(SETTINGS(), i + 1);
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
bool vtkGnomonLightKeys::SetTechnique(vtkLight* light, const char* technique)
{
  return SetSetting(light, "technique", technique);
}

//------------------------------------------------------------------------------
const char* vtkGnomonLightKeys::GetTechnique(vtkLight* light)
{
  return GetSetting(light, "technique");
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetMapSize(vtkLight* light, int mapSizeTexels)
{
  using Settings = gnomon::ShadowSettings;
  const std::string text = mapSizeTexels > 0
    ? std::to_string(
        std::clamp(mapSizeTexels, Settings::leastMapSizeTexels, Settings::mostMapSizeTexels))
    : "";
  SetSetting(light, "map_size", text.c_str());
}

//------------------------------------------------------------------------------
int vtkGnomonLightKeys::GetMapSize(vtkLight* light)
{
  const char* const text = GetSetting(light, "map_size");
  // A program may have filled SETTINGS() by itself, with any text.
  return text ? static_cast<int>(std::clamp(std::strtol(text, nullptr, 10), 0L,
                  long(gnomon::ShadowSettings::mostMapSizeTexels)))
              : 0;
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::SetBox(
  vtkLight* light, double width, double height, double depth, const double up[3])
{
  const auto isSize = [](double size) { return size > 0.0 && std::isfinite(size); };
  if (!isSize(width) || !isSize(height) || !isSize(depth))
  {
    vtkErrorWithObjectMacro(light,
      "A light's box was to have width " << width << ", height " << height << " and depth " << depth
                                         << ", expected positive and finite numbers.");
    return;
  }
  if (!isSize(std::hypot(up[0], up[1], up[2])))
  {
    vtkErrorWithObjectMacro(light,
      "A light's box was to have up (" << up[0] << ", " << up[1] << ", " << up[2]
                                       << "), expected a finite vector with a length.");
    return;
  }
  const double numbers[6] = { width, height, depth, up[0], up[1], up[2] };
  keysOf(light)->Set(BOX(), numbers, 6);
}

//------------------------------------------------------------------------------
bool vtkGnomonLightKeys::GetBox(vtkLight* light, double size[3], double up[3])
{
  const auto keys = keysOf(light);
  if (keys->Length(BOX()) != 6)
  {
    return false;
  }
  const double* const numbers = keys->Get(BOX());
  std::copy_n(numbers, 3, size);
  std::copy_n(numbers + 3, 3, up);
  return true;
}

//------------------------------------------------------------------------------
void vtkGnomonLightKeys::RemoveBox(vtkLight* light)
{
  keysOf(light)->Remove(BOX());
}
