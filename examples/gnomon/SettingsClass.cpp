#include "SettingsClass.h"

#include "SettingOptions.h"

#include <cctype>
#include <sstream>

namespace gnomon::tool
{
namespace
{

const char* const head = R"(/**
 * @class   vtkGnomonShadowSettings
 * @brief   settings of lights' shadows
 *
 * A pass has settings for all lights (vtkGnomonShadowPass::SetSettings). A light may have its own
 * (vtkGnomonLightKeys::SetSettings), whose set values override the pass. Numbers are clamped to
 * their range. A technique that lacks a setting ignores it, with an error that names the techniques
 * that have it.
 *
 * @code
 * vtkNew<vtkGnomonShadowSettings> settings;
 * settings->SetTechnique("pcf");
 * settings->SetKernelToBox();
 * settings->SetKernelSize(5);
 * pass->SetSettings(settings);
 * @endcode
 *
 * `gnomon settings --class` generates this header from the techniques' tables.
 */

#ifndef vtkGnomonShadowSettings_h
#define vtkGnomonShadowSettings_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkGnomonNamedSettings.h"

class GNOMONLIGHTS_EXPORT vtkGnomonShadowSettings : public vtkGnomonNamedSettings
{
public:
  static vtkGnomonShadowSettings* New();
  vtkTypeMacro(vtkGnomonShadowSettings, vtkGnomonNamedSettings);

  // clang-format off
)";

const char* const tail = R"(
  // clang-format on

protected:
  vtkGnomonShadowSettings() = default;
  ~vtkGnomonShadowSettings() override = default;

private:
  vtkGnomonShadowSettings(const vtkGnomonShadowSettings&) = delete;
  void operator=(const vtkGnomonShadowSettings&) = delete;
};

#endif
)";

/// Return "kernel_size" as "KernelSize". '-' also separates words.
std::string camelCase(const std::string& name)
{
  std::string text;
  bool begins = true;
  for (const char letter : name)
  {
    const bool divides = letter == '_' || letter == '-';
    if (!divides)
    {
      text += static_cast<char>(begins ? std::toupper(letter) : letter);
    }
    begins = divides;
  }
  return text;
}

/// Return "kernel_size" as "KERNEL_SIZE".
std::string upperCase(const std::string& name)
{
  std::string text;
  for (const char letter : name)
  {
    text += static_cast<char>(letter == '-' ? '_' : std::toupper(letter));
  }
  return text;
}

/// Return words as lines of a comment, of at most 100 columns.
std::string wrapped(const std::string& text)
{
  constexpr std::size_t columns = 100;
  std::string lines;
  std::string line = "   *";
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    if (line.size() + 1 + word.size() > columns)
    {
      lines += line + "\n";
      line = "   *";
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

/// The setter and getter of a setting.
struct Accessors
{
  const Setting& setting;
  std::string camel = camelCase(setting.name);
  std::string quoted = "\"" + setting.name + "\"";

  std::string pair(const char* type, const char* kind) const
  {
    return "  void Set" + this->camel + "(" + type + " value) { this->Set" + kind + "(" +
      this->quoted + ", value); }\n  " + type + " Get" + this->camel +
      "() const { return this->Get" + kind + "(" + this->quoted + "); }\n";
  }

  std::string operator()(const IntegerSetting&) const { return this->pair("int", "Integer"); }
  std::string operator()(const RealSetting&) const { return this->pair("double", "Real"); }
  std::string operator()(const ChoiceSetting& values) const
  {
    if (std::holds_alternative<std::string>(this->setting.read(ShadowSettings())))
    {
      return "  void Set" + this->camel + "(const char* value) { this->SetSetting(" + this->quoted +
        ", value); }\n  std::string Get" + this->camel + "() const { return this->GetSetting(" +
        this->quoted + "); }\n";
    }
    if (values.names == std::vector<std::string>{ "off", "on" })
    {
      return "  void Set" + this->camel + "(bool value) { this->SetChoice(" + this->quoted +
        ", value ? 1 : 0); }\n  bool Get" + this->camel + "() const { return this->GetChoice(" +
        this->quoted + ") != 0; }\n  void " + this->camel + "On() { this->Set" + this->camel +
        "(true); }\n  void " + this->camel + "Off() { this->Set" + this->camel + "(false); }\n";
    }
    const std::string upper = upperCase(this->setting.name) + "_";
    std::string constants;
    std::string shortcuts;
    for (std::size_t i = 0; i < values.names.size(); ++i)
    {
      const std::string constant = upper + upperCase(values.names[i]);
      constants += (i > 0 ? ",\n    " : "    ") + constant + " = " + std::to_string(i);
      shortcuts += "  void Set" + this->camel + "To" + camelCase(values.names[i]) +
        "() { this->Set" + this->camel + "(" + constant + "); }\n";
    }
    return "  enum " + this->camel + "Type\n  {\n" + constants + "\n  };\n" +
      this->pair("int", "Choice") + "  std::string Get" + this->camel +
      "AsString() const { return this->GetSetting(" + this->quoted + "); }\n" + shortcuts;
  }
};

} // namespace

//------------------------------------------------------------------------------
std::string settingsClass()
{
  std::string text = head;
  for (const SettingsTable* table : settingsTables())
  {
    text += "\n  // " + table->title + "\n";
    for (const Setting& setting : table->settings)
    {
      std::string meaning = setting.meaning;
      meaning[0] = static_cast<char>(std::toupper(meaning[0]));
      const std::string byDefault = defaultOf(setting);
      const std::string unit = setting.unit.empty() ? "" : ", in " + setting.unit;
      text += "\n  ///@{\n  /**\n" +
        wrapped(meaning + unit + ": " + setting.expected() + ". Default " +
          (byDefault.empty() ? "none" : byDefault) + ". The setting `" + setting.name + "`.") +
        "   */\n" + std::visit(Accessors{ setting }, setting.values) + "  ///@}\n";
    }
  }
  return text + tail;
}

} // namespace gnomon::tool
