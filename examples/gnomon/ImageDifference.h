#pragma once

#include "ImageFile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::tool
{

/// The differences of two images with the same size and channels.
struct ImageDifference
{
  int width = 0;
  int height = 0;
  std::int64_t differingPixels = 0;
  /// The largest difference over all channels and pixels; NaN if a value of one image is NaN.
  double largest = 0.0;
  int largestX = 0; ///< column of the largest difference
  int largestY = 0; ///< its row, 0 on top
  std::string largestChannel;
  /// Each pixel's largest difference over the channels.
  std::vector<float> perPixel;
};

/// Read an image for comparison: the channels of an .exr unchanged, or of a .png as R, G and B in
/// [0, 255].
/// @throws BadInput
ChannelImage readComparable(const std::string& path);

/// Compare two images by channels. A pixel differs if one of its channels differs by more than
/// `maxDifference`. NaN differs from everything, itself included.
/// @param nameA, nameB the images' names in errors
/// @throws BadInput if the sizes or the channels' names differ
ImageDifference compareImages(const ChannelImage& a, const std::string& nameA,
  const ChannelImage& b, const std::string& nameB, double maxDifference);

/// Return a sentence with the number of pixels that differ by more than `maxDifference`, the
/// largest difference, and its place.
std::string describe(const ImageDifference& difference, double maxDifference);

/// Return a picture of the differences: equal pixels are black, differences within the tolerance
/// grey, larger differences orange to yellow, NaN magenta.
Picture differencePicture(const ImageDifference& difference, double maxDifference);

} // namespace gnomon::tool
