#pragma once

#include "ImageFile.h"

#include <cstdint>
#include <string>

namespace gnomon::tool
{

/// The differences of two images with the same size and channels.
struct ImageDifference
{
  std::int64_t differingPixels = 0;
  std::string text; ///< that number, the largest difference and its place, as a sentence
  /// Equal pixels are black, differences within the tolerance grey, larger differences orange to
  /// yellow, NaN magenta.
  Picture picture;
};

/// Compare two images by channels. A pixel differs if one of its channels differs by more than
/// `maxDifference`. NaN differs from everything, itself included.
/// @param nameA, nameB the images' names in errors
/// @throws BadInput if the sizes or the channels' names differ
ImageDifference compareImages(const ChannelImage& a, const std::string& nameA,
  const ChannelImage& b, const std::string& nameB, double maxDifference);

} // namespace gnomon::tool
