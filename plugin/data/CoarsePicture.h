#pragma once

#include "lights/CameraView.h"
#include "shadowtech/tracing/EmbreeTracer.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace gnomon
{

struct Occluders;

/// Where a light shines from, as the camera sees it, in degrees.
struct KeyDirection
{
  double left;  ///< beside the camera; negative to its right
  double above; ///< the camera

  /// Return the unit vector towards the light in the camera's view space.
  glm::dvec3 towardsView() const;
};

/// Shares of a picture that a directional light brightens or darkens, in [0, 1].
struct LightShares
{
  double lit = 0.0;      ///< of the subject's visible area: it faces the light, nothing blocks it
  double inShadow = 0.0; ///< of the ground: it faces the light, and the light is blocked
  double litGround = 0.0;

  /// True if the light models the subject, and its shadow is seen.
  bool suffice() const { return this->lit >= 0.5 && this->inShadow >= 0.05; }
};

/// A coarse picture of a scene, on which directions of a key light are tried.
///
/// The *ground* is what lies below or behind: planes that the rest of the picture lies in front of.
/// The *subject* is the rest. Only ground near the subject counts: within 1.5 radii of the box
/// around the subject's visible points. Without ground, the subject's unlit part counts as shadow.
class CoarsePicture
{
public:
  static constexpr int across = 96; ///< rays along each side of the picture

  /// Trace the picture.
  /// @param occluders must stay in place
  /// @throws std::runtime_error if there is no tracer
  CoarsePicture(const Occluders& occluders, const CameraView& camera);

  /// True if the camera sees no surface that receives shadows.
  bool isEmpty() const { return this->points_.empty(); }
  bool hasGround() const { return this->groundCount_ > 0; }
  /// Return the unit vector towards a light in the world.
  glm::dvec3 towards(const KeyDirection& direction) const
  {
    return this->worldFromView_ * direction.towardsView();
  }
  LightShares sharesOf(const KeyDirection& direction) const;

  struct Choice
  {
    KeyDirection direction;
    LightShares shares;
  };
  /// Return the best of some dozen directions on the camera's side.
  Choice chooseKey() const;

  struct Point
  {
    glm::vec3 position;
    glm::vec3 normal;
    float spacing; ///< of the rays, across the view
    float offset;  ///< of shadow rays
    bool isGround = false;
  };

private:
  void look(const Occluders& occluders, const CameraView& camera, const EmbreeTracer& eye);
  void findGround();

  EmbreeTracer tracer_;
  glm::dmat3 worldFromView_;
  std::vector<Point> points_; ///< the subject's and the ground's
  std::size_t groundCount_ = 0;
};

} // namespace gnomon
