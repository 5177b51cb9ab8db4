#pragma once

#include "Cases.h"

#include <string>

namespace gnomon::fuzz
{

/// Which cases run, and for how long.
struct Run
{
  Place first;
  unsigned count = 100;
  double seconds = 0.0;         ///< no case starts later; 0: no limit
  double secondsPerCase = 60.0; ///< a longer case counts as hanging
  std::string folder;           ///< for finds, a file each; empty: none are written
};

/// Run cases in child processes, so a crash or a hang is reported like other finds. Prints finds to
/// stdout.
/// @return the number of finds
unsigned run(const CaseKind& kind, const Run& run);

} // namespace gnomon::fuzz
