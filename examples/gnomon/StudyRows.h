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
  int view = 0;      ///< negative where there is only one
  bool soft = false; ///< whether its lights have an area

  /// "bunny, view 2"; "bunny" where there is only one.
  std::string name() const;
};

/// How one variant did in one case.
struct StudyRow
{
  StudyCase of;
  std::string variant; ///< as VariantResult::name, in a study without the route
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

/// What a comparison says of its variants.
std::vector<StudyRow> rowsOf(const StudyCase& of, const ComparisonResults& results);

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

} // namespace gnomon::tool
