#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <string>

namespace gnomon
{

struct ShadowLight;

/// The coordinates in which a scene is computed. In them, floats hold positions and products of
/// lengths, for scenes at any place and with any unit of length.
///
/// Lengths count in *units* of 2^exponent. *Centred* coordinates are world coordinates in units,
/// less the centre. Within lights/ and shadowtech/ all lengths are in units, also those of world
/// coordinates. Users, files and kept images have the world's own lengths.
///
/// Units are powers of two, which no product with a float rounds. So scenes that differ by such a
/// factor have the same shadows, bit for bit.
struct SceneFrame
{
  glm::dvec3 centre{ 0.0 }; ///< in units
  int exponent = 0;

  /// The length of a unit in the world.
  double unitWorld() const;
  /// How many units the world's length 1 has: world coordinates times this are in units.
  double unitsPerWorld() const;

  glm::dvec3 fromWorld(const glm::dvec3& positionWorld) const
  {
    return positionWorld * this->unitsPerWorld() - this->centre;
  }
  glm::dvec3 toWorld(const glm::dvec3& positionCentred) const
  {
    return (positionCentred + this->centre) * this->unitWorld();
  }
  /// Return a matrix to world coordinates, changed to lead to centred coordinates.
  glm::dmat4 centredFrom(const glm::dmat4& worldFromSpace) const;

  bool operator==(const SceneFrame& other) const
  {
    return this->centre == other.centre && this->exponent == other.exponent;
  }
  bool operator!=(const SceneFrame& other) const { return !(*this == other); }
};

/// Return the frame of a scene.
///
/// It is a function of the scene's box alone, so that no picture depends on earlier frames.
/// - The box's radius is 2^-10 to 2^20 units; the exponent is a multiple of 30. So ordinary scenes
///   have the world's unit, and it rarely changes.
/// - The centre lies on a grid whose step is 2 to 4 radii of the box, a power of two. Hence small
///   changes of the scene nearly always leave it, centred coordinates are at most three radii
///   large, and a box around the origin has the origin for its centre.
///
/// @param boundsWorld the box around all surfaces; empty: the frame is the world
SceneFrame sceneFrameOf(const Bounds& boundsWorld);

/// Bring a light into a scene's frame. The light counts its lengths in the frame's units then.
/// A lamp so far off that its rays are parallel becomes a directional light.
/// @return why it cannot shine there, as a clause for users; empty if it can
std::string enterFrame(ShadowLight& light, const SceneFrame& frame);

} // namespace gnomon
