#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::tool
{

///@{
/// Add one subcommand. The subcommand's callback does the work while the command line is parsed,
/// and throws BadInput or Failure.
void addCalibrateCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);
void addDiffCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addTechniquesCommand(CLI::App& app);
void addScenesCommand(CLI::App& app);
void addSettingsCommand(CLI::App& app);
void addStudyCommand(CLI::App& app);
void addViewCommand(CLI::App& app);
///@}

/// Add an option whose help shows its default.
template <typename Value>
CLI::Option* addOption(
  CLI::App& command, const char* name, Value& value, const std::string& meaning)
{
  return command.add_option(name, value, meaning)->capture_default_str();
}

/// Refuse an option together with others of its command, but for one.
inline void excludeOthers(CLI::App& command, CLI::Option* option, const CLI::Option* but)
{
  for (CLI::Option* const other : command.get_options())
  {
    if (other != option && other != but && other->nonpositional())
    {
      option->excludes(other);
    }
  }
}

inline constexpr int largestSidePixels = 16384;

/// A window's size in pixels, on the command line WIDTHxHEIGHT, each from 1 to largestSidePixels.
struct PictureSize
{
  int width = 1024;
  int height = 1024;

  double aspect() const { return static_cast<double>(this->width) / this->height; }
};

/// Parse a size.
/// @throws BadInput
PictureSize parseSize(const std::string& text);

/// Refuse pictures that exceed an OpenGL context's limits.
/// @throws BadInput
void requireDrawable(const PictureSize& size, int mostTexels, int mostColumns, int mostRows);

} // namespace gnomon::tool
