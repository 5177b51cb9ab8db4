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

/// How the colour of an area light is spread over its area: a picture that its light comes through,
/// as through the panes of a window.
///
/// Channels are whole numbers: sums of 65536 of them, as many as a light has samples at most, are
/// whole numbers below 2^24, which floats hold. So what receivers see does not depend on the order
/// in which it is added up.
struct LightTexture
{
  static constexpr int full = 255; ///< a channel that lets all of the light's colour through

  int width = 0;                   ///< in texels
  int height = 0;                  ///< in texels
  std::vector<glm::u8vec3> texels; ///< row 0 at the bottom

  ///@{
  /// The mean colour over a rectangle, and over the disk that touches the picture's sides, in [0,
  /// 1].
  glm::dvec3 meanOfRectangle{ 1.0 };
  glm::dvec3 meanOfDisk{ 1.0 };
  ///@}
};

/// Reads an image of one slice with 1 to 4 components a point: grey or colours, and an alpha, which
/// means nothing here. Values of unsigned char and unsigned short go from 0 to the type's greatest,
/// of float and double from 0 to 1.
/// @param reason why the image is no texture, as a clause; left as it is where it is one
/// @return null where it is none
std::shared_ptr<const LightTexture> readLightTexture(vtkImageData* image, std::string& reason);

/// A texture that lies on a light's area.
struct PlacedTexture
{
  std::shared_ptr<const LightTexture> texture;
  /// Takes what LightArea measures from the light's centre to the picture: x and y from -1 to 1, to
  /// the right and up as who looks at the light sees them.
  glm::mat3 pictureFromWorld{ 0.0f };
  /// What of the light's colour reaches a receiver that nothing hides it from.
  glm::vec3 mean{ 1.0f };

  /// The colour of a point of the light, in 255ths.
  /// @param offset from the light's centre
  glm::vec3 colourAt(const glm::vec3& offset) const;
};

/// @param travel unit vector along which the light travels
/// @param up not along it, of any length: what is up in the picture lies in the plane of both
/// @param halfSize of the picture: half the width and half the height; where it is 0 the picture's
/// middle is all there is
PlacedTexture placeTexture(std::shared_ptr<const LightTexture> texture, LightArea::Shape shape,
  const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize);

} // namespace gnomon
