#pragma once

#include "Comparison.h"
#include "ComparisonRun.h"

#include <array>
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

/// One comparison of a study.
struct StudyCase
{
  std::string scene;
  int view = 0;
  bool soft = false; ///< whether its lights have an area

  /// "bunny, view 2".
  std::string name() const;
};

/// How one variant did in one case.
struct StudyRow
{
  StudyCase of;
  std::string variant; ///< as VariantResult::name, without the route
  std::string technique;
  double wrongShare = 0.0; ///< of the pixels that count
  double rootMeanSquare = 0.0;
  double meanAbsolute = 0.0;
  std::array<double, 3> milliseconds{}; ///< a frame, in the order of allMotions
  std::array<double, 3> overPlain{};    ///< the same as multiples of plain VTK's
  /// Where it is most wrong: the truth and the variant's picture side by side; without pixels where
  /// it is right.
  Picture worst;

  /// What counts: the RMS error of soft shadows, the wrong share of hard ones.
  double error() const { return this->of.soft ? this->rootMeanSquare : this->wrongShare; }
};

/// Runs a study, or goes on with one. Every case has a folder, which a later call takes as it is if
/// it was made by the same plan.
/// @param progress gets the share of the work that is done, and the present step, for people
/// @throws BadInput, Failure as runComparison(), with the case's name
std::vector<StudyRow> runStudy(const StudyPlan& plan, const std::string& folder,
  const std::function<void(double share, const std::string& step)>& progress);

/// A variant over several cases of a study.
struct StudySummary
{
  std::string variant;
  std::string technique;
  double error = 0.0;                ///< mean of StudyRow::error()
  std::array<double, 3> overPlain{}; ///< geometric means, in the order of allMotions
};

/// The variants that took part in all of the rows' cases.
/// @param rows of hard shadows alone, or of soft ones
std::vector<StudySummary> summarise(const std::vector<StudyRow>& rows);

/// A table with a line per row: text as in RFC 4180, times in milliseconds.
std::string toCsv(const std::vector<StudyRow>& rows);

/// The page: one HTML file that needs neither a network nor other files.
/// @param machine what it was measured on
std::string studyPage(const std::vector<StudyRow>& rows, const std::string& machine);

} // namespace gnomon::tool
