// Draw the hard cases with all techniques and judge them by the bounds of Matrix.h.

#include "Matrix.h"

#include "BenchmarkMain.h"
#include "Errors.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::hard
{
namespace
{

struct Options
{
  std::string folder;
  std::string known;
  std::optional<unsigned> tenth; ///< seed of the choice of a tenth of the cells
  bool butTenth = false;
  std::size_t part = 0;
  std::size_t parts = 1;
  std::string only;
  bool easy = false;
};

/// FNV-1a hash: the same on all machines.
unsigned hashOf(const std::string& text)
{
  unsigned hash = 2166136261u;
  for (const char letter : text)
  {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  }
  return hash >> 8;
}

/// Return which of ten parts a cell belongs to.
unsigned tenthOf(const Row& row, const Column& column, unsigned seed)
{
  return hashOf(row.name + column.name + std::to_string(seed)) % 10u;
}

std::vector<const Column*> chosenColumns(const Options& options, const Row& row)
{
  std::vector<const Column*> chosen;
  for (const Column& column : columns())
  {
    const bool isInTenth = options.tenth && tenthOf(row, column, *options.tenth) == 0;
    const bool isChosen = options.tenth ? isInTenth != options.butTenth : true;
    if (isChosen && (options.only.empty() || column.name == options.only))
    {
      chosen.push_back(&column);
    }
  }
  return chosen;
}

template <typename Named>
std::vector<std::string> namesOf(const std::vector<Named>& all)
{
  std::vector<std::string> names;
  for (const Named& one : all)
  {
    names.push_back(one.name);
  }
  return names;
}

int run(int argc, char** argv)
{
  CLI::App app{ "Draws the numerical hard cases of the literature with all techniques and judges "
                "them",
    "gnomon_hard_cases" };
  Options options;
  std::vector<std::string> names;
  app.add_option("ROW", names, "Scenes and movements; without them all")
    ->check(CLI::IsMember(namesOf(rows())));
  app.add_option("--technique", options.only, "One column alone")
    ->check(CLI::IsMember(namesOf(columns())));
  app
    .add_option("--known", options.known,
      "A table of cells that are known to be broken: any other broken cell is an error, and so is "
      "one of these that is fixed")
    ->check(CLI::ExistingFile);
  app.add_option("-o", options.folder, "The folder for hard_cases.csv");
  CLI::Option* const tenth =
    app.add_option("--tenth", options.tenth, "Draw a tenth of the cells, chosen by this seed");
  app.add_option("--part", options.part, "Of --parts, draw rows of this number, from 0");
  app.add_option("--parts", options.parts, "Parts that the rows are divided into")
    ->check(CLI::PositiveNumber);
  app.add_flag("--others", options.butTenth, "Draw all cells but those of the tenth")->needs(tenth);
  app.add_flag(
    "--easy", options.easy, "Print the errors of soft techniques on easy scenes instead");
  CLI11_PARSE(app, argc, argv);
  if (options.part >= options.parts)
  {
    throw tool::BadInput("--part: found " + std::to_string(options.part) + ", expected less than " +
      std::to_string(options.parts));
  }
  const KnownCells known = options.known.empty() ? KnownCells() : readKnownCells(options.known);

  if (options.easy)
  {
    for (const Column& column : columns())
    {
      if (column.kind == Kind::Soft)
      {
        std::cout << column.name << " " << easyError(column) << std::endl;
      }
    }
    return 0;
  }

  std::vector<Cell> cells;
  for (const Row& row : rows())
  {
    const bool isNamed =
      names.empty() || std::find(names.begin(), names.end(), row.name) != names.end();
    const auto number = static_cast<std::size_t>(&row - rows().data());
    if (isNamed && number % options.parts == options.part)
    {
      for (const Cell& cell : drawRow(row, chosenColumns(options, row)))
      {
        cells.push_back(cell);
        std::cout << csvLine(cell) << std::flush;
      }
    }
  }
  if (!options.folder.empty())
  {
    writeTable(options.folder, cells);
  }
  const std::vector<std::string> surprises = surprisesIn(cells, known);
  for (const std::string& surprise : surprises)
  {
    std::cerr << surprise << "\n";
  }
  return surprises.empty() ? 0 : 1;
}

} // namespace
} // namespace gnomon::hard

int main(int argc, char** argv)
{
  return gnomon::tool::runBenchmark(
    "gnomon_hard_cases", [&] { return gnomon::hard::run(argc, argv); });
}
