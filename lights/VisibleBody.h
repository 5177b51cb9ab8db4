#pragma once

#include "lights/Bounds.h"
#include "lights/CameraView.h"
#include "lights/LightRays.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon
{

/// The points p with dot(plane.xyz, p) + plane.w >= 0.
using HalfSpace = glm::dvec4;

/// A convex polyhedron, as the polygons of its surface. A flat one, a segment or a single point are
/// bodies, too, so that a scene of one ground plane has one.
class ConvexBody
{
public:
  /// The empty body.
  ConvexBody() = default;

  /// A box under an affine transformation; empty where the box is.
  ConvexBody(const Bounds& box, const glm::dmat4& transformation);

  bool empty() const { return this->polygons_.empty(); }

  /// What of it lies in a half space. A half space that is not finite leaves nothing.
  ConvexBody clipped(const HalfSpace& halfSpace) const;
  ConvexBody clipped(const std::vector<HalfSpace>& halfSpaces) const;

  /// The corners, each once but for rounding; the body is their convex hull. Empty only of an empty
  /// body, and always finite.
  std::vector<glm::dvec3> vertices() const;

private:
  std::vector<std::vector<glm::dvec3>> polygons_;
};

/// What a light shines on at most, as half spaces in its view space: nothing for a directional
/// light that fills the scene.
///
/// Of a cone eight planes around it; of a box five (the sixth, its near face, too); of a cube's
/// face the pyramid. A positional light begins at z = `nearest` > 0, so that no slope is infinite.
std::vector<HalfSpace> coneHalfSpaces(double coneTangent, double nearest);
std::vector<HalfSpace> cubeFaceHalfSpaces(double nearest);
/// @param box half the width, half the height and the depth
std::vector<HalfSpace> boxHalfSpaces(const glm::dvec3& box);

/// The share of the farthest distance at which a positional light's view begins (LightViews.h).
constexpr double nearestShare = 1e-5;

/// The near plane of a positional light's view: a small share of the distance of the farthest point
/// of the box along its axis. 0 where the whole box lies behind the light, which then sees nothing.
double nearestOf(const Bounds& sceneCentred, const LightRays& rays);

/// All that the camera may see of the scene in this light, in the light's view space: the camera's
/// frustum, the scene's box and what the light reaches, intersected plane by plane. (The body L ∩ V
/// ∩ S of Wimmer, Scherzer, Purgathofer: Light Space Perspective Shadow Maps, 2004, section 4; here
/// the receivers alone, since casters between them and the light lie on the same rays.)
///
/// Built from the box inwards, so that a far plane much farther than the scene, or at infinity,
/// costs no digits. Empty where nothing can be seen.
///
/// @param reach as made by the functions above, in the light's view space
ConvexBody visibleBody(const CameraView& camera, const Bounds& sceneCentred, const LightRays& rays,
  const std::vector<HalfSpace>& reach);

/// The slab of the body between two distances from the camera, along its direction of view.
ConvexBody sliced(const ConvexBody& body, const CameraView& camera, const LightRays& rays,
  double nearDistance, double farDistance);

/// The least and greatest distance of points in the light's view space from the camera, along its
/// direction of view. lower > upper without points.
struct DistanceRange
{
  double lower;
  double upper;
};
DistanceRange distancesOf(
  const std::vector<glm::dvec3>& pointsView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
