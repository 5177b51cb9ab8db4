#pragma once

#include "BuiltinScenes.h"

#include <ostream>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// A scene on which shadow techniques break, made for numerical hard cases of the literature.
struct HardScene
{
  BuiltinScene scene; ///< its name begins with "hard-"
  /// The cases by source and number: apelles, crsm, selective, montecarlo, survey.
  std::vector<std::string> cases;
};
/// Has tests name it.
inline std::ostream& operator<<(std::ostream& stream, const HardScene& hard)
{
  return stream << hard.scene.name;
}
/// All of them, in the order in which they are listed to people.
const std::vector<HardScene>& hardScenes();

/// A hard case that is no matter of a scene.
struct HardCaseElsewhere
{
  std::string hardCase;
  std::string where; ///< the test that holds it, or why none is needed
};
const std::vector<HardCaseElsewhere>& hardCasesElsewhere();

} // namespace gnomon::tool
