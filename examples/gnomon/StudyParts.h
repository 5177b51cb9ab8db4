#pragma once

#include "StudyRows.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::tool
{

///@{
/// Parts of pages about variants with only hard or only soft shadows. Text is HTML.

/// Return the variants that no other one beats in error and time, in order of time.
std::vector<StudySummary> frontOf(const std::vector<StudySummary>& summaries, Motion motion);

/// Return recommendations, in one sentence or two.
std::string conclusionOf(const std::vector<StudySummary>& summaries, bool soft);

/// Return the table of the front with the camera moving.
/// @param most largest number of rows; the most accurate ones stay
std::string frontTable(const std::vector<StudySummary>& summaries, bool soft, std::size_t most);

/// Return a chart of error over time.
/// @throws Failure without an OpenGL context
Picture frontChart(const std::vector<StudySummary>& summaries, bool soft, Motion motion);

/// Return the most wrong place of each variant over all cases, beside the truth.
/// @param variants in order of priority
/// @param most largest number of places
std::string worstPlaces(
  const std::vector<StudyRow>& rows, const std::vector<StudySummary>& variants, std::size_t most);
///@}

} // namespace gnomon::tool
