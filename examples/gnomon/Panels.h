#pragma once

#include "ImageFile.h"

#include <string>
#include <vector>

namespace gnomon::tool
{

/// A picture and its title.
struct Panel
{
  std::string title;
  Picture picture;
};

/// The height of the strip with the titles, and the distance between panels, in pixels.
inline constexpr int panelTitleRows = 40;
inline constexpr int panelGapColumns = 8;

/// Join panels into one picture, from left to right on white, each below its title.
/// @param panels at least one, all of one size
/// @throws std::invalid_argument for panels of different sizes, Failure without an OpenGL context
Picture sideBySide(const std::vector<Panel>& panels);

} // namespace gnomon::tool
