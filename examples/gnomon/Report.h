#pragma once

#include "Comparison.h"

#include <string>

namespace gnomon::tool
{

/// Return a table with one row per variant: text as in RFC 4180, shares as fractions, times in
/// milliseconds, memory in bytes. Cells that do not apply to a variant are empty.
std::string toCsv(const ComparisonResults& results);

/// Return the data of toCsv() as JSON, with lights, settings, stages and notes in their own
/// structure.
std::string toJson(const ComparisonResults& results);

/// Return the report for users: one HTML file, also well-formed XML, that needs neither a network
/// nor other files.
/// @param chart chart of error against time (ReportChart.h); without pixels if nothing was timed
std::string toHtml(const ComparisonResults& results, const Picture& chart);

/// Return a variant's name for file names: "nsm 1024 inline" becomes "nsm-1024-inline".
std::string fileStem(const std::string& variantName);

/// Create the folder of a report if it is missing. Fail early if the report cannot be written
/// there.
/// @param file name of the report
/// @throws BadInput
void prepareReportFolder(const std::string& folder, const std::string& file = "report.html");

/// Write a report into a folder: results.csv, results.json, report.html, and chart.png if frames
/// were timed. Each variant has its picture and errors (<variant>.png, <variant>-errors.png), and
/// its pixel classes if it has any (<variant>-classes.png).
/// @throws BadInput if the folder cannot be created, Failure if writing fails
void writeReport(const ComparisonResults& results, const std::string& folder);

} // namespace gnomon::tool
