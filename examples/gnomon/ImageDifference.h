#pragma once

#include "ImageFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// Where and how much two images of the same size and channels differ.
struct ImageDifference
{
  int width = 0;
  int height = 0;
  std::int64_t differingPixels = 0;
  /// The largest difference of any channel of any pixel; NaN where one of the two values is NaN.
  double largest = 0.0;
  int largestX = 0; ///< column of the largest difference
  int largestY = 0; ///< its row, 0 on top
  std::string largestChannel;
  /// Per pixel, the largest difference over the channels.
  std::vector<float> perPixel;
};

/// An image for comparison: the channels of an .exr as they are, or of a .png as R, G and B in
/// [0, 255].
/// @throws BadInput
ChannelImage readComparable(const std::string& path);

/// Compares channel by channel. A pixel differs when any of its channels differs by more than
/// `maxDifference`; NaN differs from everything, itself included.
/// @param nameA, nameB how errors call the images
/// @throws BadInput when the sizes or the channels' names differ
ImageDifference compareImages(const ChannelImage& a, const std::string& nameA,
  const ChannelImage& b, const std::string& nameB, double maxDifference);

/// One sentence: how many pixels differ by more than `maxDifference`, the largest difference and
/// where it is.
std::string describe(const ImageDifference& difference, double maxDifference);

/// A picture for people: equal pixels black, differences within the tolerance grey, larger ones
/// from orange to yellow, NaN magenta.
Picture differencePicture(const ImageDifference& difference, double maxDifference);

} // namespace gnomon::tool
