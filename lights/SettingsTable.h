#pragma once

#include "lights/ShadowSettings.h"

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon
{

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

/// The valid values of a setting of any kind.
using SettingValues = std::variant<IntegerSetting, RealSetting, ChoiceSetting>;

/// A setting's value: an integer or the index of a choice, a number, or a text.
using SettingValue = std::variant<int, double, std::string>;

/// Return the value that a text stands for; nothing if it is not valid.
std::optional<SettingValue> readValue(const SettingValues& values, const std::string& text);
/// Return a valid value's text.
std::string textOf(const SettingValues& values, const SettingValue& value);
/// Return the valid values for error messages: "one of: bilinear, box", "an integer in [1, 32]".
std::string expectedOf(const SettingValues& values);
/// Return the error of a value that a setting does not take, as a sentence without a full stop.
std::string errorOf(const std::string& name, const SettingValues& values, const std::string& found);

/// One setting, as light keys, scene files and command lines see it. cmake/GnomonSettings.cmake
/// makes them of settings.json; other code reads and writes the struct's members.
struct Setting
{
  std::size_t index;   ///< in shadowSettings()
  std::string name;    ///< as in scene files, "kernel_size"; on the command line "--kernel-size"
  std::string meaning; ///< one line for users
  std::string unit;    ///< for example "texels"; empty without a unit
  SettingValues values;
  SettingValue (*read)(const ShadowSettings&);
  void (*write)(ShadowSettings&, const SettingValue&);
  void (*copy)(ShadowSettings& to, const ShadowSettings& from);
  bool isBaked; ///< a change makes baked maps stale

  /// Set the value from text.
  /// @return false for an invalid value; then nothing changes
  bool set(ShadowSettings& settings, const std::string& text) const;
  std::string get(const ShadowSettings& settings) const;
  std::string expected() const { return expectedOf(this->values); }
};

/// Settings that a technique has together or not at all.
struct SettingsTable
{
  std::string title; ///< for users, for example "Kernel"
  std::vector<Setting> settings;
};

/// Return the index of the choice with this number.
int choiceOf(int number, std::initializer_list<int> numbers);
/// Return what stands for a choice.
template <typename Value>
Value valueAt(int choice, std::initializer_list<Value> values)
{
  return values.begin()[choice];
}

/// Return all tables, in the order of documentation.
const std::vector<const SettingsTable*>& settingsTables();

/// Return the settings of all tables, by Setting::index.
const std::vector<const Setting*>& shadowSettings();

/// Return the setting with this name; nullptr without one.
const Setting* findSetting(const std::string& name);

/// Return a number as the text that the setting with this name takes: 0 and 1 are off and on of a
/// switch.
std::string textOfNumber(const std::string& settingName, double number);

/// Return all names for error messages: "technique, map_size, ...".
std::string settingNames();

/// Return names as a list: "a, b, c".
std::string listOf(const std::vector<std::string>& names);

} // namespace gnomon
