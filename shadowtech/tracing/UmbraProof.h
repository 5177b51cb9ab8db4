#pragma once

#include "lights/Bounds.h"
#include "lights/ShadowLight.h"
#include "shadowtech/tracing/CasterHits.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon
{

struct Occluders;

/// The ends of a light's shadow rays: the convex hull of some points, or of some directions.
struct RayEnds
{
  RayEnds(const ShadowLight& light, const Occluders& occluders);

  /// Return the length of a directional light's ray, in lengths of its direction: to its box's near
  /// face, or beyond all casters.
  double lengthFrom(const glm::dvec3& start) const;

  bool isDirectional;
  bool hasFace;                    ///< true for a directional light with a box
  glm::dvec3 middle;               ///< centred; for a directional light a direction
  std::vector<glm::dvec3> corners; ///< likewise
  glm::dvec3 onFace, toLight;      ///< a point of the face, centred, and its unit normal
  Bounds castersCentred;
};

/// Proves that casters block all shadow rays from a box to a light, so that tracing them would find
/// the same. A blocker is one triangle, or several of a surface that share edges bit by bit. It
/// need be neither flat nor convex. docs/theory/blockers.md is the proof; F below is its edge
/// function.
class UmbraProof
{
public:
  /// @param from around the starts of all rays, centred; not empty
  /// @param hits of the same snapshot; finds a blocker's triangles
  UmbraProof(
    const Bounds& from, const RayEnds& ends, const Occluders& occluders, const CasterHits& hits);

  /// True if a blocker is found that blocks all rays.
  /// @param triangle tried first, if set; set to a triangle of the blocker if one is found
  bool finds(std::optional<std::uint32_t>& triangle) const;

private:
  struct Ray
  {
    glm::dvec3 start, end;
  };
  struct Triangle;

  bool isBlockedBy(std::uint32_t triangle) const;
  double leftOf(const glm::dvec3& a, const glm::dvec3& b, const Ray& ray) const;
  std::optional<Ray> rayBeside(const glm::dvec3& a, const glm::dvec3& b) const;
  bool isBetween(const Triangle& triangle) const;
  template <typename Visit>
  bool visitHits(const Ray& ray, const Visit& visit) const;
  double farthest(const glm::dvec3& corner) const;

  const RayEnds& ends_;
  const Occluders& occluders_;
  const CasterHits& hits_;
  std::array<glm::dvec3, 8> starts_;
  glm::dvec3 middle_;
  double radius_;
  double longest_; ///< of the directions
};

} // namespace gnomon
