#pragma once

#include "ImageFile.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::tool
{

struct Panel
{
  std::string title;
  Picture picture;
};

/// The height of the strip with the titles, and the distance between panels, in pixels.
inline constexpr int panelTitleRows = 40;
inline constexpr int panelGapColumns = 8;

/// Join panels of one size into one picture, from left to right on white, each below its title.
/// @throws Failure without an OpenGL context
Picture sideBySide(const std::vector<Panel>& panels);

/// A square part of a picture, in pixels from its upper left corner.
struct Place
{
  int left = 0;
  int top = 0;
  int side = 0;
};

/// Return the square with the greatest sum of squared differences, among squares half a side apart;
/// nothing if no pixel differs.
/// @param differences each pixel's difference, row by row
/// @param side the square's side in pixels; smaller in a smaller picture
std::optional<Place> worstPlace(
  const std::vector<float>& differences, int width, int height, int side);

Picture cropped(const Picture& picture, const Place& place);

/// Return a picture reduced by an integer factor, with sides of at most `mostPixels`.
Picture reduced(const Picture& picture, int mostPixels);

/// Return a picture as a data URI; empty without a pixel.
std::string dataUri(const Picture& picture);

} // namespace gnomon::tool
