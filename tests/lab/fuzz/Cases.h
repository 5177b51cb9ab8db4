#pragma once

#include "RandomSettings.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::fuzz
{

/// An error that a case finds.
class Find : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

///@{
/// Run a case.
/// @param random generator that determines the case
/// @param description set to the case in words, step by step, so that a find states it
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

/// The number of a case among all of its kind; seed and index alone determine the case.
struct Place
{
  unsigned seed = 1;
  unsigned index = 0;
};

/// Run a case of a kind. Return the error with its description; empty if there is none.
std::string whatIsWrong(const CaseKind& kind, const Place& place);

} // namespace gnomon::fuzz
