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

/// A convex polyhedron, stored as the polygons of its surface. It may be a flat polygon, a segment
/// or a point, so a scene of one ground plane has a body.
class ConvexBody
{
public:
  /// Construct the empty body.
  ConvexBody() = default;

  /// Construct a box under an affine transformation; empty for an empty or infinite box.
  ConvexBody(const Bounds& box, const glm::dmat4& transformation);

  bool empty() const { return this->polygons_.empty(); }

  /// Return the body's part in a half space. A half space that is not finite leaves nothing.
  ConvexBody clipped(const HalfSpace& halfSpace) const;
  ConvexBody clipped(const std::vector<HalfSpace>& halfSpaces) const;

  /// Return the corners, each once except for rounding. The body is their convex hull. They are
  /// finite, and empty only for an empty body.
  std::vector<glm::dvec3> vertices() const;

private:
  std::vector<std::vector<glm::dvec3>> polygons_;
};

/// Return half spaces around a light's reach, in its view space. A directional light without a box
/// needs none.
///
/// A cone has eight planes around it, a box its six faces, a cube's face its pyramid. A positional
/// light begins at z = `nearest` > 0, so no slope is infinite.
std::vector<HalfSpace> coneHalfSpaces(double coneTangent, double nearest);
std::vector<HalfSpace> cubeFaceHalfSpaces(double nearest);
/// @param box half the width, half the height and the depth
std::vector<HalfSpace> boxHalfSpaces(const glm::dvec3& box);

/// A positional light's view begins at this share of the farthest distance (LightViews.h).
constexpr double nearestShare = 1e-5;

/// Return the near plane of a positional light's view: nearestShare of the largest distance of the
/// box' corners along its axis. It is 0 if the whole box lies behind the light.
double nearestOf(const Bounds& sceneCentred, const LightRays& rays);

/// Return the body that the camera may see in this light, in the light's view space. It is the
/// intersection of the camera's frustum, the scene's box and the light's reach: L, V and S of
/// Wimmer, Scherzer, Purgathofer (Light Space Perspective Shadow Maps, 2004, section 4). Unlike
/// there, it holds receivers only, as casters between them and the light lie on the same rays.
///
/// It is clipped from the box inwards, so a far plane much farther than the scene, or at infinity,
/// costs no precision. It is empty if nothing is visible.
///
/// @param reach half spaces from the functions above, in the light's view space
ConvexBody visibleBody(const CameraView& camera, const Bounds& sceneCentred, const LightRays& rays,
  const std::vector<HalfSpace>& reach);

/// Return the body's slab between two distances from the camera, along its direction of view.
ConvexBody sliced(const ConvexBody& body, const CameraView& camera, const LightRays& rays,
  double nearDistance, double farDistance);

/// The least and greatest distance of points from the camera, along its direction of view; lower >
/// upper without points.
struct DistanceRange
{
  double lower;
  double upper;
};
DistanceRange distancesOf(
  const std::vector<glm::dvec3>& pointsView, const CameraView& camera, const LightRays& rays);

} // namespace gnomon
