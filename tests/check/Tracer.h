#pragma once

#include "Scene.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace gnomon::check
{

/// A ray in world coordinates.
struct Ray
{
  Vec3 origin;
  Vec3 direction; ///< unit
  double length = std::numeric_limits<double>::infinity();
};

/// The first hit of a camera ray.
struct Hit
{
  Vec3 position; ///< world coordinates
  double distance = 0.0;
  std::size_t surface = 0;
  std::size_t triangle = 0; ///< within its surface
};

/// Return the distance along a ray to a triangle. The ray is inside if it passes all three edges in
/// the same sense of rotation. Two triangles get an edge's number with opposite signs, bit for bit,
/// so no ray slips between them.
std::optional<double> intersect(const Ray& ray, const Triangle& triangle);

/// Return the point of a triangle that is nearest to a point.
Vec3 nearestPoint(const Vec3& point, const Triangle& triangle);

/// Traces rays against a scene, in double precision, by a tree of boxes.
class Tracer
{
public:
  /// The scene must outlive the tracer.
  explicit Tracer(const Scene& scene);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Return the nearest hit of all surfaces. A ray through an edge meets at least one of its
  /// triangles.
  std::optional<Hit> nearest(const Ray& ray) const;

  /// True if a surface that casts blocks the ray.
  bool blocked(const Ray& ray) const;

  /// Return the point nearest to a point, of all accepted triangles within `distance`. The hit's
  /// distance is measured from the point.
  std::optional<Hit> nearestTo(
    const Vec3& point, double distance, const std::function<bool(const Triangle&)>& accepts) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::check
