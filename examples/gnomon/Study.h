#pragma once

#include "ComparisonRun.h"
#include "StudyRows.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// The plan of a study: it compares each scene from each view.
struct StudyPlan
{
  std::vector<std::string> scenes;
  int views = 1; ///< views of each scene, by turning its camera
  ///@{
  /// As ComparisonPlan::techniques, for scenes with point lights and scenes with area lights.
  std::vector<std::string> hardTechniques;
  std::vector<std::string> softTechniques;
  ///@}
  std::vector<int> lightSamples; ///< of area lights, for techniques that sample them
  ComparisonPlan comparison;     ///< all except the techniques
};

/// Run or continue a study. Every case has a folder. A later call with the same plan reuses
/// finished cases.
/// @param progress receives the finished share of the work, and the current step, for users
/// @throws BadInput, Failure as runComparison(), with the case's name
std::vector<StudyRow> runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress);

/// Return a table with a line per row: text as in RFC 4180, times in milliseconds.
std::string toCsv(const std::vector<StudyRow>& rows);

/// Return the page: one HTML file that needs neither a network nor other files.
/// @param machine description of the machine that was measured
std::string studyPage(const std::vector<StudyRow>& rows, const std::string& machine);

} // namespace gnomon::tool
