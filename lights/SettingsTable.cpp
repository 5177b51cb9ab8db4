#include "lights/SettingsTable.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace gnomon
{
namespace
{

/// Return the whole text as a number; nothing if it is not a number.
template <typename Number>
std::optional<Number> parse(const std::string& text)
{
  Number number{};
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end ? std::optional<Number>(number)
                                                       : std::nullopt;
}

/// Return the shortest text that parses to exactly this number.
std::string shortest(double number)
{
  std::array<char, 32> text{};
  const std::to_chars_result result = std::to_chars(text.data(), text.data() + text.size(), number);
  return { text.data(), result.ptr };
}

/// Parses a text as a setting's value; nothing for an invalid value.
struct ReadText
{
  const std::string& text;

  std::optional<SettingValue> operator()(const IntegerSetting& values) const
  {
    const std::optional<int> number = parse<int>(this->text);
    return number && *number >= values.smallest && *number <= values.largest
      ? std::optional<SettingValue>(*number)
      : std::nullopt;
  }
  std::optional<SettingValue> operator()(const RealSetting& values) const
  {
    const std::optional<double> number = parse<double>(this->text); // it may be NaN
    return number && *number >= values.smallest && *number <= values.largest
      ? std::optional<SettingValue>(*number)
      : std::nullopt;
  }
  std::optional<SettingValue> operator()(const ChoiceSetting& values) const
  {
    const auto found = std::find(values.names.begin(), values.names.end(), this->text);
    return found == values.names.end()
      ? std::nullopt
      : std::optional<SettingValue>(static_cast<int>(found - values.names.begin()));
  }
};

struct Expected
{
  std::string operator()(const IntegerSetting& values) const
  {
    return "an integer in [" + std::to_string(values.smallest) + ", " +
      std::to_string(values.largest) + "]";
  }
  std::string operator()(const RealSetting& values) const
  {
    return values.largest == anyLength.largest
      ? "a number of at least " + shortest(values.smallest)
      : "a number in [" + shortest(values.smallest) + ", " + shortest(values.largest) + "]";
  }
  std::string operator()(const ChoiceSetting& values) const
  {
    return "one of: " + listOf(values.names);
  }
};

} // namespace

std::string listOf(const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() || name.empty() ? "" : ", ") + name;
  }
  return list;
}

int choiceOf(int number, std::initializer_list<int> numbers)
{
  return static_cast<int>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
}

const std::vector<const Setting*>& shadowSettings()
{
  static const std::vector<const Setting*> all = []
  {
    std::vector<const Setting*> found;
    for (const SettingsTable* table : settingsTables())
    {
      for (const Setting& setting : table->settings)
      {
        found.push_back(&setting);
      }
    }
    return found;
  }();
  return all;
}

const Setting* findSetting(const std::string& name)
{
  const std::vector<const Setting*>& settings = shadowSettings();
  const auto found = std::find_if(settings.begin(), settings.end(),
    [&](const Setting* setting) { return setting->name == name; });
  return found == settings.end() ? nullptr : *found;
}

std::string settingNames()
{
  std::vector<std::string> names;
  for (const Setting* setting : shadowSettings())
  {
    names.push_back(setting->name);
  }
  return listOf(names);
}

std::string textOfNumber(const std::string& settingName, double number)
{
  const Setting* const setting = findSetting(settingName);
  const auto* choices = setting ? std::get_if<ChoiceSetting>(&setting->values) : nullptr;
  const bool isSwitch = choices && choices->names == std::vector<std::string>{ "off", "on" };
  if (isSwitch && (number == 0.0 || number == 1.0))
  {
    return number == 0.0 ? "off" : "on";
  }
  // The shortest text of a large integer has an exponent, which integers do not parse.
  const bool isInteger = std::abs(number) <= 1e9 && number == std::trunc(number);
  return isInteger ? std::to_string(static_cast<int>(number)) : shortest(number);
}

std::optional<SettingValue> readValue(const SettingValues& values, const std::string& text)
{
  return std::visit(ReadText{ text }, values);
}

std::string textOf(const SettingValues& values, const SettingValue& value)
{
  if (const auto* text = std::get_if<std::string>(&value))
  {
    return *text;
  }
  if (const auto* number = std::get_if<double>(&value))
  {
    return shortest(*number);
  }
  const auto* choices = std::get_if<ChoiceSetting>(&values);
  const int integer = std::get<int>(value);
  return choices ? choices->names[static_cast<std::size_t>(integer)] : std::to_string(integer);
}

std::string expectedOf(const SettingValues& values)
{
  return std::visit(Expected{}, values);
}

std::string errorOf(const std::string& name, const SettingValues& values, const std::string& found)
{
  return "Invalid value '" + found + "' for the setting '" + name + "', expected " +
    expectedOf(values);
}

bool Setting::set(ShadowSettings& settings, const std::string& text) const
{
  const std::optional<SettingValue> value = readValue(this->values, text);
  if (!value)
  {
    return false;
  }
  this->write(settings, *value);
  settings.named.set(this->index);
  return true;
}

std::string Setting::get(const ShadowSettings& settings) const
{
  return textOf(this->values, this->read(settings));
}

} // namespace gnomon
