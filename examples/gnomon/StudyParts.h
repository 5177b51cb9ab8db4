#pragma once

#include "StudyRows.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::tool
{

///@{
/// What pages say of variants that are all of hard shadows, or all of soft ones. Text is HTML.

/// The variants that no other one beats in error and time, in order of time.
std::vector<StudySummary> frontOf(const std::vector<StudySummary>& summaries, Motion motion);

/// What to use when, in one sentence or two.
std::string conclusionOf(const std::vector<StudySummary>& summaries, bool soft);

/// The front with the camera moving.
/// @param most rows, of which the most accurate stay
std::string frontTable(const std::vector<StudySummary>& summaries, bool soft, std::size_t most);

/// Error over time.
/// @throws Failure when no OpenGL context can be made
Picture frontChart(const std::vector<StudySummary>& summaries, bool soft, Motion motion);

/// Where variants are most wrong, each in the case where it is: the truth beside it.
/// @param variants of which the first come first
/// @param most places
std::string worstPlaces(
  const std::vector<StudyRow>& rows, const std::vector<StudySummary>& variants, std::size_t most);
///@}

} // namespace gnomon::tool
