#pragma once

#include "shadowtech/base/PixelRays.h"
#include "shadowtech/base/Receivers.h"
#include "shadowtech/base/SeenTriangle.h"
#include "shadowtech/base/ShadowRay.h"

#include <glm/glm.hpp>

#include <cstddef>

namespace gnomon
{

/// Places in a row of the picture, one pixel apart, that show the same triangle.
struct PixelSpan
{
  double x, y;       ///< of the first one, in the picture; whole numbers are pixels' centres
  std::size_t count; ///< at most ReceiverTile::mostColumns
  std::size_t first; ///< index of the first one's receiver
};

/// Where a ray meets a triangle's plane.
struct TrianglePoint
{
  glm::dvec3 position; ///< centred
  float offset;        ///< of the shadow ray
  bool isInside;       ///< of the triangle; false if a number is not finite
};
/// Return where the ray of place (x, y) meets a triangle's plane.
inline TrianglePoint meetTriangle(
  const SeenTriangle& seen, const PixelRays& rays, double x, double y)
{
  const double along = seen.alongNormal.row(y).at(x);
  const double t = seen.planeDistance.row(y).at(x) / along;
  const double footprint = glm::length(rays.originPerRow) + t * glm::length(rays.directionPerRow);
  // Written so that NaN fails.
  return { rays.origin(x, y) + t * rays.direction(x, y),
    shadowRayOffsetInside(seen.noise, static_cast<float>(footprint)),
    seen.insideEdge[0].row(y).at(x) >= 0.0 && seen.insideEdge[1].row(y).at(x) >= 0.0 &&
      seen.insideEdge[2].row(y).at(x) >= 0.0 && along > 0.0 };
}

/// Compute the receivers of a span that shows a triangle, on the triangle.
void projectFlat(const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span,
  ReceiverPixels& receivers);

/// Compute the receivers of a span that shows a triangle, and the curved surface above them.
void projectSpan(const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span,
  ReceiverPixels& receivers);

void projectSolid(const SeenTriangle& seen, const PixelRays& rays, const PixelSpan& span,
  ReceiverPixels& receivers);

/// Find the curved surface above receivers on a triangle with smooth normals.
/// @param span only its indices into the arrays count
void findCurves(const SeenTriangle& seen, const PixelSpan& span, ReceiverPixels& receivers);

void leaveUncovered(const PixelSpan& span, ReceiverPixels& receivers);

} // namespace gnomon
