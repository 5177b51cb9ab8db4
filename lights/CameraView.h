#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon
{

/// The camera that a light's maps are fitted to, in centred coordinates (LightView.h). Conventions
/// are OpenGL's: the camera looks along -z of its view space, and clip space is [-1, 1]^3 after
/// division.
struct CameraView
{
  glm::dmat4 viewFromCentred{ 1.0 }; ///< rigid
  glm::dmat4 clipFromView{ 1.0 };    ///< perspective or parallel; invertible

  glm::dmat4 clipFromCentred() const { return this->clipFromView * this->viewFromCentred; }

  /// Return the eye of a perspective camera, or the view space origin of a parallel camera.
  glm::dvec3 eyeCentred() const
  {
    // The inverse of a rigid transformation.
    return -(
      glm::transpose(glm::dmat3(this->viewFromCentred)) * glm::dvec3(this->viewFromCentred[3]));
  }
  /// Return the unit vector along which the camera looks.
  glm::dvec3 directionCentred() const
  {
    return -glm::dvec3(
      this->viewFromCentred[0][2], this->viewFromCentred[1][2], this->viewFromCentred[2][2]);
  }
  /// Return where the lines of sight meet, as a homogeneous point (e, w) of view space: from a
  /// point p, the camera is in the direction e - w p. w is 1, or 0 for a parallel projection. It
  /// holds for all projections, also sheared ones.
  glm::dvec4 eyeView() const
  {
    // In clip coordinates they meet at the infinite end of the z axis.
    const glm::dvec4 far = glm::inverse(this->clipFromView)[2];
    const double length = glm::length(glm::dvec3(far));
    constexpr double parallelBelow = 1e-12; // rounding leaves this much of a zero
    return std::abs(far.w) > parallelBelow * length ? -far / std::abs(far.w)
                                                    : glm::dvec4(-glm::dvec3(far) / length, 0.0);
  }
  /// True for a parallel projection: w does not depend on distance.
  bool isParallel() const { return this->clipFromView[2][3] == 0.0; }

  /// Return the side of a pixel in world units, as coefficients: the side is x + y * distance. It
  /// is the side of the square with the pixel's area. Distance is measured along the direction of
  /// view.
  /// @param sizePixels size of the picture
  glm::dvec2 pixelSide(const glm::ivec2& sizePixels) const
  {
    const double pixelsOfUnit = 0.5 *
      std::sqrt(std::abs(this->clipFromView[0][0] * this->clipFromView[1][1]) * sizePixels.x *
        sizePixels.y);
    return glm::dvec2(this->clipFromView[3][3], -this->clipFromView[2][3]) / pixelsOfUnit;
  }

  /// Return the frustum's corners. Bits 0, 1 and 2 of the index choose right, top and far. Corners
  /// of a far plane at infinity are not finite, so code that must work for all cameras uses the
  /// planes.
  std::array<glm::dvec3, 8> cornersCentred() const
  {
    const glm::dmat4 centredFromClip = glm::inverse(this->clipFromCentred());
    std::array<glm::dvec3, 8> result;
    for (int i = 0; i < 8; ++i)
    {
      const glm::dvec4 corner = centredFromClip *
        glm::dvec4((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0, 1.0);
      result[static_cast<std::size_t>(i)] = glm::dvec3(corner) / corner.w;
    }
    return result;
  }
  /// Return a clipping plane's distance. It is infinite for a projection without a far plane.
  double nearDistance() const { return this->distanceAtDepth(-1.0); }
  double farDistance() const { return this->distanceAtDepth(1.0); }

private:
  /// Return the distance on the axis at which z/w is `depth`. It solves a z + b = depth (c z + e)
  /// with z = -distance.
  double distanceAtDepth(double depth) const
  {
    const double a = this->clipFromView[2][2];
    const double b = this->clipFromView[3][2];
    const double c = this->clipFromView[2][3];
    const double e = this->clipFromView[3][3];
    const double denominator = a - depth * c;
    return denominator == 0.0 ? std::numeric_limits<double>::infinity()
                              : (b - depth * e) / denominator;
  }
};

} // namespace gnomon
