#pragma once

#include "Comparison.h"

#include <string>

namespace gnomon::tool
{

/// A table with one row per variant: text as in RFC 4180, shares as fractions, times in
/// milliseconds, memory in bytes. Cells that mean nothing for a variant are empty.
std::string toCsv(const ComparisonResults& results);

/// The same as toCsv, with lights, settings, stages and notes in their own structure.
std::string toJson(const ComparisonResults& results);

/// The report for people: one HTML file that needs neither a network nor other files; it is
/// well-formed XML too.
/// @param chart the chart of error against time (ReportChart.h); without pixels: nothing was timed
std::string toHtml(const ComparisonResults& results, const Picture& chart);

/// The name of a variant in file names: "nsm 1024 inline" becomes "nsm-1024-inline".
std::string fileStem(const std::string& variantName);

/// Fails early when a report cannot be written there; makes the folder if need be.
/// @param file of the report
/// @throws BadInput
void prepareReportFolder(const std::string& folder, const std::string& file = "report.html");

/// Writes results.csv, results.json, report.html, chart.png (if frames were timed), and for each
/// variant its picture and its errors (<variant>.png, <variant>-errors.png), and where it tells its
/// pixels' classes those (<variant>-classes.png), into the folder.
/// @throws BadInput when the folder cannot be made, Failure when writing fails
void writeReport(const ComparisonResults& results, const std::string& folder);

} // namespace gnomon::tool
