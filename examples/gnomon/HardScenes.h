#pragma once

#include "BuiltinScenes.h"

#include <ostream>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A scene on which shadow techniques break: numerical hard cases of the literature.
struct HardScene
{
  BuiltinScene scene; ///< its name begins with "hard-"
  /// The cases by source and number: apelles, crsm, selective, montecarlo, survey.
  std::vector<std::string> cases;
};
/// Print the scene's name, for tests.
inline std::ostream& operator<<(std::ostream& stream, const HardScene& hard)
{
  return stream << hard.scene.name;
}
/// Return all hard scenes, in the order of listings.
const std::vector<HardScene>& hardScenes();

/// A hard case that needs no scene.
struct HardCaseElsewhere
{
  std::string hardCase;
  std::string where; ///< the test of the case, or why none is needed
};
const std::vector<HardCaseElsewhere>& hardCasesElsewhere();

} // namespace gnomon::tool
