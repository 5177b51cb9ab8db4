#pragma once

#include <glm/glm.hpp>

namespace gnomon
{

/// The camera's rays through the centres of its pixels, in centred coordinates and double
/// precision.
///
/// Pixel (x, y), row 0 at the bottom, looks along
///     origin(x, y) + t direction(x, y)
/// with both affine in x and y. With perspective the origins coincide, in parallel projection the
/// directions. Directions are not normalised: the points of all pixels at t = 1 lie in one plane,
/// which for the usual cameras is at distance 1 across the viewing direction.
struct PixelRays
{
  glm::dvec3 firstOrigin{ 0.0 }; ///< of pixel (0, 0)
  glm::dvec3 originPerColumn{ 0.0 };
  glm::dvec3 originPerRow{ 0.0 };
  glm::dvec3 firstDirection{ 0.0, 0.0, -1.0 }; ///< of pixel (0, 0)
  glm::dvec3 directionPerColumn{ 0.0 };
  glm::dvec3 directionPerRow{ 0.0 };

  /// True if the directions coincide, not the origins.
  bool parallel() const { return this->directionPerColumn == glm::dvec3(0.0); }
  glm::dvec3 origin(double x, double y) const
  {
    return this->firstOrigin + x * this->originPerColumn + y * this->originPerRow;
  }
  glm::dvec3 direction(double x, double y) const
  {
    return this->firstDirection + x * this->directionPerColumn + y * this->directionPerRow;
  }
};

/// Return the rays of a camera with any invertible projection: perspective or parallel, sheared,
/// off the axis, or a tile of a larger picture.
///
/// @param clipFromView the projection; view coordinates look along -z
/// @param centredFromView rigid
/// @param width, height of the picture in pixels; > 0
PixelRays pixelRays(
  const glm::dmat4& clipFromView, const glm::dmat4& centredFromView, int width, int height);

} // namespace gnomon
