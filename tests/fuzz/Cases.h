#pragma once

#include "RandomSettings.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::fuzz
{

/// Something that must never be.
class Find : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

///@{
/// Runs a case.
/// @param random of which the case is a function
/// @param description set to the case in words, step by step, so that a find has it
/// @throws Find
void runScene(Random random, std::string& description);
void runSequence(Random random, std::string& description);
void runFile(Random random, std::string& description);
///@}

/// A kind of cases.
struct CaseKind
{
  std::string name;
  std::string meaning; ///< one line for people
  void (*run)(Random random, std::string& description);
};
const std::vector<CaseKind>& caseKinds();

/// Where a case is in the endless row of those of its kind: it is a function of these alone.
struct Place
{
  unsigned seed = 1;
  unsigned index = 0;
};

/// Runs a case of a kind, and tells what was wrong with its description; empty if nothing was.
std::string whatIsWrong(const CaseKind& kind, const Place& place);

} // namespace gnomon::fuzz
