#pragma once

#include "lights/Bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon
{

struct Occluders;

/// The most planes that can be asked for.
constexpr int mostPlanes = 64;

/// A plane on which receiving triangles lie, in centred coordinates.
struct ReceiverPlane
{
  glm::dvec4 plane{ 0.0 }; ///< (n, d), n unit: n.p + d = 0
  /// From which distance on a point is surely off the plane, in the arithmetic of floats: more than
  /// its own triangles' corners lie off it, and than float rounds n.p + d by.
  double thickness = 0.0;
  double area = 0.0; ///< of its triangles
  Bounds boundsCentred;
};

/// The flat parts of what receives shadows: the largest planes on which triangles of the snapshot
/// lie, wherever they are and whatever surface they belong to.
///
/// Triangles lie on one plane if their corners do, to within what rounding to float has moved them
/// by. A plane counts if its triangles have at least `smallestShare` of all receivers' area. So the
/// planes follow from the scene alone, and stay the same when the camera moves. What is drawn as
/// instances lies on no plane: many small shapes have none that are large.
class ReceiverPlanes
{
public:
  static constexpr double smallestShare = 1.0 / 1024.0;

  /// Finds them again if the snapshot or what is wanted has changed.
  /// @param wanted how many of the largest, at most mostPlanes
  void update(const Occluders& occluders, std::size_t wanted);

  /// In order of area, no more than wanted.
  const std::vector<ReceiverPlane>& planes() const { return this->planes_; }
  /// The area of all receiving triangles.
  double area() const { return this->area_; }

  /// For every triangle that VTK draws of a surface, from drawnBegin() on: 0, or 1 + the plane that
  /// it lies on.
  const std::vector<std::uint8_t>& planeOfDrawn() const { return this->planeOfDrawn_; }
  std::size_t drawnBegin(std::size_t surface) const { return this->drawnBegin_[surface]; }

  /// Changes when all this changes; 0 before the first update.
  std::uint64_t version() const { return this->version_; }

private:
  std::vector<ReceiverPlane> planes_;
  std::vector<std::uint8_t> planeOfDrawn_;
  std::vector<std::size_t> drawnBegin_;
  double area_ = 0.0;
  std::uint64_t version_ = 0;
  std::size_t wanted_ = 0;
  std::uint64_t topologyVersion_ = 0;
  std::uint64_t positionsVersion_ = 0;
};

} // namespace gnomon
