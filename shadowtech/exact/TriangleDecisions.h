#pragma once

#include "lights/LightSpace.h"
#include "lights/ShadowLight.h"
#include "shadowtech/base/Bytes.h"
#include "shadowtech/base/Certainty.h"
#include "shadowtech/base/Occluders.h"
#include "shadowtech/base/PlacedTriangles.h"
#include "shadowtech/base/ShadowRay.h"
#include "shadowtech/exact/ConservativeMap.h"

#include <glm/glm.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon
{

/// The decisions for whole receiving triangles. Either side of a triangle is turned away from the
/// light, all lit, all in shadow, reached by the light without being decided, or uncertain.
/// Triangles of instances stay uncertain.
///
/// Only the size of pixels depends on the camera. So a frame looks up triangles, and pixels only of
/// triangles that are undecided.
class TriangleDecisions
{
public:
  TriangleDecisions() = default;
  /// @param maps of all views of the light
  TriangleDecisions(
    const ShadowLight& light, const Occluders& occluders, const std::vector<ConservativeMap>& maps)
    : positional_(light.kind != LightKind::Directional)
    , positionCentred_(light.positionWorld - occluders.frame.centre)
    , limitAtUnit_(std::numeric_limits<double>::infinity())
  {
    if (maps.empty())
    {
      return; // without a map, no bound on rounding is known
    }
    this->ofTriangles_.assign(
      occluders.triangles.size(), packed(Certainty::Uncertain, Certainty::Uncertain));
    std::vector<CasterScene> scenes;
    double lateral = 0.0;
    for (const ConservativeMap& map : maps)
    {
      scenes.push_back(map.sceneOf(occluders));
      lateral = std::max(lateral, scenes.back().lateral);
      // Up to 60 degrees off a view's axis, z is at least half of the distance.
      this->limitAtUnit_ =
        std::min(this->limitAtUnit_, scenes.back().largestOffset(this->positional_ ? 0.5 : 1.0));
    }
    const LightReach reach(light, occluders.frame.centre, lateral);
    const auto decide = [&](const Surface& surface, std::uint32_t triangle)
    {
      const Corners corners = centredCorners(occluders, surface, 0, triangle);
      const glm::dvec3 areaVector = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double doubleArea = glm::length(areaVector);
      const glm::dvec3 normal = areaVector / doubleArea;
      const int facing = doubleArea > 0.0 ? reach.facing(corners, normal) : 0;
      if (facing == 0)
      {
        return;
      }
      Certainty facingSide = Certainty::Uncertain;
      if (reach.holds(corners))
      {
        facingSide = Certainty::Reached;
        const double leastOffset = shadowRayOffset(noiseOf(occluders, surface, 0, triangle, corners,
                                                     glm::vec3(normal), doubleArea),
                                     0.0f) *
          (1.0 - 1e-6);
        const double mostOffset = this->offsetLimit(corners);
        for (std::size_t i = 0;
             i < maps.size() && !isDecided(facingSide) && leastOffset <= mostOfNoise * mostOffset;
             ++i)
        {
          const Certainty certainty =
            maps[i].ask(scenes[i], polygonOf(scenes[i], surface, 0, triangle), leastOffset,
              mostOffset, surface.casts && !surface.oneSided);
          facingSide = isDecided(certainty) ? certainty : facingSide;
        }
      }
      this->ofTriangles_[triangle] = facing > 0 ? packed(facingSide, Certainty::Unreached)
                                                : packed(Certainty::Unreached, facingSide);
    };
    for (const Surface& surface : occluders.surfaces)
    {
      if (surface.receives && !surface.isInstanced())
      {
        tbb::parallel_for(std::uint32_t(0), surface.triangleCount,
          [&](std::uint32_t i) { decide(surface, surface.firstTriangle + i); });
      }
    }
  }

  Certainty of(const ReceiverTriangle& triangle) const
  {
    if (this->ofTriangles_.empty())
    {
      return Certainty::Uncertain;
    }
    const auto certainty =
      static_cast<Certainty>(this->ofTriangles_[triangle.triangle] >> (triangle.back ? 4 : 0) & 15);
    // Receivers in pixels at its edges start farthest off it.
    const bool holds = certainty != Certainty::Lit && certainty != Certainty::Shadow
      ? true
      : shadowRayOffset(0.0f, static_cast<float>(triangle.mostFootprint)) <=
        (1.0 - mostOfNoise) * (1.0 - 1e-6) * this->offsetLimit(triangle.cornersCentred);
    return holds ? certainty : Certainty::Reached;
  }

  std::size_t bytes() const { return bytesOf(this->ofTriangles_); }

private:
  using Corners = std::array<glm::dvec3, 3>;

  /// The light, in double precision and centred coordinates.
  class LightReach
  {
  public:
    /// @param lateral how far rounding may move points, in world units
    LightReach(const ShadowLight& light, const glm::dvec3& centreWorld, double lateral)
      : light_(light)
      , lightFromCentred_(lightFromCentred(light, centreWorld))
      , position_(light.positionWorld - centreWorld)
      , towards_(-glm::normalize(light.directionWorld))
      , margin_(4.0 * lateral)
    {
    }

    /// Return 1 if all of a triangle faces the light, -1 if all of it is turned away, or 0 if
    /// rounding leaves it open (facesLight()).
    /// @param normal of unit length
    int facing(const Corners& corners, const glm::dvec3& normal) const
    {
      constexpr double leastCosine = 1.52587890625e-5; // 2^-16; facesLight() uses 2^-20
      double along = glm::dot(normal, this->towards_);
      double least = leastCosine;
      if (this->light_.kind != LightKind::Directional)
      {
        // This is the same for all points of the triangle, except for the ray's length.
        along = glm::dot(normal, this->position_ - corners[0]);
        double farthest = 0.0;
        for (const glm::dvec3& corner : corners)
        {
          farthest = std::max(farthest, glm::length(this->position_ - corner));
        }
        least = leastCosine * farthest + this->margin_;
      }
      return along > least ? 1 : along < -least ? -1 : 0;
    }

    /// Return true if all of a triangle lies in the light's cone or box, which are convex
    /// (insideCone(), insideBox()).
    bool holds(const Corners& corners) const
    {
      return std::all_of(corners.begin(), corners.end(),
        [this](const glm::dvec3& corner) { return this->holds(corner); });
    }

  private:
    bool holds(const glm::dvec3& corner) const
    {
      if (this->light_.kind == LightKind::Spot)
      {
        const double along = glm::dot(this->position_ - corner, this->towards_);
        const glm::dvec3 across = this->position_ - corner - along * this->towards_;
        const double tangent = std::tan(glm::radians(this->light_.coneAngleDegrees));
        return glm::length(across) + this->margin_ <=
          tangent * (along - this->margin_) * (1.0 - 1e-6);
      }
      if (this->light_.box)
      {
        const glm::dvec3 position(this->lightFromCentred_ * glm::dvec4(corner, 1.0));
        return std::abs(position.x) + this->margin_ <= 0.5 * this->light_.box->width &&
          std::abs(position.y) + this->margin_ <= 0.5 * this->light_.box->height &&
          position.z >= this->margin_ && position.z + this->margin_ <= this->light_.box->depth;
      }
      return true;
    }

    const ShadowLight& light_;
    glm::dmat4 lightFromCentred_;
    glm::dvec3 position_;
    glm::dvec3 towards_;
    double margin_;
  };

  /// The largest share of the offset's limit for a triangle's own noise. The rest is for pixels.
  static constexpr double mostOfNoise = 1.0 / 8.0;

  /// Return both sides' certainties as one number.
  static std::uint8_t packed(Certainty front, Certainty back)
  {
    return static_cast<std::uint8_t>(
      static_cast<unsigned int>(front) | static_cast<unsigned int>(back) << 4);
  }

  /// Return how far off a triangle shadow rays may start, in world units.
  double offsetLimit(const std::array<glm::dvec3, 3>& corners) const
  {
    if (!this->positional_)
    {
      return this->limitAtUnit_;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : corners)
    {
      nearest = std::min(nearest, glm::length(corner - this->positionCentred_));
    }
    return this->limitAtUnit_ * nearest;
  }

  /// For each triangle of the snapshot, the front's Certainty in the lower four bits, the back's in
  /// the upper.
  std::vector<std::uint8_t> ofTriangles_;
  bool positional_ = false;
  glm::dvec3 positionCentred_{ 0.0 };
  double limitAtUnit_ = 0.0; ///< offsetLimit() of a positional light at distance 1
};

} // namespace gnomon
