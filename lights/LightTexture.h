#pragma once

#include "lights/LightArea.h"
#include "lights/vtkGnomonVersions.h"

#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace gnomon
{

/// The distribution of an area light's colour: a picture that its light passes, as through a
/// stained glass window.
///
/// Channels are integers. Sums of up to 65536 channels, the largest number of samples, are integers
/// below 2^24, which floats hold exactly. So visibility does not depend on the order of summation.
struct LightTexture
{
  static constexpr int full = 255; ///< a channel that transmits all of the light's colour

  int width = 0;                   ///< in texels
  int height = 0;                  ///< in texels
  std::vector<glm::u8vec3> texels; ///< row 0 at the bottom

  ///@{
  /// The mean colour, in [0, 1], over the rectangle and over the disk that touches the picture's
  /// sides.
  glm::dvec3 meanOfRectangle{ 1.0 };
  glm::dvec3 meanOfDisk{ 1.0 };
  ///@}
};

/// Read a texture from an image of one slice with 1 to 4 components per point: grey or colour, with
/// an alpha that is ignored. Unsigned char and unsigned short values range from 0 to the type's
/// maximum, float and double values from 0 to 1.
/// @param reason set to a clause if the image is not a valid texture, else unchanged
/// @return null for an invalid image
std::shared_ptr<const LightTexture> readLightTexture(vtkImageData* image, std::string& reason);

/// A texture placed on a light's area.
struct PlacedTexture
{
  std::shared_ptr<const LightTexture> texture;
  /// Takes an offset from the light's centre, in LightArea's units, to the picture: x and y in [-1,
  /// 1], rightwards and upwards for a viewer who faces the light.
  glm::mat3 pictureFromWorld{ 0.0f };
  /// The share of the light's colour that reaches an unshadowed receiver.
  glm::vec3 mean{ 1.0f };

  /// Return the colour of a point of the light, in 255ths.
  /// @param offset from the light's centre, in LightArea's units
  glm::vec3 colourAt(const glm::vec3& offset) const;
};

/// Place a texture on a light's area.
/// @param travel unit vector along which the light travels
/// @param up of any length, not along travel; the picture's up direction lies in the plane of both
/// @param halfSize half the picture's width and height; for 0, the picture shrinks to its middle
PlacedTexture placeTexture(std::shared_ptr<const LightTexture> texture, LightArea::Shape shape,
  const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize);

} // namespace gnomon
