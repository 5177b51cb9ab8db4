#pragma once

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// How many pixels name a primitive that the depth buffer contradicts.
struct NumberCheck
{
  std::int64_t pixels = 0; ///< that were compared
  std::int64_t wrong = 0;  ///< of these
};

/// Compares the primitives that a picture's pixels name with what was drawn there. Drivers count
/// primitives for fragment shaders, and Mesa has counted them wrongly (work item 15660).
///
/// A pixel's number is wrong if its drawn surface has no primitive of that number, if the pixel's
/// ray misses the triangle by more than 1/64 pixel, or if it meets it at another depth than was
/// drawn. Rasterisers move corners by up to 1/256 pixel; the depth may differ by as much as 1/64
/// pixel changes it. The picture of a solid is computed in float: its ray may miss by a pixel, and
/// its depth is not compared.
///
/// @param windowDepths in [0, 1], one a pixel of the images; a polygon offset of the usual size is
/// tolerated. Empty if they may be of something else than the named surfaces: not compared.
/// @param compared by drawn surface, 1 for those whose pixels are compared
/// @param clipFromCentred of the camera that drew them
NumberCheck checkNumbers(const ReceiverImages& images, const std::vector<float>& windowDepths,
  const std::vector<DrawnSurface>& drawnSurfaces, const std::vector<std::uint8_t>& compared,
  const Occluders& occluders, const glm::dmat4& clipFromCentred);

} // namespace gnomon
