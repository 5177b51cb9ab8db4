#include "MatrixPage.h"

#include "CsvRow.h"
#include "Errors.h"
#include "Files.h"
#include "BuiltinScenes.h"
#include "Html.h"
#include "Text.h"

#include "lights/SettingsTable.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <sstream>

namespace gnomon::hard
{
namespace
{

constexpr std::size_t largestTableBytes = 1 << 20;

/// The name and colour of an outcome.
struct Look
{
  const char* name;
  const char* colour;
};

Look lookOf(Outcome outcome)
{
  static const std::map<Outcome, Look> looks = { { Outcome::Kept, { "kept", "#5aa864" } },
    { Outcome::Broken, { "broken", "#d03b3b" } }, { Outcome::Refused, { "refused", "#c9c9c9" } },
    { Outcome::None, { "none", "#f0f0f0" } } };
  return looks.at(outcome);
}

/// Return a cell's result as text.
std::string findingOf(const Cell& cell)
{
  std::string text = cell.row->name + ", " + cell.column->name + ": " + lookOf(cell.outcome).name;
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

/// Write the picture: rows of coloured cells, with each cell's result as its title.
std::string svgOf(const std::vector<Cell>& cells)
{
  constexpr int left = 190;
  constexpr int top = 96;
  constexpr int side = 16;
  constexpr int right = 420;
  const int width = left + side * static_cast<int>(columns().size()) + right;
  const int height = top + side * static_cast<int>(rows().size()) + 12;
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << " " << height
      << "\" width=\"" << width << "\" height=\"" << height
      << "\" font-family=\"sans-serif\" font-size=\"11\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (std::size_t i = 0; i < columns().size(); ++i)
  {
    svg << "<text transform=\"translate(" << left + side * static_cast<int>(i) + 11 << ","
        << top - 6 << ") rotate(-50)\">" << tool::escape(columns()[i].name) << "</text>\n";
  }
  for (std::size_t i = 0; i < rows().size(); ++i)
  {
    svg << "<text x=\"" << left - 6 << "\" y=\"" << top + side * static_cast<int>(i) + 12
        << "\" text-anchor=\"end\">" << tool::escape(rows()[i].name) << "</text>\n<text x=\""
        << width - right + 6 << "\" y=\"" << top + side * static_cast<int>(i) + 12
        << "\" font-size=\"9\">" << tool::escape(listOf(rows()[i].cases)) << "</text>\n";
  }
  for (const Cell& cell : cells)
  {
    svg << "<rect x=\"" << left + side * static_cast<int>(cell.column - columns().data())
        << "\" y=\"" << top + side * static_cast<int>(cell.row - rows().data()) << "\" width=\""
        << side - 1 << "\" height=\"" << side - 1 << "\" fill=\"" << lookOf(cell.outcome).colour
        << "\"><title>" << tool::escape(findingOf(cell)) << "</title></rect>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

std::string pageOf(const std::vector<Cell>& cells, const KnownCells& known)
{
  const auto count = [&](Outcome outcome)
  {
    return std::to_string(std::count_if(
      cells.begin(), cells.end(), [outcome](const Cell& cell) { return cell.outcome == outcome; }));
  };
  std::set<std::string> cases;
  for (const Row& row : rows())
  {
    cases.insert(row.cases.begin(), row.cases.end());
  }
  for (const tool::HardCaseElsewhere& elsewhere : tool::hardCasesElsewhere())
  {
    cases.insert(elsewhere.hardCase);
  }
  std::ostringstream page;
  page
    << "# Hard cases\n\n"
    << "The literature names " << cases.size() << " cases in which shadow techniques break. "
    << rows().size() << " scenes and\nmovements stand for them (`gnomon scenes --hard`). "
    << "Green: a technique keeps its bound (" << count(Outcome::Kept)
    << "\ncells). Red: it does not (" << count(Outcome::Broken)
    << "). Grey: it refuses such a light, and says so (" << count(Outcome::Refused)
    << ").\nLight grey: it has no part in this (" << count(Outcome::None)
    << "). `tests/lab/pages/hard_cases.sh` makes this page, its picture and\n"
    << "[its table](hard_cases.csv).\n\n"
    << "![Hard cases by techniques](hard_cases.svg)\n\n"
    << "## Bounds\n\n"
    << "All numbers are finite and in [0, 1], and neither OpenGL nor VTK reports an error. "
    << "Pictures have\n"
    << bounds::width << " x " << bounds::height << " pixels, maps " << bounds::mapSizeTexels
    << " x " << bounds::mapSizeTexels
    << " texels. The bounds were fixed before the run\n(tests/lab/hard/Bounds.h).\n\n"
    << "| | bound |\n|---|---|\n"
    << "| `raytraced` | agrees with the independent check |\n"
    << "| its offset, halved or doubled | the truth changes within " << bounds::truthEdgePixels
    << " pixels of a shadow's edge alone |\n"
    << "| exact techniques | no pixel differs from `raytraced`; `penumbra`'s from as many rays |\n"
    << "| maps | wrong pixels lie within " << bounds::edgeTexels
    << " texels of a shadow's edge; `planar`'s count on the floor alone |\n"
    << "| soft shadows | mean absolute error at most " << bounds::softFactor
    << " times that on easy scenes, " << bounds::truthSamples << " rays being the truth |\n"
    << "| movements | edges turn right or wrong at most " << bounds::flickerFactor
    << " times as often as `nsm`'s under a turning light; exact ones never |\n\n"
    << "## Red cells\n\n| case | technique | beyond the bound | why |\n|---|---|---|---|\n";
  for (const Cell& cell : cells)
  {
    if (cell.outcome == Outcome::Broken)
    {
      const auto reason = known.find({ cell.row->name, cell.column->name });
      page << "| " << cell.row->name << " | `" << cell.column->name << "` | "
           << (cell.beyond > 0 ? std::to_string(cell.beyond) + " pixels"
                  : cell.bound > 0.0
                  ? tool::threeDigits(cell.error) + " for " + tool::threeDigits(cell.bound)
                  : cell.message)
           << " | " << (reason == known.end() ? "" : reason->second) << " |\n";
    }
  }
  page << "\n## Cases without a scene\n\n| case | held by |\n|---|---|\n";
  for (const tool::HardCaseElsewhere& elsewhere : tool::hardCasesElsewhere())
  {
    page << "| " << elsewhere.hardCase << " | " << elsewhere.where << " |\n";
  }
  return page.str();
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
  tool::CsvRow line;
  line << cell.row->name << cell.column->name << std::string(lookOf(cell.outcome).name)
       << cell.counted << cell.wrong << cell.beyond << cell.error << cell.bound
       << tool::oneLine(cell.message);
  return line.line();
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
void writePage(const std::string& folder, const std::vector<Cell>& cells, const KnownCells& known)
{
  std::string csv = csvHeading();
  for (const Cell& cell : cells)
  {
    csv += csvLine(cell);
  }
  tool::writeWholeFile(folder + "/hard_cases.csv", csv);
  tool::writeWholeFile(folder + "/hard_cases.svg", svgOf(cells));
  tool::writeWholeFile(folder + "/hard_cases.md", pageOf(cells, known));
}

} // namespace gnomon::hard
