#pragma once

#include "view/ViewState.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// What keys choose among.
struct ViewChoices
{
  std::vector<std::string> techniques; ///< as parseTechnique() takes them
};

/// A key of the viewer: a change of the state, or what VTK or the window does by itself.
struct ViewKey
{
  char code;        ///< as vtkRenderWindowInteractor::GetKeyCode()
  std::string name; ///< for people
  std::string help; ///< what it does
  bool ofVtk;       ///< whether VTK's interactor styles do it
  /// Null: nothing in the state.
  std::function<void(ViewState&, const Scene&, const ViewChoices&)> change;
  /// What the state says of it; null: nothing.
  std::function<std::string(const ViewState&)> says;
};

/// All of them, in the order in which people see them.
const std::vector<ViewKey>& viewKeys();
/// Null for a code that is no key's.
const ViewKey* findKey(char code);

/// Saves the picture and the state, which no key changes.
inline constexpr char saveKey = 'g';

/// The keys with what the state says of each, for the picture.
std::string helpText(const ViewState& state);
/// The keys as a table for the documentation.
std::string keysAsMarkdown();

///@{
/// Changes that have no key: the wheel, and the sun.
/// @param steps up or down
void resizeLight(ViewState& state, const Scene& scene, int steps);
/// Has the scene's first directional light shine from the sun.
/// @throws BadInput where it has none
void placeSun(ViewState& state, const Scene& scene, const SunTime& sun);
///@}

} // namespace gnomon::tool
