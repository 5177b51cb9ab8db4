#pragma once

#include "Matrix.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::hard
{

/// Return a cell as a line of a CSV table; return the table's first line.
std::string csvLine(const Cell& cell);
std::string csvHeading();

/// Cells that are known to be broken, by row and column, with the reason.
using KnownCells = std::map<std::pair<std::string, std::string>, std::string>;
/// Read lines of row, column and reason, separated by tabs; "#" begins a comment.
/// @throws tool::BadInput naming the file and the line
KnownCells readKnownCells(const std::string& path);

/// Return one sentence for each broken cell that is not known to be, and for each known one that is
/// not broken.
std::vector<std::string> surprisesIn(const std::vector<Cell>& cells, const KnownCells& known);

/// Write hard_cases.csv into a folder.
/// @throws tool::Failure
void writeTable(const std::string& folder, const std::vector<Cell>& cells);

} // namespace gnomon::hard
