#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// The emitting shape of an area light, around the light's centre. All its points emit alike unless
/// the light has a texture (LightTexture.h). The shape is symmetric: each point has an opposite
/// point.
struct LightArea
{
  enum class Shape
  {
    Rectangle, ///< across the light
    Disk,      ///< across the light
    Ball       ///< looks like a uniform disk from all sides
  };
  Shape shape = Shape::Disk;

  /// Takes the shape of half side or radius 1 to offsets from the light's centre, in world axes and
  /// units. A directional light's area lies at distance 1 from each receiver, so its lengths are
  /// tangents of angles.
  glm::dmat3 worldFromUnit{ 0.0 };

  /// Return the largest distance of its points from the centre, in units of worldFromUnit. 0: a
  /// point.
  double radius() const;

  /// Return how far it extends from the centre along a direction, in units of worldFromUnit. It
  /// extends equally far the opposite way.
  /// @param direction a unit vector
  double extentAlong(const glm::dvec3& direction) const;

  bool operator==(const LightArea& other) const
  {
    return this->shape == other.shape && this->worldFromUnit == other.worldFromUnit;
  }
  bool operator!=(const LightArea& other) const { return !(*this == other); }
};

/// Return a rectangle across the light.
/// @param travel unit vector along which the light travels
/// @param up of any length, not along travel; the rectangle's height lies in the plane of both
/// @param halfSize half the width and half the height
LightArea rectangleArea(const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize);

/// Return a disk across the light.
/// @param travel unit vector along which the light travels
LightArea diskArea(const glm::dvec3& travel, double radius);

/// Return a ball, which looks like a uniform disk from all sides.
LightArea ballArea(double radius);

/// Return evenly spaced points on a light's rim, as offsets from its centre in units of
/// worldFromUnit. They lie on a disk's rim, on a rectangle's border starting at a corner, or on a
/// ball.
std::vector<glm::dvec3> rimOf(const LightArea& area, std::size_t points);

} // namespace gnomon
