#include "Commands.h"
#include "Errors.h"
#include "Text.h"

#include <vtkVersion.h>

#include <exception>
#include <iostream>

namespace
{

constexpr int failed = 1;

int report(const char* what, int exitCode)
{
  std::cerr << "gnomon: error: " << gnomon::tool::oneLine(what) << "\n";
  return exitCode;
}

/// Run the command of the command line. Return the exit code.
int run(int argc, char** argv)
{
  CLI::App app{ "Shadows for VTK scenes, from fast to exact", "gnomon" };
  app.require_subcommand(0, 1);
  app.set_version_flag(
    "--version", std::string("gnomon " GNOMON_VERSION ", VTK ") + vtkVersion::GetVTKVersion());
  gnomon::tool::addRenderCommand(app);
  gnomon::tool::addViewCommand(app);
  gnomon::tool::addCompareCommand(app);
  gnomon::tool::addStudyCommand(app);
  gnomon::tool::addDiffCommand(app);
  gnomon::tool::addTechniquesCommand(app);
  gnomon::tool::addCalibrateCommand(app);
  gnomon::tool::addSettingsCommand(app);
  gnomon::tool::addScenesCommand(app);

  try
  {
    app.parse(argc, argv);
    if (app.get_subcommands().empty())
    {
      throw gnomon::tool::BadInput("no subcommand, expected one; gnomon --help lists them");
    }
    return 0;
  }
  catch (const CLI::ParseError& error)
  {
    const bool wasAsked = error.get_exit_code() == 0; // the user asked for help or the version
    return wasAsked ? app.exit(error) : report(error.what(), gnomon::tool::badInputCode);
  }
  catch (const gnomon::tool::BadInput& error)
  {
    return report(error.what(), gnomon::tool::badInputCode);
  }
  catch (const std::exception& error)
  {
    return report(error.what(), failed);
  }
}

} // namespace

int main(int argc, char** argv)
{
  const int code = run(argc, argv);
  return code == 0 && !std::cout.flush()
    ? report("standard output: writing failed, the device may be full", failed)
    : code;
}
