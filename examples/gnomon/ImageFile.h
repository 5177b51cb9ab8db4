#ifndef gnomon_examples_gnomon_ImageFile_h
#define gnomon_examples_gnomon_ImageFile_h

#include "plugin/VisibilityImages.h"

#include <map>
#include <string>
#include <vector>

class vtkRenderWindow;

namespace gnomon::tool
{

/// A picture as people see it: 8 bits per channel, row 0 on top, pixels from left to right.
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;
};

/// The picture that the window shows.
Picture capture(vtkRenderWindow* window);

/// Writes a .png or .exr file, by the path's extension.
/// @throws Failure when it cannot be written
void writePicture(const Picture& picture, const std::string& path);

/// Writes visibility and receivers as 32-bit float channels of an .exr file: visibility.0 ...,
/// position.X/Y/Z, normal.X/Y/Z, coverage. The header gets `origin`, a V3d, and the attributes
/// given.
/// @throws Failure when it cannot be written
void writeVisibility(const gnomon::VisibilityImages& images, const std::string& path,
  const std::map<std::string, std::string>& header);

} // namespace gnomon::tool

#endif
