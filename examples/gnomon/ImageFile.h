#pragma once

#include "plugin/vtkGnomonVisibilityImages.h"

#include "lights/vtkGnomonVersions.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace gnomon::tool
{

/// A picture for display: red, green and blue values, interleaved. Row 0 is the *top* row; pixel
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
  std::map<std::string, std::string> header;
  /// The origin of positions, in world coordinates: the header attribute `origin`, or zero without
  /// it.
  std::array<double, 3> origin{ { 0.0, 0.0, 0.0 } };
};

/// Return the classes of pixels in their colours: of the first light whose technique has classes.
/// @param sceneIndex of a light, to ask it alone
/// @return without pixels if there are none
Picture classPicture(const VisibilityImages& images, std::optional<int> sceneIndex = std::nullopt);

Picture capture(vtkRenderWindow* window);

/// Write a .png, or an .exr with the channels R, G and B as floats in [0, 1]. These are display
/// values, without a change of gamma.
/// @throws BadInput for another extension or a path that cannot be written, Failure if writing
/// fails
void writePicture(const Picture& picture, const std::string& path);

std::vector<unsigned char> encodePng(const Picture& picture);

/// Read a .png with 8 bits per channel and without transparency (grey becomes RGB), or the channels
/// R, G and B of an .exr, clamped to [0, 1].
/// @throws BadInput
Picture readPicture(const std::string& path);

/// Read every channel of an .exr, of any pixel type, as float.
/// @throws BadInput for a file that is missing, broken, incomplete, subsampled or unreasonably
/// large
ChannelImage readChannels(const std::string& path);

/// Return a picture as the channels R, G and B.
/// @param unit what its values are divided by
ChannelImage channelsOf(const Picture& picture, float unit);

/// Write a visibility file with 32-bit float channels:
/// - `visibility.N`, or `visibility.N.R/G/B` for a light with a texture; N counts the renderer's
///   lights
/// - `position.X/Y/Z`, world coordinates minus the header attribute `origin`, a V3d
/// - `normal.X/Y/Z` and `coverage`
///
/// @param header text attributes; keys must differ from the names of EXR's own attributes
/// @throws BadInput for a path that cannot be written or does not end in .exr, Failure if writing
/// fails
void writeVisibility(const VisibilityImages& images, const std::string& path,
  const std::map<std::string, std::string>& header);

/// Read a PNG or JPEG image.
/// @throws BadInput with a message that names the file
vtkSmartPointer<vtkImageData> readImage(const std::string& path);

/// Read a PNG or JPEG image as a texture with VTK's settings: repeated, nearest texel.
/// @throws BadInput with a message that names the file
vtkSmartPointer<vtkTexture> readTexture(const std::string& path);

} // namespace gnomon::tool
