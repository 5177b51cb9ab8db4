#pragma once

#include "ComparisonRun.h"
#include "StudyRows.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// What a study compares: each scene from each view.
struct StudyPlan
{
  std::vector<std::string> scenes;
  int views = 1; ///< of each scene: its camera, turned farther and farther
  ///@{
  /// As ComparisonPlan::techniques, for scenes whose lights are points and for those with area
  /// lights.
  std::vector<std::string> hardTechniques;
  std::vector<std::string> softTechniques;
  ///@}
  std::vector<int> lightSamples; ///< of area lights, for techniques that take them
  ComparisonPlan comparison;     ///< all but the techniques
};

/// Runs a study, or goes on with one. Every case has a folder, which a later call takes as it is if
/// it was made by the same plan.
/// @param progress gets the share of the work that is done, and the present step, for people
/// @throws BadInput, Failure as runComparison(), with the case's name
std::vector<StudyRow> runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress);

/// A table with a line per row: text as in RFC 4180, times in milliseconds.
std::string toCsv(const std::vector<StudyRow>& rows);

/// The page: one HTML file that needs neither a network nor other files.
/// @param machine what it was measured on
std::string studyPage(const std::vector<StudyRow>& rows, const std::string& machine);

} // namespace gnomon::tool
