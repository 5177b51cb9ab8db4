/**
 * @class   vtkGnomonNamedSettings
 * @brief   what is asked of lights' shadows, by name
 *
 * vtkGnomonShadowSettings has the same settings with types. docs/guide/settings.md lists them all.
 */

#ifndef vtkGnomonNamedSettings_h
#define vtkGnomonNamedSettings_h

#include "GnomonLightsModule.h" // For export macro
#include "vtkObject.h"

#include <memory> // For std::unique_ptr
#include <string> // For names and values

namespace gnomon
{
struct ShadowSettings;
}

class GNOMONLIGHTS_EXPORT vtkGnomonNamedSettings : public vtkObject
{
public:
  static vtkGnomonNamedSettings* New();
  vtkTypeMacro(vtkGnomonNamedSettings, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A setting's value as text. A name that does not exist, and a value that the setting does not
   * take, are an error and change nothing. GetSetting returns an empty string for what does not
   * exist.
   */
  virtual void SetSetting(const char* name, const char* value);
  std::string GetSetting(const char* name) const;
  ///@}

  ///@{
  /**
   * Give a setting its default again, as if it had never been set. What a light's settings leave
   * unset, the pass's say.
   */
  virtual void UnsetSetting(const char* name);
  bool IsSettingSet(const char* name) const;
  ///@}

  ///@{
  /**
   * All settings, by number in [0, GetNumberOfSettings()): name, meaning, unit (empty where there is
   * none), and what values it takes. Beyond, strings are empty.
   */
  static int GetNumberOfSettings();
  static std::string GetSettingName(int index);
  static std::string GetSettingMeaning(int index);
  static std::string GetSettingUnit(int index);
  static std::string GetSettingValues(int index);
  ///@}

  /**
   * Set a setting, or say why it is not set, as a sentence without a full stop; empty where it is.
   */
  std::string TrySetting(const char* name, const char* value);

  ///@{
  /**
   * The values for the library itself: all of them, or those that are set written over others.
   */
  const gnomon::ShadowSettings& GetValues() const;
  void CopySetValues(gnomon::ShadowSettings& to) const;
  ///@}

protected:
  vtkGnomonNamedSettings();
  ~vtkGnomonNamedSettings() override;

  ///@{
  /**
   * By type. Numbers beyond a setting's range are clamped to it, and NaN is an error. A choice is
   * the index of a value.
   */
  void SetInteger(const char* name, int value);
  int GetInteger(const char* name) const;
  void SetReal(const char* name, double value);
  double GetReal(const char* name) const;
  void SetChoice(const char* name, int index);
  int GetChoice(const char* name) const;
  ///@}

private:
  vtkGnomonNamedSettings(const vtkGnomonNamedSettings&) = delete;
  void operator=(const vtkGnomonNamedSettings&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
