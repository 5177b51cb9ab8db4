#include "Commands.h"
#include "Errors.h"
#include "Files.h"
#include "ImageDifference.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

namespace gnomon::tool
{
namespace
{

/// Read the channels of an .exr unchanged, or of a .png as R, G and B in [0, 255].
ChannelImage readComparable(const std::string& path)
{
  return lowerExtension(path) == ".exr" ? readChannels(path) : channelsOf(readPicture(path), 1.0f);
}

/// Return an image's size and channels: "10 x 5 pixels with R, G, B".
std::string shapeOf(const ChannelImage& image)
{
  std::string names;
  for (const auto& [name, plane] : image.channels)
  {
    names += (names.empty() ? "" : ", ") + name;
  }
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels with " +
    (names.empty() ? "no channel" : names);
}

/// True if a is larger than b. NaN counts as larger than any number.
bool larger(double a, double b)
{
  return a > b || (std::isnan(a) && !std::isnan(b));
}

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
  const ImageDifference difference = compareImages(readComparable(options.fileA), options.fileA,
    readComparable(options.fileB), options.fileB, options.maxDifference);
  std::cout << difference.text << std::endl;
  if (!options.output.empty())
  {
    writePicture(difference.picture, options.output);
  }
  if (difference.differingPixels > options.maxPixels)
  {
    throw Failure("images differ: " + std::to_string(difference.differingPixels) +
      " pixels, at most " + std::to_string(options.maxPixels) + " are allowed");
  }
}

} // namespace

ImageDifference compareImages(const ChannelImage& a, const std::string& nameA,
  const ChannelImage& b, const std::string& nameB, double maxDifference)
{
  if (shapeOf(a) != shapeOf(b))
  {
    throw BadInput("the sizes or channels differ: " + nameA + " has " + shapeOf(a) + "; " + nameB +
      " has " + shapeOf(b));
  }
  ImageDifference result;
  result.picture.width = a.width;
  result.picture.height = a.height;
  std::vector<float> ofPixels(result.picture.pixelCount(), 0.0f);
  float brightest = 0.0f; // the largest finite difference, shown as yellow
  float largest = 0.0f;
  std::size_t largestPixel = 0;
  std::string largestChannel;
  for (const auto& [name, planeA] : a.channels)
  {
    const std::vector<float>& planeB = b.channels.at(name);
    for (std::size_t i = 0; i < planeA.size(); ++i)
    {
      // Infinities may be equal.
      const float d = planeA[i] == planeB[i] ? 0.0f : std::fabs(planeA[i] - planeB[i]);
      ofPixels[i] = larger(d, ofPixels[i]) ? d : ofPixels[i];
      brightest = std::isfinite(d) ? std::max(brightest, d) : brightest;
      if (larger(d, largest))
      {
        largest = d;
        largestPixel = i;
        largestChannel = name;
      }
    }
  }
  for (const float d : ofPixels)
  {
    const bool differs = larger(d, maxDifference);
    result.differingPixels += differs;
    const float share = std::isfinite(d) && differs ? d / brightest : 1.0f;
    const unsigned char grey = d > 0.0f ? 80 : 0;
    const auto green = static_cast<unsigned char>(80.0f + 175.0f * share);
    const std::array<unsigned char, 3> colour = std::isnan(d)
      ? std::array<unsigned char, 3>{ 255, 0, 255 }
      : differs ? std::array<unsigned char, 3>{ 255, green, 0 }
                : std::array<unsigned char, 3>{ grey, grey, grey };
    result.picture.rgb.insert(result.picture.rgb.end(), colour.begin(), colour.end());
  }
  std::ostringstream text;
  text << result.differingPixels << " of " << ofPixels.size() << " pixels differ by more than "
       << maxDifference << "; largest difference " << largest;
  if (!largestChannel.empty())
  {
    const auto columns = static_cast<std::size_t>(a.width);
    text << " in channel " << largestChannel << " at pixel (" << largestPixel % columns << ", "
         << largestPixel / columns << "), counted from the top left";
  }
  result.text = text.str();
  return result;
}

void addDiffCommand(CLI::App& app)
{
  CLI::App* const command =
    app.add_subcommand("diff", "Compare two images, pixel by pixel, with a tolerance");
  const auto options = std::make_shared<DiffOptions>();
  command->add_option("A", options->fileA, "Image: .png, or .exr with any channels")->required();
  command->add_option("B", options->fileB, "Image of the same size and channels")->required();
  addOption(*command, "--max-difference", options->maxDifference,
    "A pixel differs when a channel differs by more than this: in steps of 8 bits for .png, in "
    "the channel's own unit for .exr; NaN always differs")
    ->check(CLI::NonNegativeNumber);
  addOption(
    *command, "--max-pixels", options->maxPixels, "Largest number of pixels that may differ")
    ->check(CLI::NonNegativeNumber);
  command->add_option("-o,--output", options->output,
    "Write a picture of the differences: black for equal, grey within the tolerance, orange to "
    "yellow beyond it, magenta for NaN");
  command->footer("Exit code: 0 if at most --max-pixels pixels differ, 1 if more do.");
  command->callback([options] { diff(*options); });
}

} // namespace gnomon::tool
