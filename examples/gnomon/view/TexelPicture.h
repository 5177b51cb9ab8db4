#pragma once

#include "ImageFile.h"
#include "view/LightSights.h"

namespace gnomon::tool
{

/// How large the texels of a light's map look: over the picture in grey, blue where a texel is a
/// quarter of a pixel or less, white where it is as large as one, red where it is four or more.
/// Pixels that no view of the map holds stay grey.
/// @param images of the picture's pixels
/// @param camera that shows it, for the snapshot's centre
Picture texelPicture(const Picture& picture, const VisibilityImages& images,
  const LightSight& sight, const glm::dvec3& centreWorld, const CameraView& camera);

} // namespace gnomon::tool
