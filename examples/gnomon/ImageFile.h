#pragma once

#include "plugin/vtkGnomonVisibilityImages.h"

#include "lights/vtkGnomonVersions.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// A picture for people: display values, red, green and blue in turn. Row 0 is the *top* row; pixel
/// (x, y) starts at 3 * (y * width + x).
struct Picture
{
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;

  std::size_t pixelCount() const
  {
    return static_cast<std::size_t>(this->width) * static_cast<std::size_t>(this->height);
  }
};

/// An image as data: named channels of one size. Row 0 is the *top* row; pixel (x, y) is at
/// y * width + x.
struct ChannelImage
{
  int width = 0;
  int height = 0;
  std::map<std::string, std::vector<float>> channels;
  /// The header's text attributes.
  std::map<std::string, std::string> header;
  /// Where positions are counted from, in world coordinates: the header attribute `origin`. Zero
  /// where the file has none.
  std::array<double, 3> origin{ { 0.0, 0.0, 0.0 } };
};

/// The classes of a visibility's pixels in their colours.
/// @param light which image of `visibility`; one whose technique tells classes
Picture classPicture(const VisibilityImages& images, std::size_t light);

/// What the window shows after its last Render().
Picture capture(vtkRenderWindow* window);

/// Writes a .png, or an .exr with the channels R, G and B as floats in [0, 1] (the display values
/// as they are, with no change of gamma).
/// @throws BadInput for another ending or a path that cannot be written, Failure when writing fails
void writePicture(const Picture& picture, const std::string& path);

/// A picture in the form in which it is written into a .png, for embedding.
std::vector<unsigned char> encodePng(const Picture& picture);

/// Reads a .png with 8 bits per channel and no transparency (grey becomes RGB), or the channels R,
/// G and B of an .exr, clamped to [0, 1].
/// @throws BadInput
Picture readPicture(const std::string& path);

/// Reads every channel of an .exr, whatever its pixel type, as float.
/// @throws BadInput for a file that is missing, broken, incomplete, subsampled or unreasonably
/// large
ChannelImage readChannels(const std::string& path);

/// Writes a visibility file: 32-bit float channels `visibility.N` (N counts the renderer's lights;
/// of one with a texture `visibility.N.R/G/B`), `position.X/Y/Z` (world coordinates less the header
/// attribute `origin`, a V3d), `normal.X/Y/Z` and `coverage`. `header` becomes text attributes; its
/// keys must differ from the names of EXR's own attributes.
/// @throws BadInput for a path that cannot be written or does not end in .exr, Failure when writing
/// fails
void writeVisibility(const VisibilityImages& images, const std::string& path,
  const std::map<std::string, std::string>& header);

} // namespace gnomon::tool
