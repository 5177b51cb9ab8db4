#pragma once

#include "shadowtech/base/Receivers.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace gnomon
{

/// The truth that a picture of triangle numbers is compared with.
struct NumberTruth
{
  glm::dmat4 clipFromCentred{ 1.0 }; ///< of the camera that drew the picture
  std::vector<float> windowDepths;   ///< in [0, 1], one a pixel; empty: they are not compared
  double vertexNoise = 0.0; ///< how far the driver's floats may move a vertex, in world units
};

/// How many pixels name a primitive that was not drawn there, by drawn surface.
struct NumberCheck
{
  std::vector<std::int64_t> pixels; ///< that were compared
  std::vector<std::int64_t> wrong;  ///< of these

  std::int64_t allPixels() const;
  std::int64_t allWrong() const;
};

/// Compare the primitives that a picture's pixels name with the depths that were drawn. Drivers
/// count primitives for fragment shaders, and Mesa has counted them wrongly (work item 15660).
///
/// A pixel's number is wrong if its drawn surface has no primitive of that number, if the pixel's
/// ray misses the triangle by more than 1/64 pixel, or if it meets it at another depth. Rasterisers
/// move corners by up to 1/256 pixel; the depth may differ by as much as 1/64 pixel changes it.
/// VTK's shaders compute solids in float: their rays may miss by a pixel, and their depths are not
/// compared.
///
/// @param compared by drawn surface, 1 for those whose pixels are compared
NumberCheck checkNumbers(const ReceiverImages& images, const NumberTruth& truth,
  const std::vector<DrawnSurface>& drawnSurfaces, const std::vector<std::uint8_t>& compared,
  const Occluders& occluders);

} // namespace gnomon
