#include "Commands.h"
#include "Errors.h"
#include "Files.h"
#include "ImageDifference.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

namespace gnomon::tool
{
namespace
{

struct DiffOptions
{
  std::string fileA;
  std::string fileB;
  double maxDifference = 0.0;
  std::int64_t maxPixels = 0;
  std::string output;
};

void diff(const DiffOptions& options)
{
  if (!(options.maxDifference >= 0.0)) // NaN included
  {
    throw BadInput("--max-difference: is not a number, expected a number >= 0");
  }
  if ((lowerExtension(options.fileA) == ".exr") != (lowerExtension(options.fileB) == ".exr"))
  {
    throw BadInput("the formats differ: " + options.fileA + " and " + options.fileB +
      " have different units, expected two .png or two .exr files");
  }
  const ChannelImage a = readComparable(options.fileA);
  const ChannelImage b = readComparable(options.fileB);
  const ImageDifference difference =
    compareImages(a, options.fileA, b, options.fileB, options.maxDifference);
  std::cout << describe(difference, options.maxDifference) << std::endl;
  if (!options.output.empty())
  {
    writePicture(differencePicture(difference, options.maxDifference), options.output);
  }
  if (difference.differingPixels > options.maxPixels)
  {
    throw Failure("images differ: " + std::to_string(difference.differingPixels) +
      " pixels, at most " + std::to_string(options.maxPixels) + " are allowed");
  }
}

} // namespace

//------------------------------------------------------------------------------
void addDiffCommand(CLI::App& app)
{
  CLI::App* const command =
    app.add_subcommand("diff", "Compare two images, pixel by pixel, with a tolerance");
  const auto options = std::make_shared<DiffOptions>();
  command->add_option("A", options->fileA, "Image: .png, or .exr with any channels")->required();
  command->add_option("B", options->fileB, "Image of the same size and channels")->required();
  command
    ->add_option("--max-difference", options->maxDifference,
      "A pixel differs when a channel differs by more than this: in steps of 8 bits for .png, in "
      "the "
      "channel's own unit for .exr; NaN always differs")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command
    ->add_option("--max-pixels", options->maxPixels, "Largest number of pixels that may differ")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command->add_option("-o,--output", options->output,
    "Write a picture of the differences: black for equal, grey within the tolerance, orange to "
    "yellow beyond it, magenta for NaN");
  command->footer("Exit code: 0 if at most --max-pixels pixels differ, 1 if more do.");
  command->callback([options] { diff(*options); });
}

} // namespace gnomon::tool
