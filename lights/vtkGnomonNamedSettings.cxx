#include "vtkGnomonNamedSettings.h"

#include "lights/SettingsTable.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <set>
#include <string>
#include <variant>

vtkStandardNewMacro(vtkGnomonNamedSettings);

//------------------------------------------------------------------------------
struct vtkGnomonNamedSettings::Internals
{
  gnomon::ShadowSettings values;
  std::set<std::string> set; ///< names of the settings that were set
  std::string error;
};

namespace
{

const gnomon::Setting* settingOf(const char* name)
{
  return gnomon::findSetting(name ? name : "");
}

/// Return a text of the setting with this index; empty if the index is out of range.
template <typename TextOf>
std::string textAt(int index, const TextOf& textOf)
{
  const auto settings = gnomon::shadowSettings();
  return index >= 0 && static_cast<std::size_t>(index) < settings.size()
    ? textOf(*settings[static_cast<std::size_t>(index)])
    : std::string();
}

/// Return a number clamped to a setting's range, as text; empty without such a setting.
template <typename Range, typename Number>
std::string clamped(const gnomon::Setting* setting, Number value)
{
  if (!setting || value != value)
  {
    return setting ? "nan" : "";
  }
  const auto& range = std::get<Range>(setting->values);
  gnomon::ShadowSettings scratch;
  setting->write(scratch, std::clamp(value, range.smallest, range.largest));
  return setting->get(scratch);
}

/// Return a setting's value; 0 without such a setting.
template <typename Value>
Value valueOf(const gnomon::Setting* setting, const gnomon::ShadowSettings& settings)
{
  return setting ? std::get<Value>(setting->read(settings)) : Value{};
}

} // namespace

//------------------------------------------------------------------------------
vtkGnomonNamedSettings::vtkGnomonNamedSettings()
  : Internal(new Internals)
{
}

//------------------------------------------------------------------------------
vtkGnomonNamedSettings::~vtkGnomonNamedSettings() = default;

//------------------------------------------------------------------------------
bool vtkGnomonNamedSettings::TrySetting(const char* name, const char* value)
{
  const gnomon::Setting* const setting = settingOf(name);
  std::string& error = this->Internal->error;
  if (!setting)
  {
    error = "Lights have no setting '" + std::string(name ? name : "") +
      "'. There are: " + gnomon::settingNames();
    return false;
  }
  gnomon::ShadowSettings& values = this->Internal->values;
  const std::string text = value ? value : "";
  const std::string before = setting->get(values);
  if (!setting->set(values, text))
  {
    error = "Invalid value '" + text + "' for the setting '" + setting->name + "', expected " +
      setting->expected();
    return false;
  }
  error.clear();
  if (setting->name == "technique")
  {
    values.named = { setting->name }; // settings for another technique are no errors
  }
  const bool isNew = this->Internal->set.insert(setting->name).second;
  if (isNew || setting->get(values) != before)
  {
    this->Modified();
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkGnomonNamedSettings::SetSetting(const char* name, const char* value)
{
  const bool isSet = this->TrySetting(name, value);
  if (!isSet)
  {
    vtkErrorMacro(<< this->Internal->error << ".");
  }
  return isSet;
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSettingError() const
{
  return this->Internal->error;
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSetting(const char* name) const
{
  const gnomon::Setting* const setting = settingOf(name);
  return setting ? setting->get(this->Internal->values) : std::string();
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::UnsetSetting(const char* name)
{
  if (this->Internal->set.erase(name ? name : "") == 0)
  {
    return;
  }
  gnomon::ShadowSettings left;
  this->CopySetValues(left);
  this->Internal->values = left;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkGnomonNamedSettings::IsSettingSet(const char* name) const
{
  return this->Internal->set.count(name ? name : "") > 0;
}

//------------------------------------------------------------------------------
int vtkGnomonNamedSettings::GetNumberOfSettings()
{
  return static_cast<int>(gnomon::shadowSettings().size());
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSettingName(int index)
{
  return textAt(index, [](const gnomon::Setting& setting) { return setting.name; });
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSettingMeaning(int index)
{
  return textAt(index, [](const gnomon::Setting& setting) { return setting.meaning; });
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSettingUnit(int index)
{
  return textAt(index, [](const gnomon::Setting& setting) { return setting.unit; });
}

//------------------------------------------------------------------------------
std::string vtkGnomonNamedSettings::GetSettingValues(int index)
{
  return textAt(index, [](const gnomon::Setting& setting) { return setting.expected(); });
}

//------------------------------------------------------------------------------
const gnomon::ShadowSettings& vtkGnomonNamedSettings::GetValues() const
{
  return this->Internal->values;
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::CopySetValues(gnomon::ShadowSettings& to) const
{
  for (const gnomon::Setting* setting : gnomon::shadowSettings())
  {
    if (this->Internal->set.count(setting->name) > 0)
    {
      setting->set(to, setting->get(this->Internal->values));
      if (this->Internal->values.named.count(setting->name) == 0)
      {
        to.named.erase(setting->name); // set for another technique
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::SetInteger(const char* name, int value)
{
  this->SetSetting(name, clamped<gnomon::IntegerSetting>(settingOf(name), value).c_str());
}

//------------------------------------------------------------------------------
int vtkGnomonNamedSettings::GetInteger(const char* name) const
{
  return valueOf<int>(settingOf(name), this->Internal->values);
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::SetReal(const char* name, double value)
{
  this->SetSetting(name, clamped<gnomon::RealSetting>(settingOf(name), value).c_str());
}

//------------------------------------------------------------------------------
double vtkGnomonNamedSettings::GetReal(const char* name) const
{
  return valueOf<double>(settingOf(name), this->Internal->values);
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::SetChoice(const char* name, int index)
{
  const gnomon::Setting* const setting = settingOf(name);
  std::string text;
  if (setting)
  {
    const auto& names = std::get<gnomon::ChoiceSetting>(setting->values).names;
    const int last = static_cast<int>(names.size()) - 1;
    text = names[static_cast<std::size_t>(std::clamp(index, 0, last))];
  }
  this->SetSetting(name, text.c_str());
}

//------------------------------------------------------------------------------
int vtkGnomonNamedSettings::GetChoice(const char* name) const
{
  return valueOf<int>(settingOf(name), this->Internal->values);
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const gnomon::Setting* setting : gnomon::shadowSettings())
  {
    os << indent << "Setting " << setting->name << ": " << setting->get(this->Internal->values)
       << "\n";
  }
}
