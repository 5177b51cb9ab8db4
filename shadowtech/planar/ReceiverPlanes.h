#pragma once

#include "lights/Bounds.h"
#include "lights/ShadowSettings.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Occluders;

/// The largest number of planes that a setting may ask for.
constexpr int mostPlanes = PlanarSettings::mostPlanes;

/// A plane on which receiving triangles lie, in centred coordinates.
struct ReceiverPlane
{
  glm::dvec4 plane{ 0.0 }; ///< (n, d) with n.p + d = 0 and n of unit length
  /// The distance beyond which a point is certainly off the plane, in float arithmetic. It exceeds
  /// the distance of its own triangles' corners, and the rounding of n.p + d.
  double thickness = 0.0;
  double area = 0.0; ///< of its triangles
  Bounds boundsCentred;
};

/// The flat parts of receivers: the largest planes on which triangles of the snapshot lie, across
/// all surfaces.
///
/// Triangles lie on one plane if their corners do, up to rounding to float. A plane counts if its
/// triangles have at least `smallestShare` of all receivers' area. So planes follow from the scene
/// alone, and stay the same when the camera moves. Instances lie on no plane, as many small shapes
/// have no large one.
class ReceiverPlanes
{
public:
  static constexpr double smallestShare = 1.0 / 1024.0;

  /// Find the planes, if the snapshot or `wanted` changed.
  /// @param wanted number of largest planes, at most mostPlanes
  void update(const Occluders& occluders, std::size_t wanted);

  /// Return the planes, the largest first; at most as many as wanted.
  const std::vector<ReceiverPlane>& planes() const { return this->planes_; }
  /// Return the area of all receiving triangles.
  double area() const { return this->area_; }

  /// Return for each triangle of the snapshot 0, or 1 + its plane.
  const std::vector<std::uint8_t>& planeOfTriangle() const { return this->planeOfTriangle_; }

private:
  std::vector<ReceiverPlane> planes_;
  std::vector<std::uint8_t> planeOfTriangle_;
  double area_ = 0.0;
  std::size_t wanted_ = 0; ///< 0 before the first update
  Occluders::Versions versions_;
};

} // namespace gnomon
