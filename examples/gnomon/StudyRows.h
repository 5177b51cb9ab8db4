#pragma once

#include "Comparison.h"

#include <array>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// One comparison of a study.
struct StudyCase
{
  std::string scene;
  int view = 0;      ///< negative for a single view
  bool soft = false; ///< true if its lights have an area

  /// Return "bunny, view 2", or "bunny" for a single view.
  std::string name() const;
};

/// The result of one variant in one case.
struct StudyRow
{
  StudyCase of;
  std::string variant; ///< as VariantResult::name, in a study without the route
  std::string technique;
  double wrongShare = 0.0; ///< of the pixels that count
  double rootMeanSquare = 0.0;
  double meanAbsolute = 0.0;
  std::array<double, 3> milliseconds{}; ///< a frame, in the order of allMotions
  std::array<double, 3> overPlain{};    ///< milliseconds as multiples of plain VTK's
  /// Its most wrong place: the truth and the variant's picture side by side; without pixels if it
  /// is right everywhere.
  Picture worst;

  /// Return the error: the RMS error of soft shadows, the wrong share of hard shadows.
  double error() const { return this->of.soft ? this->rootMeanSquare : this->wrongShare; }
};

/// Return a comparison's results for its variants.
std::vector<StudyRow> rowsOf(const StudyCase& of, const ComparisonResults& results);

/// A variant's means over several cases of a study.
struct StudySummary
{
  std::string variant;
  std::string technique;
  double error = 0.0;                ///< mean of StudyRow::error()
  std::array<double, 3> overPlain{}; ///< geometric means, in the order of allMotions
};

/// Return summaries of the variants that have a row in every case.
/// @param rows only of hard shadows, or only of soft shadows
std::vector<StudySummary> summarise(const std::vector<StudyRow>& rows);

} // namespace gnomon::tool
