#pragma once

#include "ImageFile.h"
#include "view/LightSights.h"

namespace gnomon::tool
{

/// Colour a grey picture by the size of the texels of a light's map: blue for a quarter of a pixel
/// or less, white for one pixel, red for four or more. Pixels outside of all views stay grey.
/// @param images the picture's receivers
/// @param camera the picture's, for the snapshot's centre
Picture texelPicture(const Picture& picture, const VisibilityImages& images,
  const LightSight& sight, const SceneFrame& frame, const CameraView& camera);

} // namespace gnomon::tool
