#pragma once

#include "lights/Bounds.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/tracing/CasterHits.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon
{

struct Occluders;

/// The ends of a light's shadow rays: the convex hull of some points, or of some directions.
struct RayEnds
{
  RayEnds(const ShadowLight& light, const Occluders& occluders)
    : isDirectional(light.kind == LightKind::Directional)
    , hasFace(light.box)
    , castersCentred(occluders.castersCentred)
  {
    const ShadowRayLight rays(light, occluders.frame.centre);
    this->onFace = rays.position;
    this->toLight = rays.toLight;
    this->middle = this->isDirectional ? this->toLight : this->onFace;
    if (!light.area)
    {
      this->corners = { this->middle };
      return;
    }
    for (const glm::dvec3& corner : Bounds{ glm::dvec3(-1.0), glm::dvec3(1.0) }.corners())
    {
      this->corners.push_back(this->middle + light.area->worldFromUnit * corner);
    }
  }

  /// Return the length of a directional light's ray, in lengths of its direction: to its box's near
  /// face, or beyond all casters.
  double lengthFrom(const glm::dvec3& start) const
  {
    return this->hasFace
      ? glm::dot(this->onFace - start, this->toLight)
      : glm::distance(start, this->castersCentred.centre()) + this->castersCentred.radius();
  }

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
    const Bounds& from, const RayEnds& ends, const Occluders& occluders, const CasterHits& hits)
    : ends_(ends)
    , occluders_(occluders)
    , hits_(hits)
    , starts_(from.corners())
    , middle_(from.centre())
    , radius_(from.radius())
    , longest_(0.0)
  {
    for (const glm::dvec3& corner : ends.corners)
    {
      this->longest_ =
        std::max(this->longest_, ends.isDirectional ? glm::length(corner) : this->farthest(corner));
    }
  }

  /// True if a blocker is found that blocks all rays.
  /// @param triangle tried first, if set; set to a triangle of the blocker if one is found
  bool finds(std::optional<std::uint32_t>& triangle) const
  {
    if (triangle && this->isBlockedBy(*triangle))
    {
      return true;
    }
    return this->visitHits({ this->middle_, this->ends_.middle },
      [&](std::uint32_t hit)
      {
        const bool blocks = this->isBlockedBy(hit);
        triangle = blocks ? hit : triangle;
        return blocks;
      });
  }

private:
  /// The bound of rounding, as a share of (longest edge + farthest corner) times the product's
  /// other lengths. Let u = 2^-24, E the longest edge, R the distance of the farthest corner from a
  /// ray's start and D the longest direction. Corners relative to the start are off by u R, edges
  /// by u (E + 2R), directions by 4u D. The cross product of two products and a subtraction adds 7u
  /// E R, the dot product 3u. So F is off by less than 40u (E + R) R D. Likewise distances to the
  /// plane are off by less than 40u (E + R) E R. This constant is 64u.
  static constexpr double productNoise = 1.0 / 262144.0; // 2^-18

  /// The most triangles of one blocker.
  static constexpr std::size_t mostTriangles = 8;

  /// The most hits along a ray.
  static constexpr int mostHits = 8;

  static const Surface& surfaceOf(const Occluders& occluders, std::uint32_t triangle)
  {
    const auto next =
      std::upper_bound(occluders.surfaces.begin(), occluders.surfaces.end(), triangle,
        [](std::uint32_t of, const Surface& surface) { return of < surface.firstTriangle; });
    return *std::prev(next);
  }

  struct Ray
  {
    glm::dvec3 start, end;
  };
  /// A triangle as the light sees it.
  struct Triangle
  {
    std::array<glm::dvec3, 3> corners; ///< counter-clockwise
    bool isBack;                       ///< the light sees its back

    Triangle(const Occluders& occluders, std::uint32_t triangle)
      : isBack(false)
    {
      for (glm::length_t i = 0; i < 3; ++i)
      {
        this->corners[static_cast<std::size_t>(i)] =
          occluders.positionsCentred[occluders.triangles[triangle][i]];
      }
    }

    glm::dvec3 normal() const
    {
      return glm::cross(this->corners[1] - this->corners[0], this->corners[2] - this->corners[0]);
    }

    void turnOver()
    {
      std::swap(this->corners[1], this->corners[2]);
      this->isBack = !this->isBack;
    }

    /// Rotate or turn over the corners so that they begin with an edge. False if the triangle does
    /// not have it.
    bool beginWith(const glm::dvec3& from, const glm::dvec3& to)
    {
      for (int side = 0; side < 2; ++side)
      {
        for (int i = 0; i < 3; ++i)
        {
          if (this->corners[0] == from && this->corners[1] == to)
          {
            return true;
          }
          std::rotate(this->corners.begin(), this->corners.begin() + 1, this->corners.end());
        }
        this->turnOver();
      }
      return false;
    }
  };

  /// True if all rays are blocked by a triangle, or by a blocker grown from it: over edges that
  /// rays pass on the wrong side, to the triangles beside them.
  bool isBlockedBy(std::uint32_t first) const
  {
    struct Edge
    {
      glm::dvec3 from, to;
    };
    const auto mayBlock = [&](const Triangle& triangle, std::uint32_t number)
    {
      return !(triangle.isBack && surfaceOf(this->occluders_, number).oneSided) &&
        this->isBetween(triangle);
    };

    const Surface& surface = surfaceOf(this->occluders_, first);
    Triangle triangle(this->occluders_, first);
    const glm::dvec3 direction =
      this->ends_.isDirectional ? this->ends_.middle : this->ends_.middle - this->middle_;
    if (glm::dot(triangle.normal(), direction) < 0.0)
    {
      triangle.turnOver();
    }
    if (!mayBlock(triangle, first))
    {
      return false;
    }
    const auto& [a, b, c] = triangle.corners;
    std::vector<Edge> unproven{ { a, b }, { b, c }, { c, a } };
    std::size_t triangles = 1;
    while (!unproven.empty())
    {
      const Edge edge = unproven.back();
      unproven.pop_back();
      const std::optional<Ray> beside = this->rayBeside(edge.from, edge.to);
      if (!beside)
      {
        continue;
      }
      const auto growTo = [&](std::uint32_t number)
      {
        Triangle next(this->occluders_, number);
        if (&surfaceOf(this->occluders_, number) != &surface ||
          !next.beginWith(edge.to, edge.from) || !mayBlock(next, number))
        {
          return false;
        }
        unproven.push_back({ edge.from, next.corners[2] });
        unproven.push_back({ next.corners[2], edge.to });
        return true;
      };
      if (++triangles > mostTriangles || !this->visitHits(*beside, growTo))
      {
        return false;
      }
    }
    return true;
  }

  /// Return F(A, B) of a ray: positive if it passes the edge on its left.
  double leftOf(const glm::dvec3& a, const glm::dvec3& b, const Ray& ray) const
  {
    const glm::dvec3 direction = this->ends_.isDirectional ? ray.end : ray.end - ray.start;
    return glm::dot(glm::cross(b - a, direction), a - ray.start);
  }

  /// Find a ray that does not certainly pass the edge from a to b on its left.
  /// @return a ray that passes it closely on its right, for finding the triangle there; none if all
  /// rays certainly pass it on its left
  std::optional<Ray> rayBeside(const glm::dvec3& a, const glm::dvec3& b) const
  {
    const double far = std::max(this->farthest(a), this->farthest(b));
    const double sure = productNoise * (glm::distance(a, b) + far) * far * this->longest_;
    const Ray middle{ this->middle_, this->ends_.middle };
    double least = sure;
    Ray rightmost = middle;
    for (const glm::dvec3& end : this->ends_.corners)
    {
      for (const glm::dvec3& start : this->starts_)
      {
        const double left = this->leftOf(a, b, { start, end });
        if (!(left > least))
        {
          least = left;
          rightmost = { start, end };
        }
      }
    }
    if (least == sure)
    {
      return std::nullopt;
    }
    // F is affine, or nearly so between rays to an area.
    const double ofMiddle = this->leftOf(a, b, middle);
    const double share =
      ofMiddle > least ? std::clamp(ofMiddle / (ofMiddle - least) + 0.05, 0.0, 2.0) : 1.0;
    return Ray{ glm::mix(middle.start, rightmost.start, share),
      glm::mix(middle.end, rightmost.end, share) };
  }

  /// True if all rays certainly start behind a triangle's plane and end in front of it, as the
  /// light sees it.
  bool isBetween(const Triangle& triangle) const
  {
    const auto& [a, b, c] = triangle.corners;
    const glm::dvec3 normal = triangle.normal();
    const double longestEdge =
      std::max(glm::distance(a, b), std::max(glm::distance(b, c), glm::distance(c, a)));
    const double far = std::max(this->farthest(a), std::max(this->farthest(b), this->farthest(c)));
    const double noise = productNoise * (longestEdge + far) * longestEdge; // per unit of length
    const auto isBehind = [&, a = a](const glm::dvec3& start)
    { return glm::dot(normal, a - start) > noise * far; };
    const auto endsInFront = [&, a = a](const glm::dvec3& end)
    {
      if (!this->ends_.isDirectional)
      {
        return glm::dot(normal, end - a) > noise * (far + this->longest_);
      }
      // Rays from the face itself extend a little beyond it, which takes them farther to the front.
      return glm::dot(normal, end) > noise * this->longest_ &&
        (!this->ends_.hasFace ||
          std::all_of(this->starts_.begin(), this->starts_.end(),
            [&](const glm::dvec3& start)
            {
              const double length = this->ends_.lengthFrom(start);
              return glm::dot(normal, start + length * end - a) >
                noise * (far + std::abs(length) * this->longest_);
            }));
    };
    return std::all_of(this->starts_.begin(), this->starts_.end(), isBehind) &&
      std::all_of(this->ends_.corners.begin(), this->ends_.corners.end(), endsInFront);
  }

  /// Call `visit` with triangles on a ray, from the light's end on, until it returns true:
  /// triangles next to a lamp hide it from most receivers.
  /// @return true if `visit` did
  template <typename Visit>
  bool visitHits(const Ray& ray, const Visit& visit) const
  {
    const glm::dvec3 from =
      this->ends_.isDirectional ? ray.start + this->ends_.lengthFrom(ray.start) * ray.end : ray.end;
    float after = 0.0f;
    for (int i = 0; i < mostHits; ++i)
    {
      const std::optional<CasterHits::Hit> hit =
        this->hits_.nearest(glm::vec3(from), glm::vec3(ray.start - from), after, 1.0f);
      if (!hit)
      {
        return false;
      }
      const Surface& surface = this->occluders_.surfaces[hit->surface];
      const bool isWhole = !surface.cutout && !surface.isInstanced(); // solids are instances
      if (isWhole && visit(hit->triangle))
      {
        return true;
      }
      after = std::nextafter(hit->at, 2.0f);
    }
    return false;
  }

  /// Return the largest distance of a point from the start of a ray.
  double farthest(const glm::dvec3& corner) const
  {
    return glm::distance(corner, this->middle_) + this->radius_;
  }

  const RayEnds& ends_;
  const Occluders& occluders_;
  const CasterHits& hits_;
  std::array<glm::dvec3, 8> starts_;
  glm::dvec3 middle_;
  double radius_;
  double longest_; ///< of the directions
};

} // namespace gnomon
