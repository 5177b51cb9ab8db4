#pragma once

#include "ComparisonRun.h"
#include "Report.h"

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
Rows runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress);

} // namespace gnomon::tool
