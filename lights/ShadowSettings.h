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

/// What a user can ask of a light's shadows. A light sets some by name (vtkGnomonLightKeys), the
/// pass sets others, and the rest are defaults.
///
/// Each folder owns a struct of its settings with their defaults, and the table of their names
/// (SettingsTable.h). Settings of views and of light points are members here; a technique's are
/// found by their type.
struct ShadowSettings
  : ViewSettings
  , LightPointSettings
{
  /// A name of the registry of techniques (shadowtech/Registry.h); empty: the registry's default.
  std::string technique;
  /// A name of the registry of estimators; empty: the technique's.
  std::string estimator;
  /// Whether to follow the technique's publication to the letter, where that is not exact.
  bool asPublished = false;

  /// The names that Setting::set() was called for since the technique was chosen.
  std::set<std::string> named;

  ///@{
  /// The settings of a struct.
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
  std::map<std::type_index, std::any> ofTechniques_; ///< defaults where there is none
};

} // namespace gnomon
