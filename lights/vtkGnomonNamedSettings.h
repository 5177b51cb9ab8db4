/**
 * @class   vtkGnomonNamedSettings
 * @brief   settings of lights' shadows, by name
 *
 * vtkGnomonShadowSettings has the same settings with types. docs/guide/settings.md lists all
 * settings with units, ranges and defaults.
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
   * A setting's value, as text or as a number, where 1 and 0 switch on and off. GetSetting()
   * returns it as text. An unknown name or an invalid value is an error, returns false and changes
   * nothing. GetSettingError() then says why, as a sentence without a full stop, also while
   * VTK's warnings are switched off; it is empty after a success. GetSetting() returns an empty
   * string for an unknown name.
   */
  virtual bool SetSetting(const char* name, const char* value);
  bool SetSetting(const char* name, double number);
  std::string GetSettingError() const;
  std::string GetSetting(const char* name) const;
  ///@}

  ///@{
  /**
   * Reset a setting to its default and mark it as unset. The pass's settings apply where a light's
   * settings are unset.
   */
  virtual void UnsetSetting(const char* name);
  bool IsSettingSet(const char* name) const;
  ///@}

  ///@{
  /**
   * All settings, by index in [0, GetNumberOfSettings()): name, meaning, unit (empty without a
   * unit) and valid values. For other indices the strings are empty.
   */
  static int GetNumberOfSettings();
  static std::string GetSettingName(int index);
  static std::string GetSettingMeaning(int index);
  static std::string GetSettingUnit(int index);
  static std::string GetSettingValues(int index);
  ///@}

  /**
   * Do what SetSetting() does without an error.
   */
  bool TrySetting(const char* name, const char* value);

  ///@{
  /**
   * The values, for the library's own code. GetValues() returns all values. CopySetValues() copies
   * the values that were set.
   */
  const gnomon::ShadowSettings& GetValues() const;
  void CopySetValues(gnomon::ShadowSettings& to) const;
  ///@}

protected:
  vtkGnomonNamedSettings();
  ~vtkGnomonNamedSettings() override;

  /**
   * The values, for a typed setter. NoteAssigned() follows an assignment, with the setting's index
   * and whether the value changed.
   */
  gnomon::ShadowSettings& ValuesToAssign();
  void NoteAssigned(int index, bool changes);

private:
  vtkGnomonNamedSettings(const vtkGnomonNamedSettings&) = delete;
  void operator=(const vtkGnomonNamedSettings&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
