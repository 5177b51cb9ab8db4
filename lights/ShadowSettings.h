#pragma once

#include "lights/LightPointSettings.h"
#include "lights/ViewSettings.h"

#include <any>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <typeindex>

namespace gnomon
{

/// The settings of a light's shadows. A light sets some by name (vtkGnomonLightKeys), the pass sets
/// others, and the rest are defaults.
///
/// Each folder owns a struct of its settings with their defaults, and a table of their names
/// (SettingsTable.h). Settings of views and light points are members here. A technique's settings
/// are looked up by their type.
struct ShadowSettings
  : ViewSettings
  , LightPointSettings
{
  /// A technique's name in the registry (shadowtech/Registry.h); empty: the registry's default.
  std::string technique;
  /// An estimator's name in the registry; empty: the technique's estimator.
  std::string estimator;
  /// True to follow the technique's publication to the letter, even if the result is then not
  /// exact.
  bool asPublished = false;

  /// The names that Setting::set() set since the technique was chosen.
  std::set<std::string> named;

  ///@{
  /// Return the settings of a struct.
  template <typename Struct>
  const Struct& of() const
  {
    if constexpr (std::is_base_of_v<Struct, ShadowSettings>)
    {
      return *this;
    }
    else
    {
      static const Struct defaults{};
      const auto found = this->ofTechniques_.find(typeid(Struct));
      return found == this->ofTechniques_.end() ? defaults : *std::any_cast<Struct>(&found->second);
    }
  }
  template <typename Struct>
  Struct& of()
  {
    if constexpr (std::is_base_of_v<Struct, ShadowSettings>)
    {
      return *this;
    }
    else
    {
      std::any& settings = this->ofTechniques_[typeid(Struct)];
      if (!settings.has_value())
      {
        settings = Struct{};
      }
      return *std::any_cast<Struct>(&settings);
    }
  }
  ///@}

private:
  std::map<std::type_index, std::any> ofTechniques_; ///< a missing struct has its defaults
};

} // namespace gnomon
