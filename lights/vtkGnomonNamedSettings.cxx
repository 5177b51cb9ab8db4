#include "vtkGnomonNamedSettings.h"

#include "lights/SettingsTable.h"

#include "vtkObjectFactory.h"

#include <cstddef>
#include <string>

vtkStandardNewMacro(vtkGnomonNamedSettings);

//------------------------------------------------------------------------------
struct vtkGnomonNamedSettings::Internals
{
  gnomon::ShadowSettings values;
  decltype(gnomon::ShadowSettings::named) set; ///< the settings that were set, by index
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
  const auto& settings = gnomon::shadowSettings();
  return index >= 0 && static_cast<std::size_t>(index) < settings.size()
    ? textOf(*settings[static_cast<std::size_t>(index)])
    : std::string();
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
  const gnomon::SettingValue before = setting->read(values);
  if (!setting->set(values, text))
  {
    error = gnomon::errorOf(setting->name, setting->values, text);
    return false;
  }
  if (setting->name == "technique")
  {
    values.named.reset(); // settings for another technique are no errors
  }
  this->NoteAssigned(static_cast<int>(setting->index), setting->read(values) != before);
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
bool vtkGnomonNamedSettings::SetSetting(const char* name, double number)
{
  return this->SetSetting(name, gnomon::textOfNumber(name ? name : "", number).c_str());
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
  if (!this->IsSettingSet(name))
  {
    return;
  }
  this->Internal->set.reset(settingOf(name)->index);
  gnomon::ShadowSettings left;
  this->CopySetValues(left);
  this->Internal->values = left;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkGnomonNamedSettings::IsSettingSet(const char* name) const
{
  const gnomon::Setting* const setting = settingOf(name);
  return setting && this->Internal->set[setting->index];
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
    if (this->Internal->set[setting->index])
    {
      setting->copy(to, this->Internal->values);
      // False if it was set for another technique.
      to.named[setting->index] = this->Internal->values.named[setting->index];
    }
  }
}

//------------------------------------------------------------------------------
gnomon::ShadowSettings& vtkGnomonNamedSettings::ValuesToAssign()
{
  return this->Internal->values;
}

//------------------------------------------------------------------------------
void vtkGnomonNamedSettings::NoteAssigned(int index, bool changes)
{
  const auto bit = static_cast<std::size_t>(index);
  this->Internal->error.clear();
  this->Internal->values.named.set(bit);
  if (changes || !this->Internal->set[bit])
  {
    this->Internal->set.set(bit);
    this->Modified();
  }
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
