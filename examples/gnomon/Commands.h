#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::tool
{

///@{
/// Each adds one subcommand. Its work runs while the command line is parsed, in the subcommand's
/// callback, and throws BadInput or Failure.
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

inline constexpr int largestSidePixels = 16384;

/// A window's size as the command line says it: WIDTHxHEIGHT, each from 1 to largestSidePixels.
struct PictureSize
{
  int width = 1024;
  int height = 1024;

  double aspect() const { return static_cast<double>(this->width) / this->height; }
};

/// @throws BadInput
PictureSize parseSize(const std::string& text);

/// Refuses pictures that are larger than an OpenGL context's limits.
/// @throws BadInput
void requireDrawable(const PictureSize& size, int mostTexels, int mostColumns, int mostRows);

} // namespace gnomon::tool
