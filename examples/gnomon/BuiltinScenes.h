#pragma once

#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace gnomon::tool
{

struct BuiltinScene
{
  std::string name;
  std::string summary; ///< one line
  /// The numerical hard cases of the literature that it has, by source and number: apelles, crsm,
  /// selective, montecarlo, survey. Shadow techniques break on them.
  std::vector<std::string> cases;

  /// @throws BadInput if a file of its is missing
  Scene make() const;
};
/// Print the scene's name, for tests.
inline std::ostream& operator<<(std::ostream& stream, const BuiltinScene& scene)
{
  return stream << scene.name;
}

/// Return all built-in scenes except the hard ones, in the order of listings.
const std::vector<BuiltinScene>& builtinScenes();
/// Return the scenes of hard cases; their names begin with "hard-".
const std::vector<BuiltinScene>& hardScenes();
/// Find a built-in scene by its name, hard scenes included.
/// @return null without such a scene
const BuiltinScene* findBuiltinScene(const std::string& name);
/// Return all names for messages: "bunny, horse, ...".
std::string builtinSceneNames();

/// The x of the shadow edge of the scene half-plane on the plane y = 0. Larger x are lit.
constexpr double halfPlaneShadowEdge = 1.25;

} // namespace gnomon::tool
