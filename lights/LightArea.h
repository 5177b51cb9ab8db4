#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

/// How far a light's area may reach from its centre, in world units.
constexpr double largestAreaRadius = 1e12;

/// What a light that is more than a point shines from: a shape around its centre. Its points shine
/// alike unless it has a texture (LightTexture.h). It is symmetric about the centre, so that
/// opposite every point there is another one.
struct LightArea
{
  enum class Shape
  {
    Rectangle, ///< across the light
    Disk,      ///< across the light
    Ball       ///< that looks like an even disk from all sides
  };
  Shape shape = Shape::Disk;

  /// From the shape of half side or radius 1 to the light's own, without its centre: world
  /// coordinates and units. Of a directional light, the area lies at distance 1 from whatever it
  /// lights, so that lengths are tangents of angles.
  glm::dmat3 worldFromUnit{ 0.0 };

  /// How far from the centre it shines at most, in the units of worldFromUnit; 0: it is a point.
  double radius() const;

  /// How far from the centre it goes along a direction, which is as far as it goes the opposite
  /// way, in the units of worldFromUnit.
  /// @param direction a unit vector
  double extentAlong(const glm::dvec3& direction) const;

  bool operator==(const LightArea& other) const
  {
    return this->shape == other.shape && this->worldFromUnit == other.worldFromUnit;
  }
  bool operator!=(const LightArea& other) const { return !(*this == other); }
};

/// A rectangle.
/// @param travel unit vector along which the light travels
/// @param up not along it, of any length: the rectangle's height lies in the plane of both
/// @param halfSize half the width and half the height
LightArea rectangleArea(const glm::dvec3& travel, const glm::dvec3& up, const glm::dvec2& halfSize);

/// A disk across the light.
/// @param travel unit vector along which the light travels
LightArea diskArea(const glm::dvec3& travel, double radius);

LightArea ballArea(double radius);

/// Points all around a light, as far from each other as they go: on a disk's rim, on a rectangle's
/// border from a corner on, on a ball. From the centre, in the units of worldFromUnit.
std::vector<glm::dvec3> rimOf(const LightArea& area, std::size_t points);

} // namespace gnomon
