#pragma once

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// The result of a check of primitive numbers against the depth buffer.
struct NumberCheck
{
  std::int64_t pixels = 0; ///< that were compared
  std::int64_t wrong = 0;  ///< those whose number contradicts the depth buffer
};

/// Compare the primitives that a picture's pixels name with the drawn depths. Drivers count
/// primitives for fragment shaders, and Mesa has counted them wrongly (work item 15660).
///
/// A pixel's number is wrong in three cases:
/// - its drawn surface has no primitive of that number;
/// - the pixel's ray misses the triangle by more than 1/64 pixel;
/// - the ray meets it at another depth than was drawn.
///
/// Rasterisers move corners by up to 1/256 pixel. The depth may differ by as much as 1/64 pixel
/// changes it. VTK computes the picture of a solid in float: its ray may miss by a pixel, and its
/// depth is not compared.
///
/// @param windowDepths in [0, 1], one per pixel of the images; a polygon offset of the usual size
/// is tolerated. Empty: compare no depths, because they may belong to other surfaces.
/// @param compared by drawn surface, 1 for those whose pixels are compared
/// @param clipFromCentred of the camera that drew them
NumberCheck checkNumbers(const ReceiverImages& images, const std::vector<float>& windowDepths,
  const std::vector<DrawnSurface>& drawnSurfaces, const std::vector<std::uint8_t>& compared,
  const Occluders& occluders, const glm::dmat4& clipFromCentred);

} // namespace gnomon
