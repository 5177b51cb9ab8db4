// Run random cases: gnomon_fuzz scenes|sequences|files. Repeat earlier finds: gnomon_fuzz replay.

#include "Runner.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{

using namespace gnomon::fuzz;

constexpr int foundSomething = 1;
constexpr int failed = 2;

const CaseKind& kindOf(const std::string& name)
{
  for (const CaseKind& kind : caseKinds())
  {
    if (kind.name == name)
    {
      return kind;
    }
  }
  throw std::runtime_error("there is no kind \"" + name + "\"");
}

/// Run a list of finds: a line each, with kind, seed, index and error. Lines that begin with # are
/// comments.
unsigned replay(const std::string& path)
{
  std::ifstream file(path);
  unsigned finds = 0;
  unsigned lines = 0;
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    std::istringstream words(line);
    std::string kind;
    Run one;
    one.count = 1;
    if (!(words >> kind >> one.first.seed >> one.first.index))
    {
      throw std::runtime_error(path + ": \"" + line + "\" is not a find");
    }
    finds += run(kindOf(kind), one);
    ++lines;
  }
  if (!file.eof())
  {
    throw std::runtime_error(path + " cannot be read");
  }
  std::cout << lines << " replayed\n";
  return finds;
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app{ "Random scenes, sequences of changes and broken files for Gnomon", "gnomon_fuzz" };
  app.require_subcommand(1);
  Run run;
  for (const CaseKind& kind : caseKinds())
  {
    CLI::App* const command = app.add_subcommand(kind.name, kind.meaning);
    command->add_option("--seed", run.first.seed, "seed of the cases")->capture_default_str();
    command->add_option("--first", run.first.index, "the first case's number in it");
    command->add_option("--count", run.count, "how many cases")->capture_default_str();
    command->add_option("--seconds", run.seconds, "no case starts later");
    command->add_option("--seconds-per-case", run.secondsPerCase, "a longer case counts as hanging")
      ->capture_default_str();
    command->add_option("-o", run.folder, "folder for finds, a file each");
  }
  std::string list;
  CLI::App* const again = app.add_subcommand("replay", "the cases of a list of finds");
  again->add_option("list", list)->required()->check(CLI::ExistingFile);

  try
  {
    app.parse(argc, argv);
    const unsigned finds = again->parsed()
      ? replay(list)
      : gnomon::fuzz::run(kindOf(app.get_subcommands().front()->get_name()), run);
    return finds > 0 ? foundSomething : 0;
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error);
  }
  catch (const std::exception& error)
  {
    std::cerr << "gnomon_fuzz: error: " << error.what() << "\n";
    return failed;
  }
}
