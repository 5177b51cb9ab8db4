#pragma once

#include "ComparisonRun.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon::tool
{

/// A variant in a case (a scene from a view), or its mean over cases: a row of a study's table,
/// with the table's columns as members. `place` describes its most wrong place: `of`, the case and
/// its error, and the pictures `truth` and `technique` as data URIs. Without timed frames it has no
/// times; a variant that is right everywhere has no place.
using Row = nlohmann::ordered_json;
using Rows = std::vector<Row>;

/// Return a row's error: the RMS error of soft shadows, the wrong share of hard shadows.
double errorOf(const Row& row);

/// Return a comparison's rows.
/// @param view the scene's view, from 1; 0: its own
Rows rowsOf(const ComparisonResults& results, int view = 0);

/// Return the means of the variants that have a row in every case: of errors, and geometric means
/// of multiples of plain VTK's times. The place is the worst case's.
/// @param rows only of hard shadows, or only of soft shadows
Rows meansOf(const Rows& rows);

/// Return the Pareto front, in order of time: the rows that no other one beats. A row beats another
/// if it is faster and no more wrong, or less wrong and no slower. Errors count as equal up to 2 %.
/// @param time name of the times' column
Rows frontOf(Rows rows, const std::string& time);

/// Return the data of a chart (Chart.svg) of error over time, both logarithmic. The front is
/// coloured, joined and labelled. Other rows are grey points.
/// @param rows only of hard shadows, or only of soft shadows; at least one
nlohmann::ordered_json chartOf(const Rows& rows, Motion motion);

/// Return a line of a CSV file as in RFC 4180; null is an empty cell.
std::string csvLine(const std::vector<nlohmann::ordered_json>& cells);

/// Return rows with equal members as a table; members with a structure are left out.
std::string csvOf(const Rows& rows);

/// Return the table of a comparison, with a row per variant. Cells that do not apply to a variant
/// are empty.
/// @param results as ComparisonResults::json
std::string csvOf(const nlohmann::ordered_json& results);

/// Return a number with at most nine significant digits.
std::string shortNumber(double value);
/// Return a number with three significant digits, without exponent; "-" for a number that is not
/// finite.
std::string threeDigits(double value);

/// Return the page of a comparison: one HTML file, also well-formed XML, that needs neither a
/// network nor other files.
std::string pageOf(const ComparisonResults& results);

/// Return the page of a study, as one file, too.
/// @param machine description of the machine that was measured
std::string pageOf(const Rows& rows, const std::string& machine);

/// Create the folder of a report if it is missing. Fail early if the report cannot be written
/// there.
/// @param file name of the report
/// @throws BadInput
void prepareReportFolder(const std::string& folder, const std::string& file = "report.html");

/// Write a report into a folder: results.csv, results.json, report.html, and chart.svg if frames
/// were timed. Each variant has its picture and errors (<variant>.png, <variant>-errors.png), and
/// its pixel classes if it has any (<variant>-classes.png).
/// @throws BadInput if the folder cannot be created, Failure if writing fails
void writeReport(const ComparisonResults& results, const std::string& folder);

} // namespace gnomon::tool
