#pragma once

#include "Matrix.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::hard
{

/// A cell as a line of a CSV table, and the table's first line.
std::string csvLine(const Cell& cell);
std::string csvHeading();

/// Cells that are known to be broken, by row and column, with the reason.
using KnownCells = std::map<std::pair<std::string, std::string>, std::string>;
/// Reads lines of row, column and reason, separated by tabs; "#" begins a comment.
/// @throws tool::BadInput that names the file and the line
KnownCells readKnownCells(const std::string& path);

/// One sentence for each cell that is broken and not known to be, or the other way round.
std::vector<std::string> surprisesIn(const std::vector<Cell>& cells, const KnownCells& known);

/// Writes hard_cases.csv, hard_cases.svg and hard_cases.md into a folder.
/// @throws tool::Failure
void writePage(const std::string& folder, const std::vector<Cell>& cells, const KnownCells& known);

} // namespace gnomon::hard
