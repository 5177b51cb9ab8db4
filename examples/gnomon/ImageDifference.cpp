#include "ImageDifference.h"

#include "Errors.h"
#include "Files.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gnomon::tool
{
namespace
{

std::string channelNames(const ChannelImage& image)
{
  std::string names;
  for (const auto& [name, plane] : image.channels)
  {
    names += (names.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "none" : names;
}

std::string sizeText(const ChannelImage& image)
{
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void requireSameShape(
  const ChannelImage& a, const std::string& nameA, const ChannelImage& b, const std::string& nameB)
{
  if (a.width != b.width || a.height != b.height)
  {
    throw BadInput("the sizes differ: " + nameA + " has " + sizeText(a) + " pixels, " + nameB +
      " has " + sizeText(b));
  }
  const bool sameChannels = a.channels.size() == b.channels.size() &&
    std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(),
      [](const auto& one, const auto& other) { return one.first == other.first; });
  if (!sameChannels)
  {
    throw BadInput("the channels differ: " + nameA + " has " + channelNames(a) + "; " + nameB +
      " has " + channelNames(b));
  }
}

/// Return |a - b|: 0 for equal infinities, NaN if a or b is NaN.
float distance(float a, float b)
{
  return a == b ? 0.0f : std::fabs(a - b);
}

/// True if a is larger than b. NaN counts as larger than any number.
bool larger(double a, double b)
{
  return a > b || (std::isnan(a) && !std::isnan(b));
}

} // namespace

//------------------------------------------------------------------------------
ChannelImage readComparable(const std::string& path)
{
  if (lowerExtension(path) == ".exr")
  {
    return readChannels(path);
  }
  const Picture picture = readPicture(path);
  ChannelImage image;
  image.width = picture.width;
  image.height = picture.height;
  static constexpr const char* names[] = { "R", "G", "B" };
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    std::vector<float>& plane = image.channels[names[channel]];
    plane.resize(picture.pixelCount());
    for (std::size_t i = 0; i < plane.size(); ++i)
    {
      plane[i] = picture.rgb[3 * i + channel];
    }
  }
  return image;
}

//------------------------------------------------------------------------------
ImageDifference compareImages(const ChannelImage& a, const std::string& nameA,
  const ChannelImage& b, const std::string& nameB, double maxDifference)
{
  requireSameShape(a, nameA, b, nameB);
  ImageDifference result;
  result.width = a.width;
  result.height = a.height;
  result.perPixel.assign(
    static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height), 0.0f);
  for (const auto& [name, planeA] : a.channels)
  {
    const std::vector<float>& planeB = b.channels.at(name);
    for (std::size_t i = 0; i < planeA.size(); ++i)
    {
      const float d = distance(planeA[i], planeB[i]);
      if (larger(d, result.perPixel[i]))
      {
        result.perPixel[i] = d;
      }
      if (larger(d, result.largest))
      {
        result.largest = d;
        result.largestX = static_cast<int>(i % static_cast<std::size_t>(a.width));
        result.largestY = static_cast<int>(i / static_cast<std::size_t>(a.width));
        result.largestChannel = name;
      }
    }
  }
  result.differingPixels = std::count_if(result.perPixel.begin(), result.perPixel.end(),
    [maxDifference](float d) { return larger(d, maxDifference); });
  return result;
}

//------------------------------------------------------------------------------
std::string describe(const ImageDifference& difference, double maxDifference)
{
  std::ostringstream text;
  text << difference.differingPixels << " of " << difference.perPixel.size()
       << " pixels differ by more than " << maxDifference << "; largest difference "
       << difference.largest;
  if (!difference.largestChannel.empty())
  {
    text << " in channel " << difference.largestChannel << " at pixel (" << difference.largestX
         << ", " << difference.largestY << "), counted from the top left";
  }
  return text.str();
}

//------------------------------------------------------------------------------
Picture differencePicture(const ImageDifference& difference, double maxDifference)
{
  float brightest = 0.0f; // the largest finite difference, shown as yellow
  for (float d : difference.perPixel)
  {
    brightest = std::isfinite(d) ? std::max(brightest, d) : brightest;
  }
  Picture picture;
  picture.width = difference.width;
  picture.height = difference.height;
  picture.rgb.reserve(3 * picture.pixelCount());
  for (float d : difference.perPixel)
  {
    if (std::isnan(d))
    {
      picture.rgb.insert(picture.rgb.end(), { 255, 0, 255 });
    }
    else if (d > maxDifference)
    {
      const float share = std::isfinite(d) ? d / brightest : 1.0f; // brightest >= d > 0
      const auto green = static_cast<unsigned char>(80.0f + 175.0f * share);
      picture.rgb.insert(picture.rgb.end(), { 255, green, 0 });
    }
    else
    {
      const unsigned char grey = d > 0.0f ? 80 : 0;
      picture.rgb.insert(picture.rgb.end(), { grey, grey, grey });
    }
  }
  return picture;
}

} // namespace gnomon::tool
