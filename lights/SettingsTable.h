#pragma once

#include "lights/ShadowSettings.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon
{

struct ShadowLight;

///@{
/// What values a setting takes.
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
struct ChoiceSetting
{
  std::vector<std::string> names;
};
///@}

/// A setting's value: an integer or the index of a choice, a number, or a text.
using SettingValue = std::variant<int, double, std::string>;

/// One setting: what light keys, scene files and command lines know it by.
struct Setting
{
  std::string name;    ///< as in scene files, "kernel_size"; on the command line "--kernel-size"
  std::string meaning; ///< one line for people
  std::string unit;    ///< "texels"; empty where there is none
  std::variant<IntegerSetting, RealSetting, ChoiceSetting> values;
  std::function<SettingValue(const ShadowSettings&)> read;
  std::function<void(ShadowSettings&, const SettingValue&)> write;
  bool isBaked = false; ///< a map that was baked with another value is stale

  /// Sets it from text.
  /// @return false for what it does not take; nothing changes then
  bool set(ShadowSettings& settings, const std::string& text) const;
  std::string get(const ShadowSettings& settings) const;
  /// What it takes, for error messages: "one of: bilinear, box", "an integer in [1, 32]".
  std::string expected() const;
};

/// Settings that a technique has together or not at all. Their owner has them as a struct.
struct SettingsTable
{
  std::string title; ///< for people: "Kernel"
  std::vector<Setting> settings;
  /// Why a light's values make no sense together, as a clause; empty where they do. Null: they
  /// always do.
  std::string (*refused)(const ShadowLight&) = nullptr;
};

///@{
/// A line of a table, for a member of the owner's struct.
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
/// @param names of the enumeration's values, or of false and true, in their order
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
/// @param numbers by name: { "off", 0 }, { "4", 4 }
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
/// @param names that a text may have
Setting oneOfNames(std::string name, std::string meaning, std::string ShadowSettings::*member,
  std::vector<std::string> names);
/// The same setting as one that maps are baked with.
Setting bakedInto(Setting setting);
///@}

/// All tables, in the order in which they are listed to people: those of lights/, until the
/// registry of techniques sets the list.
const std::vector<const SettingsTable*>& settingsTables();
/// @return true, so that a library can call it while it is loaded
bool setSettingsTables(std::vector<const SettingsTable*> tables);

/// The settings of all tables.
std::vector<const Setting*> shadowSettings();

/// The setting of that name; nullptr when there is none.
const Setting* findSetting(const std::string& name);

/// "technique, map_size, ...": for error messages.
std::string settingNames();

/// "a, b, c"
std::string listOf(const std::vector<std::string>& names);

} // namespace gnomon
