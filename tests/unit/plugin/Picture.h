#pragma once

#include <vtkRenderWindow.h>

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::test
{

/// A window's picture; row 0 is the bottom row.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;

  std::size_t pixels() const { return this->rgb.size() / 3; }
  glm::ivec3 at(int x, int y) const;
  int red(int x, int y) const { return this->at(x, y).r; }
  bool operator==(const Picture& other) const
  {
    return this->width == other.width && this->height == other.height && this->rgb == other.rgb;
  }
};

///@{
/// Read the whole window, or a part of it.
Picture readPicture(vtkRenderWindow* window);
Picture readPicture(vtkRenderWindow* window, const glm::ivec2& lower, const glm::ivec2& size);
///@}

/// Return a picture's channels, of 255.
std::vector<float> channelsOf(const Picture& picture);

/// Return the root of the mean square of the channels' differences, of 255.
double rmsDifference(const Picture& a, const Picture& b);

/// Count the pixels in which some channel differs by more than `tolerance` of 255.
std::size_t differingPixels(const Picture& a, const Picture& b, int tolerance = 0);

} // namespace gnomon::test
