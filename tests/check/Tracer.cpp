#include "Tracer.h"

#include <algorithm>
#include <vector>

namespace gnomon::check
{

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The most triangles of a leaf.
constexpr std::size_t leafSize = 4;

/// A triangle by its numbers, with its middle.
struct Leaf
{
  std::size_t surface;
  std::size_t triangle;
  Vec3 middle;
};

struct Extent
{
  Vec3 low{ infinite };
  Vec3 high{ -infinite };

  void add(const Vec3& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->low[axis] = std::min(this->low[axis], point[axis]);
      this->high[axis] = std::max(this->high[axis], point[axis]);
    }
  }

  /// True if a ray passes the box before `end`.
  bool meets(const Ray& ray, double end) const
  {
    double from = 0.0, to = end;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = (this->low[axis] - ray.origin[axis]) / ray.direction[axis];
      const double b = (this->high[axis] - ray.origin[axis]) / ray.direction[axis];
      // NaN, of a ray that lies in the box's side, limits nothing.
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    return from <= to * (1.0 + 1e-12); // more than their rounding
  }
};

Vec3 pointAt(const Ray& ray, double distance)
{
  return ray.origin + distance * ray.direction;
}

Vec3 nearestPointOfEdge(const Vec3& point, const Vec3& a, const Vec3& b)
{
  const Vec3 edge = b - a;
  const double along = std::clamp((point - a).dot(edge) / edge.dot(edge), 0.0, 1.0);
  return a + along * edge;
}

} // namespace

std::optional<double> intersect(const Ray& ray, const Triangle& triangle)
{
  const Vec3 a = triangle[0] - ray.origin;
  const Vec3 b = triangle[1] - ray.origin;
  const Vec3 c = triangle[2] - ray.origin;
  const double u = ray.direction.dot(b.cross(c));
  const double v = ray.direction.dot(c.cross(a));
  const double w = ray.direction.dot(a.cross(b));
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  if (!inside)
  {
    return std::nullopt;
  }
  const Vec3 normal = (b - a).cross(c - a);
  const double along = ray.direction.dot(normal);
  if (along == 0.0) // the ray lies in the triangle's plane
  {
    return std::nullopt;
  }
  const double distance = a.dot(normal) / along;
  return distance > 0.0 && distance < ray.length ? std::optional(distance) : std::nullopt;
}

Vec3 nearestPoint(const Vec3& point, const Triangle& triangle)
{
  const auto& [a, b, c] = triangle;
  const Vec3 normal = (b - a).cross(c - a);
  const auto insideOf = [&](const Vec3& from, const Vec3& to)
  { return (to - from).cross(point - from).dot(normal) >= 0.0; };
  if (insideOf(a, b) && insideOf(b, c) && insideOf(c, a))
  {
    return point - (point - a).dot(normal) / normal.dot(normal) * normal;
  }
  Vec3 nearest = nearestPointOfEdge(point, a, b);
  for (const Vec3& other : { nearestPointOfEdge(point, b, c), nearestPointOfEdge(point, c, a) })
  {
    if ((other - point).length() < (nearest - point).length())
    {
      nearest = other;
    }
  }
  return nearest;
}

struct Tracer::Impl
{
  const Scene& scene;
  std::vector<Leaf> leaves;
  std::vector<Extent> boxes; ///< of a binary tree, as in a heap; each child has half of the leaves

  explicit Impl(const Scene& of)
    : scene(of)
  {
    for (std::size_t surface = 0; surface < of.surfaces.size(); ++surface)
    {
      for (std::size_t i = 0; i < of.surfaces[surface].triangles.size(); ++i)
      {
        const auto& [a, b, c] = of.surfaces[surface].triangles[i];
        this->leaves.push_back({ surface, i, (a + b + c) / 3.0 });
      }
    }
    this->split(0, 0, this->leaves.size());
  }

  const Triangle& triangleOf(const Leaf& leaf) const
  {
    return this->scene.surfaces[leaf.surface].triangles[leaf.triangle];
  }

  /// Halve leaves along the longest side of their middles' box, down to a few.
  void split(std::size_t node, std::size_t first, std::size_t end)
  {
    Extent box, middles;
    for (std::size_t i = first; i < end; ++i)
    {
      const Triangle& triangle = this->triangleOf(this->leaves[i]);
      std::for_each(triangle.begin(), triangle.end(), [&](const Vec3& corner) { box.add(corner); });
      middles.add(this->leaves[i].middle);
    }
    this->boxes.resize(std::max(this->boxes.size(), node + 1));
    this->boxes[node] = box;
    if (end - first > leafSize)
    {
      const Vec3 size = middles.high - middles.low;
      const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
      const std::size_t half = (first + end) / 2;
      Leaf* const all = this->leaves.data();
      std::nth_element(all + first, all + half, all + end,
        [axis](const Leaf& a, const Leaf& b) { return a.middle[axis] < b.middle[axis]; });
      this->split(2 * node + 1, first, half);
      this->split(2 * node + 2, half, end);
    }
  }

  /// Visit the leaves of all boxes that are met, until a visit returns true.
  template <typename Meets, typename Visit>
  bool visit(const Meets& meets, const Visit& visitLeaf) const
  {
    return this->visit(meets, visitLeaf, 0, 0, this->leaves.size());
  }
  template <typename Meets, typename Visit>
  bool visit(const Meets& meets, const Visit& visitLeaf, std::size_t node, std::size_t first,
    std::size_t end) const
  {
    const std::size_t half = (first + end) / 2;
    const Leaf* const all = this->leaves.data();
    return meets(this->boxes[node]) &&
      (end - first <= leafSize ? std::any_of(all + first, all + end, visitLeaf)
                               : this->visit(meets, visitLeaf, 2 * node + 1, first, half) ||
            this->visit(meets, visitLeaf, 2 * node + 2, half, end));
  }

  /// Return the distance at which a leaf stops a ray, if it has no hole there.
  std::optional<double> hit(const Ray& ray, const Leaf& leaf) const
  {
    const std::optional<double> distance = intersect(ray, this->triangleOf(leaf));
    return distance &&
        isDrawn(this->scene.surfaces[leaf.surface], leaf.triangle, pointAt(ray, *distance))
      ? distance
      : std::nullopt;
  }
};

Tracer::Tracer(const Scene& scene)
  : impl_(std::make_unique<Impl>(scene))
{
}

Tracer::~Tracer() = default;

std::optional<Hit> Tracer::nearest(const Ray& ray) const
{
  std::optional<Hit> found;
  double end = infinite;
  this->impl_->visit([&](const Extent& box) { return box.meets(ray, end); },
    [&](const Leaf& leaf)
    {
      const std::optional<double> distance = this->impl_->hit(ray, leaf);
      if (distance && *distance < end)
      {
        end = *distance;
        found = Hit{ pointAt(ray, end), end, leaf.surface, leaf.triangle };
      }
      return false;
    });
  return found;
}

bool Tracer::blocked(const Ray& ray) const
{
  return this->impl_->visit([&](const Extent& box) { return box.meets(ray, ray.length); },
    [&](const Leaf& leaf)
    {
      const Surface& surface = this->impl_->scene.surfaces[leaf.surface];
      const auto& [a, b, c] = surface.triangles[leaf.triangle];
      const bool isFront = (b - a).cross(c - a).dot(ray.direction) > 0.0;
      return surface.casts && (isFront || !surface.oneSided) && this->impl_->hit(ray, leaf);
    });
}

std::optional<Hit> Tracer::nearestTo(
  const Vec3& point, double distance, const std::function<bool(const Triangle&)>& accepts) const
{
  std::optional<Hit> found;
  double least = distance;
  this->impl_->visit(
    [&](const Extent& box)
    {
      Vec3 inside = point;
      for (int axis = 0; axis < 3; ++axis)
      {
        inside[axis] = std::clamp(point[axis], box.low[axis], box.high[axis]);
      }
      return (point - inside).length() <= distance;
    },
    [&](const Leaf& leaf)
    {
      const Triangle& triangle = this->impl_->triangleOf(leaf);
      const Vec3 nearest = nearestPoint(point, triangle);
      const double from = (point - nearest).length();
      if (from <= least && accepts(triangle))
      {
        least = from;
        found = Hit{ nearest, from, leaf.surface, leaf.triangle };
      }
      return false;
    });
  return found;
}

} // namespace gnomon::check
