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

/// What a camera ray meets first.
struct Hit
{
  Vec3 position; ///< world coordinates
  double distance = 0.0;
  std::size_t surface = 0;
  std::size_t triangle = 0; ///< within its surface
};

/// Distance along a ray to a triangle. The ray passes inside when it turns the same way round all
/// three edges; two triangles get an edge's number with opposite signs, bit for bit, so no ray
/// slips between them.
std::optional<double> intersect(const Ray& ray, const Triangle& triangle);

/// The point of a triangle that is nearest to a point.
Vec3 nearestPoint(const Vec3& point, const Triangle& triangle);

/// Rays against a scene. Embree finds the triangles whose boxes a ray passes; whether and where it
/// meets them is computed in double precision, so that nothing but the input is rounded to float.
class Tracer
{
public:
  /// The scene must outlive the tracer.
  explicit Tracer(const Scene& scene);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// The nearest of all surfaces. A ray through an edge meets at least one of its triangles.
  std::optional<Hit> nearest(const Ray& ray) const;

  /// Whether a surface that casts is in the way.
  bool blocked(const Ray& ray) const;

  /// The point nearest to a point of all triangles that are accepted and as near as `distance`; its
  /// own distance is that from the point.
  std::optional<Hit> nearestTo(
    const Vec3& point, double distance, const std::function<bool(const Triangle&)>& accepts) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::check
