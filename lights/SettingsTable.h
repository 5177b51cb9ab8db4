#pragma once

#include "lights/ShadowSettings.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon
{

struct ShadowLight;

///@{
/// The valid values of a setting.
struct IntegerSetting
{
  int smallest;
  int largest;
};
struct RealSetting
{
  double smallest;
  double largest;
};
/// Values of lengths, which depend on the world's unit: all that are finite.
inline constexpr RealSetting anyLength{ 0.0, std::numeric_limits<double>::max() };
struct ChoiceSetting
{
  std::vector<std::string> names;
};
///@}

/// A setting's value: an integer or the index of a choice, a number, or a text.
using SettingValue = std::variant<int, double, std::string>;

/// One setting, as light keys, scene files and command lines see it.
struct Setting
{
  std::string name;    ///< as in scene files, "kernel_size"; on the command line "--kernel-size"
  std::string meaning; ///< one line for users
  std::string unit;    ///< for example "texels"; empty without a unit
  std::variant<IntegerSetting, RealSetting, ChoiceSetting> values;
  std::function<SettingValue(const ShadowSettings&)> read;
  std::function<void(ShadowSettings&, const SettingValue&)> write;
  bool isBaked = false; ///< a change makes baked maps stale

  /// Set the value from text.
  /// @return false for an invalid value; then nothing changes
  bool set(ShadowSettings& settings, const std::string& text) const;
  std::string get(const ShadowSettings& settings) const;
  /// Return the valid values for error messages: "one of: bilinear, box", "an integer in [1, 32]".
  std::string expected() const;
};

/// Settings that a technique has together or not at all. Their owner keeps them in a struct.
struct SettingsTable
{
  std::string title; ///< for users, for example "Kernel"
  std::vector<Setting> settings;
  /// Returns why a light's values contradict each other, as a clause; empty if they do not. Null:
  /// all combinations are valid.
  std::string (*refused)(const ShadowLight&) = nullptr;
};

///@{
/// Return a table's line for a member of the owner's struct.
template <typename Struct>
Setting integer(std::string name, std::string meaning, std::string unit, int Struct::*member,
  IntegerSetting values)
{
  return { std::move(name), std::move(meaning), std::move(unit), values,
    [member](const ShadowSettings& settings) { return settings.of<Struct>().*member; },
    [member](ShadowSettings& settings, const SettingValue& value)
    { settings.of<Struct>().*member = std::get<int>(value); } };
}
template <typename Struct>
Setting real(std::string name, std::string meaning, std::string unit, double Struct::*member,
  RealSetting values)
{
  return { std::move(name), std::move(meaning), std::move(unit), values,
    [member](const ShadowSettings& settings) { return settings.of<Struct>().*member; },
    [member](ShadowSettings& settings, const SettingValue& value)
    { settings.of<Struct>().*member = std::get<double>(value); } };
}
/// @param names of the enumeration's values, or of false and true, in order
template <typename Struct, typename Choice>
Setting choice(
  std::string name, std::string meaning, Choice Struct::*member, std::vector<std::string> names)
{
  return { std::move(name), std::move(meaning), {}, ChoiceSetting{ std::move(names) },
    [member](const ShadowSettings& settings)
    { return static_cast<int>(settings.of<Struct>().*member); },
    [member](ShadowSettings& settings, const SettingValue& value)
    { settings.of<Struct>().*member = static_cast<Choice>(std::get<int>(value)); } };
}
/// @param numbers name and value of each choice: { "off", 0 }, { "4", 4 }
template <typename Struct>
Setting oneOf(std::string name, std::string meaning, std::string unit, int Struct::*member,
  const std::vector<std::pair<std::string, int>>& numbers)
{
  ChoiceSetting values;
  std::vector<int> ofChoice;
  for (const auto& [text, number] : numbers)
  {
    values.names.push_back(text);
    ofChoice.push_back(number);
  }
  return { std::move(name), std::move(meaning), std::move(unit), std::move(values),
    [member, ofChoice](const ShadowSettings& settings)
    {
      int index = 0;
      while (ofChoice[static_cast<std::size_t>(index)] != settings.of<Struct>().*member)
      {
        ++index;
      }
      return index;
    },
    [member, ofChoice](ShadowSettings& settings, const SettingValue& value)
    { settings.of<Struct>().*member = ofChoice[static_cast<std::size_t>(std::get<int>(value))]; } };
}
/// @param names valid texts
Setting oneOfNames(std::string name, std::string meaning, std::string ShadowSettings::*member,
  std::vector<std::string> names);
/// Return the setting, marked as baked into maps.
Setting bakedInto(Setting setting);
///@}

/// Return all tables, in the order of documentation: those of lights/, until the registry of
/// techniques sets the list.
const std::vector<const SettingsTable*>& settingsTables();
/// Set the list of tables.
/// @return true, so that a static initialiser can call it
bool setSettingsTables(std::vector<const SettingsTable*> tables);

/// Return the settings of all tables.
std::vector<const Setting*> shadowSettings();

/// Return the setting with this name; nullptr without one.
const Setting* findSetting(const std::string& name);

/// Return all names for error messages: "technique, map_size, ...".
std::string settingNames();

/// Return names as a list: "a, b, c".
std::string listOf(const std::vector<std::string>& names);

} // namespace gnomon
