#pragma once

#include "view/ViewState.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// The choices that keys step through.
struct ViewChoices
{
  std::vector<std::string> techniques; ///< as parseTechnique() takes them
};

/// A key of the viewer. It changes the state, or VTK or the window handles it.
struct ViewKey
{
  char code;        ///< as vtkRenderWindowInteractor::GetKeyCode()
  std::string name; ///< for users
  std::string help; ///< its effect
  bool ofVtk;       ///< true if VTK's interactor styles handle it
  /// Changes the state; null if the state stays.
  std::function<void(ViewState&, const Scene&, const ViewChoices&)> change;
  /// Returns its value in a state, for users; null if it has none.
  std::function<std::string(const ViewState&)> says;
};

/// Return all keys, in the order of the help.
const std::vector<ViewKey>& viewKeys();
const ViewKey* findKey(char code);

/// The key that saves picture and state, and changes neither.
inline constexpr char saveKey = 'g';

/// Return the keys with their values in a state, for the picture.
std::string helpText(const ViewState& state);
std::string keysAsMarkdown();

/// Return the number of the scene's sun, its first directional light without a box.
std::optional<std::size_t> sunOf(const Scene& scene);

///@{
/// Changes that have no key: the wheel, and the sun.
/// @param steps up or down
void resizeLight(ViewState& state, const Scene& scene, int steps);
/// Place the scene's sun by date and place.
/// @throws BadInput if the scene has no sun
void placeSun(ViewState& state, const Scene& scene, const SunTime& sun);
///@}

} // namespace gnomon::tool
