#pragma once

#include "ImageFile.h"

#include <string>
#include <vector>

namespace gnomon::tool
{

/// A picture and what stands above it.
struct Panel
{
  std::string title;
  Picture picture;
};

/// Height of the strip with the titles, and distance between panels, in pixels.
inline constexpr int panelTitleRows = 40;
inline constexpr int panelGapColumns = 8;

/// Joins panels into one picture, from left to right on white, each below its title.
/// @param panels at least one, all of one size
/// @throws std::invalid_argument for panels of different sizes, Failure when no OpenGL context can
/// be made
Picture sideBySide(const std::vector<Panel>& panels);

} // namespace gnomon::tool
