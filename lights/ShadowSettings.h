#ifndef gnomon_lights_ShadowSettings_h
#define gnomon_lights_ShadowSettings_h

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon
{

/// Which texels around a receiver a filter reads, and with which weights.
enum class FilterKernel
{
  Bilinear, ///< a square of any place: texels count by how far it covers them
  Box,      ///< n x n texels of equal weight
  Poisson   ///< a few texels of equal weight, scattered over a disc that turns from place to place
};

/// What a user can ask of a light's shadows. A light says what it wants by name
/// (vtkGnomonLightKeys), the pass says the rest, and these are the defaults of both.
struct ShadowSettings
{
  /// A name of the registry of techniques (shadowtech/Registry.h); empty: the registry's default.
  std::string technique;

  /// The side of the light's map, of each layer where it has several.
  int mapSizeTexels = 1024;

  /// Of techniques that filter. The default is the narrowest that shows no single texels (as a box
  /// does) and also smooths the steps of an edge that runs across the texels.
  FilterKernel kernel = FilterKernel::Bilinear;
  int kernelTexels = 3; ///< the side of a kernel's square, the diameter of its disc
};

///@{
/// What values a setting takes, and where it lives.
struct TextSetting
{
  std::string ShadowSettings::*member;
};
struct IntegerSetting
{
  int ShadowSettings::*member;
  int smallest;
  int largest;
};
struct ChoiceSetting
{
  std::vector<std::string> names; ///< by the number of the choice
  int (*get)(const ShadowSettings&);
  void (*set)(ShadowSettings&, int choice);
};
///@}

/// One setting: a line of the table that light keys, scene files and command lines are made from.
struct Setting
{
  std::string name; ///< as in scene files, "kernel_size"; on the command line "--kernel-size"
  std::string help; ///< one line for people
  std::variant<TextSetting, IntegerSetting, ChoiceSetting> values;

  /// Sets it from text.
  /// @return false for what it does not take; nothing changes then
  bool set(ShadowSettings& settings, const std::string& text) const;
  std::string get(const ShadowSettings& settings) const;
  /// What it takes, for error messages: "one of: bilinear, box, poisson", "an integer in [1, 32]".
  std::string expected() const;
};

/// All settings, in the order in which they are listed to people.
const std::vector<Setting>& shadowSettings();

/// The setting of that name; nullptr when there is none.
const Setting* findSetting(const std::string& name);

/// "technique, map_size, ...": for error messages.
std::string settingNames();

} // namespace gnomon

#endif
