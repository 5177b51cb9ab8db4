#pragma once

#include "Cases.h"

#include <string>

namespace gnomon::fuzz
{

/// Which cases are run, and for how long.
struct Run
{
  Place first;
  unsigned count = 100;
  double seconds = 0.0;         ///< after which no case is begun; 0: never
  double secondsPerCase = 60.0; ///< after which a case hangs
  std::string folder;           ///< where finds are written to, a file each; empty: nowhere
};

/// Runs cases in child processes, so that a crash or a hang is a find like others. Prints finds to
/// stdout.
/// @return how many there were
unsigned run(const CaseKind& kind, const Run& run);

} // namespace gnomon::fuzz
