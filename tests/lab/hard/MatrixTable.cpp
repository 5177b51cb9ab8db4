#include "MatrixTable.h"

#include "BuiltinScenes.h"
#include "Errors.h"
#include "Files.h"
#include "Report.h"
#include "Text.h"

#include "lights/SettingsTable.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <map>

namespace gnomon::hard
{
namespace
{

constexpr std::size_t largestTableBytes = 1 << 20;

const char* nameOf(Outcome outcome)
{
  static const std::map<Outcome, const char*> names = { { Outcome::Kept, "kept" },
    { Outcome::Broken, "broken" }, { Outcome::Refused, "refused" }, { Outcome::None, "none" } };
  return names.at(outcome);
}

/// Return a cell's result as text.
std::string findingOf(const Cell& cell)
{
  std::string text = cell.row->name + ", " + cell.column->name + ": " + nameOf(cell.outcome);
  if (cell.counted > 0)
  {
    text += "; " + std::to_string(cell.wrong) + " of " + std::to_string(cell.counted) +
      " pixels wrong, " + std::to_string(cell.beyond) + " beyond the bound";
  }
  if (cell.bound > 0.0 || cell.error > 0.0)
  {
    text += "; error " + tool::threeDigits(cell.error) + ", bound " + tool::threeDigits(cell.bound);
  }
  return text + (cell.message.empty() ? "" : "; " + cell.message);
}

} // namespace

//------------------------------------------------------------------------------
std::string csvHeading()
{
  return "case,technique,outcome,counted,wrong,beyond,error,bound,message\r\n";
}

//------------------------------------------------------------------------------
std::string csvLine(const Cell& cell)
{
  return tool::csvLine({ cell.row->name, cell.column->name, nameOf(cell.outcome), cell.counted,
    cell.wrong, cell.beyond, cell.error, cell.bound, tool::oneLine(cell.message) });
}

//------------------------------------------------------------------------------
KnownCells readKnownCells(const std::string& path)
{
  KnownCells known;
  const std::vector<std::string> lines =
    tool::split(tool::readWholeFile(path, largestTableBytes), '\n');
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    if (lines[i].empty() || lines[i][0] == '#')
    {
      continue;
    }
    const std::vector<std::string> parts = tool::split(lines[i], '\t');
    const auto isNamed = [](const auto& all, const std::string& name) {
      return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
    };
    if (parts.size() != 3 || !isNamed(rows(), parts[0]) || !isNamed(columns(), parts[1]))
    {
      throw tool::BadInput(path + ", line " + std::to_string(i + 1) +
        ": a row, a column and a reason are expected, separated by tabs");
    }
    known[{ parts[0], parts[1] }] = parts[2];
  }
  return known;
}

//------------------------------------------------------------------------------
std::vector<std::string> surprisesIn(const std::vector<Cell>& cells, const KnownCells& known)
{
  std::vector<std::string> surprises;
  for (const Cell& cell : cells)
  {
    const bool isKnown = known.count({ cell.row->name, cell.column->name }) > 0;
    if (isKnown != (cell.outcome == Outcome::Broken))
    {
      surprises.push_back((isKnown ? "no more broken: " : "broken: ") + findingOf(cell));
    }
  }
  return surprises;
}

//------------------------------------------------------------------------------
void writeTable(const std::string& folder, const std::vector<Cell>& cells)
{
  std::string csv = csvHeading();
  for (const Cell& cell : cells)
  {
    csv += csvLine(cell);
  }
  tool::writeWholeFile(folder + "/hard_cases.csv", csv);
}

} // namespace gnomon::hard
